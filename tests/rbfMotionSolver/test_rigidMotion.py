# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Rigid motion of a mesh or of zones, by the entries that OpenFOAM's solvers
read: two lines that select another solver change nothing about it.

Source of truth: the points that OpenFOAM's solidBody, multiSolidBodyMotionSolver
and solidBodyDisplacementLaplacian give with the same entries, to the last bit;
an uninterrupted run; one rank.
"""

import re

import numpy as np
import pytest

from boxCase import point_field, write_control
from rbfCase import points_at, reference
from test_overset import zoned_case

TURN = (
    "solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
    " { origin (2 1.5 0); axis (0.1 0 1); omega 0.4; }"
)
SHIFT = (
    "solidBodyMotionFunction linearMotion;"
    " linearMotionCoeffs { velocity (0.1 0 0.2); }"
)
FLAT = (
    "solidBodyMotionFunction rotatingMotion;"
    " origin (2 1.5 0); axis (0.1 0 1); omega 0.4;"
)

# The former solver, and the dictionary beside the line that selects it
RIGID = {
    "flat": ("solidBody", FLAT),
    "flat zone": ("solidBody", FLAT + "cellZone ring;"),
    "coefficients": ("solidBody", f"solidBodyCoeffs {{ {TURN} }}"),
    "zone": ("solidBody", f"solidBodyCoeffs {{ {TURN} cellZone ring; }}"),
    "set": ("solidBody", f"solidBodyCoeffs {{ {TURN} cellSet ring; }}"),
    "zones": (
        "multiSolidBodyMotionSolver",
        "multiSolidBodyMotionSolverCoeffs"
        f" {{ ring {{ {TURN} }} back {{ {SHIFT} }} }}",
    ),
    "one of the zones": (
        "multiSolidBodyMotionSolver",
        f"multiSolidBodyMotionSolverCoeffs {{ ring {{ {TURN} }} }}",
    ),
}
OURS = "motionSolverLibs (morphMotionSolvers); motionSolver rbfMotionSolver;"
ZERO = "uniformFixedValue; uniformValue (0 0 0);"


def theirs(solver):
    return f"motionSolverLibs (fvMotionSolvers); motionSolver {solver};"


def moved(path, lines, entries, field=None, ranks=1, end=2):
    """The case after a run, and its points."""
    case = zoned_case(
        path,
        f"dynamicFvMesh dynamicMotionSolverFvMesh; {lines} {entries}",
        end=end,
    )
    if field:
        case.write("0/pointDisplacement", *point_field(field))
    case.write(
        "system/fvSolution",
        "dictionary",
        'solvers { "cellDisplacement.*" { solver PCG; preconditioner DIC;'
        " tolerance 1e-10; relTol 0; } }",
    )
    case.write(
        "system/fvSchemes",
        "dictionary",
        "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }"
        " divSchemes { } interpolationSchemes { default linear; }"
        " snGradSchemes { default corrected; }"
        " laplacianSchemes { default Gauss linear corrected; }",
    )
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    return case, points_at(case, str(end)), output


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("kind", RIGID)
def test_two_lines_leave_a_rigid_motion_as_it_was(tmp_path, kind, ranks):
    solver, entries = RIGID[kind]
    case, expected, _ = moved(tmp_path / "theirs", theirs(solver), entries)
    _, points, output = moved(tmp_path / "ours", OURS, entries, ranks=ranks)
    assert not np.array_equal(expected, reference(case))
    assert np.array_equal(points, expected)
    assert "FOAM Warning" not in output.split("Rigid motion")[1]
    assert "other motion solvers" not in output


def test_a_field_of_zeros_that_is_left_over_changes_nothing(tmp_path):
    solver, entries = RIGID["zones"]
    field = {p: ZERO for p in ("far", "body", "outer", "ends")}
    _, expected, _ = moved(tmp_path / "theirs", theirs(solver), entries)
    _, points, _ = moved(tmp_path / "ours", OURS, entries, field)
    assert np.array_equal(points, expected)


BOTH = {
    "far": ZERO,
    "outer": ZERO,
    "ends": "zeroGradient;",
    "body": "uniformFixedValue; uniformValue table"
    " ((0 (0 0 0)) (2 (0.1 0.2 0)));",
}
DEFORMS = f"solidBodyDisplacementLaplacianCoeffs {{ {TURN} diffusivity"
DEFORMS += " uniform; }"


def on_patches(case, names):
    """Which points are on these patches."""
    mesh = case.path / "constant/polyMesh"
    faces = re.findall(r"\d+\(([\d ]+)\)", (mesh / "faces").read_text())
    found = set()
    for name in names:
        entry = re.search(
            rf"\b{name}\s*\{{([^}}]*)\}}", (mesh / "boundary").read_text()
        )[1]
        n, first = (
            int(re.search(rf"{key}\s+(\d+)", entry)[1])
            for key in ("nFaces", "startFace")
        )
        for face in faces[first : first + n]:
            found.update(map(int, face.split()))
    return sorted(found)


def test_a_displacement_is_added_to_the_rigid_motion(tmp_path):
    solver = "solidBodyDisplacementLaplacian"
    case, expected, _ = moved(
        tmp_path / "theirs", theirs(solver), DEFORMS, BOTH
    )
    _, points, output = moved(tmp_path / "ours", OURS, DEFORMS, BOTH)
    prescribed = on_patches(case, ("far", "body", "outer"))
    np.testing.assert_allclose(
        points[prescribed], expected[prescribed], rtol=0, atol=1e-14
    )
    # Inside it is another field
    assert np.abs(points - expected).max() > 1e-4
    assert "rbfMotionSolver: selected" in output


def test_a_rigid_motion_of_ones_own_with_groups(tmp_path):
    groups = (
        "controlPoints { body { type moving; patches (body); displacement"
        " { type uniform; value (0.1 0.2 0); } }"
        " rest { type fixed; patches (far outer); } }"
    )
    case, points, _ = moved(
        tmp_path, OURS, f"rbfMotionSolverCoeffs {{ {TURN} {groups} }}"
    )
    _, rigid, _ = moved(
        tmp_path / "rigid", theirs("solidBody"), RIGID["flat"][1]
    )
    body, rest = on_patches(case, ["body"]), on_patches(case, ["far", "outer"])
    np.testing.assert_allclose(
        points[body], rigid[body] + [0.1, 0.2, 0], rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(points[rest], rigid[rest], rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    "entries, field", [(RIGID["zone"][1], None), (DEFORMS, BOTH)]
)
def test_a_restart_continues_a_rigid_motion(tmp_path, entries, field):
    _, whole, _ = moved(tmp_path / "whole", OURS, entries, field)
    case, _, _ = moved(tmp_path / "half", OURS, entries, field, end=1)
    write_control(case, end=2, startFrom="latestTime")
    case.run("moveDynamicMesh")
    assert np.array_equal(points_at(case, "2"), whole)


@pytest.mark.parametrize(
    "beside",
    [
        # Groups say what moves
        "rbfMotionSolverCoeffs { controlPoints { body { type moving; patches"
        " (body); displacement { type uniform; value (0.1 0 0); } } } }",
        # Another solver may have been the one that moved the mesh
        "displacementLaplacianCoeffs { diffusivity uniform; }",
    ],
)
def test_what_did_not_move_the_mesh_for_sure_is_named_instead(
    tmp_path, beside
):
    field = {**BOTH, "body": "fixedValue; value uniform (0.1 0 0);"}
    case, points, output = moved(
        tmp_path, OURS, RIGID["coefficients"][1] + beside, field
    )
    assert "solidBodyCoeffs (solidBodyMotionFunction" in output
    body = on_patches(case, ["body"])
    np.testing.assert_allclose(
        (points - reference(case))[body],
        [[0.1, 0, 0]] * len(body),
        rtol=0,
        atol=1e-14,
    )


@pytest.mark.parametrize(
    "entries, phrases",
    [
        (
            f"solidBodyCoeffs {{ {TURN} }}" + RIGID["zones"][1],
            ["solidBodyCoeffs", "multiSolidBodyMotionSolverCoeffs", "Remove"],
        ),
        (
            "multiSolidBodyMotionSolverCoeffs"
            f" {{ ring {{ {TURN} }} backk {{ {SHIFT} }} }}",
            ["backk", "ring", "back"],
        ),
        (
            "solidBodyMotionFunction linearMotion; velocity (1e200 0 0);",
            ["linearMotion", "not finite, or too large", "amplitudes"],
        ),
        (
            FLAT.replace("rotatingMotion", "rotatingMotin"),
            ["rotatingMotin", "rotatingMotion"],
        ),
    ],
)
def test_faults_are_named(tmp_path, entries, phrases):
    case = zoned_case(
        tmp_path, f"dynamicFvMesh dynamicMotionSolverFvMesh; {OURS} {entries}"
    )
    output = case.run("moveDynamicMesh", status=1)
    for phrase in phrases:
        assert phrase in output
