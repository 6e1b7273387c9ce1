# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/pistonBowl as a regression, run in a temporary copy.

Sources of truth: the cylinder and the planes on which points slide; figures
measured before with the same settings (tutorials/pistonBowl/README.md).
"""

import csv

import pytest

from tutorialCase import run, tutorial


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    case = tutorial("pistonBowl", tmp_path_factory.mktemp("piston"))
    run(case, "./Allrun", "-noPictures")
    with (case / "results/motions.csv").open() as file:
        return {row["motion"]: row for row in csv.DictReader(file)}


@pytest.mark.parametrize("motion", ["stroke", "offset", "reentrant"])
@pytest.mark.parametrize("surface", ["liner", "crown", "head", "symmetry"])
def test_points_stay_on_the_surfaces_they_slide_on(results, motion, surface):
    assert float(results[motion][f"off {surface}"]) <= 1e-12


@pytest.mark.parametrize(
    "motion, angle", [("stroke", 29), ("offset", 36), ("reentrant", 40)]
)
def test_the_mesh_keeps_its_quality(results, motion, angle):
    row = results[motion]
    assert float(row["wrong faces"]) == 0
    assert float(row["max non-orthogonality"]) < angle
    assert float(row["max skewness"]) < 1


def test_only_the_stroke_takes_more_than_one_step(results):
    steps = {motion: int(row["steps"]) for motion, row in results.items()}
    assert steps["offset"] == steps["reentrant"] == 1 < steps["stroke"] <= 32
