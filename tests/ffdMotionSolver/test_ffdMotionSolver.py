# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What ffdMotionSolver does with a mesh.

Sources of truth: the formula of Sederberg and Parry (1986), computed by numpy;
symmetry of the problem (a rotated box is the mesh rotated, the box, and the
mesh rotated back); what each constraint means in OpenFOAM.
"""

import math
import pathlib
import re
import shutil

import numpy as np
import pytest

from boxCase import fixed, from_block_mesh, point_field, vectors, words
from foamCase import build_program
from ffdCase import (
    CUBE,
    displaced,
    ffd_box,
    ffd_case,
    move,
    parameter,
    points_at,
    reference,
    rotation,
    write_boxes,
)

ROUND_OFF = 1e-14

CELLS = (5, 4, 3)

MOVES = [
    ((1, 1, 1), (0.5, 0.3, -0.2)),
    ((1, 2, 1), (0, 0.2, 0)),
    ((2, 2, 2), (0.1, 0, 0)),
]

TABLE = "table ((0 0) (1 0.3) (2 0.3) (3 -0.2) (4 0))"


def test_points_move_by_the_formula(tmp_path):
    case = ffd_case(
        tmp_path, ffd_box("body", parameter("a", MOVES, "0.7")), cells=CELLS
    )
    before = reference(case)
    d = displaced(before, MOVES, (2, 2, 2), [-0.1] * 3, [1.2] * 3)
    assert np.abs(d).max() > 0.05
    np.testing.assert_allclose(
        move(case), before + 0.7 * d, rtol=0, atol=ROUND_OFF
    )


def test_only_points_in_a_local_box_move_and_those_on_its_faces_belong_to_it(
    tmp_path,
):
    # The box reaches from 0.2 to 0.6 in x: points at 0.2 and 0.6 are on its
    # faces; there is no mesh beyond the others
    moves = [((i, 1, 1), (0, 0.2, 0)) for i in range(3)]
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", moves, "1"),
            origin=(0.2, 0, 0),
            span=(0.4, 1, 1),
            extra="continuity none;",
        ),
        "onInvalidMesh ignore;",
        cells=(5, 4, 4),
    )
    before = reference(case)
    d = displaced(before, moves, (2, 2, 2), (0.2, 0, 0), (0.4, 1, 1))
    on = np.isclose(before[:, 0], 0.2) | np.isclose(before[:, 0], 0.6)
    assert np.abs(d[on]).max() > 0.04
    np.testing.assert_allclose(move(case), before + d, rtol=0, atol=ROUND_OFF)


@pytest.mark.parametrize(
    "extra", ["", "basis bSpline; degree (2 3 1);", "weights ( ((1 1 1) 3) );"]
)
def test_parameters_of_zero_leave_the_mesh_as_it_is_to_the_bit(
    tmp_path, extra
):
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", MOVES, "0"),
            order=(4, 4, 4),
            extra=extra + "continuity none;"
            "rotation { type axisAngle; axis (1 2 3);"
            " angle 20; }",
        ),
        cells=CELLS,
    )
    before = reference(case)
    np.testing.assert_array_equal(move(case, rests=True), before)


def test_a_rotated_box_is_the_mesh_rotated_and_rotated_back(tmp_path):
    axis, angle, origin = (1, 2, 3), 25, np.array([0.1, 0.2, 0])
    R = rotation(axis, angle)
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", MOVES, "0.5"),
            origin=origin,
            span=(0.9, 0.8, 0.7),
            extra="continuity none; rotation { type"
            f" axisAngle; axis ({words(axis)}); angle {angle}; }}",
        ),
        "onInvalidMesh ignore;",
        cells=(8, 8, 8),
    )
    before = reference(case)
    turned = origin + (before - origin) @ R
    d = displaced(turned, MOVES, (2, 2, 2), origin, (0.9, 0.8, 0.7))
    assert (np.abs(d).max(axis=1) > 0.01).sum() > 50
    np.testing.assert_allclose(
        move(case), before + 0.5 * d @ R.T, rtol=0, atol=ROUND_OFF
    )


def test_units_of_metres_are_along_the_axes_of_the_box(tmp_path):
    R = rotation((0, 0, 1), 10)
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", [((0, 0, 0), (0.1, 0.02, 0))], "1"),
            order=(0, 0, 0),
            origin=(-1, -1, -1),
            span=(3, 3, 3),
            extra="units metres; rotation { type axisAngle; axis (0 0 1);"
            " angle 10; }",
        ),
    )
    before = reference(case)
    np.testing.assert_allclose(
        move(case) - before,
        np.tile(R @ (0.1, 0.02, 0), (len(before), 1)),
        rtol=0,
        atol=ROUND_OFF,
    )


def test_a_chain_acts_on_what_the_former_box_left_and_a_sum_does_not(tmp_path):
    first = [((1, 1, 1), (0.8, 0, 0))]
    second = [((1, 1, 1), (0, 0.8, 0))]
    boxes = ffd_box("one", parameter("a", first, "0.5")) + ffd_box(
        "two", parameter("b", second, "0.5")
    )
    how = ((2, 2, 2), [-0.1] * 3, [1.2] * 3)
    case = ffd_case(tmp_path, boxes, cells=CELLS)
    before = reference(case)
    middle = before + 0.5 * displaced(before, first, *how)
    chain = middle + 0.5 * displaced(middle, second, *how)
    add = middle + 0.5 * displaced(before, second, *how)
    assert np.abs(chain - add).max() > 0.003
    np.testing.assert_allclose(move(case), chain, rtol=0, atol=ROUND_OFF)
    write_boxes(case, boxes, "combine sum;")
    np.testing.assert_allclose(move(case), add, rtol=0, atol=ROUND_OFF)


def test_a_later_box_of_a_chain_follows_when_a_former_one_changes(tmp_path):
    first = [((1, 1, 1), (0.8, 0, 0))]
    second = [((1, 1, 1), (0, 0.8, 0))]
    case = ffd_case(
        tmp_path,
        ffd_box("one", parameter("a", first, TABLE))
        + ffd_box("two", parameter("b", second, "0.5")),
        cells=CELLS,
        control={"end": 4},
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    how = ((2, 2, 2), [-0.1] * 3, [1.2] * 3)
    for time, value in ((1, 0.3), (2, 0.3), (3, -0.2), (4, 0)):
        middle = before + value * displaced(before, first, *how)
        np.testing.assert_allclose(
            points_at(case, time),
            middle + 0.5 * displaced(middle, second, *how),
            rtol=0,
            atol=ROUND_OFF,
        )


def test_a_motion_that_returns_brings_the_mesh_back_to_the_bit(tmp_path):
    case = ffd_case(
        tmp_path,
        ffd_box("body", parameter("a", MOVES, TABLE)),
        cells=CELLS,
        control={"end": 4},
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    assert np.abs(points_at(case, 3) - before).max() > 0.01
    np.testing.assert_array_equal(points_at(case, 1), points_at(case, 2))
    np.testing.assert_array_equal(points_at(case, 4), before)


CYLINDER = """tube
{{
    type cylindrical; origin (0.5 0.5 0); axis (0 0 1); direction (1 0 0);
    start ({start}); span ({span}); order (2 {around} 1); {extra}
    parameters {{ {parameters} }}
}}
"""


def test_a_cylindrical_box_moves_radius_angle_and_height(tmp_path):
    # All points alike: by 0.1 in r (fractions of 0.5), 18 degrees, 0.2
    moves = [
        ((i, j, k), (0.2, 0.1, 0.2))
        for i in range(3)
        for j in range(3)
        for k in range(2)
    ]
    case = ffd_case(
        tmp_path,
        CYLINDER.format(
            start="0.2 90 0",
            span="0.5 180 1",
            around=2,
            extra="continuity none;",
            parameters=parameter("a", moves, "1"),
        ),
        "onInvalidMesh ignore;",
        cells=(8, 8, 2),
    )
    before = reference(case)
    after = move(case)
    z, after_z = (
        p[:, 0] - 0.5 + 1j * (p[:, 1] - 0.5) for p in (before, after)
    )
    r = np.abs(z)
    # Half a ring across the cut of atan2, with the points at x = 0.5
    inside = (r > 0.2 - 1e-9) & (r < 0.7 + 1e-9) & (z.real < 1e-9)
    assert 20 < inside.sum() < len(before) / 2
    turned = (z + 0.1 * z / np.where(r > 0, r, 1)) * np.exp(
        1j * np.radians(18)
    )
    np.testing.assert_allclose(
        after_z, np.where(inside, turned, z), rtol=0, atol=ROUND_OFF
    )
    np.testing.assert_allclose(
        after[:, 2], before[:, 2] + 0.2 * inside, rtol=0, atol=ROUND_OFF
    )


@pytest.mark.parametrize("extra", ["", "basis bSpline; degree (2 3 1);"])
def test_a_ring_closes(tmp_path, extra):
    # Turned by one control point and the box by as much: the same motion
    results = []
    for turn in (0, 2):
        moves = [((2, turn, n), (0.2, 0, 0)) for n in range(2)]
        case = ffd_case(
            tmp_path / str(turn),
            CYLINDER.format(
                start=f"0 {-60*turn} 0",
                span="1 360 1",
                around=6,
                extra=extra,
                parameters=parameter("a", moves, "0.5"),
            ),
            cells=(8, 8, 1),
        )
        before = reference(case)
        results.append(move(case) - before)
    assert np.abs(results[0]).max() > 0.01
    if extra:
        np.testing.assert_allclose(
            results[0], results[1], rtol=0, atol=ROUND_OFF
        )
    # Without a seam: the point at angle zero moves along the radius, and
    # mirror images about it alike
    for d in results[:1]:
        on = np.isclose(before[:, 1], 0.5) & (before[:, 0] > 0.6)
        np.testing.assert_allclose(d[on, 1], 0, rtol=0, atol=ROUND_OFF)
        order = np.lexsort(before.round(9).T)
        mirror = np.lexsort((before * (1, -1, 1) + (0, 1, 0)).round(9).T)
        np.testing.assert_allclose(
            d[order], d[mirror] * (1, -1, 1), rtol=0, atol=ROUND_OFF
        )


def test_a_box_with_eight_corners_takes_points_along_its_lines(tmp_path):
    # The mesh is the box: uniform cells are at (i/4, j/4, k/4) of it
    corners = [
        (0, 0, 0),
        (1.2, 0, 0.1),
        (1, 1.1, 0),
        (0, 0.9, 0),
        (0.1, 0, 1),
        (1, 0.1, 1.2),
        (1.1, 1, 1),
        (-0.1, 1.1, 1.1),
    ]
    moves = [((1, 1, 1), (0.3, -0.2, 0.1)), ((2, 1, 1), (0, 0.3, 0))]
    case = ffd_case(
        tmp_path,
        f"hex {{ type corners; corners {vectors(corners)};"
        " order (2 2 2); parameters { " + parameter("a", moves, "1") + "} }",
        corners=corners,
    )
    before = reference(case)

    c = np.array(corners)[[0, 1, 3, 2, 4, 5, 7, 6]].reshape(2, 2, 2, 3)

    def at(s, t, p):
        w = np.multiply.outer(
            np.multiply.outer([1 - p, p], [1 - t, t]), [1 - s, s]
        )
        return np.tensordot(w, c, 3)

    d = np.zeros_like(before)
    places = (
        np.array(
            [(s, t, p) for p in range(5) for t in range(5) for s in range(5)]
        )
        / 4
    )
    positions = np.array([at(*place) for place in places])
    np.testing.assert_allclose(positions, before, rtol=0, atol=1e-12)
    for index, vector in moves:
        rest = np.array(index) / 2
        physical = np.zeros(3)
        for a in range(3):
            low, high = rest.copy(), rest.copy()
            low[a], high[a] = 0, 1
            physical += vector[a] * (at(*high) - at(*low))
        b = np.prod([bern(index[a], places[:, a]) for a in range(3)], axis=0)
        d += np.outer(b, physical)
    np.testing.assert_allclose(move(case), before + d, rtol=0, atol=1e-12)


def bern(i, s):
    return (1, 2, 1)[i] * s**i * (1 - s) ** (2 - i)


# --- constraints


def test_an_empty_mesh_keeps_its_planes(tmp_path):
    patches = {**CUBE, "zMin": "empty", "zMax": "empty"}
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", [((1, 1, 0), (0.4, 0.2, 0.5))], "0.5"),
            order=(2, 2, 0),
            origin=(0, 0, -1),
            span=(1, 1, 3),
        ),
        patches=patches,
        cells=(6, 6, 1),
    )
    before = reference(case)
    after = move(case)
    np.testing.assert_array_equal(after[:, 2], before[:, 2])
    d = 0.5 * displaced(
        before, [((1, 1, 0), (0.4, 0.2, 0))], (2, 2, 0), (0, 0, -1), (1, 1, 3)
    )
    np.testing.assert_allclose(after, before + d, rtol=0, atol=ROUND_OFF)
    lower, upper = np.split(np.lexsort(before.round(4).T), 2)
    # (blockMesh makes both sides alike to the last digit but one)
    np.testing.assert_allclose(
        after[lower][:, :2], after[upper][:, :2], rtol=0, atol=4e-16
    )


ANGLE = np.radians(2.5)


@pytest.mark.parametrize("inner", [0.2, 0])
def test_points_of_a_wedge_keep_their_angle(tmp_path, inner):
    corners = [
        (x, r * np.cos(ANGLE), z * r * np.sin(ANGLE))
        for z in (-1, 1)
        for x, r in ((0, inner), (1, inner), (1, 1), (0, 1))
    ]
    patches = {
        **CUBE,
        "zMin": "wedge",
        "zMax": "wedge",
        "yMin": "patch" if inner else "empty",
    }
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter(
                "a",
                [((1, 1, 0), (0.2, 0.3, 0.4)), ((1, 0, 0), (0.1, 0, 0))],
                "1",
            ),
            order=(2, 2, 0),
            origin=(0, 0, -1),
            span=(1, 1.1, 2),
        ),
        patches=patches,
        cells=(6, 6, 1),
        corners=corners,
        axis=not inner,
    )
    before = reference(case)
    after = move(case)
    axis = np.hypot(before[:, 1], before[:, 2]) < 1e-10
    assert axis.any() != bool(inner)
    assert np.abs(after - before).max() > 0.05
    angle = np.arctan2(after[:, 2], after[:, 1])
    np.testing.assert_allclose(
        angle[~axis], np.sign(before[~axis, 2]) * ANGLE, rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(after[axis, 1:], 0, rtol=0, atol=1e-15)

    # In the plane between: axial and radial parts of the formula
    r = np.hypot(before[:, 1], before[:, 2])
    flat = np.column_stack([before[:, 0], r, 0 * r])
    d = displaced(
        flat,
        [((1, 1, 0), (0.2, 0.3, 0)), ((1, 0, 0), (0.1, 0, 0))],
        (2, 2, 0),
        (0, 0, -1),
        (1, 1.1, 2),
    )
    np.testing.assert_allclose(
        after[:, 0] - before[:, 0], d[:, 0], rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(
        np.hypot(after[:, 1], after[:, 2]) - r, d[:, 1], rtol=0, atol=1e-13
    )


def test_symmetry_patches_keep_their_plane_and_the_log_says_what_that_took(
    tmp_path,
):
    patches = {**CUBE, "xMax": "symmetryPlane", "yMax": "symmetry"}
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter(
                "a",
                [((2, 2, 1), (0.02, 0, 0.2)), ((1, 2, 1), (0, 0.03, 0.3))],
                "1",
            ),
        ),
        patches=patches,
        cells=CELLS,
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    after = points_at(case, 1)
    for axis in (0, 1):
        on = np.isclose(before[:, axis], 1)
        np.testing.assert_array_equal(after[on, axis], before[on, axis])
        assert np.abs(after[on] - before[on]).max() > 0.02
    assert "symmetry" in output and "off their plane" in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_cyclic_pairs_move_alike(tmp_path, ranks):
    patches = {
        **CUBE,
        "xMin": "cyclic; neighbourPatch xMax;",
        "xMax": "cyclic; neighbourPatch xMin;",
    }
    case = ffd_case(
        tmp_path,
        ffd_box("body", parameter("a", [((2, 1, 1), (0.1, 0, 0.2))], "0.5")),
        patches=patches,
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    after = points_at(case, 1)
    left, right = (np.flatnonzero(np.isclose(before[:, 0], x)) for x in (0, 1))
    left, right = (
        these[np.lexsort(before[these].T[1:])] for these in (left, right)
    )
    assert np.abs(after[left] - before[left]).max() > 0.005
    np.testing.assert_allclose(
        after[right] - after[left],
        np.tile([1.0, 0, 0], (len(left), 1)),
        rtol=0,
        atol=1e-15,
    )
    assert "cyclic points are moved differently" in output


@pytest.mark.parametrize("ranks", [1, 3])
def test_rotational_pairs_move_alike(tmp_path, ranks):
    # A quarter of a ring; source of truth: the rotation of the patches
    corners = [
        (r * c, r * s, z)
        for z in (0, 1)
        for r, (c, s) in (
            (0.5, (1, 0)),
            (1, (1, 0)),
            (1, (0, 1)),
            (0.5, (0, 1)),
        )
    ]
    turn = (
        "transform rotational; rotationAxis (0 0 1);"
        " rotationCentre (0 0 0);"
    )
    patches = {
        **CUBE,
        "yMin": f"cyclic; neighbourPatch yMax; {turn}",
        "yMax": f"cyclic; neighbourPatch yMin; {turn}",
    }
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body", parameter("a", [((2, 0, 1), (0.05, 0.02, 0.1))], "0.5")
        ),
        patches=patches,
        corners=corners,
        cells=(4, 4, 4),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((1, 1, 3))
    case.run("moveDynamicMesh", ranks=ranks)
    after = points_at(case, 1)
    first, last = (
        np.flatnonzero(np.isclose(before[:, a], 0, atol=1e-9)) for a in (1, 0)
    )
    turned = np.stack(
        [-before[first, 1], before[first, 0], before[first, 2]], 1
    )
    partner = last[
        np.linalg.norm(turned[:, None] - before[last], axis=2).argmin(axis=1)
    ]
    assert np.abs(after[first] - before[first]).max() > 0.002
    np.testing.assert_allclose(
        after[partner],
        np.stack([-after[first, 1], after[first, 0], after[first, 2]], 1),
        rtol=0,
        atol=1e-14,
    )


# --- parallel and restart


PARALLEL = ffd_box(
    "one",
    parameter("a", MOVES, "0.1")
    + parameter("b", [((3, 1, 2), (0.1, 0.4, 0))], "0.3"),
    order=(4, 3, 2),
    extra="basis bSpline; degree (2 3 2);",
) + ffd_box(
    "two",
    parameter("c", [((1, 1, 1), (0.2, 0.3, 0.4))], "0.4"),
    origin=(0.2, 0.1, 0.15),
    span=(0.6, 0.7, 0.7),
    extra="rotation { type axisAngle; axis (1 2 3);" " angle 5; }",
)


def test_every_number_of_ranks_gives_the_same_points_to_the_bit(tmp_path):
    results = []
    for ranks in (1, 2, 3, 4):
        case = ffd_case(tmp_path / str(ranks), PARALLEL, cells=(9, 8, 7))
        if ranks > 1:
            case.decompose({2: (2, 1, 1), 3: (1, 3, 1), 4: (2, 1, 2)}[ranks])
        results.append(move(case, ranks=ranks))
    assert np.abs(results[0] - reference(case)).max() > 0.03
    for other in results[1:]:
        np.testing.assert_array_equal(results[0], other)


def test_a_restart_is_the_uninterrupted_run_to_the_bit(tmp_path):
    boxes = ffd_box("one", parameter("a", MOVES, TABLE)) + ffd_box(
        "two",
        parameter("b", [((1, 1, 1), (0, 0.8, 0))], "table ((0 0) (4 1))"),
    )
    whole = ffd_case(
        tmp_path / "whole", boxes, cells=CELLS, control={"end": 4}
    )
    whole.run("moveDynamicMesh")
    parts = ffd_case(
        tmp_path / "parts", boxes, cells=CELLS, control={"end": 2}
    )
    parts.run("moveDynamicMesh")
    control = (parts.path / "system/controlDict").read_text()
    (parts.path / "system/controlDict").write_text(
        control.replace("endTime 2;", "endTime 4;").replace(
            "startFrom startTime;", "startFrom latestTime;"
        )
    )
    parts.run("moveDynamicMesh")
    for time in (3, 4):
        np.testing.assert_array_equal(
            points_at(parts, time), points_at(whole, time)
        )


@pytest.mark.parametrize("file", [False, True])
def test_it_needs_no_pointDisplacement_and_does_not_mind_one(tmp_path, file):
    case = ffd_case(
        tmp_path, ffd_box("body", parameter("a", MOVES, "0.5")), cells=CELLS
    )
    if file:
        case.write(
            "0/pointDisplacement",
            *point_field({name: fixed(0, 0, 0) for name in CUBE}),
        )
    before = reference(case)
    d = displaced(before, MOVES, (2, 2, 2), [-0.1] * 3, [1.2] * 3)
    np.testing.assert_allclose(
        move(case), before + 0.5 * d, rtol=0, atol=ROUND_OFF
    )


def test_a_motion_that_makes_the_mesh_invalid_is_limited_on_request(tmp_path):
    # Boundary torn from the inside: the lattice does not fold, the mesh does
    boxes = ffd_box(
        "body",
        parameter("a", [((0, 0, 0), (-0.9, 0, 0))], "1"),
        order=(0, 0, 0),
        origin=(0.4, -1, -1),
        span=(2, 3, 3),
        extra="continuity none;",
    )
    case = ffd_case(tmp_path, boxes, "onInvalidMesh limit;")
    before = reference(case)
    after = move(case)
    d = after - before
    moved = before[:, 0] > 0.4
    assert (d[~moved] == 0).all()
    # Cells of 0.25 may lose all but a margin of a tenth of the valid part
    np.testing.assert_allclose(d[moved, 0], -0.25 * 0.9, rtol=1e-2)


@pytest.mark.parametrize(
    "continuity, layers", [("C0", 1), ("C1", 2), ("C2", 3)]
)
def test_continuity_is_that_of_the_first_layer_that_may_move(
    tmp_path, continuity, layers
):
    # Half of the mesh is in the box. Control points of layer i move the mesh
    # at a distance h from its face by C(n, i) h^i (1 - h)^(n - i): all
    # derivatives below the i-th vanish there
    n, place = 5, dict(origin=(0.5, -0.1, -0.1), span=(1, 1.2, 1.2))

    def case(name, layer):
        moves = [((layer, 1, 1), (0.05, 0.1, 0.05))]
        return (
            ffd_case(
                tmp_path / name,
                ffd_box(
                    "body",
                    parameter("a", moves, "1"),
                    order=(n, 2, 2),
                    extra=f"continuity {continuity};",
                    **place,
                ),
                cells=(32, 2, 2),
            ),
            moves,
        )

    within, moves = case("within", layers)
    before = reference(within)
    after = move(within)
    np.testing.assert_allclose(
        after,
        before + displaced(before, moves, (n, 2, 2), **place),
        rtol=0,
        atol=ROUND_OFF,
    )
    line = np.isclose(before[:, 1], 0.5) & np.isclose(before[:, 2], 0.5)
    d = (after - before)[line][np.argsort(before[line, 0])][:, 1]
    assert (d[:17] == 0).all()
    order = np.log2(d[18] / d[17])
    assert layers - 0.3 < order < layers

    refused, _ = case("refused", layers - 1)
    output = refused.run("moveDynamicMesh", status=1)
    assert f"({layers - 1} 1 1)" in output and "frozen layer" in output


def test_cut_patches_are_named_where_continuity_is_none(tmp_path):
    case = ffd_case(
        tmp_path,
        ffd_box(
            "body",
            parameter("a", [((0, 1, 1), (0.01, 0, 0))], "1"),
            origin=(0.4, -0.1, -0.1),
            span=(2, 1.2, 1.2),
            extra="continuity none;",
        ),
    )
    output = " ".join(case.run("moveDynamicMesh").split())
    assert re.findall(
        r"face (\w = \d) of box 'body' cuts through patches" r" \(([^)]*)\)",
        output,
    ) == [("s = 0", "yMin yMax zMin zMax")]
    assert "tears where parameters (a) move" in output


# --- several meshes, other meshes


def test_two_regions_in_one_process_move_as_each_by_itself(tmp_path):
    build_program("moveRegions")
    boxes = {
        "left": PARALLEL,
        "right": ffd_box(
            "one",
            parameter("a", MOVES, TABLE),
            origin=(-0.2, -0.1, -0.3),
            span=(1.5, 1.4, 1.5),
        ),
    }
    both = ffd_case(
        tmp_path / "both", PARALLEL, cells=CELLS, control={"end": 3}
    )
    alone = {}
    for region, its in boxes.items():
        alone[region] = ffd_case(
            tmp_path / region, its, cells=CELLS, control={"end": 3}
        )
        alone[region].run("moveDynamicMesh")
        for name in (
            "constant/polyMesh",
            "constant/dynamicMeshDict",
            "system/fvSchemes",
            "system/fvSolution",
        ):
            there = pathlib.Path(name)
            to = both.path / there.parent / region / there.name
            to.parent.mkdir(parents=True, exist_ok=True)
            copy = shutil.copytree if there.name == "polyMesh" else shutil.copy
            copy(alone[region].path / name, to)
    both.run("moveRegions", "(left right)")
    for region in boxes:
        for time in (1, 2, 3):
            np.testing.assert_array_equal(
                both.points(f"{time}/{region}/polyMesh/points"),
                points_at(alone[region], time),
            )


def test_after_a_change_of_topology_the_motion_is_that_of_a_new_solver(
    tmp_path,
):
    build_program("changeTopology")
    case = ffd_case(
        tmp_path,
        ffd_box("body", parameter("a", MOVES, TABLE)),
        cells=(6, 5, 4),
    )
    output = case.run("changeTopology")
    before, after = map(
        int, re.search(r"cells (\d+) then (\d+)", output).groups()
    )
    assert 0 < after < before
    assert float(re.search(r"largest motion (\S+)", output)[1]) > 0.02
    assert float(re.search(r"largest difference (\S+)", output)[1]) == 0


# Nine points on each side of the plane x = 0.5 and on it
WHOLE = [
    ((i, j, k), (0, 0, 1))
    for i in range(2)
    for j in range(2)
    for k in range(2)
]


def side_by_side(value="0.1", other="0.1", moves=WHOLE, extra=""):
    how = dict(
        order=(1, 1, 1),
        span=(0.5, 1, 1),
        extra="units metres; " + (extra or "continuity none;"),
    )
    return ffd_box(
        "left", parameter("m", moves, value), origin=(0, 0, 0), **how
    ) + ffd_box(
        "right", parameter("m", WHOLE, other), origin=(0.5, 0, 0), **how
    )


@pytest.mark.parametrize("combine", ["chain", "sum"])
@pytest.mark.parametrize("ranks", [1, 3])
def test_points_that_neighbours_share_move_once(tmp_path, combine, ranks):
    """Source of truth: partition of unity: all control points of both boxes
    move by 0.1, and so does every point of the mesh."""
    case = ffd_case(
        tmp_path, side_by_side(), f"combine {combine};", cells=(8, 4, 4)
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    np.testing.assert_allclose(
        move(case, ranks=ranks) - before,
        np.tile((0, 0, 0.1), (len(before), 1)),
        rtol=0,
        atol=ROUND_OFF,
    )


def test_mesh_in_a_neighbour_is_no_mesh_beyond_a_face(tmp_path):
    """With C0 the common face may move; the others end with the mesh. Source
    of truth: partition of unity."""
    case = ffd_case(
        tmp_path, side_by_side(extra="continuity C0;"), cells=(8, 4, 4)
    )
    before = reference(case)
    np.testing.assert_allclose(
        move(case)[:, 2] - before[:, 2], 0.1, rtol=0, atol=ROUND_OFF
    )


def joined(path, continuity, slope, bend, ranks=1):
    """Two boxes of 0.4 and 0.6 m that share the plane x = 0.4. Rows of control
    points of both rise by the numbers of a common cubic of x, changed by a kink
    in the slope, or in the second derivative, of the right one."""
    n, spans = 3, (0.4, 0.6)

    # Control points at x of Bernstein's form of 0.2 x + 0.3 x^2 + 0.1 x^3
    def rows(low, span, slope=0, bend=0):
        f = np.polynomial.Polynomial((0, 0.2, 0.3, 0.1))
        a = [f.deriv(k)(low) if k else f(low) for k in range(4)]
        a[1] += slope
        a[2] += bend
        # Taylor at its end: b_k = sum_j C(k, j)/C(3, j) a_j span^j/j!
        terms = [a[0], a[1] * span, a[2] * span**2 / 2, a[3] * span**3 / 6]
        return [
            sum(
                math.comb(k, j) / math.comb(n, j) * terms[j]
                for j in range(k + 1)
            )
            for k in range(n + 1)
        ]

    def box(name, low, span, heights):
        moves = [
            ((i, j, k), (0, 0, float(height)))
            for i, height in enumerate(heights)
            for j in (0, 1)
            for k in (0, 1)
        ]
        return ffd_box(
            name,
            parameter("m", moves, "1"),
            order=(n, 1, 1),
            origin=(low, 0, 0),
            span=(span, 1, 1),
            extra=f"units metres; continuity {continuity};",
        )

    case = ffd_case(
        path,
        box("left", 0, spans[0], rows(0, spans[0]))
        + box(
            "right", spans[0], spans[1], rows(spans[0], spans[1], slope, bend)
        ),
        cells=(10, 2, 2),
    )
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    return case


def test_neighbours_join_as_smoothly_as_continuity_asks_for(tmp_path):
    """Both boxes carry one cubic of x: the mesh rises by it, to round-off, and
    it has all derivatives across the common face."""
    for continuity in ("C0", "C1", "C2"):
        case = joined(tmp_path / continuity, continuity, 0, 0)
        before = reference(case)
        x = before[:, 0]
        np.testing.assert_allclose(
            move(case)[:, 2] - before[:, 2],
            0.2 * x + 0.3 * x**2 + 0.1 * x**3,
            rtol=0,
            atol=ROUND_OFF,
        )


@pytest.mark.parametrize("ranks", [1, 3])
@pytest.mark.parametrize(
    "continuity, slope, bend, words",
    [
        ("C0", 0.1, 0.1, None),
        ("C1", 0.1, 0, ["first derivative", "'continuity C0'"]),
        ("C1", 0, 0.1, None),
        ("C2", 0.1, 0, ["first derivative"]),
        ("C2", 0, 0.1, ["second derivative", "'continuity C1'"]),
    ],
)
def test_a_kink_between_neighbours_is_an_error_where_it_is_not_asked_for(
    tmp_path, continuity, slope, bend, words, ranks
):
    """By the derivatives at x = 0.4 of the cubic, and of the changed one."""
    case = joined(tmp_path, continuity, slope, bend, ranks)
    output = case.run("moveDynamicMesh", ranks=ranks, status=1 if words else 0)
    if words is None:
        return
    message = " ".join(output.split())
    for word in [f"'continuity {continuity[0]}", "'left'", "kink", *words]:
        assert word in message
    order = 1 if "first" in words[0] else 2
    exact = {1: 0.2 + 0.6 * 0.4 + 0.3 * 0.16, 2: 0.6 + 0.6 * 0.4}[order]
    found = re.search(
        r"derivative of the displacement is \((\S+) (\S+) (\S+)\) and"
        r" \((\S+) (\S+) (\S+)\)",
        message,
    )
    assert float(found[3]) == pytest.approx(exact, rel=1e-5)
    assert float(found[6]) == pytest.approx(exact + slope + bend, rel=1e-5)


def test_four_boxes_around_an_edge_move_what_they_share_once(tmp_path):
    how = dict(
        order=(1, 1, 1),
        span=(0.5, 0.5, 1),
        extra="units metres; continuity none;",
    )
    boxes = "".join(
        ffd_box(
            f"b{i}{j}",
            parameter("m", WHOLE, "0.1"),
            origin=(0.5 * i, 0.5 * j, 0),
            **how,
        )
        for i in range(2)
        for j in range(2)
    )
    case = ffd_case(tmp_path, boxes, cells=(4, 4, 2))
    before = reference(case)
    np.testing.assert_allclose(
        move(case)[:, 2] - before[:, 2], 0.1, rtol=0, atol=ROUND_OFF
    )


def test_boxes_in_one_another_are_no_neighbours(tmp_path):
    """A box inside another, with faces in common: both act. Source of truth:
    the formula, twice."""
    moves = [((1, 1, 1), (0, 0.4, 0))]
    boxes = ffd_box(
        "outer",
        parameter("a", moves, "1"),
        origin=(0, 0, 0),
        span=(1, 1, 1),
        extra="continuity none;",
    ) + ffd_box(
        "inner",
        parameter("a", moves, "1"),
        origin=(0, 0, 0),
        span=(0.5, 0.5, 1),
        extra="continuity none;",
    )
    case = ffd_case(tmp_path, boxes, "combine sum;", cells=(4, 4, 4))
    before = reference(case)
    expected = (
        before
        + displaced(before, moves, (2, 2, 2), [0] * 3, [1] * 3)
        + displaced(before, moves, (2, 2, 2), [0] * 3, [0.5, 0.5, 1])
    )
    np.testing.assert_allclose(move(case), expected, rtol=0, atol=ROUND_OFF)


def test_a_hexahedral_box_smaller_than_the_mesh_leaves_the_rest(tmp_path):
    """Eight corners of a cube: the formula of the plain box, and points
    outside stay to the bit."""
    low, high = 0.1, 0.9
    corners = vectors(
        [
            (low, low, low),
            (high, low, low),
            (high, high, low),
            (low, high, low),
            (low, low, high),
            (high, low, high),
            (high, high, high),
            (low, high, high),
        ]
    )
    moves = [((1, 1, 1), (0.05, 0, 0))]
    case = ffd_case(
        tmp_path,
        f"b {{ type corners; corners {corners}; order (2 2 2);"
        " units metres; continuity none; parameters {"
        + parameter("m", moves, "1")
        + "} }",
        cells=(8, 8, 8),
    )
    before = reference(case)
    d = displaced(before, moves, (2, 2, 2), [low] * 3, [high - low] * 3)
    d /= high - low
    after = move(case)
    assert 0 < (np.abs(d).max(axis=1) > 0).sum() < len(before)
    np.testing.assert_allclose(after, before + d, rtol=0, atol=ROUND_OFF)
    still = np.abs(d).max(axis=1) == 0
    np.testing.assert_array_equal(after[still], before[still])


STEP = """
scale 1; edges ();
vertices ( (0 1 0) (1 1 0) (3 1 0) (1 0 0) (3 0 0) (0 2 0) (1 2 0) (3 2 0)
           (0 1 1) (1 1 1) (3 1 1) (1 0 1) (3 0 1) (0 2 1) (1 2 1) (3 2 1) );
