# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What rbfMotionSolver keeps: planes, wedges, cyclic pairs, slip surfaces.

Sources of truth: what each constraint means in OpenFOAM (an empty mesh moves
in its plane, points of a wedge keep their angle, cyclic pairs keep their
separation), and the definition of sliding in Aubert et al. (2017): of the
displacement, the part normal to the surface is prescribed.
"""

import numpy as np
import pytest

from boxCase import fixed, words
from rbfCase import (
    CUBE,
    groups,
    move,
    rbf_case,
    reference,
    selections,
    side,
    ulps,
)

SPAN = np.sqrt(3)

FREE = {name: "zeroGradient" for name in CUBE}

# Leaves out some of the points, which nevertheless have to keep their surface
COARSE = "greedy { tolerance 0.2; }"

KERNELS = [
    "wendlandC0",
    "wendlandC2",
    "wendlandC4",
    "wendlandC6",
    "gaussian",
    "inverseMultiQuadric",
    "multiQuadric",
    "thinPlate",
]


def uniform(*value):
    return f"displacement {{ type uniform; value ({words(value)}); }}"


# --- two dimensions


@pytest.mark.parametrize("thin", "xyz")
def test_both_planes_of_an_empty_mesh_move_alike_and_in_the_plane(
    tmp_path, thin
):
    axis = "xyz".index(thin)
    up = "xyz"[(axis + 1) % 3]
    patches = {name: "empty" if name[0] == thin else "patch" for name in CUBE}
    cells = tuple(1 if a == axis else 8 for a in range(3))
    case = rbf_case(
        tmp_path,
        {
            **{name: "empty" if name[0] == thin else "slip" for name in CUBE},
            f"{up}Min": fixed(0, 0, 0),
            f"{up}Max": "solidBodyMotionDisplacement; solidBodyMotionFunction"
            " rotatingMotion; rotatingMotionCoeffs { origin (0.4 0.4 0.4);"
            f" axis ({words(np.eye(3)[axis])}); omega 0.1; }}",
        },
        patches=patches,
        cells=cells,
    )
    before = reference(case)
    displacement = move(case) - before
    assert np.abs(displacement).max() > 0.02
    np.testing.assert_array_equal(displacement[:, axis], 0)

    order = np.lexsort(
        [before[:, a] for a in range(3) if a != axis] + [before[:, axis]]
    )
    lower, upper = np.split(order, 2)
    after = case.points("1/polyMesh/points")
    in_plane = [a for a in range(3) if a != axis]
    np.testing.assert_array_equal(
        before[lower][:, in_plane], before[upper][:, in_plane]
    )
    np.testing.assert_array_equal(
        after[lower][:, in_plane], after[upper][:, in_plane]
    )


def test_a_displacement_out_of_the_plane_of_an_empty_mesh_is_dropped(tmp_path):
    patches = {name: "empty" if name[0] == "z" else "patch" for name in CUBE}
    case = rbf_case(
        tmp_path,
        {
            **FREE,
            "zMin": "empty",
            "zMax": "empty",
            "xMin": fixed(0, 0, 0),
            "xMax": fixed(0.1, 0.05, 0.3),
        },
        patches=patches,
        cells=(6, 6, 1),
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[:, 2], before[:, 2])
    on = side(before, "xMax")
    np.testing.assert_array_equal(after[on], before[on] + (0.1, 0.05, 0))


ANGLE = np.radians(2.5)
WEDGE = {**CUBE, "zMin": "wedge", "zMax": "wedge"}


def wedge_corners(inner):
    """The axis is x; the wedge is 5 degrees between zMin and zMax."""
    return [
        (x, r * np.cos(ANGLE), z * r * np.sin(ANGLE))
        for z in (-1, 1)
        for x, r in ((0, inner), (1, inner), (1, 1), (0, 1))
    ]


@pytest.mark.parametrize("inner", [0.2, 0])
def test_points_of_a_wedge_keep_their_angle(tmp_path, inner):
    on_axis = inner == 0
    patches = {**WEDGE, "yMin": "empty" if on_axis else "patch"}
    case = rbf_case(
        tmp_path,
        {
            **FREE,
            "zMin": "wedge",
            "zMax": "wedge",
            "yMin": "empty" if on_axis else "zeroGradient",
            "xMin": fixed(0, 0, 0),
            "xMax": fixed(0.1, 0, 0),
            "yMax": "uniformFixedValue; uniformValue (0.05 0.1 0);",
        },
        coeffs="supportRadius 1;",
        patches=patches,
        cells=(6, 6, 1),
        corners=wedge_corners(inner),
        axis=on_axis,
    )
    before = reference(case)
    after = move(case)
    assert np.abs(after - before).max() > 0.05

    axis = np.hypot(before[:, 1], before[:, 2]) < 1e-10
    assert axis.any() == on_axis
    angle = np.arctan2(after[:, 2], after[:, 1])
    np.testing.assert_allclose(
        angle[~axis], np.sign(before[~axis, 2]) * ANGLE, rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(after[axis, 1:], 0, rtol=0, atol=1e-15)
    if on_axis:
        # They slide along it
        middle = axis & (before[:, 0] > 0.4) & (before[:, 0] < 0.6)
        assert middle.any() and (after[middle, 0] > before[middle, 0]).all()

    # Both sides are mirror images
    lower, upper = (before[:, 2] < -1e-10), (before[:, 2] > 1e-10)
    for points in (before, after):
        a, b = points[lower], points[upper] * (1, 1, -1)
        a = a[np.lexsort(before[lower].round(9).T[:2])]
        b = b[np.lexsort(before[upper].round(9).T[:2])]
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-14)

    # What is told in y is taken along the radius
    outer = (
        np.isclose(np.hypot(before[:, 1], before[:, 2]), 1)
        & (before[:, 0] > 0.1)
        & (before[:, 0] < 0.9)
    )
    d = after[outer] - before[outer]
    np.testing.assert_allclose(d[:, 0], 0.05, rtol=0, atol=1e-14)
    np.testing.assert_allclose(
        np.hypot(d[:, 1], d[:, 2]), 0.1 * np.cos(ANGLE), rtol=0, atol=1e-14
    )


# --- cyclic

CYCLIC = {
    **CUBE,
    "xMin": "cyclic; neighbourPatch xMax;",
    "xMax": "cyclic; neighbourPatch xMin;",
}


@pytest.mark.parametrize("ranks", [1, 2])
def test_cyclic_pairs_keep_their_separation(tmp_path, ranks):
    # The control point that moves is nearer to one side than to the other
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 1;\n"
        + groups(
            one="type moving; points ((0.25 0.5 0.5));"
            + uniform(0.05, 0, 0.1),
            ends="type fixed; patches (zMin zMax);",
        ),
        patches=CYCLIC,
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    after = move(case, ranks=ranks)
    left, right = (
        np.flatnonzero(side(before, name)) for name in ("xMin", "xMax")
    )
    left, right = (
        these[np.lexsort(before[these].T[1:])] for these in (left, right)
    )
    assert np.abs(after[left] - before[left]).max() > 0.01
    np.testing.assert_allclose(
        after[right] - after[left],
        np.tile([1.0, 0, 0], (len(left), 1)),
        rtol=0,
        atol=1e-15,
    )


# --- sliding


def test_edges_of_two_slip_walls_slide_along_themselves_and_corners_stay(
    tmp_path,
):
    case = rbf_case(
        tmp_path,
        coeffs=COARSE
        + "supportRadius 2;\n"
        + groups(
            one="type moving; points ((0.5 0.5 0.5));"
            + uniform(0.05, 0.04, -0.06),
            walls='type sliding; patches (".*");',
        ),
    )
    before = reference(case)
    after = move(case)
    count = sum(side(before, name).astype(int) for name in CUBE)
    for name in CUBE:
        on, axis = side(before, name), "xyz".index(name[0])
        np.testing.assert_allclose(
            after[on, axis], before[on, axis], rtol=0, atol=1e-15
        )
    corners = count == 3
    assert corners.sum() == 8
    np.testing.assert_array_equal(after[corners], before[corners])
    for axis in range(3):
        along = (count == 2) & (before[:, axis] == 0.5)
        assert along.sum() == 4
        assert (np.abs(after[along, axis] - 0.5) > 1e-3).all()
    assert (np.abs(after - before)[count == 1].max(axis=1) > 1e-3).all()


def rotated(points, angle=0.7, axis=(1, 2, 3)):
    k = np.array(axis) / np.linalg.norm(axis)
    points = np.array(points, float)
    return (
        points * np.cos(angle)
        + np.cross(k, points) * np.sin(angle)
        + np.outer(points @ k, k) * (1 - np.cos(angle))
    )


def test_points_of_a_plane_in_any_direction_stay_on_it(tmp_path):
    corners = [
        (x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    up = rotated([(0.05, 0.03, 0.2)])[0]
    case = rbf_case(
        tmp_path,
        {
            **{name: "slip" for name in CUBE},
            "zMin": fixed(0, 0, 0),
            "zMax": fixed(*up),
        },
        coeffs=COARSE,
        corners=rotated(corners),
    )
    before = rotated(reference(case), -0.7)
    ((selected, candidates, error, _),) = selections(
        case.run("moveDynamicMesh")
    )
    assert selected < candidates and error > 1e-3
    after = rotated(case.points("1/polyMesh/points"), -0.7)
    for name in ("xMin", "xMax", "yMin", "yMax"):
        axis = "xyz".index(name[0])
        # The top moves off the plane, what slides below it does not
        on = np.isclose(before[:, axis], 1 if "Max" in name else 0) & (
            before[:, 2] < 0.9
        )
        assert on.sum() == 20
        np.testing.assert_allclose(
            after[on, axis], before[on, axis], rtol=0, atol=1e-12 * SPAN
        )
        assert np.abs(after[on] - before[on]).max() > 0.05


def test_a_moving_surface_imposes_only_the_normal_part_on_what_slides(
    tmp_path,
):
    case = rbf_case(
        tmp_path,
        coeffs=COARSE
        + "supportRadius 1;\n"
        + groups(
            ends="type fixed; patches (zMin zMax xMin);",
            flank="type sliding; patches (xMax);" + uniform(0.1, 0.3, 0.2),
        ),
    )
    before = reference(case)
    after = move(case)
    on = side(before, "xMax") & ~side(before, "zMin") & ~side(before, "zMax")
    np.testing.assert_allclose(
        after[on, 0], before[on, 0] + 0.1, rtol=0, atol=ulps(before)
    )
    # Nothing asks for the tangential part
    assert np.abs(after[on, 1:] - before[on, 1:]).max() < 0.05


def test_points_slide_on_the_surface_where_it_has_moved_to(tmp_path):
    angle, centre = 0.1, np.array([1, 0.5, 0.5])
    case = rbf_case(
        tmp_path,
        coeffs=COARSE
        + "supportRadius 1;\n"
        + groups(
            held="type fixed; patches (xMin);",
            flank="type sliding; patches (xMax); displacement { type solidBody;"
            " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
            f" {{ origin ({words(centre)}); axis (0 1 0); omega {angle}; }} }}",
        ),
    )
    before = reference(case)
    after = move(case)
    on = side(before, "xMax")
    n = np.array([np.cos(angle), 0, -np.sin(angle)])
    np.testing.assert_allclose(
        (after[on] - centre) @ n, 0, rtol=0, atol=1e-12 * SPAN
    )


def test_symmetry_patches_slide_though_no_group_selects_them(tmp_path):
    patches = {**CUBE, "xMax": "symmetryPlane", "yMax": "symmetry"}
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax);" + uniform(0, 0, 0.2),
            bottom="type fixed; patches (zMin);",
        ),
        patches=patches,
    )
    before = reference(case)
    after = move(case)
    for name in ("xMax", "yMax"):
        on, axis = side(before, name), "xyz".index(name[0])
        np.testing.assert_allclose(after[on, axis], 1, rtol=0, atol=1e-15)
    middle = side(before, "xMax") & (before[:, 2] == 0.75)
    assert (after[middle, 2] > 0.78).all()


def test_points_of_a_curved_surface_slide_in_the_plane_of_their_faces(
    tmp_path,
):
    # A tent: its ridge is an edge of two planes, along which alone it slides
    corners = [
        (0, 0, 0),
        (1, 0, 0),
        (1, 1, 0),
        (0, 1, 0),
        (0, 0, 1),
        (1, 0, 1.5),
        (1, 1, 1.5),
        (0, 1, 1),
    ]
    case = rbf_case(
        tmp_path,
        {
            "xMin": "slip",
            "yMax": "slip",
            "roof": "slip",
            "zMin": fixed(0, 0, 0),
            "yMin": fixed(0, 0.2, 0),
        },
        patches={
            **{n: "patch" for n in CUBE if n not in ("xMax", "zMax")},
            "roof": ("patch", "xMax zMax"),
        },
        corners=corners,
    )
    before = reference(case)
    after = move(case)
    n = np.array([-0.5, 0, 1]) / np.hypot(0.5, 1)
    top = np.isclose(before[:, 2], 1 + 0.5 * before[:, 0])
    wall = np.isclose(before[:, 0], 1)
    np.testing.assert_allclose(
        (after - before)[top] @ n, 0, rtol=0, atol=1e-12 * SPAN
    )
    np.testing.assert_allclose(
        (after - before)[wall, 0], 0, rtol=0, atol=1e-12 * SPAN
    )
    ridge = top & wall
    assert ridge.sum() == 5
    middle = ridge & (before[:, 1] == 0.25)
    assert (after[middle, 1] > before[middle, 1] + 0.05).all()


# --- what a linear polynomial reproduces


def affine_case(path, kernel, moving, sliding, displacement):
    """Boundaries displaced by an affine function, through a file."""
    case = rbf_case(
        path,
        coeffs=f"""
        kernel {kernel}; polynomial linear; supportRadius 0.7;
        """
        + groups(
            wall=f"type moving; patches ({moving}); displacement"
            ' { type file; file "constant/wall.txt"; tolerance 1e-9; }',
            **(
                {"slip": f"type sliding; patches ({sliding});"}
                if sliding
                else {}
            ),
        ),
        cells=(4, 3, 5),
    )
    x = reference(case)
    (case.path / "constant/wall.txt").write_text(
        "".join(f"{words(a)} {words(d)}\n" for a, d in zip(x, displacement(x)))
    )
    return case


@pytest.mark.parametrize("kernel", KERNELS)
def test_an_affine_displacement_is_reproduced_everywhere(tmp_path, kernel):
    matrix = np.array([[0.1, -0.2, 0.05], [0.03, 0.2, 0.1], [-0.1, 0.07, 0.3]])

    def displacement(x):
        return x @ matrix.T + (0.2, -0.1, 0.3)

    case = affine_case(tmp_path, kernel, '".*"', "", displacement)
    before = reference(case)
    np.testing.assert_allclose(
        move(case), before + displacement(before), rtol=0, atol=1e-13
    )


@pytest.mark.parametrize("kernel", KERNELS)
def test_an_affine_displacement_is_reproduced_with_sliding_sides(
    tmp_path, kernel
):
    def displacement(x):
        return np.outer(x @ (0.05, 0.02, 0.2) + 0.01, (0, 0, 1))

    case = affine_case(tmp_path, kernel, "zMin zMax", '"[xy].*"', displacement)
    before = reference(case)
    np.testing.assert_allclose(
        move(case), before + displacement(before), rtol=0, atol=1e-13
    )


# --- motions that return

THERE_AND_BACK = (
    "displacement { type uniform; value table ((0 (0 0 0))"
    " (1 (0.02 0 0.2)) (2 (0.01 0 0.1)) (3 (0.02 0 0.2))"
    " (4 (0 0 0))); }"
)


@pytest.mark.parametrize(
    "extra",
    [
        "",
        "polynomial linear;",
        "selection all;",
        "kernel gaussian; supportRadius 0.5;",
    ],
)
def test_a_motion_that_returns_brings_the_mesh_back(tmp_path, extra):
    case = rbf_case(
        tmp_path,
        coeffs=extra
        + groups(
            top="type moving; patches (zMax);" + THERE_AND_BACK,
            bottom="type fixed; patches (zMin);",
            sides='type sliding; patches ("[xy].*");',
        ),
        control={"end": 4},
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    there, half, again, back = (
        case.points(f"{t}/polyMesh/points") for t in (1, 2, 3, 4)
    )
    assert np.abs(there - before).max() > 0.1
    # All displacements are zero again, and with them all weights
    np.testing.assert_array_equal(back, before)
    np.testing.assert_allclose(again, there, rtol=0, atol=1e-13 * SPAN)
    # The system is linear: half the displacement everywhere
    np.testing.assert_allclose(
        half, (before + there) / 2, rtol=0, atol=1e-13 * SPAN
    )
    assert len(selections(output)) == 1


def test_a_displacement_of_zero_leaves_the_mesh_as_it_is(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax);" + uniform(0, 0, 0),
            sides='type sliding; patches ("[xy].*");',
        ),
    )
    before = reference(case)
    np.testing.assert_array_equal(move(case, rests=True), before)
