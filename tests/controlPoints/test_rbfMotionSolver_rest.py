# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A mesh at rest: it runs, with one warning, as long as nothing moves it but
something could, and says what of dynamicMeshDict is another solver's.

Sources of truth: displacementLaplacian, which leaves a mesh without a
displacement as it is and freezes the points of a zone to the last bit; the
integral of a velocity.
"""

import re

import numpy as np
import pytest

from boxCase import fixed, point_field
from rbfCase import (
    CUBE,
    DROP_IN,
    groups,
    move,
    points_at,
    rbf_case,
    reference,
    side,
    ulps,
)

SLIPPING = {
    **{name: "slip" for name in CUBE},
    "zMin": fixed(0, 0, 0),
    "zMax": fixed(0, 0, 0),
}

REST = "Nothing moves the mesh"


def warnings(output):
    return output.count("FOAM Warning")


@pytest.mark.parametrize("program", ["moveDynamicMesh", "morphMesh"])
def test_zero_values_are_a_mesh_at_rest_with_one_warning(tmp_path, program):
    case = rbf_case(tmp_path, SLIPPING, control={"end": 3})
    before = reference(case)
    output = case.run(program)
    assert warnings(output) == 1 and output.count(REST) == 1
    for mover in ("patch zMin (fixedValue)", "patch zMax (fixedValue)"):
        assert mover in output
    if program == "moveDynamicMesh":
        np.testing.assert_array_equal(points_at(case, 3), before)


def test_what_starts_later_moves_then(tmp_path):
    table = "table ((0 (0 0 0)) (1 (0 0 0)) (2 (0 0 0.1)))"
    case = rbf_case(
        tmp_path,
        {**SLIPPING, "zMax": f"uniformFixedValue; uniformValue {table};"},
        control={"end": 2},
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert output.count(REST) == 1
    np.testing.assert_array_equal(points_at(case, 1), before)
    top = side(before, "zMax")
    np.testing.assert_allclose(
        points_at(case, 2)[top],
        before[top] + (0, 0, 0.1),
        rtol=0,
        atol=ulps(before),
    )


def test_where_nothing_can_move_it_is_an_error_as_before(tmp_path):
    case = rbf_case(tmp_path, {name: "slip" for name in CUBE})
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    assert case.tree() == before
    for phrase in (
        REST,
        "no patch or group prescribes a motion",
        "type sixDoFRigidBody",
        "type moving",
    ):
        assert phrase in output


# --- what another solver left

MULTI = """multiSolidBodyMotionSolverCoeffs { movingZone
{ solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs
{ origin (0 0 0); axis (0 0 1); omega 1; } } }"""


def test_leftovers_of_another_solver_are_named_in_the_one_warning(tmp_path):
    zero = "uniformFixedValue; uniformValue (0 0 0);"
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": zero}, extra=MULTI)
    output = case.run("moveDynamicMesh")
    assert warnings(output) == 1
    for phrase in (
        REST,
        "patch zMax (uniformFixedValue)",
        "multiSolidBodyMotionSolverCoeffs (movingZone)",
        "type solidBody",
    ):
        assert phrase in output


LEFT = {
    "layers": (
        "displacementLayeredMotionCoeffs { regions { a { } } }",
        ["displacementLayeredMotionCoeffs (regions)", "layers"],
        1,
    ),
    "frozen": (
        "displacementLaplacianCoeffs { diffusivity uniform;"
        " frozenPointsZone z; }",
        ["frozenPointsZone", "rbfMotionSolverCoeffs"],
        1,
    ),
    "diffusivity": (
        "diffusivity inverseDistance (zMax);",
        ["diffusivity", "supportRadius"],
        0,
    ),
}


@pytest.mark.parametrize("left", LEFT)
def test_leftovers_beside_a_motion_of_ours_are_mentioned(tmp_path, left):
    entry, phrases, warns = LEFT[left]
    case = rbf_case(
        tmp_path, {**SLIPPING, "zMax": fixed(0, 0, 0.1)}, extra=entry
    )
    output = case.run("moveDynamicMesh")
    assert warnings(output) == warns and REST not in output
    for phrase in phrases:
        assert phrase in output


def test_a_clean_dictionary_is_not_commented(tmp_path):
    case = rbf_case(
        tmp_path, {**SLIPPING, "zMax": fixed(0, 0, 0.1)}, coeffs=""
    )
    output = case.run("moveDynamicMesh")
    assert warnings(output) == 0 and "other motion solvers" not in output


SIX_DOF = """sixDoFRigidBodyMotionCoeffs { patches (zMax); innerDistance 0.1;
outerDistance 1; mass 15; centreOfMass (0.5 0.5 1);
momentOfInertia (1 1 1); solver { type Newmark; } report on; }"""

JOINTED = """rigidBodyMotionCoeffs { solver { type Newmark; } bodies
{ hull { type cuboid; patches (zMax); innerDistance 0.1; outerDistance 1; }
propeller { type masslessBody; } } }"""


@pytest.mark.parametrize(
    "body, phrases",
    [
        (
            SIX_DOF,
            [
                "type            sixDoFRigidBody;",
                "body\n{",
                "patches         ( zMax );",
                "mass            15;",
            ],
        ),
        (
            JOINTED,
            [
                "type            rigidBody;",
                "body\n{",
                "patches         ( zMax );",
                "propeller",
            ],
        ),
    ],
)
def test_a_body_of_another_solver_is_refused_with_the_group_to_copy(
    tmp_path, body, phrases
):
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": "calculated"}, extra=body)
    output = case.run("moveDynamicMesh", status=1)
    for phrase in phrases:
        assert phrase in output
    assert "innerDistance" not in output


# --- a target alone


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_target_alone_moves(tmp_path, ranks):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type sliding; patches (zMax); target { type searchablePlane;"
            " planeType pointAndNormal; pointAndNormalDict"
            " { point (0 0 1.1); normal (0 0 1); } }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    after = move(case, ranks=ranks)
    np.testing.assert_allclose(
        after[side(before, "zMax"), 2], 1.1, rtol=0, atol=1e-6
    )


# --- frozenPointsZone

ZONE = """actions
( { name s; type pointSet; action new; source boxToPoint;
    sourceInfo { box (0.3 0.3 0.45) (0.7 0.7 1.1); } }
  { name frozen; type pointZoneSet; action new; source setToPointZone;
    sourceInfo { set s; } } );"""


@pytest.mark.parametrize("where", ["beside", "in the coefficients"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_frozen_points_stay_to_the_last_bit(tmp_path, where, ranks):
    # Points of the moving patch too: the zone wins
    entry = "frozenPointsZone frozen;"
    given = {"extra": entry} if where == "beside" else {"coeffs": entry}
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": fixed(0, 0, 0.1)}, **given)
    case.write("system/topoSetDict", "dictionary", ZONE)
    case.run("topoSet")
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    after = move(case, ranks=ranks)
    frozen = ((before[:, :2] > 0.3) & (before[:, :2] < 0.7)).all(axis=1) & (
        before[:, 2] > 0.45
    )
    assert frozen.sum() == 3
    np.testing.assert_array_equal(after[frozen], before[frozen])
    others = side(before, "zMax") & ~frozen
    np.testing.assert_array_equal(after[others], before[others] + (0, 0, 0.1))


def test_a_zone_that_is_not_there_is_an_error(tmp_path):
    case = rbf_case(
        tmp_path,
        {**SLIPPING, "zMax": fixed(0, 0, 0.1)},
        extra="frozenPointsZone ice;",
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "'frozenPointsZone'" in output and "'ice'" in output


# --- fields of other solvers


def scalar_field(conditions, dimensions="0 1 -1 0 0 0 0"):
    _, text = point_field(conditions, dimensions)
    return "pointScalarField", text.replace("uniform (0 0 0)", "uniform 0")


MOTION_U = {
    **{name: "slip" for name in CUBE},
    "zMin": fixed(0, 0, 0),
    "zMax": fixed(0, 0, 0.1),
}


def component(value):
    return f"uniformFixedValue; uniformValue {value};"


FIELDS = {
    "pointMotionU": (point_field(MOTION_U, "0 1 -1 0 0 0 0"), 0.1),
    "pointMotionUz": (
        scalar_field(
            {
                **MOTION_U,
                "zMin": component(0),
                "zMax": component("table ((0 0) (1 0.2))"),
            }
        ),
        0.1,
    ),
    "pointDisplacementz": (
        scalar_field(
            {
                **MOTION_U,
                "zMin": component(0),
                "zMax": component("table ((0 0) (1 0.1))"),
            },
            "0 1 0 0 0 0 0",
        ),
        0.1,
    ),
}


@pytest.mark.parametrize("name", FIELDS)
def test_a_field_of_another_solver_is_named_with_the_groups_to_copy(
    tmp_path, name
):
    """The block that is printed runs as it is; the top is where the velocity
    takes it: the integral of 0.1, of 0.2 t, or 0.1 t."""
    field, up = FIELDS[name]
    case = rbf_case(tmp_path)
    case.write(f"0/{name}", *field)
    output = case.run("moveDynamicMesh", status=1)
    assert f"0/{name} prescribes" in output
    block = re.search(
        r"^controlPoints\n\{\n(?:    .*\n)+\}\n", output, re.MULTILINE
    ).group(0)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        DROP_IN + f"rbfMotionSolverCoeffs\n{{\n{block}\n}}",
    )
    before = reference(case)
    after = move(case)
    top, bottom = side(before, "zMax"), side(before, "zMin")
    np.testing.assert_allclose(
        after[top], before[top] + (0, 0, up), rtol=0, atol=ulps(before)
    )
    np.testing.assert_array_equal(after[bottom], before[bottom])


def test_velocities_that_a_program_fills_are_not_offered_a_dead_end(tmp_path):
    case = rbf_case(tmp_path)
    case.write(
        "0/pointMotionU",
        *point_field({**MOTION_U, "zMax": fixed(0, 0, 0)}, "0 1 -1 0 0 0 0"),
    )
    output = case.run("moveDynamicMesh", status=1)
    for phrase in (
        "0/pointMotionU",
        "All of its values are zero",
        "interfaceTrackingFvMesh",
        "fixedValue",
    ):
        assert phrase in output


@pytest.mark.parametrize(
    "value, error",
    [
        (
            "value sine; valueCoeffs { frequency 1; amplitude 1; scale (1 0 0);"
            " level (0 0 0); }",
            "no integral",
        ),
        ("value (0 0 0.1); speed 1;", "'speed'"),
    ],
)
def test_a_velocity_that_cannot_be_integrated_is_an_error(
    tmp_path, value, error
):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type velocity;"
            f" {value} }}"
        ),
    )
    assert error in case.run("moveDynamicMesh", status=1)


def test_a_velocity_starts_where_it_is_said_to(tmp_path):
    case = rbf_case(
        tmp_path,
        control={"end": 2},
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type velocity;"
            " value (0 0 0.1); start 1; }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    top = side(before, "zMax")
    np.testing.assert_array_equal(points_at(case, 1)[top], before[top])
    np.testing.assert_allclose(
        points_at(case, 2)[top],
        before[top] + (0, 0, 0.1),
        rtol=0,
        atol=ulps(before),
    )


# --- solid bodies as OpenFOAM's dictionaries write them


@pytest.mark.parametrize(
    "coeffs",
    ["velocity (0 0 0.1);", "linearMotionCoeffs { velocity (0 0 0.1); }"],
)
def test_solid_body_coefficients_stand_beside_or_below(tmp_path, coeffs):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type solidBody;"
            f" solidBodyMotionFunction linearMotion; {coeffs} }}",
            bottom="type fixed; patches (zMin);",
        ),
    )
    before = reference(case)
    top = side(before, "zMax")
    np.testing.assert_allclose(
        move(case)[top], before[top] + (0, 0, 0.1), rtol=0, atol=ulps(before)
    )


@pytest.mark.parametrize(
    "coeffs, error",
    [
        ("rotatingMotionCoeffs { origin (0 0 0); }", "'linearMotionCoeffs'"),
        (
            "linearMotionCoeffs { velocity (0 0 1); } velocity (0 0 2);",
            "'velocity'",
        ),
    ],
)
def test_solid_body_coefficients_nobody_reads_are_an_error(
    tmp_path, coeffs, error
):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type solidBody;"
            f" solidBodyMotionFunction linearMotion; {coeffs} }}"
        ),
    )
    assert error in case.run("moveDynamicMesh", status=1)