blocks ( hex (0 1 6 5 8 9 14 13) (4 4 {n}) simpleGrading (1 1 1)
         hex (1 2 7 6 9 10 15 14) (8 4 {n}) simpleGrading (1 1 1)
         hex (3 4 2 1 11 12 10 9) (8 4 {n}) simpleGrading (1 1 1) );
boundary ( frontAndBack {{ type {sides}; faces (
    (0 5 6 1) (1 6 7 2) (3 1 2 4) (8 9 14 13) (9 10 15 14) (11 12 10 9)); }}
    wall {{ type wall; faces ((0 1 9 8) (1 3 11 9) (3 4 12 11)); }} );
defaultPatch {{ name rest; type patch; }}
"""


@pytest.mark.parametrize("n, sides", [(1, "empty"), (3, "patch")])
def test_a_face_that_lies_on_a_step_has_no_mesh_beyond(tmp_path, n, sides):
    """Behind a backward facing step: the box's faces lie on the step and on
    the floor, its upper and rear faces cut the mesh. The step's control points
    may move along it. Source of truth: the formula; C0 at what is cut."""
    moves = [((0, 1, k), (0, 0.3, 0)) for k in range(2)]
    case = from_block_mesh(tmp_path, STEP.format(n=n, sides=sides))
    write_boxes(
        case,
        ffd_box(
            "recirculation",
            parameter("a", moves, "1"),
            order=(2, 3, 1),
            origin=(1, 0, 0),
            span=(1, 1, 1),
        ),
    )
    before = reference(case)
    d = displaced(before, moves, (2, 3, 1), (1, 0, 0), (1, 1, 1))
    assert np.abs(d[(before[:, 0] == 1) & (before[:, 1] < 1)]).max() > 0.1
    np.testing.assert_allclose(move(case), before + d, rtol=0, atol=ROUND_OFF)


def test_the_cut_faces_of_a_box_behind_a_step_stay_frozen(tmp_path):
    case = from_block_mesh(tmp_path, STEP.format(n=1, sides="empty"))
    for at, face in (((1, 3, 0), "t = 1"), ((2, 1, 0), "s = 1")):
        write_boxes(
            case,
            ffd_box(
                "recirculation",
                parameter("a", [(at, (0, 0.1, 0))], "1"),
                order=(2, 3, 1),
                origin=(1, 0, 0),
                span=(1, 1, 1),
            ),
        )
        output = case.run("moveDynamicMesh", status=1)
        assert "frozen layer" in output and face in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_points_of_a_frozen_zone_stay_and_others_move_by_the_formula(
    tmp_path, ranks
):
    # As with displacementLaplacian, whose entry it is
    parameters = parameter("a", [((1, 1, 1), (0.1, 0, 0))])
    free = ffd_case(tmp_path / "free", ffd_box("body", parameters))
    moved = move(free)
    case = ffd_case(
        tmp_path / "frozen",
        ffd_box("body", parameters),
        "frozenPointsZone some;",
    )
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions
( { name s; type pointSet; action new; source boxToPoint;
    sourceInfo { box (-1 -1 0.6) (2 2 2); } }
  { name some; type pointZoneSet; action new; source setToPointZone;
    sourceInfo { set s; } } );""",
    )
    case.run("topoSet")
    if ranks > 1:
        case.decompose((1, 1, ranks))
    points = move(case, ranks=ranks)
    frozen = reference(case)[:, 2] > 0.6
    assert 0 < frozen.sum() < frozen.size
    np.testing.assert_array_equal(points[frozen], reference(case)[frozen])
    np.testing.assert_array_equal(points[~frozen], moved[~frozen])
    assert not np.array_equal(moved[frozen], reference(case)[frozen])


def test_a_frozen_zone_that_is_not_there_is_an_error(tmp_path):
    parameters = parameter("a", [((1, 1, 1), (0.1, 0, 0))])
    output = ffd_case(
        tmp_path, ffd_box("body", parameters), "frozenPointsZone some;"
    ).run("moveDynamicMesh", status=1)
    assert "no pointZone is called 'some'" in output
