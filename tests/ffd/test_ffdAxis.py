# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reference axes, lattices from files, parents, bulk parameters and the position
form, on a surface file.

Sources of truth: rotation matrices (Rodrigues) and linear functions by numpy;
scipy's B-splines; central differences; the nested cubes of pyGeo's second block
test, by its rules (control points and axes embedded in the parent).
"""

import re

import numpy as np
import pytest

from boxCase import write_control
from ffdCase import bernstein, ffd_box, parameter, rotation
from foamCase import FoamCase, build_program
from surfaceCase import morphed

# A swept wing along z: sections of a diamond, and its axis at a quarter chord
SECTION = np.array([(0, 0), (0.4, 0.06), (1, 0), (0.4, -0.06)])


def wing(n=9, sweep=0.5):
    points = [
        (x + sweep * z, y, z) for z in np.linspace(0, 3, n) for x, y in SECTION
    ]
    faces = []
    for k in range(n - 1):
        for i in range(4):
            a, b = 4 * k + i, 4 * k + (i + 1) % 4
            faces += [(a, b, a + 4), (b, b + 4, a + 4)]
    return np.array(points), faces


AXIS = "through ((0.25 0 0) (1.75 0 3)); normal (0 0 1);"


def axis(variables, extra=""):
    return f"wing {{ type axis; {AXIS} {extra} variables {{ {variables} }} }}"


def sections(points, n=9):
    return points.reshape(n, 4, 3)


def distances(section):
    return np.linalg.norm(section[:, None] - section, axis=-1)


def test_a_twisted_section_keeps_its_shape_at_ninety_degrees(tmp_path):
    """On points: 1e-12, and it is the rotation about the axis."""
    points, faces = wing()
    moved = morphed(
        tmp_path, points, faces, axis("t { type twist; value 90; }")
    )
    for before, after in zip(sections(points), sections(moved)):
        z = before[0, 2]
        A = np.array([0.25 + 0.5 * z, 0, z])
        expected = A + (before - A) @ rotation((0, 0, 1), 30 * z).T
        np.testing.assert_allclose(after, expected, rtol=0, atol=1e-14)
        np.testing.assert_allclose(
            distances(after), distances(before), rtol=0, atol=1e-12
        )
    assert np.abs(sections(moved)[-1][0] - sections(points)[-1][0]).max() > 0.2


def test_a_section_at_a_layer_of_a_lattice_keeps_its_shape(tmp_path):
    """Through a lattice the sections at its ends are turned as a whole."""
    points, faces = wing()
    box = (
        "lattice { origin (-0.1 -0.1 0); span (2.7 0.2 3); order (2 1 1);"
        f" axis {{ {AXIS} variables {{ t {{ type twist; value 90; }} }} }} }}"
    )
    moved = morphed(tmp_path, points, faces, box)
    tip, after = sections(points)[-1], sections(moved)[-1]
    A = np.array([1.75, 0, 3])
    np.testing.assert_allclose(
        after, A + (tip - A) @ rotation((0, 0, 1), 90).T, rtol=0, atol=1e-12
    )
    np.testing.assert_array_equal(sections(moved)[0], sections(points)[0])


def test_variables_add_up_along_the_axis(tmp_path):
    """chord, thickness, sweep, dihedral, span and two twists, by their
    formula; `along` linear and as natural spline (scipy)."""
    from scipy.interpolate import CubicSpline

    points, faces = wing()
    moved = morphed(
        tmp_path,
        points,
        faces,
        axis(
            """
        a { type twist; value 10; }
        b { type twist; value -4; along ((0 0) (0.4 1) (1 0.5)); line spline; }
        c { type chord; value 0.3; along ((0 1) (1 -1)); }
        d { type thickness; value 0.5; along ((0 1) (1 1)); }
        e { type sweep; value 0.2; } f { type dihedral; value 0.1; }
        g { type span; value 0.6; }"""
        ),
    )
    spline = CubicSpline([0, 0.4, 1], [0, 1, 0.5], bc_type="natural")
    for before, after in zip(sections(points), sections(moved)):
        z = before[0, 2]
        u = z / 3
        R = rotation((0, 0, 1), 10 * u - 4 * spline(u))
        chord = 1 + 0.3 * (1 - 2 * u)
        S = np.diag([chord, chord * 1.5, 1])
        A = np.array([0.25 + 0.5 * z, 0, z])
        expected = A + u * np.array([0.2, 0.1, 0.6]) + (before - A) @ (R @ S).T
        np.testing.assert_allclose(after, expected, rtol=0, atol=1e-14)


CUBE4 = np.array(
    [[0.5, 0.5, 0.5], [1.25, 1.25, 1.25], [1.5, 1.5, 1.5], [2.0, 2.5, 0.5]]
)


def cube_box(name, low, size, extra):
    return (
        f"{name} {{ origin ({low} {low} {low}); span ({size} {size} {size});"
        f" order (1 1 1); continuity none; {extra} }}"
    )


def nested():
    """pyGeo's Blocks_02: a cube turned about x, a child moved, its child turned
    about y."""
    constant = "along ((0 1) (1 1));"
    return (
        cube_box(
            "big",
            0,
            3,
            f"""axis {{ through ((0 1.5 1.5) (3 1.5 1.5));
        chord (0 1 0); variables {{ r {{ type twist; value 10; {constant} }} }} }}
        """,
        )
        + cube_box(
            "small",
            0,
            2,
            f"""parent big; axis {{
        through ((1 0 1) (1 2 1)); variables {{
            x {{ type sweep; value 0.5; {constant} }}
            y {{ type span; value -1; {constant} }}
            z {{ type dihedral; value -0.7; {constant} }} }} }}
        """,
        )
        + cube_box(
            "tiny",
            1,
            1,
            f"""parent small; axis {{
        through ((1.5 1 1.5) (1.5 2 1.5)); variables {{
            r {{ type twist; value -20; {constant} }} }} }}""",
        )
    )


def trilinear(low, size, x):
    """Weights of the corners of a cube, None outside."""
    xi = (np.array(x) - low) / size
    if (xi < 0).any() or (xi > 1).any():
        return None
    return {
        (i, j, k): np.prod(
            [xi[a] if c else 1 - xi[a] for a, c in enumerate((i, j, k))]
        )
        for i in (0, 1)
        for j in (0, 1)
        for k in (0, 1)
    }


def by_hand(points):
    """The rules of pyGeo with trilinear lattices: control points and axis of a
    child move with the parent, then it turns what it has about its axis."""

    def big(x):
        w = trilinear(0, 3, x)
        R = rotation((1, 0, 0), 10)
        A = np.array([0, 1.5, 1.5])
        d = np.zeros(3)
        for corner, weight in w.items():
            P = 3.0 * np.array(corner)
            arm = (P - A) * [0, 1, 1]
            d += weight * (R @ arm - arm)
        return d

    def small(x):
        w = trilinear(0, 2, x)
        return np.array([0.5, -1, 0.7]) * (w is not None)

    def both(x):
        return big(x) + small(x)

    def tiny(x):
        w = trilinear(1, 1, x)
        d = np.zeros(3)
        if w is None:
            return d
        R = rotation((0, 1, 0), -20)
        for corner, weight in w.items():
            P = 1.0 + np.array(corner)
            A = np.array([1.5, P[1], 1.5])
            arm = P + both(P) - A - both(A)
            d += weight * (R @ arm - arm)
        return d

    return np.array([x + both(x) + tiny(x) for x in points])


# What pyGeo's own regression test holds (test_Blocks_02, Apache 2.0)
PYGEO = [
    [1.0, -0.3111595753452773, 1.0415440693208615],
    [1.8492828670118886, 0.29721010616368027, 1.8397287751522697],
    [1.9999999999999996, 0.49999999999999956, 2.2],
    [2.0, 2.6584559306791387, 0.6888404246547224],
]


def test_children_go_with_their_parents(tmp_path):
    """By the rules, and by the numbers of pyGeo's own test."""
    moved = morphed(tmp_path, CUBE4, [(0, 1, 2), (0, 2, 3)], nested())
    np.testing.assert_allclose(moved, by_hand(CUBE4), rtol=0, atol=1e-12)
    np.testing.assert_allclose(moved, PYGEO, rtol=0, atol=1e-12)
    assert np.abs(moved - CUBE4)[2].max() > 0.5


