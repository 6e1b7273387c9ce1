# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""One design, from an empty folder to its outcome. Started by the workflow
engine:

    python3 -m morphfoam.study.worker STUDYFILE SNAPSHOT STRATEGY NUMBER

SNAPSHOT is the study file as it was when the sweep started; STRATEGY baseline
with number 0 is the baseline. Exits with 0 once there is an outcome, be it a
failure, and with 1 without one or where the baseline fails, as the designs
cannot start without it."""

import contextlib
import datetime
import fcntl
import os
import re
import shutil
import sys

from . import (
    case_folder,
    designs,
    failures,
    outcomes,
    process,
    responses,
)
from .errors import StudyError
from .study_file import DRY_RUN, Strategy, StudyFile


class DesignFailed(Exception):
    """The reason that is recorded."""


def environment(study, case):
    """Of what runs in a case folder."""
    return {
        **os.environ,
        "PWD": str(case),
        "MORPHSTUDY_TEMPLATE": str(study.template),
        "MORPHSTUDY_STUDY": str(study.root),
        "MORPHSTUDY_BASELINE": str(outcomes.case(study, outcomes.BASELINE)),
    }


def copy_baseline(study, case):
    """The baseline's case, with what was corrected in the template since;
    the baseline's outcome."""
    case_folder.copy_case(outcomes.case(study, outcomes.BASELINE), case)
    baseline = outcomes.read(study, outcomes.BASELINE)
    case_folder.copy_files(
        study, case_folder.corrections(study, baseline)[0], case
    )
    return baseline


class Worker:
    """One design or the baseline."""

    def __init__(self, study, strategy, number):
        self.study, self.number = study, number or None
        if strategy == outcomes.BASELINE:
            self.strategy = Strategy(
                strategy, "template", study.baseline_steps
            )
            self.parameters = dict(study.baseline)
            self.designs = []
        else:
            self.strategy = study.strategy(strategy)
            self.designs = designs.read(study)
            self.parameters = next(
                d.parameters for d in self.designs if d.number == number
            )
        self.dry = strategy.endswith(DRY_RUN)
        self.case = outcomes.case(study, strategy, self.number)

    def environment(self):
        return environment(self.study, self.case)

    def reader(self):
        return responses.Reader(
            self.study,
            self.case,
            self.parameters,
            self.environment(),
            None
            if self.strategy.name == outcomes.BASELINE
            else outcomes.baseline_values(self.study),
        )

    def work(self):
        """Make, run, read; again where it fails and retries are left."""
        for attempt in range(1, self.study.retries + 2):
            self.outcome = self.blank(attempt)
            try:
                self.make_case()
                self.run_steps()
                if not self.dry:
                    reader = self.reader()
                    self.outcome.responses = reader.responses()
                    self.outcome.gradients = reader.gradients()
                status, reason = outcomes.DONE, ""
            except (
                DesignFailed,
                StudyError,
                responses.ResponseError,
            ) as error:
                status, reason = outcomes.FAILED, str(error)
            self.outcome.status, self.outcome.reason = status, reason
            if status == outcomes.DONE:
                break
        self.read_what_there_is()
        if status == outcomes.DONE and not self.dry:
            self.take_picture()
        self.outcome.finished = datetime.datetime.now().isoformat(
            timespec="seconds"
        )
        outcomes.write(self.study, self.outcome)
        return status

    def blank(self, attempt):
        """The outcome before anything is done."""
        study, values = self.study, self.study.values(self.parameters)
        return outcomes.Outcome(
            strategy=self.strategy.name,
            number=self.number,
            parameters=self.parameters,
            derived={d.name: float(values[d.name]) for d in study.derived},
            attempts=attempt,
            template_hash=case_folder.template_hash(study),
            response_texts=outcomes.response_texts(study),
            made=outcomes.recipe(study, self.strategy.name),
        )

    def make_case(self):
        """The case folder, anew."""
        shutil.rmtree(self.case, ignore_errors=True)
        self.case.parent.mkdir(parents=True, exist_ok=True)
        if self.strategy.start == "template":
            case_folder.copy_template(self.study, self.case)
        else:
            baseline = copy_baseline(self.study, self.case)
            self.outcome.started_from = outcomes.BASELINE
            self.outcome.baseline_made = baseline.finished
            if self.strategy.start == "nearest":
                self.take_nearest_fields()
        case_folder.write_parameters(self.study, self.case, self.parameters)
        if self.strategy.name == outcomes.BASELINE:
            self.outcome.template_files = case_folder.digests(
                self.study, self.case
            )

    def take_nearest_fields(self):
        """Of the nearest design with a smaller number that did not fail."""
        for number in nearer(self.study, self.designs, self.number):
            if outcomes.is_done(
                outcomes.read(self.study, self.strategy.name, number)
            ):
                case_folder.replace_fields(
                    outcomes.case(self.study, self.strategy.name, number),
                    self.case,
                )
                self.outcome.started_from = f"{number:04d}"
                return

    def run_steps(self):
        for step in self.strategy.steps:
            log = self.case / f"log.{step.name}"
            status, wall, cpu = process.run(
                step.run, self.case, log, step.timeout, self.environment()
            )
            self.outcome.wall[step.name] = round(wall, 3)
            self.outcome.cpu[step.name] = round(cpu, 3)
            if status is None:
                raise DesignFailed(
                    f"{step.name}: timeout after {step.timeout:g} s"
                )
            if status != 0:
                raise DesignFailed(f"{step.name}: {failures.why(log, status)}")
            if step.expect and not re.search(
                step.expect, log.read_text(errors="replace"), re.MULTILINE
            ):
                raise DesignFailed(
                    f"{step.name}: its log does not say" f" '{step.expect}'"
                )

    def read_what_there_is(self):
        """Iterations, notes, the mesh: of a failed design as well."""
        step = self.study.iteration_step or self.strategy.steps[-1].name
        log = self.case / f"log.{step}"
        if log.exists():
            self.outcome.iterations = len(
                re.findall(
                    self.study.iteration_regex,
                    log.read_text(errors="replace"),
                    re.MULTILINE,
                )
            )
        reader = self.reader()
        reader.known.update(self.outcome.responses)
        self.outcome.notes = reader.notes()
        with contextlib.suppress(responses.ResponseError):
            names, rows = responses.columns(
                responses.newest(
                    self.case, "postProcessing/**/morphMesh/*/quality.dat"
                )
            )
            self.outcome.quality = {
                name: float(word)
                for name, word in zip(names, rows[-1])
                if re.match(r"[-+]?[.\d]", word)
            }
        self.read_safe_scale()
        with contextlib.suppress(responses.ResponseError):
            text = responses.newest(
                self.case, "postProcessing/**/morphMesh/*/motion"
            ).read_text()
            self.outcome.motion = {
                name: float(value)
                for name, value in re.findall(
                    r"^(attainable|moved)\s+(\S+);", text, re.MULTILINE
                )
            }

    def read_safe_scale(self):
        """How far a lattice goes that folds: morphMesh ends before it has a
        mesh to judge."""
        for step in self.strategy.steps:
            log = self.case / f"log.{step.name}"
            if log.exists():
                scale = failures.safe_scale(log.read_text(errors="replace"))
                if scale is not None:
                    self.outcome.motion = {"attainable": scale}

    def take_picture(self):
        if not self.study.picture:
            return
        process.run(
            self.study.picture,
            self.case,
            self.case / "log.picture",
            600,
            self.environment(),
        )
        file = self.case / "picture.png"
        self.outcome.picture = (
            str(file.relative_to(self.study.folder))
            if file.exists()
            else f"none: see {file.parent.name}/log.picture"
        )


