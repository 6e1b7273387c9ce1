# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The section infill of the study file."""

from dataclasses import dataclass

from .descend_section import choose
from .errors import StudyError
from .section import Section

CRITERIA = ("expectedImprovement",)


@dataclass
class Infill:
    """README.md has the keys."""

    criterion: str
    budget: int
    tolerance: float


def read_infill(file, study):
    """The section, or None where there is none."""
    if "infill" not in file:
        return None
    item = Section(
        file.get("infill"), "infill", ("criterion", "budget", "tolerance")
    )
    if study.optimise is None:
        raise StudyError(
            "infill needs optimise: nothing says what is better. Add for"
            " example 'optimise: {objectives: {Nu: maximise}}'"
        )
    if len(study.optimise.objectives) > 2:
        raise StudyError(
            f"infill: there are {len(study.optimise.objectives)} objectives,"
            " and the expected improvement is that of one or of two. Make the"
            " others constraints of optimise"
        )
    return Infill(
        choose(item, "criterion", CRITERIA[0], CRITERIA),
        item.number("budget", low=1, whole=True),
        item.number("tolerance", 0.001, low=0),
    )