DERIVATIVES = {
    "axis": "through ((0.5 0.5 0) (0.6 0.5 0.5) (0.5 0.6 1)); line spline;"
    " normal (0 0 1); variables {"
    " a { type twist; value 30; line spline;"
    "     along ((0 0.2) (0.5 1) (1 0)); }"
    " b { type chord; value 0.2; } c { type thickness; value -0.1; }"
    " d { type sweep; value 0.1; } e { type dihedral; value 0.2; }"
    " f { type span; value 0.1; } }"
}


@pytest.mark.parametrize("combine", ["chain", "sum"])
def test_derivatives_are_those_of_central_differences(tmp_path, combine):
    """A lattice before an axis on points, a lattice with an axis, its child
    with another, one in position form with pairs in bulk."""
    build_program("ffdDerivatives")
    case = FoamCase(tmp_path)
    write_control(case)
    moves = [((1, 1, 1), (0.2, 0.3, -0.2))]
    case.write(
        "constant/ffdDict",
        "dictionary",
        f"""boxes {{
        {ffd_box("plain", parameter("a", moves, "0.3"))}
        points {{ type axis; {DERIVATIVES["axis"]} }}
        {ffd_box("parent", parameter("a", moves, "0.3"), order=(2, 3, 2),
                 origin=(-1, -1, -1), span=(3, 3, 3),
                 extra=f"axis {{ {DERIVATIVES['axis']} }}")}
        {ffd_box("child", parameter("a", moves, "0.3"), order=(2, 2, 2),
                 origin=(-1, -1, -1), span=(2, 3, 3),
                 extra="parent parent; axis {" + DERIVATIVES["axis"] + "}")}
        spline {{ origin (-1 -1 -1); span (3 3 3); order (4 4 4); basis bSpline;
            degree (3 2 3); form position; bulk {{ pair {{ i (2 2); j (1 2);
            k (2 2); directions (t (0.1 0 0.2)); mirror t;
            values {{ pair_2_1_2_t 0.2; }} }} }} }}
        }} combine {combine};""",
    )
    output = case.run("ffdDerivatives")
    found = re.findall(
        r"parameter (\S+) dx (\S+) error (\S+) measures (\S+)" r" error (\S+)",
        output,
    )
    assert len(found) == 1 + 6 + 7 + 7 + 3
    for name, dx, error, measures, measures_error in found:
        assert float(dx) > 1e-3, name
        assert float(error) < 1e-8 * max(1, float(dx)), name
        assert float(measures_error) < 1e-8 * max(1, float(measures)), name


