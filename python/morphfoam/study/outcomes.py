# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The outcome of a design: one file, written last and at once. A design that has
one is finished, whatever its folder looks like; one without is made anew."""

import json
import os
from dataclasses import dataclass, field, fields

DONE, FAILED = "done", "failed"
BASELINE = "baseline"

# What a field is called in the file, where that is not its name
KEYS = {
    "started_from": "startedFrom",
    "baseline_made": "baselineMade",
    "template_hash": "templateHash",
    "template_files": "templateFiles",
    "response_texts": "responseTexts",
}


@dataclass(kw_only=True)
class Outcome:
    """What became of one design of one strategy, or of the baseline.

    number          None: the baseline
    derived         {name: value}, as parameters, responses and notes
    started_from    template, baseline, or the number of the design whose
                    fields it started from
    baseline_made   when the baseline was finished that it is a copy of
    template_hash   of the template when the design was made
    template_files  of the baseline: {file: digest of what was copied, and of
                    the copy with the parameters in it}
    wall, cpu       {step: seconds}
    quality         the last row of morphMesh's table
    motion          attainable and moved fraction of the motion
    iterations      of the solver; None: it was not reached
    picture         its path in the study's folder
    gradients       {response: {parameter: derivative}}, of tables
    made            the recipe, response_texts: how responses are read; what
                    the study file says now is compared with them
    """

    started_from: str = "template"
    baseline_made: str | None = None
    template_hash: str | None = None
    wall: dict = field(default_factory=dict)
    cpu: dict = field(default_factory=dict)
    responses: dict = field(default_factory=dict)
    gradients: dict = field(default_factory=dict)
    notes: dict = field(default_factory=dict)
    quality: dict = field(default_factory=dict)
    motion: dict = field(default_factory=dict)
    iterations: int | None = None
    picture: str = ""
    strategy: str
    number: int | None
    parameters: dict
    derived: dict = field(default_factory=dict)
    attempts: int = 1
    template_files: dict = field(default_factory=dict)
    response_texts: dict = field(default_factory=dict)
    made: dict = field(default_factory=dict)
    status: str = FAILED
    reason: str = ""
    finished: str = ""

    @property
    def done(self):
        return self.status == DONE

    @property
    def name(self):
        return f"{self.number:04d}" if self.number else BASELINE

    @property
    def seconds(self):
        """Wall time of all steps."""
        return sum(self.wall.values())


def path(study, strategy, number=None):
    """Of a design, or of the baseline."""
    folder = study.folder / "outcomes"
    if strategy == BASELINE:
        return folder / "baseline.json"
    return folder / strategy / f"{number:04d}.json"


def case(study, strategy, number=None):
    """The case folder."""
    if strategy == BASELINE:
        return study.folder / BASELINE
    return study.folder / strategy / f"{number:04d}"


def read(study, strategy, number=None):
    """The outcome, or None."""
    file = path(study, strategy, number)
    if not file.exists():
        return None
    content = json.loads(file.read_text())
    return Outcome(
        **{
            f.name: content[KEYS.get(f.name, f.name)]
            for f in fields(Outcome)
            if KEYS.get(f.name, f.name) in content
        }
    )


def write(study, outcome):
    file = path(study, outcome.strategy, outcome.number)
    file.parent.mkdir(parents=True, exist_ok=True)
    content = {KEYS.get(k, k): v for k, v in vars(outcome).items()}
    new = file.with_suffix(f".new{os.getpid()}")
    with new.open("w") as stream:
        json.dump(content, stream, indent=1)
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(new, file)


def is_done(outcome):
    return outcome is not None and outcome.done


def baseline_values(study):
    """What baseline.x means: parameters, derived quantities, and responses
    once the baseline has run."""
    outcome = (
        read(study, BASELINE) if study.baseline_steps is not None else None
    )
    return {
        **study.baseline_values,
        **(outcome.responses if outcome else {}),
    }


def recipe(study, strategy):
    """Everything of the study file that made a design what it is. Without paths,
    so that a study may be moved; responses are read again where only they
    change."""
    made = {
        "exclude": study.exclude,
        "parametersFile": study.parameters_file,
        "targets": {name: [t.file, t.entry] for name, t in study.targets()},
        "derived": {d.name: d.expression.text for d in study.derived},
        "baseline": study.baseline,
    }
    start = "template"
    if strategy != BASELINE:
        made["steps"] = steps(study.strategy(strategy).steps)
        start = made["start"] = study.strategy(strategy).start
    if start != "template" or strategy == BASELINE:
        made["baseline steps"] = steps(study.baseline_steps)
    return made


def steps(items):
    return {step.name: [step.run, step.expect] for step in items}


def changes(study, strategy, outcome):
    """The keys of the recipe in which an outcome differs."""
    now = json.loads(json.dumps(recipe(study, strategy)))
    return sorted(k for k in now if now[k] != outcome.made.get(k))


def response_texts(study):
    """What responses and notes are read by, to see when that has changed."""
    # Keys that are not set are left out, so that new ones change nothing
    return {
        name: [
            str(v.text if k == "expression" and v else v)
            for k, v in vars(r).items()
            if k not in ("row", "gradient") or v is not None
        ]
        for name, r in [*study.responses.items(), *study.notes.items()]
    }
