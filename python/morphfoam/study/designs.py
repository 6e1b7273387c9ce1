# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The table of designs, designs.csv: rows are added, never changed."""

import csv
import os
from dataclasses import dataclass

import numpy as np

from .errors import StudyError

SAMPLED, VERIFICATION = "sample", "verification"
INFILL = "infill"
# Points of a descent, and those that its differences are made of
DESCENT, GRADIENT = "descent", "gradient"


@dataclass
class Design:
    number: int
    origin: str
    parameters: dict

    @property
    def id(self):
        """Its folder's name; number 0 is the baseline."""
        return f"{self.number:04d}" if self.number else "baseline"


def path(study):
    return study.folder / "designs.csv"


def read(study):
    """The designs there are, each checked against the study file."""
    if not path(study).exists():
        return []
    with path(study).open() as file:
        rows = list(csv.DictReader(file))
    designs = []
    for row in rows:
        if list(row) != ["number", "origin", *study.names]:
            raise StudyError(
                f"{path(study)} has the columns {' '.join(row)}, and the study"
                f" file the parameters {' '.join(study.names)}. Use another"
                " folder for another set of parameters"
            )
        designs.append(
            Design(
                int(row["number"]),
                row["origin"],
                {name: float(row[name]) for name in study.names},
            )
        )
    return designs


def points(study, designs):
    return np.array(
        [[d.parameters[name] for name in study.names] for d in designs]
    ).reshape(-1, len(study.names))


def add(study, new_points, origin):
    """Append designs; the file is replaced at once, so that it is whole."""
    designs = read(study)
    first = designs[-1].number + 1 if designs else 1
    added = [
        Design(first + i, origin, dict(zip(study.names, map(float, point))))
        for i, point in enumerate(new_points)
    ]
    study.folder.mkdir(parents=True, exist_ok=True)
    new = path(study).with_suffix(".new")
    with new.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["number", "origin", *study.names])
        for d in [*designs, *added]:
            writer.writerow(
                [
                    d.number,
                    d.origin,
                    *(repr(d.parameters[n]) for n in study.names),
                ]
            )
    os.replace(new, path(study))
    return added