def knots(n, degree):
    inner = np.linspace(0, 1, n - degree + 1)[1:-1]
    return np.concatenate([[0] * (degree + 1), inner, [1] * (degree + 1)])


def spline_volume(control, degrees, xi):
    """Sum over control points (l m n 3) of scipy's clamped B-splines."""
    from scipy.interpolate import BSpline

    for d in range(3):
        n = control.shape[0 if d == 0 else 1]
        basis = [
            BSpline(knots(n, degrees[d]), np.eye(n)[i], degrees[d])
            for i in range(n)
        ]
        row = np.array([b(xi[:, d]) for b in basis]).T
        control = (
            np.einsum("pl,lmnc->pmnc", row, control)
            if d == 0
            else np.einsum("pm,pm...->p...", row, control)
        )
    return control


def test_the_position_form_is_the_map_of_b_splines(tmp_path):
    """scipy's B-splines: points are at places xi of the volume that the
    control points span, and move to where the moved ones say, 1e-10."""
    rng = np.random.default_rng(3)
    shape, degrees = (6, 5, 7), (3, 2, 3)
    grid = np.stack(
        np.meshgrid(*[np.linspace(0, 1, n) for n in shape], indexing="ij"),
        axis=-1,
    ) * [2, 1, 1.5]
    xi = rng.random((200, 3))
    points = spline_volume(grid, degrees, xi)
    moves = [((2, 1, 3), (0.1, 0.2, -0.1)), ((3, 3, 2), (0, -0.15, 0.1))]
    moved_grid = grid.copy()
    for at, vector in moves:
        moved_grid[at] += vector
    expected = spline_volume(moved_grid, degrees, xi)
    assert np.abs(expected - points).max() > 0.02
    box = ffd_box(
        "b",
        parameter("a", moves, "1"),
        order=(5, 4, 6),
        origin=(0, 0, 0),
        span=(2, 1, 1.5),
        extra="basis bSpline; degree (3 2 3); form position;"
        " units metres; continuity none;",
    )
    moved = morphed(tmp_path, points, [(0, 1, 2)], box)
    np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-10)
    # The displacement form is another one
    other = morphed(
        tmp_path, points, [(0, 1, 2)], box.replace("form position;", "")
    )
    assert np.abs(other - expected).max() > 1e-3


