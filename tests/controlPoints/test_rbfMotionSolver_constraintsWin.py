# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Constraints of patches win over what groups and conditions say.

Source of truth: what each constraint means in OpenFOAM. Points of a plane of
symmetry stay in it (displacementLaplacian: 0), those of an empty or wedge mesh
in their planes, coupled points together.
"""

import numpy as np
import pytest

from boxCase import fixed, words
from rbfCase import CUBE, groups, move, rbf_case, reference, side

ACROSS = (0.1, 0.03, 0.2)

BOTTOM = "type fixed; patches (zMin);"


def uniform(*value):
    return f"displacement {{ type uniform; value ({words(value)}); }}"


TOLD = {
    "patch": "type moving; patches (zMax);" + uniform(*ACROSS),
    "points": "type moving; points ((0 0.5 1) (0 0.5 0.5));"
    + uniform(*ACROSS),
    "zone": "type moving; pointZones (some);" + uniform(*ACROSS),
    "sliding": "type sliding; patches (zMax);" + uniform(*ACROSS),
    "target": "type sliding; patches (zMax); target { type searchablePlane;"
    " planeType pointAndNormal; pointAndNormalDict"
    " { point (0.3 0.5 1.1); normal (0.2 0.1 1); } }",
    "whole": 'type moving; patches (".*");' + uniform(*ACROSS),
}

ZONE = """actions
( { name s; type pointSet; action new; source boxToPoint;
    sourceInfo { box (-1 -1 0.9) (0.3 2 2); } }
  { name some; type pointZoneSet; action new; source setToPointZone;
    sourceInfo { set s; } } );"""


def told_case(path, told, patches, images, **rest):
    case = rbf_case(
        path,
        patches=patches,
        **rest,
        coeffs=(
            f"images {images}; supportRadius 1;"
            + groups(told=TOLD[told], bottom=BOTTOM)
        ),
    )
    case.write("system/topoSetDict", "dictionary", ZONE)
    case.run("topoSet")
    return case


@pytest.mark.parametrize("images", ["auto", "no", "yes"])
@pytest.mark.parametrize("told", TOLD)
def test_a_plane_of_symmetry_is_kept_whatever_moves(tmp_path, told, images):
    kind = "symmetry" if images == "auto" else "symmetryPlane"
    case = told_case(tmp_path, told, {**CUBE, "xMin": kind}, images)
    before = reference(case)
    output = case.run("moveDynamicMesh")
    after = case.points("1/polyMesh/points")
    on = side(before, "xMin")
    np.testing.assert_array_equal(after[on, 0], 0)
    if told in ("patch", "points", "zone", "whole"):
        # Of what was told the rest is done
        at = (before == (0, 0.5, 1)).all(axis=1)
        np.testing.assert_allclose(
            after[at] - before[at], [(0, *ACROSS[1:])], rtol=0, atol=1e-15
        )
        assert "xMin" in output and "0.1" in output
        assert output.count("FOAM Warning") >= 1
    if told in ("patch", "whole"):
        free = side(before, "zMax") & ~on
        np.testing.assert_allclose(
            after[free], before[free] + ACROSS, rtol=0, atol=1e-15
        )
    case.run("checkMesh", "-time", "1")


def test_a_condition_across_a_plane_of_symmetry_loses(tmp_path):
    case = rbf_case(
        tmp_path,
        {
            **{name: "slip" for name in CUBE},
            "xMin": "symmetryPlane",
            "zMin": fixed(0, 0, 0),
            "zMax": fixed(*ACROSS),
        },
        patches={**CUBE, "xMin": "symmetryPlane"},
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[side(before, "xMin"), 0], 0)


def test_two_planes_of_symmetry_leave_the_edge_between_them(tmp_path):
    patches = {**CUBE, "xMin": "symmetryPlane", "yMin": "symmetry"}
    case = told_case(tmp_path, "patch", patches, "auto")
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[side(before, "xMin"), 0], 0)
    np.testing.assert_array_equal(after[side(before, "yMin"), 1], 0)
    corner = side(before, "xMin") & side(before, "yMin") & side(before, "zMax")
    np.testing.assert_allclose(
        after[corner] - before[corner], [(0, 0, ACROSS[2])], rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("ranks", [2, 4])
def test_the_plane_is_the_same_on_any_number_of_ranks(tmp_path, ranks):
    patches = {**CUBE, "xMin": "symmetryPlane"}
    one = told_case(tmp_path / "one", "patch", patches, "auto")
    many = told_case(tmp_path / "many", "patch", patches, "auto")
    many.decompose((1, ranks, 1))
    np.testing.assert_array_equal(move(many, ranks=ranks), move(one))


@pytest.mark.parametrize(
    "entry",
    [
        uniform(0.1, 0, 0),
        'target "other.stl";',
        "surface { type searchablePlane; planeType pointAndNormal;"
        " pointAndNormalDict { point (0.1 0 0); normal (1 0 0); } }",
    ],
)
def test_a_group_that_moves_a_plane_of_symmetry_itself_is_an_error(
    tmp_path, entry
):
    case = rbf_case(
        tmp_path,
        patches={**CUBE, "xMin": "symmetryPlane"},
        coeffs=groups(
            plane="type sliding; patches (xMin);" + entry, bottom=BOTTOM
        ),
    )
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    assert case.tree() == before
    for phrase in ("'plane'", "'xMin'", "symmetryPlane"):
        assert phrase in output


@pytest.mark.parametrize("told", ["patch", "points", "zone", "target"])
def test_an_empty_mesh_stays_in_its_plane(tmp_path, told):
    patches = {**CUBE, "yMin": "empty", "yMax": "empty"}
    case = told_case(tmp_path, told, patches, "auto", cells=(4, 1, 4))
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[:, 1], before[:, 1])
    assert np.abs(after - before).max() > 0.05


def test_a_mesh_of_one_dimension_moves_along_it(tmp_path):
    """Four empty sides: in OpenFOAM they keep y and z."""
    patches = {**CUBE, **{name: "empty" for name in CUBE if name[0] != "x"}}
    case = rbf_case(
        tmp_path,
        patches=patches,
        cells=(8, 1, 1),
        coeffs=groups(
            piston="type moving; patches (xMax);" + uniform(*ACROSS),
            end="type fixed; patches (xMin);",
        ),
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[:, 1:], before[:, 1:])
    piston = side(before, "xMax")
    np.testing.assert_allclose(after[piston, 0], 1.1, rtol=0, atol=1e-15)


def coupled(kind, extra=""):
    return {
        "yMin": f"{kind}; neighbourPatch yMax; {extra}",
        "yMax": f"{kind}; neighbourPatch yMin; {extra}",
    }


AMI = "matchTolerance 1e-4; transform translational; separationVector"


@pytest.mark.parametrize("images", ["auto", "no", "yes"])
@pytest.mark.parametrize("told", ["patch", "points", "zone", "target"])
@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI"])
def test_coupled_sides_stay_on_each_other(tmp_path, told, images, kind):
    patches = {**CUBE, **coupled(kind)}
    if kind == "cyclicAMI":
        for name, way in (("yMin", "(0 1 0)"), ("yMax", "(0 -1 0)")):
            patches[name] = patches[name] + f"{AMI} {way};"
    if told == "target":
        # One that has the period too
        patches = {**patches}
    case = told_case(tmp_path, told, patches, images)
    if told == "target":
        path = tmp_path / "constant/dynamicMeshDict"
        path.write_text(
            path.read_text().replace("normal (0.2 0.1 1)", "normal (0.2 0 1)")
        )
    before = reference(case)
    after = move(case)
    low = {
        tuple(x[[0, 2]].round(9)): y
        for x, y in zip(before, after)
        if x[1] < 1e-9
    }
    for x, y in zip(before, after):
        if x[1] > 1 - 1e-9:
            np.testing.assert_allclose(
                y - (0, 1, 0),
                low[tuple(x[[0, 2]].round(9))],
                rtol=0,
                atol=1e-14,
            )
    assert np.abs(after - before).max() > 0.05


def test_cyclicSlip_sides_keep_their_plane_too(tmp_path):
    """cyclic and slip: each point of a side stays on it."""
    case = told_case(
        tmp_path, "patch", {**CUBE, **coupled("cyclicSlip")}, "auto"
    )
    before = reference(case)
    after = move(case)
    for name, at in (("yMin", 0), ("yMax", 1)):
        np.testing.assert_allclose(
            after[side(before, name), 1], at, rtol=0, atol=1e-15
        )
    inner = (
        side(before, "zMax") & ~side(before, "yMin") & ~side(before, "yMax")
    )
    np.testing.assert_allclose(
        after[inner], before[inner] + ACROSS, rtol=0, atol=1e-15
    )


def test_constraint_types_that_only_the_condition_knows_are_accepted(tmp_path):
    """cyclicPeriodicAMI: OpenFOAM's condition for it is cyclicAMI."""
    patches = {
        **CUBE,
        **coupled(
            "cyclicPeriodicAMI", "periodicPatch xMin; matchTolerance 1e-4;"
        ),
    }
    for name, way in (("yMin", "(0 1 0)"), ("yMax", "(0 -1 0)")):
        patches[name] += f"transform translational; separationVector {way};"
    case = rbf_case(
        tmp_path,
        {
            **{name: "slip" for name in CUBE},
            "zMin": fixed(0, 0, 0),
            "yMin": "cyclicAMI",
            "yMax": "cyclicAMI",
            "zMax": fixed(0, 0, 0.1),
        },
        patches=patches,
    )
    before = reference(case)
    after = move(case)
    top = side(before, "zMax")
    np.testing.assert_array_equal(after[top], before[top] + (0, 0, 0.1))


