# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Why designs failed: the log's own sentence, and classes of such reasons."""

import contextlib
import re
from dataclasses import dataclass

from . import case_folder, responses

# What is said of a class, and the reasons that belong to it
CLASSES = [
    ("a lattice folds", r"Box '.*' folds"),
    ("the mesh becomes invalid", r"invalid: "),
    ("timeout", r"timeout after"),
    ("diverged", r"diverged"),
    ("its log lacks what is expected", r"its log does not say"),
    ("other", r"exit status|ended by signal"),
]
FOLD = re.compile(
    r"Box '[^']*' folds:.*?Largest safe scale: (\S+)[^\n]*", re.DOTALL
)
INVALID = re.compile(
    r"(?:The motion makes the mesh|The moved mesh would be) invalid:.*?"
    r"(?=\n\s*(?:Of these|Nothing|The mesh is left|\n)|\Z)",
    re.DOTALL,
)
# Numbers of designs that a line lists
LISTED = 8


def why(log, status):
    """The sentence of a log that says why the command failed."""
    text = log.read_text(errors="replace")
    for pattern in (FOLD, INVALID):
        found = pattern.search(text)
        if found:
            return " ".join(found.group().split())[:400]
    if "--> FOAM FATAL" in text:
        return case_folder.first_error(text)[:300]
    if "sigFpe" in text or "Floating point exception" in text:
        times = re.findall(r"^Time = (\S+)", text, re.MULTILINE)
        return "diverged, floating point exception" + (
            f" at time {times[-1]}" if times else ""
        )
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    said = f" ({lines[-1][:200]})" if lines else ""
    if status < 0:
        return f"ended by signal {-status}{said}"
    return f"exit status {status}{said}"


def safe_scale(text):
    """The fraction of the motion at which a lattice would not fold, or
    None."""
    found = FOLD.search(text)
    return float(found.group(1)) if found else None


def blamed(reason):
    """The parameters that a lattice's fold is put down to."""
    found = re.search(r"Parameters that cause it: (.*?) Largest safe", reason)
    return re.findall(r"[A-Za-z_]\w*", found.group(1)) if found else []


def attainable(case, logs):
    """The fraction of the motion that a valid mesh allows, of a run that failed
    of it; None where it is not known."""
    for log in logs:
        if log.exists():
            scale = safe_scale(log.read_text(errors="replace"))
            if scale is not None:
                return scale
    with contextlib.suppress(responses.ResponseError):
        text = responses.newest(
            case, "postProcessing/**/morphMesh/*/motion"
        ).read_text()
        found = re.search(r"^attainable\s+(\S+);", text, re.MULTILINE)
        return float(found.group(1)) if found else None


def kind(outcome):
    """The step and the class of a failure."""
    if outcome.reason.startswith("response"):
        return "responses"
    step, _, rest = outcome.reason.partition(": ")
    for name, pattern in CLASSES:
        if re.search(pattern, rest):
            return f"{step}: {name}"
    steps = outcome.made.get("steps", outcome.made.get("baseline steps", {}))
    return f"{step}: OpenFOAM error" if step in steps else "other"


@dataclass
class Group:
    """Failed designs of one class."""

    kind: str
    outcomes: list

    @property
    def names(self):
        names = [outcome.name for outcome in self.outcomes]
        more = " ..." if len(names) > LISTED else ""
        return " ".join(names[:LISTED]) + more

    @property
    def sentence(self):
        """What the first of them says."""
        return self.outcomes[0].reason

    def __str__(self):
        return (
            f"{len(self.outcomes)} x {self.kind} ({self.names}):"
            f" {self.sentence}"
        )


def groups(failed):
    """The classes of these outcomes, the largest first."""
    found = {}
    for outcome in failed:
        found.setdefault(kind(outcome), []).append(outcome)
    return [
        Group(name, members)
        for name, members in sorted(
            found.items(), key=lambda item: -len(item[1])
        )
    ]