def curved_lattice(shape=(4, 3, 5)):
    """Control points about an arc."""
    a, b, c = np.meshgrid(
        *[np.linspace(0, 1, n) for n in shape], indexing="ij"
    )
    radius = 2 + a
    return np.stack(
        [radius * np.cos(c), b + 0.1 * a * c, radius * np.sin(c)], axis=-1
    )


def plot3d(blocks):
    text = f"{len(blocks)}\n"
    for block in blocks:
        text += " ".join(map(str, block.shape[:3])) + "\n"
    for block in blocks:
        for c in range(3):
            text += (
                "\n".join(
                    repr(float(x)) for x in block[..., c].flatten(order="F")
                )
                + "\n"
            )
    return text


def table(block):
    rows = [
        f"{i},{j},{k}," + ",".join(repr(float(x)) for x in block[i, j, k])
        for k in range(block.shape[2])
        for j in range(block.shape[1])
        for i in range(block.shape[0])
    ]
    return "i,j,k,x,y,z\n" + "\n".join(reversed(rows)) + "\n"


MOVE = [((1, 1, 2), (0.1, 0.1, 0.2))]


@pytest.mark.parametrize("kind", ["blocks", "single", "csv"])
def test_a_lattice_from_a_file(tmp_path, kind):
    """scipy's B-splines over control points about an arc."""
    rng = np.random.default_rng(5)
    control = curved_lattice()
    degrees = (2, 1, 3)
    xi = rng.random((50, 3))
    points = spline_volume(control, degrees, xi)
    moved_control = control.copy()
    moved_control[MOVE[0][0]] += MOVE[0][1]
    tmp_path.mkdir(exist_ok=True)
    name = "l.csv" if kind == "csv" else "l.xyz"
    if kind == "csv":
        text = table(control)
    elif kind == "blocks":
        text = plot3d([control + 10, control])
    else:
        text = plot3d([control])
    (tmp_path / name).write_text(text)
    block = "block 1;" if kind == "blocks" else ""
    moved = morphed(
        tmp_path,
        points,
        [(0, 1, 2)],
        f"""l {{ type lattice;
        file "{name}"; {block} basis bSpline; degree (2 1 3); continuity none;
        parameters {{ {parameter("a", MOVE, "1")} }} }}""",
    )
    np.testing.assert_allclose(
        moved, spline_volume(moved_control, degrees, xi), rtol=0, atol=1e-10
    )


def test_bulk_parameters_of_a_lattice_in_one_line(tmp_path):
    """All points of a 7 x 7 x 7 lattice in three directions: 1,029 names. One
    of them moves by the formula."""
    rng = np.random.default_rng(7)
    points = rng.random((30, 3))
    moved, output = morphed(
        tmp_path,
        points,
        [(0, 1, 2)],
        "b { origin (0 0 0); span (1 1 1); order (6 6 6); continuity none;"
        " bulk { all { values { all_2_3_4_t 0.2; } } } }",
        options=["-derivatives"],
        output=True,
    )
    assert len(re.findall(r"^b\.all_\d_\d_\d_[stp] ", output, re.M)) == 1029
    d = 0.2 * np.prod(
        [bernstein(6, i, points[:, a]) for a, i in enumerate((2, 3, 4))],
        axis=0,
    )
    np.testing.assert_allclose(
        moved, points + d[:, None] * [0, 1, 0], rtol=0, atol=1e-14
    )