# --- targets and what they meet

PLANE = (
    "target { type searchablePlane; planeType pointAndNormal;"
    " pointAndNormalDict { point (0.5 0.5 1.1); normal (%s); } }"
)


@pytest.mark.parametrize("normal", ["0 0 1", "0.3 0.2 1"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_a_target_meets_planes_edges_and_corners(tmp_path, normal, ranks):
    """Every point of the top ends on the plane and on the sides it is on:
    the corners where three planes meet."""
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type sliding; patches (zMax);" + PLANE % normal,
            bottom=BOTTOM,
            sides='type sliding; patches ("[xy].*");',
        ),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    after = move(case, ranks=ranks)
    top = side(before, "zMax")
    n = np.array(normal.split(), dtype=float)
    np.testing.assert_allclose(
        (after[top] - (0.5, 0.5, 1.1)) @ n, 0, rtol=0, atol=1e-12
    )
    for name in ("xMin", "xMax", "yMin", "yMax"):
        on = side(before, name)
        axis = "xyz".index(name[0])
        np.testing.assert_allclose(
            after[on, axis], before[on, axis], rtol=0, atol=1e-12
        )


def test_a_target_meets_planes_of_symmetry_in_corners(tmp_path):
    patches = {**CUBE, "xMin": "symmetryPlane", "yMin": "symmetry"}
    case = rbf_case(
        tmp_path,
        patches=patches,
        coeffs=groups(
            top="type sliding; patches (zMax);" + PLANE % "0 0 1",
            bottom=BOTTOM,
        ),
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_allclose(
        after[side(before, "zMax"), 2], 1.1, rtol=0, atol=1e-12
    )
    np.testing.assert_array_equal(after[side(before, "xMin"), 0], 0)
    np.testing.assert_array_equal(after[side(before, "yMin"), 1], 0)


def test_corners_of_a_plane_mesh_are_on_the_target(tmp_path):
    patches = {**CUBE, "yMin": "empty", "yMax": "empty"}
    case = rbf_case(
        tmp_path,
        patches=patches,
        cells=(4, 1, 4),
        coeffs=groups(
            top="type sliding; patches (zMax);" + PLANE % "0.2 0 1",
            bottom=BOTTOM,
            sides="type sliding; patches (xMin xMax);",
        ),
    )
    before = reference(case)
    after = move(case)
    top = side(before, "zMax")
    np.testing.assert_allclose(
        (after[top] - (0.5, 0.5, 1.1)) @ (0.2, 0, 1), 0, rtol=0, atol=1e-12
    )


def test_corners_of_a_sliding_surface_that_moves_go_along(tmp_path):
    """The top moves as a surface: its corners are where it meets the sides."""
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type sliding; patches (zMax);" + uniform(0, 0, 0.1),
            bottom=BOTTOM,
            sides='type sliding; patches ("[xy].*");',
        ),
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_allclose(
        after[side(before, "zMax"), 2], 1.1, rtol=0, atol=1e-12
    )


def test_a_corner_that_cannot_be_on_its_target_is_an_error(tmp_path):
    """A target that is parallel to a side never meets it."""
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type sliding; patches (zMax);" + PLANE % "1 0 0",
            bottom=BOTTOM,
            sides='type sliding; patches ("[xy].*");',
        ),
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "'top'" in output and "corner" in output
