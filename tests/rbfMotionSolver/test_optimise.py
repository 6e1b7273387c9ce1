# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The entry optimise of rbfMotionSolver.

Sources of truth: where the dictionary says that points go, planes, the check of
the mesh by morphMesh, one rank.
"""

import re

import numpy as np
import pytest

from rbfCase import CUBE, groups, points_at, rbf_case, reference, side, ulps

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


@pytest.mark.parametrize(
    "kind, images",
    [("cyclic", "auto"), ("cyclic", "no"), ("cyclicAMI", "auto")],
)
def test_periodic_sides_match_after_it(tmp_path, kind, images):
    """Point for point, by the period; the same on two ranks."""
    patches = {
        **CUBE,
        "yMin": f"{kind}; neighbourPatch yMax; transform translational;"
        " separationVector (0 1 0);",
        "yMax": f"{kind}; neighbourPatch yMin; transform translational;"
        " separationVector (0 -1 0);",
    }
    body = " ".join(
        f"({x} {y} {z})"
        for x in (0.4, 0.6)
        for y in (0.25, 0.5, 0.75)
        for z in (0.25, 0.75)
    )
    coeffs = (
        f"supportRadius 0.8; images {images}; subSteps 1;"
        + groups(
            body=f"type moving; points ({body}); displacement {{ type"
            " solidBody; solidBodyMotionFunction rotatingMotion;"
            " rotatingMotionCoeffs { origin (0.5 0.5 0.5); axis (0 1 0);"
            " omega 1.2; } }",
            ends="type fixed; patches (xMin xMax);",
            sides="type sliding; patches (zMin zMax);",
        )
        + "optimise { limits { nonOrthogonality 40; } iterations 60; }"
    )
    results = []
    for ranks, split in ((1, None), (2, (1, 2, 1))):
        case = rbf_case(
            tmp_path / str(ranks),
            coeffs=coeffs,
            cells=(10, 4, 4),
            patches=patches,
            control={"digits": 17},
        )
        if split:
            case.decompose(split)
        log = case.run("morphMesh", "-time", "1", ranks=ranks)
        assert re.search(r"optimise: non-orthogonality .* iterations", log)
        results.append(points_at(case, 1))
    x, y = reference(case), results[0]
    pair = {}
    for i in np.flatnonzero(side(x, "yMin") | side(x, "yMax")):
        pair.setdefault((x[i, 0].round(9), x[i, 2].round(9)), []).append(i)
    assert len(pair) == 11 * 5
    for a, b in pair.values():
        gap = np.abs(np.abs(y[a] - y[b]) - [0, 1, 0]).max()
        assert gap < 1e-14
    np.testing.assert_allclose(results[1], y, rtol=0, atol=1e-10)