def test_mirrored_pairs_camber_and_thickness(tmp_path):
    """Bernstein polynomials by themselves."""
    rng = np.random.default_rng(8)
    points = rng.random((30, 3))
    moved = morphed(
        tmp_path,
        points,
        [(0, 1, 2)],
        "b { origin (0 0 0); span (1 1 1); order (3 4 2); continuity none;"
        " bulk { pair { mirror t; directions (s t);"
        "               values { pair_1_1_1_t 0.2; pair_2_0_1_s 0.1; } }"
        "        camber { type camber; across p; values { camber_1_2 0.3; } }"
        "        thick { type thickness; across p; values { thick_2_1 0.4; } }"
        " } }",
    )

    def b(i, j, k):
        return np.prod(
            [
                bernstein(n, at, points[:, a])
                for a, (n, at) in enumerate(zip((3, 4, 2), (i, j, k)))
            ],
            axis=0,
        )

    d = np.zeros_like(points)
    d[:, 1] += 0.2 * (b(1, 1, 1) - b(1, 3, 1))
    d[:, 0] += 0.1 * (b(2, 0, 1) + b(2, 4, 1))
    d[:, 2] += 0.3 * (b(1, 2, 0) + b(1, 2, 1) + b(1, 2, 2))
    d[:, 2] += 0.4 * (0.5 * b(2, 1, 2) - 0.5 * b(2, 1, 0))
    np.testing.assert_allclose(moved, points + d, rtol=0, atol=1e-14)


def lattice_box(name, extra=""):
    return (
        f'l {{ type lattice; file "{name}"; {extra} parameters {{ '
        + parameter("a", MOVE, "1")
        + "} }"
    )


def bulk_box(entries):
    return (
        "b { origin (0 0 0); span (1 1 1); order (2 2 2);"
        f" bulk {{ g {{ {entries} }} }} }}"
    )


