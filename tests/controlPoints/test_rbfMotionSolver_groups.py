# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Groups of control points and their displacement types, by dictionary.

Sources of truth: the formula of each displacement type in the header of its
class (src/motion), and of the groups in controlPointGroup.H.
"""

import numpy as np
import pytest

from boxCase import fixed, vectors, words
from rbfCase import (
    CUBE,
    groups,
    move,
    points_at,
    rbf_case,
    reference,
    selections,
    side,
    ulps,
)

BOTTOM = "type fixed; patches (zMin);"


def top_case(path, displacement, select="patches (zMax);", **rest):
    """A box whose top, or another selection, gets a displacement."""
    body = f"type moving; {select} displacement {{ {displacement} }}"
    return rbf_case(
        path,
        coeffs="supportRadius 0.6;\n" + groups(top=body, bottom=BOTTOM),
        **rest,
    )


def check(after, before, selected, displacement):
    np.testing.assert_allclose(
        after[selected],
        before[selected] + displacement,
        rtol=0,
        atol=ulps(before),
    )
    bottom = side(before, "zMin") & ~selected
    np.testing.assert_array_equal(after[bottom], before[bottom])


# --- displacement types


def test_uniform_follows_a_function_of_time(tmp_path):
    case = top_case(
        tmp_path,
        "type uniform; value table"
        " ((0 (0 0 0)) (1 (0 0.02 0.1)) (2 (0.1 0 0)));",
        control={"deltaT": 0.5},
    )
    before = reference(case)
    move(case)
    for time, value in (("0.5", (0, 0.01, 0.05)), ("1", (0, 0.02, 0.1))):
        check(points_at(case, time), before, side(before, "zMax"), value)


def test_solidBody_moves_by_the_motion_function(tmp_path):
    # x = v t, with t the time
    case = top_case(
        tmp_path,
        "type solidBody; solidBodyMotionFunction"
        " linearMotion; linearMotionCoeffs"
        " { velocity (0.02 0 0.1); }",
        control={"deltaT": 0.5},
    )
    before = reference(case)
    move(case)
    for time in ("0.5", "1"):
        check(
            points_at(case, time),
            before,
            side(before, "zMax"),
            float(time) * np.array([0.02, 0, 0.1]),
        )


@pytest.mark.parametrize(
    "scale, factor",
    [
        ("", 1),
        ("scale 0.5;", 0.5),
        ("scale table ((0 0) (4 1));", 0.25),
        (
            "scale sine; scaleCoeffs { frequency 0.125; amplitude 1; scale 1;"
            " level 0; }",
            np.sin(np.pi / 4),
        ),
    ],
)
def test_values_are_given_to_the_points_in_their_order(
    tmp_path, scale, factor
):
    at = [(1, 1, 1), (0, 0, 1), (0.5, 0.5, 0.5)]
    values = np.array([(0, 0, 0.1), (0.03, 0, 0), (0, -0.05, 0.01)])
    case = top_case(
        tmp_path,
        f"type values; values {vectors(values)};" f" {scale}",
        select=f"points {vectors(at)};",
    )
    before = reference(case)
    after = move(case)
    for x, value in zip(at, values):
        there = (before == x).all(axis=1)
        assert there.sum() == 1
        check(after, before, there, factor * value)


@pytest.mark.parametrize("scale", [1, 0.5])
def test_polyline_is_linear_between_its_vertices(tmp_path, scale):
    # Along x at any y: the place nearest to a point is the one at its x
    case = top_case(
        tmp_path,
        "type polyline; vertices ((0 0 1) (0.5 0 1) (1 0 1));"
        " values ((0 0 0) (0.01 0.02 0.1) (0 0 0.05));"
        f" scale {scale};",
        cells=(8, 3, 4),
    )
    before = reference(case)
    top = side(before, "zMax")
    x = before[top, 0]
    expected = np.stack(
        [
            np.interp(x, [0, 0.5, 1], column)
            for column in np.array(
                [(0, 0.01, 0), (0, 0.02, 0), (0, 0.1, 0.05)]
            )
        ],
        axis=1,
    )
    check(move(case), before, top, scale * expected)


@pytest.mark.parametrize("ranks", [1, 2])
def test_file_is_matched_by_position_not_by_order(tmp_path, ranks):
    case = top_case(
        tmp_path, 'type file; file "constant/top.txt";' " tolerance 1e-3;"
    )
    before = reference(case)
    top = side(before, "zMax")
    rng = np.random.default_rng(2)
    values = 0.05 * rng.uniform(-1, 1, (top.sum(), 3))
    off = 5e-4 * rng.uniform(-1, 1, (top.sum(), 3))
    lines = [
        f"{words(x)}\t {words(d)}" for x, d in zip(before[top] + off, values)
    ]
    rng.shuffle(lines)
    (tmp_path / "constant/top.txt").write_text(
        "# x y z  dx dy dz\n\n" + "\n  # between\n".join(lines) + "\n"
    )
    if ranks > 1:
        case.decompose((2, 1, 1))
    check(move(case, ranks=ranks), before, top, values)


@pytest.mark.parametrize(
    "entry", ["", "displacement { type pointDisplacement; }"]
)
def test_pointDisplacement_is_what_a_moving_group_takes_by_default(
    tmp_path, entry
):
    case = rbf_case(
        tmp_path,
        {
            **{name: "zeroGradient" for name in CUBE},
            "zMax": fixed(0, 0.02, 0.1),
        },
        coeffs=groups(
            top=f"type moving; patches (zMax); {entry}", bottom=BOTTOM
        ),
    )
    before = reference(case)
    check(move(case), before, side(before, "zMax"), (0, 0.02, 0.1))


# --- what a group selects

PATCH_GROUPS = {
    **CUBE,
    "xMax": ("patch; inGroups (flanks ends);", "xMax"),
    "yMax": ("patch; inGroups (flanks);", "yMax"),
}


@pytest.mark.parametrize(
    "patches, names",
    [
        ("(zMax xMax)", ["zMax", "xMax"]),
        ('("[xz]Max")', ["zMax", "xMax"]),
        ("(flanks)", ["xMax", "yMax"]),
        ('("fla.*" zMax)', ["xMax", "yMax", "zMax"]),
    ],
)
def test_patches_are_selected_by_name_pattern_and_patch_group(
    tmp_path, patches, names
):
    value = (0.02, 0.03, 0.05)
    case = top_case(
        tmp_path,
        f"type uniform; value ({words(value)});",
        select=f"patches {patches};",
        patches=PATCH_GROUPS,
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    on = np.any([side(before, name) for name in names], axis=0)
    assert selections(output)[0][1] == (on | side(before, "zMin")).sum()
    check(case.points("1/polyMesh/points"), before, on, value)


ZONES = """
actions
(
    { name middle; type faceSet; action new; source boxToFace;
      box (-1 -1 0.49) (2 2 0.51); }
    { name middle; type faceZoneSet; action new; source setToFaceZone;
      faceSet middle; }
    { name corner; type pointSet; action new; source boxToPoint;
      box (0.6 0.6 0.6) (0.9 0.9 0.9); }
    { name corner; type pointZoneSet; action new; source setToPointZone;
      set corner; }
);
"""


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    "select, inside",
    [
        ("faceZones (middle);", lambda x: x[:, 2] == 0.5),
        ('pointZones ("cor.*");', lambda x: (x == 0.75).all(axis=1)),
    ],
)
def test_zones_select_points_inside_the_mesh(tmp_path, select, inside, ranks):
    value = (0.01, 0.02, 0.05)
    case = top_case(
        tmp_path, f"type uniform; value ({words(value)});", select=select
    )
    case.write("system/topoSetDict", "dictionary", ZONES)
    case.run("topoSet")
    before = reference(case)
    if ranks > 1:
        case.decompose((1, 1, 2))
    on = inside(before)
    assert on.any()
    check(move(case, ranks=ranks), before, on, value)


@pytest.mark.parametrize("ranks", [1, 2])
def test_points_off_the_mesh_attract_it(tmp_path, ranks):
    # One control point between mesh points, with a kernel whose value at any
    # distance is known: s(x) = phi(|x - x1|/r0) d, phi = (1 - r)^4 (4 r + 1)
    at, d, radius = (0.6, 0.55, 0.45), (0.02, 0.01, 0.05), 0.8
    case = rbf_case(
        tmp_path,
        coeffs=f"supportRadius {radius};\n"
        + groups(
            free=f"type moving; points (({words(at)})); displacement"
            f" {{ type uniform; value ({words(d)}); }}"
        ),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    r = np.minimum(np.linalg.norm(before - at, axis=1) / radius, 1)
    phi = (1 - r) ** 4 * (4 * r + 1)
    np.testing.assert_allclose(
        move(case, ranks=ranks), before + np.outer(phi, d), rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("first", ["moving", "fixed"])
def test_the_earlier_group_wins_at_points_that_two_select(tmp_path, first):
    top = (
        "type moving; patches (zMax); displacement"
        " { type uniform; value (0 0 0.1); }"
    )
    flank = "type fixed; patches (xMin);"
    order = (
        {"top": top, "flank": flank}
        if first == "moving"
        else {"flank": flank, "top": top}
    )
    case = rbf_case(tmp_path, coeffs=groups(**order))
    before = reference(case)
    edge = side(before, "zMax") & side(before, "xMin")
    after = move(case)
    np.testing.assert_array_equal(
        after[edge], before[edge] + (0, 0, 0.1 if first == "moving" else 0)
    )


def test_a_listed_point_of_an_earlier_group_wins_over_a_patch(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            one="type moving; points ((1 1 1)); displacement"
            " { type values; values ((0 0 0.05)); }",
            top="type moving; patches (zMax); displacement"
            " { type uniform; value (0 0 0.1); }",
        ),
    )
    before = reference(case)
    after = move(case)
    corner = (before == 1).all(axis=1)
    np.testing.assert_array_equal(after[corner], before[corner] + (0, 0, 0.05))
    rest = side(before, "zMax") & ~corner
    np.testing.assert_array_equal(after[rest], before[rest] + (0, 0, 0.1))


def test_a_patch_of_an_earlier_group_wins_over_a_listed_point(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement"
            " { type uniform; value (0 0 0.1); }",
            one="type moving; points ((1 1 1) (0.4 0.4 0.4)); displacement"
            " { type values; values ((0 0 0.05) (0 0 0)); }",
        ),
    )
    before = reference(case)
    after = move(case)
    top = side(before, "zMax")
    np.testing.assert_array_equal(after[top], before[top] + (0, 0, 0.1))


@pytest.mark.parametrize("at", [(1, 1, 1), (0.4, 0.4, 0.4)])
def test_the_earlier_group_wins_at_a_point_that_two_list(tmp_path, at):
    # On the mesh and off it
    body = (
        "type moving; points ((%s)); displacement"
        " { type uniform; value (0 0 %g); }"
    )
    two = rbf_case(
        tmp_path / "two",
        coeffs="supportRadius 1;"
        + groups(
            a=body % (words(at), 0.05),
            b=body % (words(at), 0.1),
            bottom=BOTTOM,
        ),
    )
    one = rbf_case(
        tmp_path / "one",
        coeffs="supportRadius 1;"
        + groups(a=body % (words(at), 0.05), bottom=BOTTOM),
    )
    after = move(two)
    assert np.abs(after - reference(two)).max() > 0.04
    np.testing.assert_array_equal(after, move(one))


def test_points_listed_twice_with_one_displacement_count_once(tmp_path):
    case = top_case(
        tmp_path,
        "type values; values ((0 0 0.1) (0 0 0.1));",
        select="points ((0.4 0.4 0.4) (0.4 0.4 0.4));",
    )
    assert selections(case.run("moveDynamicMesh"))[0][1] == 25 + 1
