# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The outcome of a design: one file, written last and at once. A design that has
one is finished, whatever its folder looks like; one without is made anew."""

import json
import os


DONE, FAILED = "done", "failed"
BASELINE = "baseline"

# An outcome of which nothing is known yet; what reading one falls back on
BLANK = {
    "startedFrom": "template",
    "baselineMade": None,
    "templateHash": None,
    "wall": {},
    "cpu": {},
    "responses": {},
    "notes": {},
    "quality": {},
    "motion": {},
    "iterations": None,
    "picture": "",
}


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
    return {**BLANK, **json.loads(file.read_text())}


def write(study, outcome):
    file = path(study, outcome["strategy"], outcome["number"])
    file.parent.mkdir(parents=True, exist_ok=True)
    new = file.with_suffix(f".new{os.getpid()}")
    with new.open("w") as stream:
        json.dump(outcome, stream, indent=1)
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(new, file)


def is_done(outcome):
    return outcome is not None and outcome["status"] == DONE


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
        made["steps"] = steps(study.strategies[strategy].steps)
        start = made["start"] = study.strategies[strategy].start
    if start != "template" or strategy == BASELINE:
        made["baseline steps"] = steps(study.baseline_steps)
    return made


def steps(items):
    return {step.name: [step.run, step.expect] for step in items}


def changes(study, strategy, outcome):
    """The keys of the recipe in which an outcome differs."""
    now = json.loads(json.dumps(recipe(study, strategy)))
    return sorted(k for k in now if now[k] != outcome["made"].get(k))


def response_texts(study):
    """What responses and notes are read by, to see when that has changed."""
    return {
        name: [
            str(v.text if k == "expression" and v else v)
            for k, v in vars(r).items()
        ]
        for name, r in [*study.responses.items(), *study.notes.items()]
    }
