# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb run: what is not finished, by Snakemake.

Outcomes alone say what is finished, so that this can be killed at any moment:
each call plans anew what is missing, and the engine's own memory is thrown away.
"""

import contextlib
import fcntl
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

from . import (
    case_folder,
    check,
    designs,
    outcomes,
    process,
    responses,
    results,
    worker,
)
from .errors import StudyError
from .study_file import DRY_RUN

# Where the package is, for the workers
HOME = Path(__file__).resolve().parents[2]

# Of clusters, by name
PROFILES = Path(__file__).resolve().with_name("profiles")


@contextlib.contextmanager
def only_one(study):
    """Two sweeps at once would make each other's folders."""
    study.folder.mkdir(parents=True, exist_ok=True)
    with (study.folder / ".lock").open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise StudyError(
                f"another morphStudy is at work in {study.folder}."
                " Wait for it, or stop it first"
            ) from None
        yield


def selected(study, only):
    """The designs to run."""
    all_ = designs.read(study)
    if not all_:
        raise StudyError(
            f"there are no designs in {study.folder}. Choose them"
            f" first: morphStudy sample {study.path.name}"
        )
    for design in all_:
        # Differences may step across
        broken = study.broken(design.parameters)
        if broken and design.origin != designs.GRADIENT:
            raise StudyError(
                f"design {design.id} breaks the constraint {broken[0]}: the"
                " constraints have changed since it was sampled. Remove its row"
                " of designs.csv with its outcomes, or use another folder"
            )
    unknown = set(only) - {d.number for d in all_}
    if unknown:
        raise StudyError(
            f"there is no design {min(unknown)}; the designs are"
            f" 1 to {all_[-1].number}"
        )
    return [d for d in all_ if not only or d.number in only]


def forget(study, strategy, chosen, redo):
    """Remove the outcomes of designs that are to be made again."""
    check_redo(study, chosen, redo)
    if "baseline" in redo:
        forget_baseline(study)
    for design in chosen:
        outcome = outcomes.read(study, strategy, design.number)
        if outcome and (
            design.number in redo or ("failed" in redo and not outcome.done)
        ):
            outcomes.path(study, strategy, design.number).unlink()


def check_redo(study, chosen, redo):
    there = {d.number for d in designs.read(study)}
    for number in redo:
        if number == 0:
            raise StudyError(
                "there is no design 0; what designs start from is called"
                " baseline: -redo baseline"
            )
        if isinstance(number, int) and number not in there:
            raise StudyError(
                f"-redo: there is no design {number}; the designs are 1 to"
                f" {max(there)}"
            )
        if isinstance(number, int) and number not in {
            d.number for d in chosen
        }:
            raise StudyError(
                f"-redo: design {number} is not among those of -only, so that"
                " it would not be made. Add it there"
            )
    if "baseline" in redo and study.baseline_steps is None:
        raise StudyError("-redo baseline: this study has no baseline")


def forget_baseline(study):
    """The baseline and what was made from it, in every strategy."""
    gone = []
    for name, strategy in study.strategies.items():
        if strategy.start == "template":
            continue
        files = [
            outcomes.path(study, name, d.number)
            for d in designs.read(study)
            if outcomes.read(study, name, d.number)
        ]
        for file in files:
            file.unlink()
        if files:
            gone.append(f"{len(files)} of {name}")
    outcomes.path(study, outcomes.BASELINE).unlink(missing_ok=True)
    print(
        "The baseline is made again"
        + (f", and what was made from it: {', '.join(gone)}" if gone else ""),
        flush=True,
    )


def keep_up(study, strategy, numbers, note=True):
    """Stop where finished designs were made in another way than the study file
    says now, or from another baseline; read responses again where only those
    have changed. note: say where the template has changed."""
    baseline = outcomes.read(study, outcomes.BASELINE)
    found = [outcomes.read(study, strategy, n) for n in numbers]
    if study.strategy(strategy).start != "template":
        found.append(baseline)
    found = [outcome for outcome in found if outcome]
    for outcome in found:
        number, name = outcome.number, outcome.strategy
        what = f"design {number:04d} of {name}" if number else "the baseline"
        changed = outcomes.changes(study, name, outcome)
        if changed:
            raise StudyError(
                f"{what} was made with another study file: "
                + ", ".join(changed)
                + " differ. Use another folder, or have it made anew: -redo"
                f" {number or 'baseline'}"
            )
        if (
            number
            and outcome.baseline_made
            and (not baseline or baseline.finished != outcome.baseline_made)
        ):
            raise StudyError(
                f"{what} was made from a baseline that is no more there. Have"
                " the baseline and all that is made from it made anew: -redo"
                " baseline"
            )
        if outcome.response_texts != outcomes.response_texts(study):
            read_again(study, outcome)
    if note:
        note_template(study, found)


