# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""rbfMotionSolver in a case of displacementLaplacian: what its conditions do.

Sources of truth: the formulas of OpenFOAM's conditions for pointDisplacement
(their headers and updateCoeffs), and the contract in rbfMotionSolver.H, by
which a condition that fixes the value moves points, slip and symmetry let them
slide, zeroGradient and calculated leave them free.
"""

import numpy as np
import pytest

from boxCase import fixed
from conditions import CONDITIONS, HELD, SLIPPING, boundary_data, mapped
from rbfCase import CUBE, move, rbf_case, reference, selections, side, ulps

SPAN = np.sqrt(3)


@pytest.mark.parametrize("condition", CONDITIONS)
def test_points_of_a_moving_patch_end_where_its_condition_says(
    tmp_path, condition
):
    entries, formula = CONDITIONS[condition]
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": entries})
    before = reference(case)
    top = side(before, "zMax")
    if condition == "timeVaryingMappedFixedValue":
        boundary_data(case, before[top], mapped(before[top]))

    after = move(case)

    np.testing.assert_allclose(
        after[top],
        before[top] + formula(before[top]),
        rtol=0,
        atol=ulps(before),
    )
    bottom = side(before, "zMin")
    np.testing.assert_array_equal(after[bottom], before[bottom])


def test_a_fixed_value_is_met_bit_for_bit_on_nonuniform_values(tmp_path):
    x = reference(rbf_case(tmp_path / "mesh", {}))
    top = side(x, "zMax")
    values = 0.05 * np.random.default_rng(1).uniform(-1, 1, (top.sum(), 3))
    case = rbf_case(
        tmp_path / "case",
        {
            **{name: "zeroGradient" for name in CUBE},
            "zMin": HELD,
            "zMax": "timeVaryingMappedFixedValue; mapMethod nearest;",
        },
    )
    boundary_data(case, x[top], values)
    np.testing.assert_array_equal(move(case)[top], x[top] + values)


@pytest.mark.parametrize(
    "slide", ["slip", "fixedNormalSlip", "symmetry", "symmetryPlane"]
)
def test_sliding_points_keep_their_plane_and_follow_along_it(tmp_path, slide):
    kind = slide if "symmetry" in slide else "patch"
    patches = {name: kind if name[0] in "xy" else "patch" for name in CUBE}

    def condition(name):
        if slide == "fixedNormalSlip":
            return f"{slide}; n ({'1 0 0' if name[0] == 'x' else '0 1 0'});"
        return slide

    case = rbf_case(
        tmp_path,
        {
            **{name: condition(name) for name in CUBE},
            "zMin": HELD,
            "zMax": fixed(0.05, 0.03, -0.2),
        },
        coeffs="greedy { tolerance 0.2; }",
        patches=patches,
    )
    before = reference(case)
    after = move(case)
    for name in ("xMin", "xMax", "yMin", "yMax"):
        # The top moves off the plane, what slides below it does not
        on = side(before, name) & ~side(before, "zMax")
        axis = "xyz".index(name[0])
        np.testing.assert_allclose(
            after[on, axis], before[on, axis], rtol=0, atol=1e-12 * SPAN
        )
        # Halfway up, away from edges, they follow the top downwards
        middle = on & (before[:, 2] == 0.75)
        assert (after[middle, 2] < before[middle, 2] - 0.05).all()


def test_interior_points_move_less_the_farther_they_are(tmp_path):
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": fixed(0, 0, 0.2)})
    before = reference(case)
    moved = (move(case) - before)[:, 2]
    inside = [
        moved[(before == (0.5, 0.5, z)).all(axis=1)][0]
        for z in (0, 0.25, 0.5, 0.75, 1)
    ]
    assert np.all(np.diff(inside) > 0)


@pytest.mark.parametrize(
    "condition",
    ["zeroGradient", "calculated", "calculated; value uniform (0 0 0);"],
)
def test_points_of_free_patches_are_no_control_points(tmp_path, condition):
    case = rbf_case(
        tmp_path,
        {
            **{name: condition for name in CUBE},
            "zMin": HELD,
            "zMax": fixed(0.1, 0, 0),
        },
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert [s[1] for s in selections(output)] == [2 * 25]
    after = case.points("1/polyMesh/points")
    # What is free leaves its plane where the top goes sideways
    free = side(before, "xMax") & (before[:, 2] == 0.75)
    assert (after[free, 0] > 1.005).all()


def test_moving_wins_where_a_moving_and_a_sliding_patch_meet(tmp_path):
    value = (0.05, 0, 0.1)
    case = rbf_case(tmp_path, {**SLIPPING, "zMax": fixed(*value)})
    before = reference(case)
    edge = side(before, "zMax") & side(before, "xMax")
    np.testing.assert_array_equal(move(case)[edge], before[edge] + value)


def test_the_last_patch_wins_where_two_moving_patches_meet(tmp_path):
    # As in OpenFOAM, which evaluates one condition after the other
    case = rbf_case(
        tmp_path,
        {
            **{name: "zeroGradient" for name in CUBE},
            "xMin": HELD,
            "yMax": fixed(0.05, 0, 0),
            "zMax": fixed(0, 0.05, 0),
        },
    )
    before = reference(case)
    edge = side(before, "yMax") & side(before, "zMax")
    np.testing.assert_array_equal(
        move(case)[edge], before[edge] + (0, 0.05, 0)
    )


def test_pointDisplacement_may_be_absent(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs="""controlPoints
        { top { type moving; patches (zMax); displacement
          { type uniform; value (0 0 0.1); } }
          bottom { type fixed; patches (zMin); } }""",
    )
    before = reference(case)
    after = move(case)
    top = side(before, "zMax")
    np.testing.assert_array_equal(after[top], before[top] + (0, 0, 0.1))
    # The displacement is written for restart and post-processing
    assert (tmp_path / "1/pointDisplacement").exists()


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_condition_without_a_part_is_an_error_that_says_so(tmp_path, ranks):
    condition = (
        "surfaceSlipDisplacement; projectMode nearest;"
        " projectDirection (0 0 1); wedgePlane -1;"
        " geometry { ball { type searchableSphere;"
        " centre (0 0 0); radius 1; } }"
    )
    case = rbf_case(
        tmp_path, {**SLIPPING, "zMin": condition, "zMax": fixed(0, 0, 0.1)}
    )
    if ranks > 1:
        case.decompose((2, 1, 1))
    before = case.tree()
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    assert case.tree() == before
    for phrase in (
        "pointDisplacement",
        "'zMin'",
        "surfaceSlipDisplacement",
        "rbfMotionSolver cannot interpret",
        "controlPoints",
    ):
        assert phrase in output


def test_a_support_radius_of_four_displacements_reaches_as_far(tmp_path):
    # 4 x 0.05 = 0.2 from the top: nothing at 0.75 and below moves
    case = rbf_case(
        tmp_path,
        {**{name: "zeroGradient" for name in CUBE}, "zMax": fixed(0, 0, 0.05)},
        coeffs="supportRadiusFactor 4;",
        cells=(4, 4, 8),
    )
    before = reference(case)
    after = move(case)
    still = before[:, 2] <= 0.8
    np.testing.assert_array_equal(after[still], before[still])
    moving = before[:, 2] == 0.875
    assert (after[moving, 2] > before[moving, 2]).all()


def test_coefficients_may_be_empty(tmp_path):
    bare = rbf_case(tmp_path / "bare", {**SLIPPING, "zMax": fixed(0, 0, 0.1)})
    empty = rbf_case(
        tmp_path / "empty", {**SLIPPING, "zMax": fixed(0, 0, 0.1)}, coeffs=""
    )
    np.testing.assert_array_equal(move(bare), move(empty))


def test_a_patch_far_from_the_origin_is_moved_exactly(tmp_path):
    shift = 1000.0
    case = rbf_case(
        tmp_path,
        {**SLIPPING, "zMax": fixed(0, 0, 0.1)},
        low=(shift,) * 3,
        high=(shift + 1,) * 3,
    )
    before = reference(case)
    top = before[:, 2] == shift + 1
    np.testing.assert_array_equal(move(case)[top], before[top] + (0, 0, 0.1))


def test_fixedNormalSlip_keeps_points_in_the_plane_of_its_own_normal(tmp_path):
    # On a slanted side, whose own normal is another. As in OpenFOAM, where
    # the condition removes the part of the displacement along n
    slanted = [
        (0, 0, 0),
        (1, 0, 0),
        (1, 1, 0),
        (0, 1, 0),
        (0, 0, 1),
        (1.4, 0, 1),
        (1.4, 1, 1),
        (0, 1, 1),
    ]
    case = rbf_case(
        tmp_path,
        {
            **{name: "zeroGradient" for name in CUBE},
            "zMin": HELD,
            "zMax": fixed(0, 0, 0.2),
            "xMax": "fixedNormalSlip; n (2 0 0);",
        },
        corners=slanted,
    )
    before = reference(case)
    after = move(case)
    on = np.isclose(before[:, 0], 1 + 0.4 * before[:, 2])
    assert on.sum() == 25
    np.testing.assert_allclose(
        after[on, 0], before[on, 0], rtol=0, atol=1e-12 * SPAN
    )
    middle = on & (before[:, 2] == 0.75)
    assert (after[middle, 2] > before[middle, 2] + 0.01).all()


def test_what_a_field_includes_beside_its_conditions_does_not_matter(tmp_path):
    # As OpenFOAM's sphereDrop does for its macros: arcs of a blockMeshDict
    conditions = {**SLIPPING, "zMax": fixed(0, 0, 0.1)}
    case = rbf_case(tmp_path, conditions)
    field = tmp_path / "0/pointDisplacement"
    text = field.read_text()
    field.write_text(
        text.replace(
            "dimensions",
            "edges ( arc 30 31 (0.1 0.2 0.3) arc 1 40000000 (1 2 3) );"
            " dimensions",
            1,
        )
    )
    before = reference(case)
    top = side(before, "zMax")
    np.testing.assert_array_equal(move(case)[top], before[top] + [0, 0, 0.1])
