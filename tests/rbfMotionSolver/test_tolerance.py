# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tolerance that nobody gave: what the first cells can notice.

Source of truth: the formula of wallAccuracy.H, T = min(max(0.05 h, 1e-3 d),
1e-2 d), with the least height h of the first cells and the largest displacement
d; for rough fields 0.04 d, and no more points than that takes. A run in parts
and on several ranks is the uninterrupted serial one to the last bit.
"""

import re

import numpy as np
import pytest

from boxCase import words, write_control
from rbfCase import (
    bent_top,
    groups,
    rbf_case,
    reference,
    selections,
    side,
    ulps,
)
from test_rbfMotionSolver_time import advance, points_at


def bent(path, size, settings="", cells=(12, 12, 12), **rest):
    """A unit box whose top bends by so much in its middle."""

    def height(x):
        a, b = x[:, 0], x[:, 1]
        bulge = a * (1 - a) * b * (1 - b)
        return size * 16 * bulge * np.cos(3 * a - 1.5)

    case, _ = bent_top(path, height, settings, cells=cells, **rest)
    return case


# Twelve cells: h = 1/12, 0.05 h = 1/240
@pytest.mark.parametrize(
    "size, expected, why",
    [
        (0.1, 1e-3, "0.01 of the largest displacement, less than"),
        (0.8, 1 / 240, "0.05 of the first cells' height of 0.0833 m"),
    ],
)
def test_the_tolerance_follows_the_first_cells(tmp_path, size, expected, why):
    output = bent(tmp_path, size, "onInvalidMesh ignore;").run(
        "moveDynamicMesh"
    )
    ((_, _, error, tolerance),) = selections(output)
    assert tolerance == pytest.approx(expected, rel=5e-3)
    assert error <= tolerance
    assert output.count("rbfMotionSolver: tolerance ") == 1
    assert why in output


# The cells at the top are a thousandth of the box high
THIN = {"cells": (12, 12, 20), "grading": (1, 1, 0.00532)}


@pytest.mark.parametrize("ranks", [1, 2])
def test_thin_cells_are_left_to_the_correction(tmp_path, ranks):
    case = bent(tmp_path, 0.3, **THIN)
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    ((_, _, error, tolerance),) = selections(output)
    assert tolerance == pytest.approx(3e-4, rel=5e-3)
    height = float(re.search(r"first cells' height of (\S+) m", output)[1])
    assert 0.05 * height < tolerance
    on = "surfaceCorrection is on" in output
    assert on == (tolerance > 0.1 * height)


def test_without_a_correction_thin_cells_get_what_they_notice(tmp_path):
    output = bent(tmp_path, 0.3, "surfaceCorrection no;", **THIN).run(
        "moveDynamicMesh"
    )
    ((_, _, error, tolerance),) = selections(output)
    height = float(re.search(r"first cells' height of (\S+) m", output)[1])
    assert tolerance == pytest.approx(0.05 * height, rel=5e-3)
    assert "heights of the first cell" not in output


def test_a_tolerance_that_is_given_is_one_of_the_motion(tmp_path):
    output = bent(tmp_path, 0.1, "greedy { tolerance 1e-4; }").run(
        "moveDynamicMesh"
    )
    ((_, _, _, tolerance),) = selections(output)
    assert tolerance == pytest.approx(1e-5, rel=5e-3)
    assert "rbfMotionSolver: tolerance" not in output


# --- rough ground


def terrain(x):
    """Waves of all lengths, the shorter the lower."""
    random = np.random.default_rng(7)
    z = np.zeros(len(x))
    for _ in range(400):
        k = random.uniform(1, 90)
        a = random.uniform(0, 2 * np.pi)
        z += k**-0.5 * np.sin(
            k * (np.cos(a) * x[:, 0] + np.sin(a) * x[:, 1])
            + random.uniform(0, 2 * np.pi)
        )
    return 0.06 * z / np.abs(z).max()


def rough(path, extra=""):
    """A floor that becomes a terrain under a top that turns."""
    case = rbf_case(
        path,
        coeffs="supportRadius 1;"
        + extra
        + groups(
            floor="type moving; patches (zMin); displacement"
            ' { type file; file "constant/floor.txt"; scale table'
            " ((0 0) (1 0.9) (2 1)); }",
            top="type moving; patches (zMax); displacement { type solidBody;"
            " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
            " { origin (0.5 0.5 1); axis (0 1 0); omega 0.1; } }",
            walls='type sliding; patches ("[xy].*");',
        ),
        cells=(32, 32, 8),
    )
    x = reference(case)
    x = x[side(x, "zMin")]
    z = terrain(x)
    (path / "constant/floor.txt").write_text(
        "".join(f"{words(a)} 0 0 {h!r}\n" for a, h in zip(x, z))
    )
    return case, x, z


@pytest.fixture(scope="module")
def ground(tmp_path_factory):
    """The uninterrupted run on one rank, and its log"""
    case, x, z = rough(tmp_path_factory.mktemp("ground"))
    return points_at_end(case), x, z


def points_at_end(case, stops=(2,), ranks=1):
    for stop in stops:
        output = advance(case, stop, ranks=ranks)
    return points_at(case, 2), output


def test_rough_ground_is_not_reproduced_by_a_selection(ground, tmp_path):
    (points, output), x, z = ground
    (selected, candidates, error, tolerance), *others = selections(output)
    assert 500 < selected < len(x) - 100
    assert selected > candidates / 20
    moved = 0.25 * 0.9 * np.abs(z).max()
    assert tolerance == pytest.approx(0.04 * moved, rel=5e-3)
    assert error <= tolerance
    # It was kept over some of the eight steps
    assert 0 < len(others) < 7
    # The surface is exact, and so is the field but for the tolerance
    selected, _, _, tolerance = others[-1]
    case, _, _ = rough(tmp_path, "greedy { tolerance 1e-5; }")
    exact, more = points_at_end(case)
    assert selections(more)[-1][0] > 1.2 * selected
    assert np.abs(points - exact).max() < 4 * tolerance
    floor = side(reference(case), "zMin")
    np.testing.assert_allclose(
        points[floor, 2], exact[floor, 2], rtol=0, atol=ulps(points)
    )


@pytest.mark.parametrize("ranks, stops", [(3, [2]), (1, [1, 2])])
def test_rough_ground_is_the_same_in_parts_and_on_ranks(
    ground, tmp_path, ranks, stops
):
    case, _, _ = rough(tmp_path)
    if ranks > 1:
        write_control(case, format="binary")
        case.decompose((ranks, 1, 1))
    np.testing.assert_array_equal(
        points_at_end(case, stops, ranks)[0], ground[0][0]
    )