def note_template(study, found):
    """A template may be run in and written to: changes are no error."""
    now = case_folder.template_hash(study)
    older = [o for o in found if o.template_hash not in (now, None)]
    if not older:
        return
    names = ", ".join(o.name for o in older[:5])
    advice = "-redo ID or -redo failed makes designs again"
    baseline = next((o for o in found if o.number is None), None)
    if baseline:
        corrected, kept = case_folder.corrections(study, baseline)
        if corrected:
            advice += f" with the template's {listed(corrected)}"
        if kept:
            advice += (
                f"; the baseline's own {listed(kept)} stays until it is made"
                " again"
            )
        advice += (
            "; -redo baseline makes the baseline again, and all that was made"
            " from it"
        )
    print(
        f"Note: {study.template} has changed since {len(older)} of the"
        f" finished designs were made ({names}"
        + (", ..." if len(older) > 5 else "")
        + f"). They stay as they are. {advice}",
        flush=True,
    )


def listed(names):
    return ", ".join(names[:5]) + (", ..." if len(names) > 5 else "")


def read_again(study, outcome):
    if outcome.reason and not outcome.reason.startswith("response"):
        return
    maker = worker.Worker(study, outcome.strategy, outcome.number or 0)
    try:
        reader = maker.reader()
        outcome.responses = reader.responses()
        outcome.gradients = reader.gradients()
        outcome.notes = reader.notes()
        outcome.status, outcome.reason = outcomes.DONE, ""
    except responses.ResponseError as error:
        outcome.status, outcome.reason = outcomes.FAILED, str(error)
        outcome.responses = {}
    outcome.response_texts = outcomes.response_texts(study)
    outcomes.write(study, outcome)


def plan(study, strategy, chosen, snapshot):
    """The jobs that are missing: {name: {command, after}}."""
    jobs = {}

    def add(name, strategy_, number, after):
        jobs[name] = {
            "after": [a for a in after if a in jobs],
            "command": " ".join(
                map(
                    shlex.quote,
                    [
                        "env",
                        f"PYTHONPATH={HOME}",
                        sys.executable,
                        "-m",
                        "morphfoam.study.worker",
                        str(study.path),
                        str(snapshot),
                        strategy_,
                        str(number),
                    ],
                )
            ),
        }

    start = study.strategy(strategy).start
    if study.needs_baseline(strategy) and not outcomes.is_done(
        outcomes.read(study, outcomes.BASELINE)
    ):
        add("baseline", outcomes.BASELINE, 0, [])
    table = designs.read(study)
    for design in chosen:
        if outcomes.read(study, strategy, design.number):
            continue
        after = ["baseline"]
        if start == "nearest":
            after += [
                f"{n:04d}"
                for n in worker.nearer(study, table, design.number)[:1]
            ]
        add(design.id, strategy, design.number, after)
    return jobs


def run(
    study,
    strategy=None,
    cores=None,
    only=(),
    redo=(),
    profile=None,
    dry_run=False,
):
    """Returns the exit status: 0 when every design has an outcome. A dry run
    makes what comes before the solver, always anew, in folders of its own."""
    strategy, cores = prepared(study, strategy, cores, profile)
    chosen = selected(study, only)
    if dry_run:
        strategy += DRY_RUN
        study.strategy(strategy)
        redo = [
            *(w for w in redo if w == "baseline"),
            *(d.number for d in chosen),
        ]
    with only_one(study):
        forget(study, strategy, chosen, redo)
        complete(study, strategy, chosen, cores, profile)
        return results.conclude(study, strategy, chosen)


def prepared(study, strategy, cores, profile):
    """Strategy and cores, by default the first and all; checked."""
    strategy = strategy or next(iter(study.strategies))
    if strategy not in study.strategies:
        raise StudyError(
            f"there is no strategy {strategy}; the strategies are"
            f" {' '.join(study.strategies)}"
        )
    check.check(study, quiet=True)
    cores = cores or len(os.sched_getaffinity(0))
    if not profile and study.cores > cores:
        raise StudyError(
            f"a design takes {study.cores} cores (cores) and there"
            f" are {cores}. Give more (-cores), or let it take"
            " fewer"
        )
    return strategy, cores


