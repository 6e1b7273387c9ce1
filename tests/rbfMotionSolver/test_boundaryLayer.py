# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pitching a body whose first cells are 1e-6 of its chord high.

Sources of truth: quality.dat, whose figures are those of checkMesh; a rigid
rotation leaves the cells at the wall as they are, so that the largest
non-orthogonality should stay what it is at rest.
"""

import re

import numpy as np
import pytest

from boundaryLayer import AROUND, CHORD, THICKNESS, pitched

TOLERANCE = "greedy { tolerance %s; }"


def morph(case, **run):
    return case.run("morphMesh", "-time", "1", **run)


def quality(output, row):
    """Cells, volume, non-orthogonality, ... of a row that morphMesh prints."""
    return [float(word) for word in
            re.search(rf"^{row}\s+(.*)$", output, re.MULTILINE)[1].split()]


def assert_first_cells_turn(before, after):
    """What is within some 1e-6 of the wall turns with it, by 20 degrees.

    Without correction these points are off by 1e-4, the error of the selection.
    """
    near = np.hypot(before[:, 0]/(0.5*CHORD),
                    before[:, 1]/(0.5*THICKNESS)) < 1 + 3e-5
    assert near.sum() > 3*4*AROUND
    a = np.radians(20)
    turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0],
                     [0, 0, 1]])
    np.testing.assert_allclose(after[near], before[near] @ turn.T, rtol=0,
                               atol=1e-6)


def test_an_error_above_the_first_cells_is_announced_with_its_remedy(tmp_path):
    output = morph(pitched(tmp_path, TOLERANCE % "1e-5"), status=1)
    assert "At patch 'wall' the motion around the control points is off" \
        in output
    assert "surfaceCorrection yes" in output
    assert "makes the mesh invalid" in output


def test_the_tolerance_that_the_warning_names_silences_it(tmp_path):
    output = morph(pitched(tmp_path/"before", TOLERANCE % "1e-5"), status=1)
    advice = re.search(r"greedy/tolerance (\S+)", output)[1]
    output = morph(pitched(tmp_path/"after", TOLERANCE % advice))
    assert "heights of the first cell" not in output
    assert quality(output, "after")[5:] == [0, 0]


@pytest.mark.parametrize("tolerance", ["1e-3", "1e-5"])
def test_surface_correction_keeps_the_cells_at_the_wall(tmp_path, tolerance):
    output = morph(pitched(
        tmp_path, f"surfaceCorrection yes; {TOLERANCE % tolerance}"))
    before, after = quality(output, "before"), quality(output, "after")
    assert after[5:] == [0, 0]
    assert after[2] < before[2] + 0.5
    assert after[1] == pytest.approx(before[1], rel=0.01)


def test_surface_correction_is_the_same_on_any_number_of_ranks(tmp_path):
    coeffs = f"surfaceCorrection yes; {TOLERANCE % '1e-3'}"
    serial = pitched(tmp_path/"1", coeffs)
    morph(serial)
    expected = serial.points("1/polyMesh/points")
    assert_first_cells_turn(serial.points("constant/polyMesh/points"),
                            expected)
    for parts in ((2, 1, 1), (2, 2, 1)):
        case = pitched(tmp_path/f"{np.prod(parts)}", coeffs)
        case.decompose(parts)
        morph(case, ranks=int(np.prod(parts)))
        np.testing.assert_array_equal(
            case.decomposed_points("1/polyMesh/points"), expected)
