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

from boundaryLayer import AROUND, CHORD, THICKNESS, layers, pitched
from rbfCase import groups, points_at, rbf_case, reference, side, ulps

TOLERANCE = "greedy { tolerance %s; }"
UNCORRECTED = "subSteps 1; surfaceCorrection no; " + TOLERANCE


def morph(case, **run):
    return case.run("morphMesh", "-time", "1", **run)


def quality(output, row):
    """Cells, volume, non-orthogonality, ... of a row that morphMesh prints."""
    return [
        float(word)
        for word in re.search(rf"^{row}\s+(.*)$", output, re.MULTILINE)[
            1
        ].split()
    ]


def assert_first_cells_turn(before, after):
    """What is within some 1e-6 of the wall turns with it, by 20 degrees.

    Without correction these points are off by 1e-4, the error of the selection.
    """
    near = (
        np.hypot(
            before[:, 0] / (0.5 * CHORD), before[:, 1] / (0.5 * THICKNESS)
        )
        < 1 + 3e-5
    )
    assert near.sum() > 3 * 4 * AROUND
    a = np.radians(20)
    turn = np.array(
        [[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]
    )
    np.testing.assert_allclose(
        after[near], before[near] @ turn.T, rtol=0, atol=1e-6
    )


def test_an_error_above_the_first_cells_is_announced_with_its_remedy(tmp_path):
    output = morph(pitched(tmp_path, UNCORRECTED % "1e-5"), status=1)
    assert (
        "At patch 'wall' the motion around the control points is off" in output
    )
    assert "surfaceCorrection yes" in output
    assert "makes the mesh invalid" in output


def test_the_tolerance_that_the_warning_names_silences_it(tmp_path):
    output = morph(
        pitched(tmp_path / "before", UNCORRECTED % "1e-5"), status=1
    )
    advice = re.search(r"greedy/tolerance (\S+)", output)[1]
    output = morph(pitched(tmp_path / "after", UNCORRECTED % advice))
    assert "heights of the first cell" not in output
    assert quality(output, "after")[5:] == [0, 0]


def test_by_default_thin_first_cells_are_corrected(tmp_path):
    yes = pitched(
        tmp_path / "yes", "surfaceCorrection yes; " + TOLERANCE % "1e-3"
    )
    morph(yes)
    case = pitched(tmp_path / "auto", TOLERANCE % "1e-3")
    output = morph(case)
    assert output.count("surfaceCorrection is on") == 1
    assert "heights of the first cell" not in output
    assert np.array_equal(points_at(case, "1"), points_at(yes, "1"))


def test_by_default_thick_first_cells_are_not(tmp_path):
    case = pitched(
        tmp_path / "auto", TOLERANCE % "1e-5", first=1e-2, degrees=5
    )
    assert "surfaceCorrection is on" not in morph(case)
    no = pitched(tmp_path / "no", UNCORRECTED % "1e-5", first=1e-2, degrees=5)
    morph(no)
    assert np.array_equal(points_at(case, "1"), points_at(no, "1"))


@pytest.mark.parametrize("word", ["some", "(yes)"])
def test_a_wrong_word_for_the_correction_is_an_error(tmp_path, word):
    output = morph(
        pitched(tmp_path, f"surfaceCorrection {word};", first=1e-2), status=1
    )
    assert "FOAM FATAL IO ERROR" in output


@pytest.mark.parametrize("tolerance", ["1e-3", "1e-5"])
def test_surface_correction_keeps_the_cells_at_the_wall(tmp_path, tolerance):
    output = morph(
        pitched(tmp_path, f"surfaceCorrection yes; {TOLERANCE % tolerance}")
    )
    before, after = quality(output, "before"), quality(output, "after")
    assert after[5:] == [0, 0]
    assert after[2] < before[2] + 0.5
    assert after[1] == pytest.approx(before[1], rel=0.01)


def test_surface_correction_is_the_same_on_any_number_of_ranks(tmp_path):
    coeffs = f"surfaceCorrection yes; {TOLERANCE % '1e-3'}"
    serial = pitched(tmp_path / "1", coeffs)
    morph(serial)
    expected = serial.points("1/polyMesh/points")
    assert_first_cells_turn(
        serial.points("constant/polyMesh/points"), expected
    )
    for parts in ((2, 1, 1), (2, 2, 1)):
        case = pitched(tmp_path / f"{np.prod(parts)}", coeffs)
        case.decompose(parts)
        morph(case, ranks=int(np.prod(parts)))
        np.testing.assert_array_equal(
            case.decomposed_points("1/polyMesh/points"), expected
        )


# --- symmetric and periodic


FLOOR = {
    "xMin": "cyclic; neighbourPatch xMax;",
    "xMax": "cyclic; neighbourPatch xMin;",
    "yMin": "symmetryPlane",
    "yMax": "symmetryPlane",
    "zMin": "wall",
    "zMax": "wall",
}


def wavy_floor(x):
    """A displacement of period 1 in x that is symmetric about y = 0, 1."""
    wave = 2 * np.pi * x[:, 0]
    return np.stack(
        [
            0.02 * np.sin(wave) * np.cos(np.pi * x[:, 1]),
            0.01 * np.sin(np.pi * x[:, 1]) * np.cos(wave),
            0.06 * np.cos(wave) * np.cos(np.pi * x[:, 1]),
        ],
        1,
    )


def floor_case(path, coeffs):
    """A box of first cells 1e-6 high on a floor that bulges."""
    n, last = layers(1e-6, far=1, growth=1.5)
    case = rbf_case(
        path,
        patches=FLOOR,
        cells=(24, 16, n),
        grading=(1, 1, last),
        coeffs=f"supportRadius 1.2; images yes; {coeffs}"
        + groups(
            floor="type moving; patches (zMin); displacement { type file;"
            ' file "constant/floor.txt"; tolerance 1e-9; }',
            top="type fixed; patches (zMax);",
        ),
    )
    x = reference(case)
    floor = x[side(x, "zMin")]
    np.savetxt(
        path / "constant/floor.txt",
        np.hstack([floor, wavy_floor(floor)]),
        fmt="%.17g",
    )
    return case


@pytest.mark.parametrize("ranks", [1, 3])
def test_thin_layers_follow_their_wall_between_planes_of_symmetry(
    tmp_path, ranks
):
    case = floor_case(tmp_path, TOLERANCE % "1e-3")
    if ranks > 1:
        case.decompose((1, ranks, 1))
    output = morph(case, ranks=ranks)
    before, after = quality(output, "before"), quality(output, "after")
    assert after[5:] == [0, 0]
    # The floor is as steep as 2 pi 0.06: 20.7 degrees, and no cell is worse
    # than a cell that follows it and its shear can be
    assert before[2] < 1 and after[2] < 30
    x = reference(case)
    moved = points_at(case, "1")
    floor = side(x, "zMin")
    np.testing.assert_allclose(
        moved[floor], x[floor] + wavy_floor(x[floor]), rtol=0, atol=ulps(x)
    )
    for name in ("yMin", "yMax"):
        plane = side(x, name)
        np.testing.assert_allclose(
            moved[plane, 1], x[plane, 1], rtol=0, atol=1e-15
        )
    left, right = side(x, "xMin"), side(x, "xMax")
    np.testing.assert_allclose(
        moved[right] - moved[left], x[right] - x[left], rtol=0, atol=1e-14
    )


def test_without_the_correction_thin_layers_fold(tmp_path):
    output = morph(floor_case(tmp_path, UNCORRECTED % "1e-3"), status=1)
    assert "makes the mesh invalid" in output