def nearer(study, designs_, number):
    """The designs with smaller numbers that are nearer to this one than the
    baseline is, the nearest first; distances in units of the bounds. Which they
    are depends on the table of designs alone, not on who finished first."""
    span = study.highs - study.lows

    def distance(a, b):
        return sum(((a[n] - b[n]) / s) ** 2 for n, s in zip(study.names, span))

    own = next(d.parameters for d in designs_ if d.number == number)
    limit = distance(own, study.baseline)
    found = sorted(
        (distance(own, d.parameters), d.number)
        for d in designs_
        if d.number < number
    )
    return [n for far, n in found if far < limit]


def is_engine(pid):
    """Whether a process is Snakemake, which starts the workers."""
    with contextlib.suppress(OSError), open(
        f"/proc/{pid}/cmdline", "rb"
    ) as file:
        return b"snakemake" in file.read()
    return False


def main(arguments):
    path, snapshot, strategy, number = arguments
    process.die_with_parent(is_engine)
    study = StudyFile(path, snapshot)
    number = int(number)
    lock = study.folder / "outcomes" / f".lock.{strategy}.{number}"
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as held:
        # Another sweep's worker may still be at it, on a cluster
        fcntl.flock(held, fcntl.LOCK_EX)
        outcome = outcomes.read(study, strategy, number or None)
        if outcome and (outcome.status == outcomes.DONE or number):
            status = outcome.status
        else:
            status = Worker(study, strategy, number).work()
    lock.unlink(missing_ok=True)
    return 1 if strategy == outcomes.BASELINE and status != "done" else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