WRONG = {
    "axis that meets no section": (
        axis("t { type twist; value 1; }")
        .replace("(0.25 0 0)", "(0 0 50)")
        .replace("(1.75 0 3)", "(0 0 60)"),
        ["meets no section", "through"],
    ),
    "axis of a lattice that meets no section": (
        cube_box(
            "b",
            0,
            3,
            "axis { through ((0 0 50) (0 0 60)); variables { t {"
            " type twist; value 1; } } }",
        ),
        ["meets no section", "from 0 to 1", "through"],
    ),
    "axis of one point": (
        "w { type axis; through ((0 0 0)); variables { t { type twist;"
        " value 1; } } }",
        ["'through'", "two at least"],
    ),
    "axis that turns back": (
        "w { type axis; through ((0 0 0) (0 0 2) (0 0 1)); variables { t {"
        " type twist; value 1; } } }",
        ["point 2", "not further"],
    ),
    "chord along the axis": (
        axis("t { type twist; value 1; }", "chord (0 0 1);"),
        ["chord", "normal"],
    ),
    "unknown variable": (
        axis("t { type turn; value 1; }"),
        ["turn", "twist", "dihedral"],
    ),
    "no variables": (axis(""), ["'variables' is empty"]),
    "places that descend": (
        axis("t { type twist; value 1; along ((1 0) (0 1)); }"),
        ["'along'", "ascend"],
    ),
    "parent below": (
        cube_box(
            "a",
            0,
            1,
            "parent b; parameters { "
            + parameter("m", [((1, 1, 1), (0, 0, 1))])
            + " }",
        ),
        ["'parent'", "'b'", "before"],
    ),
    "no file": (lattice_box("none.xyz"), ["none.xyz", "is not there"]),
    "holes": (lattice_box("holes.csv"), ["holes.csv", "holes", "(3 2 4)"]),
    "a point that is no number": (
        lattice_box("nan.csv"),
        ["nan.csv", "line 3", "i j k x y z"],
    ),
    "a point that is no number in blocks": (
        lattice_box("nan.xyz"),
        ["nan.xyz", "numbers"],
    ),
    "blanking": (lattice_box("blank.xyz"), ["blank.xyz", "24 numbers more"]),
    "twice": (lattice_box("twice.csv"), ["twice.csv", "twice", "Remove one"]),
    "short": (lattice_box("short.xyz"), ["short.xyz", "ends in block 0"]),
    "words": (lattice_box("words.xyz"), ["words.xyz", "numbers"]),
    "which block": (
        lattice_box("two.xyz"),
        ["two.xyz", "2 blocks", "from 0 to 1"],
    ),
    "block beyond": (lattice_box("two.xyz", "block 2;"), ["no block 2"]),
    "inside out": (lattice_box("out.xyz"), ["inside out", "right-handed"]),
    "another order": (
        lattice_box("one.xyz", "order (1 1 1);"),
        ["'order'", "(3 2 4)"],
    ),
    "weights in position form": (
        ffd_box(
            "b",
            parameter("a", MOVE),
            order=(2, 2, 2),
            extra="form position; weights ( ((1 1 1) 2) );",
        ),
        ["'weights'", "displacement"],
    ),
    "bulk layers": (bulk_box("i (0 3);"), ["'i'", "from 0 to 2"]),
    "bulk direction": (bulk_box("directions (x);"), ["'directions'", "x"]),
    "bulk name": (
        bulk_box("values { g_9_9_9_s 1; }"),
        ["g_9_9_9_s", "81", "g_0_0_0_s", "g_2_2_2_p"],
    ),
    "bulk mirror": (bulk_box("mirror y;"), ["'mirror'", "y"]),
    "thickness without across": (bulk_box("type thickness;"), ["across"]),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_entry_is_an_error_that_helps(tmp_path, name):
    boxes, words = WRONG[name]
    control = curved_lattice()
    (tmp_path / "one.xyz").write_text(plot3d([control]))
    (tmp_path / "two.xyz").write_text(plot3d([control, control]))
    (tmp_path / "short.xyz").write_text(plot3d([control])[:-100])
    (tmp_path / "words.xyz").write_text("lattice of a wing\n")
    (tmp_path / "out.xyz").write_text(plot3d([control[::-1]]))
    lines = table(control).splitlines()
    (tmp_path / "holes.csv").write_text("\n".join(lines[:1] + lines[2:]))
    (tmp_path / "twice.csv").write_text("\n".join(lines[:2] + lines[1:]))
    words_of = lines[2].split(",")
    (tmp_path / "nan.csv").write_text(
        "\n".join(lines[:2] + [",".join(words_of[:-1] + ["nan"])] + lines[3:])
    )
    text = plot3d([control])
    (tmp_path / "blank.xyz").write_text(text + " 1" * 24)
    (tmp_path / "nan.xyz").write_text(" ".join(text.split()[:-1] + ["nan"]))
    points, faces = wing()
    output = morphed(tmp_path, points, faces, boxes, status=1)
    message = " ".join(output.split())
    assert "FOAM FATAL IO ERROR" in message
    for word in words:
        assert word in message, (word, message)


def test_parameters_of_frozen_points_rest(tmp_path):
    """With C0 a box inside a surface: those of its rim have no derivative, and
    a value is an error."""
    grid = np.array(
        [
            (x, y, 0.5)
            for y in np.linspace(-1, 2, 7)
            for x in np.linspace(-1, 2, 7)
        ]
    )
    faces = [
        (7 * j + i, 7 * j + i + 1, 7 * j + i + 7)
        for j in range(6)
        for i in range(6)
    ]
    box = (
        "b { origin (0 0 0); span (1 1 1); order (2 2 2);"
        " bulk { g { directions (p); %s } } }"
    )
    _, output = morphed(
        tmp_path, grid, faces, box % "", options=["-derivatives"], output=True
    )
    rows = {
        m[0]: float(m[1])
        for m in re.findall(
            r"^b\.(g_\d_\d_\d_p) +\S+ +\S+ +\S+ +\S+ +(\S+)", output, re.M
        )
    }
    moving = {name for name, dz in rows.items() if dz != 0}
    assert moving == {f"g_1_1_{k}_p" for k in range(3)}
    text = morphed(
        tmp_path, grid, faces, box % "values { g_0_1_1_p 0.1; }", status=1
    )
    assert "g_0_1_1_p" in text and "frozen layer" in text
