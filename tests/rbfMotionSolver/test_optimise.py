# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The entry optimise of rbfMotionSolver.

Sources of truth: where the dictionary says that points go, planes, the check of
the mesh by morphMesh, one rank.
"""

import re

import numpy as np
import pytest

from rbfCase import groups, points_at, rbf_case, reference, ulps

CELLS = (10, 4, 4)


def sheet(distance):
    """A sheet across the middle of a box goes along it; the sides slide."""
    points = " ".join(
        f"(0.5 {y} {z})" for y in np.arange(5) / 4 for z in np.arange(5) / 4
    )
    return "supportRadius 1.2;" + groups(
        sheet=f"type moving; points ({points}); displacement {{ type uniform;"
        f" value ({distance} 0 0); }}",
        ends="type fixed; patches (xMin xMax);",
        sides="type sliding; patches (yMin yMax zMin zMax);",
    )


def run(path, coeffs, ranks=None, status=0):
    case = rbf_case(path, coeffs=coeffs, cells=CELLS, control={"digits": 17})
    if ranks:
        case.decompose(ranks)
    n = int(np.prod(ranks or 1))
    return case, case.run("morphMesh", "-time", "1", ranks=n, status=status)


FOLDS = sheet(0.38)


def test_a_motion_that_folds_is_untangled(tmp_path):
    _, log = run(tmp_path / "refused", "subSteps 1;" + FOLDS, status=1)
    assert "The motion makes the mesh invalid" in log
    case, log = run(tmp_path / "untangled", FOLDS + "optimise {}")
    assert re.search(r"invalid [1-9]\d* -> 0;", log)
    x, y = reference(case), points_at(case, 1)
    moved = np.abs(x[:, 0] - 0.5) < 1e-9
    assert np.abs(y[moved] - x[moved] - [0.38, 0, 0]).max() <= ulps(x)
    for axis in range(3):
        for plane in (0, 1):
            on = np.abs(x[:, axis] - plane) < 1e-9
            assert np.abs(y[on, axis] - plane).max() < 1e-15

    # In layers of one thickness on either side of the sheet, nearly
    layers = [
        np.mean(y[np.abs(x[:, 0] - i / 10) < 1e-9, 0]) for i in range(11)
    ]
    assert np.diff(layers)[5:].min() > 0.01


def test_a_motion_within_the_limits_is_left_alone(tmp_path):
    plain, _ = run(tmp_path / "plain", sheet(0.1))
    case, log = run(tmp_path / "needed", sheet(0.1) + "optimise {}")
    assert np.array_equal(points_at(case, 1), points_at(plain, 1))
    assert "iterations," not in log


def test_never_does_nothing(tmp_path):
    _, log = run(
        tmp_path, "subSteps 1;" + FOLDS + "optimise { when never; }", status=1
    )
    assert "The motion makes the mesh invalid" in log


@pytest.mark.parametrize("ranks", [(2, 1, 1), (1, 3, 1), (2, 2, 1)])
def test_ranks_agree_to_the_last_bit(tmp_path, ranks):
    coeffs = FOLDS + "optimise { iterations 60; }"
    serial, _ = run(tmp_path / "serial", coeffs)
    case, _ = run(tmp_path / "parallel", coeffs, ranks)
    assert np.array_equal(points_at(case, 1), points_at(serial, 1))
