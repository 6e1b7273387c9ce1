# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial movingCone: a case with a field of velocities runs with what its
refusal prints. Source of truth: OpenFOAM's velocityComponentLaplacian, and the
integral of a constant velocity."""

import csv

from tutorialCase import run, tutorial


def test_walls_are_where_their_velocity_takes_them(tmp_path):
    case = tutorial("movingCone", tmp_path)
    run(case, "./Allrun", "-noPictures", "-endTime", "0.0002")
    with open(case / "results/walls.csv") as file:
        rows = list(csv.DictReader(file))
    assert [row["patch"] for row in rows] == [
        "movingWall",
        "fixedWall",
        "left",
    ]
    for row in rows:
        assert float(row["from OpenFOAM's"]) < 1e-7
        assert float(row["from the integral of its velocity"]) < 1e-12