def complete(study, strategy, chosen, cores, profile, note=True):
    """Run what is missing of these designs, and the baseline."""
    keep_up(study, strategy, [d.number for d in chosen], note)
    workflow = study.folder / "workflow"
    profile = profile_folder(profile)
    cancel_jobs(workflow, profile)
    shutil.rmtree(workflow, ignore_errors=True)
    workflow.mkdir()
    snapshot = workflow / "study.yaml"
    shutil.copy(study.path, snapshot)
    jobs = plan(study, strategy, chosen, snapshot)
    (workflow / "plan.json").write_text(
        json.dumps({"cores": study.cores, "jobs": jobs}, indent=1)
    )
    if jobs:
        progress = Progress(
            study,
            strategy,
            chosen,
            None if profile else max(1, cores // study.cores),
        )
        engine(study, workflow, cores, profile, progress)


def profile_folder(profile):
    """The folder of a profile of ours, by its name, or of the user's own."""
    if not profile or os.sep in profile or Path(profile).exists():
        return profile
    ours = PROFILES / profile
    if not ours.exists():
        raise StudyError(
            f"there is no profile {profile}. There are"
            f" {' '.join(sorted(p.name for p in PROFILES.iterdir()))}; or give"
            " the folder of a profile of Snakemake, with a / in it"
        )
    return str(ours)


def cancel_jobs(workflow, profile):
    """Jobs of a sweep that was killed would make the same designs again, in the
    same folders."""
    left = [
        job.stem
        for job in workflow.glob("*/*.job")
        if not job.with_suffix(".exit").exists()
    ]
    if not left:
        return
    cancel = Path(profile or PROFILES / "slurm") / "cancel.py"
    if cancel.exists():
        subprocess.run([cancel, *left])
        print(f"{len(left)} jobs of a former run are cancelled", flush=True)


def engine(study, workflow, cores, profile, progress):
    """Run Snakemake and say what it gets done."""
    command = [
        sys.executable,
        "-m",
        "snakemake",
        "--snakefile",
        str(Path(__file__).with_name("Snakefile")),
        "--directory",
        str(workflow),
        "--keep-going",
        "--nolock",
        "--nocolor",
        "--config",
        f"plan={workflow/'plan.json'}",
    ]
    command += ["--profile", profile] if profile else ["--cores", str(cores)]
    with (study.folder / "snakemake.log").open("w") as log:
        engine_ = subprocess.Popen(
            command,
            stdout=log,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            preexec_fn=process.started_here(),
        )
        try:
            while engine_.poll() is None:
                time.sleep(0.2)
                progress.update()
        except KeyboardInterrupt:
            engine_.kill()
            engine_.wait()
            print("\nStopped. The same command goes on from here", flush=True)
            sys.exit(130)
    progress.update()


class Progress:
    """One line for each design that gets its outcome."""

    def __init__(self, study, strategy, chosen, at_once):
        self.study, self.strategy, self.at_once = study, strategy, at_once
        self.waiting, self.start, self.before = [], time.monotonic(), 0
        self.total, self.times, self.finished = len(chosen), [], 0
        for design in chosen:
            outcome = outcomes.read(study, strategy, design.number)
            if outcome:
                self.finished += 1
                self.times.append(outcome.seconds)
            else:
                self.waiting.append(design.number)
        self.baseline = study.needs_baseline(strategy) and (
            not outcomes.is_done(outcomes.read(study, outcomes.BASELINE))
        )
        if self.baseline:
            outcomes.path(study, outcomes.BASELINE).unlink(missing_ok=True)
        self.before = self.finished
        print(
            f"{strategy}: {self.finished} of {self.total} designs are"
            " finished" + (f", {at_once} at once" if at_once else ""),
            flush=True,
        )

    def update(self):
        if self.baseline:
            outcome = outcomes.read(self.study, outcomes.BASELINE)
            if outcome:
                self.baseline = False
                print("baseline: " + describe(outcome), flush=True)
        for number in list(self.waiting):
            outcome = outcomes.read(self.study, self.strategy, number)
            if outcome:
                self.waiting.remove(number)
                self.finished += 1
                self.times.append(outcome.seconds)
                print(
                    f"[{self.finished}/{self.total}] {number:04d}: "
                    f"{describe(outcome)}{self.left()}",
                    flush=True,
                )

    def left(self):
        if not self.waiting:
            return ""
        if self.at_once:
            seconds = time_left(self.times, len(self.waiting), self.at_once)
        else:
            # A cluster runs as many at once as it likes
            seconds = (
                (time.monotonic() - self.start)
                * len(self.waiting)
                / (self.finished - self.before)
            )
        return f"; some {duration(seconds)} left"


def time_left(times, count, at_once):
    """[s] for count designs, from what those before took."""
    return sum(times) / len(times) * -(-count // at_once)


def duration(seconds):
    if seconds < 100:
        return f"{seconds:.0f} s"
    return (
        f"{seconds/60:.0f} min" if seconds < 6000 else f"{seconds/3600:.1f} h"
    )


def describe(outcome):
    times = ", ".join(f"{k} {v:.1f}" for k, v in outcome.wall.items())
    text = outcome.status
    if outcome.reason:
        text += f", {outcome.reason}"
    return f"{text} ({times} s)"
