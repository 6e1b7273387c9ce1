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

from boundaryLayer import pitched

TOLERANCE = "greedy { tolerance %s; }"


def morph(case, **run):
    return case.run("morphMesh", "-time", "1", **run)


def quality(output, row):
    """Cells, volume, non-orthogonality, ... of a row that morphMesh prints."""
    return [float(word) for word in
            re.search(rf"^{row}\s+(.*)$", output, re.MULTILINE)[1].split()]


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
    for parts in ((2, 1, 1), (2, 2, 1)):
        case = pitched(tmp_path/f"{np.prod(parts)}", coeffs)
        case.decompose(parts)
        morph(case, ranks=int(np.prod(parts)))
        np.testing.assert_array_equal(
            case.decomposed_points("1/polyMesh/points"), expected)
