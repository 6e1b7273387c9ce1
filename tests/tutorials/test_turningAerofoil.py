# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial turningAerofoil by its own script, for a quarter of a turn.
Source of truth: checkMesh's non-orthogonality as its README gives it."""

import csv

from tutorialCase import run, tutorial


def test_a_quarter_of_a_turn(tmp_path):
    case = tutorial("turningAerofoil", tmp_path)
    run(case, "./Allrun", "-noPictures", "-angle", "90")
    with open(case / "results/turn.csv") as file:
        at = {row["motion"]: float(row["90"]) for row in csv.DictReader(file)}
    assert abs(at["fixed"] - 61.1) < 0.5
    assert abs(at["moving"] - 52.9) < 0.5
    assert abs(at["movingOptimised"] - 52.9) < 0.5


def test_half_a_turn_from_the_mesh_at_rest_and_no_more(tmp_path):
    case = tutorial("turningAerofoil", tmp_path)
    run(case, "./Allrun", "-noPictures", "-motions", "fixed", "-angle", "195")
    with open(case / "results/turn.csv") as file:
        (row,) = csv.DictReader(file)
    assert float(row["150"]) < 78
    assert float(row["180"]) < 85
    assert row["refused"] == "195"
    log = (case / "runs/fixed/log").read_text()
    assert "Control points 'aerofoil' have turned by more than half" in log
