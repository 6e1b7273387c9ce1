# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphSurface: boxes of ffdMotionSolver on surface files.

Sources of truth: the Bernstein polynomials by themselves, closed forms of a
cube, central differences of the program's own volumes.
"""

import gzip
import re

import numpy as np
import pytest

from ffdCase import bernstein, ffd_box, parameter
from foamCase import FoamCase

CUBE = [
    (0, 2, 1),
    (1, 2, 3),
    (4, 5, 6),
    (5, 7, 6),
    (0, 1, 4),
    (1, 5, 4),
    (2, 6, 3),
    (3, 6, 7),
    (0, 4, 2),
    (2, 4, 6),
    (1, 3, 5),
    (3, 7, 5),
]

MOVES = [((1, 1, 2), (0.1, 0, 0.3)), ((2, 1, 1), (0.2, 0.1, 0))]


def cube(path, faces=CUBE):
    """The unit cube as obj."""
    corners = [(i & 1, i >> 1 & 1, i >> 2 & 1) for i in range(8)]
    path.write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
        + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)
    )


def surface_case(path, value=0.5, extra="", boxes=None):
    case = FoamCase(path)
    path.mkdir(exist_ok=True)
    cube(case.path / "cube.obj")
    case.write(
        "boxes",
        "dictionary",
        "boxes\n{\n"
        + (
            boxes
            or ffd_box(
                "cube", parameter("mu", MOVES, value, extra), order=(2, 2, 2)
            )
        )
        + "}",
    )
    return case


def vertices(path):
    return np.array(
        [
            line.split()[1:]
            for line in path.read_text().splitlines()
            if line.startswith("v ")
        ],
        float,
    )


def row(output, name):
    return np.array(
        re.search(rf"^{name}((?: +[-+.0-9e]+)+)$", output, re.MULTILINE)[
            1
        ].split(),
        float,
    )


def test_points_move_by_the_polynomials(tmp_path):
    case = surface_case(tmp_path)
    case.run("morphSurface", "-dict", "boxes", "cube.obj", "out/moved.obj")
    x = vertices(tmp_path / "cube.obj")
    xi = (x + 0.1) / 1.2
    expected = x + sum(
        0.5
        * 1.2
        * np.array(vector)
        * np.prod(
            [bernstein(2, i, xi[:, a]) for a, i in enumerate(at)], axis=0
        )[:, None]
        for at, vector in MOVES
    )
    moved = vertices(tmp_path / "out/moved.obj")
    # In another order, with six digits
    assert len(moved) == 8
    distance = np.linalg.norm(moved[:, None] - expected, axis=2).min(axis=0)
    np.testing.assert_array_less(distance, 1e-5)


def test_measures_of_a_closed_and_an_open_surface(tmp_path):
    case = surface_case(tmp_path, value=0)
    output = case.run("morphSurface", "-dict", "boxes", "cube.obj", "out.stl")
    assert "closed" in output
    np.testing.assert_allclose(
        row(output, "after"), [6, 1, 0.5, 0.5, 0.5], rtol=1e-12
    )
    cube(tmp_path / "cube.obj", CUBE[:10])
    output = case.run("morphSurface", "-dict", "boxes", "cube.obj", "out.stl")
    assert "open" in output
    np.testing.assert_allclose(
        row(output, "after"), [5, 0.4, 0.5, 0.5], rtol=1e-12
    )


def test_derivatives_are_those_of_differences(tmp_path):
    h = 0.01
    volumes = []
    for value in (0.5 - h, 0.5 + h, 0.5):
        case = surface_case(tmp_path / f"{value}", value)
        output = case.run(
            "morphSurface",
            "-dict",
            "boxes",
            "-derivatives",
            "cube.obj",
            "out.obj",
        )
        volumes.append(row(output, "after"))
    table = (tmp_path / "0.5/out.derivatives.dat").read_text().splitlines()
    derivative = np.array(table[1].split()[2:], float)
    # Printed with six digits
    np.testing.assert_allclose(
        derivative, (volumes[1] - volumes[0]) / (2 * h), atol=5e-4
    )
    assert np.abs(derivative).max() > 0.04


def test_formats_and_compressed_input(tmp_path):
    case = surface_case(tmp_path)
    with gzip.open(tmp_path / "packed.obj.gz", "wb") as file:
        file.write((tmp_path / "cube.obj").read_bytes())
    for source, target in (
        ("packed.obj.gz", "a.stl"),
        ("a.stl", "b.vtk"),
        ("packed.obj.gz", "c.obj"),
    ):
        case.run("morphSurface", "-dict", "boxes", source, target)
        assert (tmp_path / target).stat().st_size > 100


def test_lattice_and_bounds_are_shown(tmp_path):
    case = surface_case(tmp_path, extra="min -0.3; max 40;")
    output = case.run(
        "morphSurface", "-dict", "boxes", "-lattice", "cube.obj", "out.obj"
    )
    shown = {path.name for path in (tmp_path / "out.lattice").iterdir()}
    # 40 folds: told, and left out
    assert shown == {
        "cube.vtk",
        "cubeAtRest.vtk",
        "cube.mu.min.vtp",
        "surface.vtp",
    }
    assert "With cube.mu at 40 the box folds" in output


def test_default_dictionary_is_that_of_the_case(tmp_path):
    case = surface_case(tmp_path)
    text = (tmp_path / "boxes").read_text().split("}", 1)[1]
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        "motionSolver ffdMotionSolver; ffdMotionSolverCoeffs {" + text + "}",
    )
    case.run("morphSurface", "cube.obj", "out.obj")


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(arguments=["none.obj", "out.obj"]), "There is no surface"),
        (dict(arguments=["cube.obj", "out.doc"]), "cannot be written"),
        (dict(dictionary="none"), "There is no dictionary"),
        (dict(text="colour blue;"), "There are no boxes"),
        (dict(value=30), "Largest safe scale"),
        (dict(arguments=["-time", "nan", "cube.obj", "out.obj"]), "-time"),
        (dict(arguments=["empty.obj", "out.obj"]), "empty.obj"),
        (dict(arguments=["zero.obj", "out.obj"]), "zero.obj"),
        (dict(arguments=["huge.obj", "out.obj"]), "huge.obj"),
        (
            dict(boxes=ffd_box(300 * "b", parameter("mu", MOVES))),
            "300 characters",
        ),
        (
            dict(
                boxes=ffd_box("far", parameter("mu", MOVES), origin=(5, 5, 5))
            ),
            "far",
        ),
    ],
)
def test_wrong_input_is_an_error_and_writes_nothing(tmp_path, change, message):
    case = surface_case(
        tmp_path, value=change.get("value", 0.5), boxes=change.get("boxes")
    )
    if "text" in change:
        case.write("boxes", "dictionary", change["text"])
    text = (tmp_path / "cube.obj").read_text()
    (tmp_path / "empty.obj").write_text("v 0 0 0\n")
    (tmp_path / "zero.obj").write_text(text + "f 0 2 3\n")
    (tmp_path / "huge.obj").write_text(text.replace("v 0 0 0", "v 1e300 0 0"))
    before = case.tree()
    output = case.run(
        "morphSurface",
        "-dict",
        change.get("dictionary", "boxes"),
        *change.get("arguments", ["cube.obj", "out.obj"]),
        status=1,
    )
    assert message in output
    assert case.tree() == before


def test_positions_are_read_back_as_they_were_written(tmp_path):
    """17 digits: the formula to round-off, where six would differ by 1e-6."""
    case = surface_case(tmp_path)
    case.run("morphSurface", "-dict", "boxes", "cube.obj", "moved.obj")
    x = vertices(tmp_path / "cube.obj")
    xi = (x + 0.1) / 1.2
    expected = x + sum(
        0.5
        * 1.2
        * np.array(vector)
        * np.prod(
            [bernstein(2, i, xi[:, a]) for a, i in enumerate(at)], axis=0
        )[:, None]
        for at, vector in MOVES
    )
    np.testing.assert_allclose(
        vertices(tmp_path / "moved.obj"), expected, rtol=0, atol=1e-15
    )


def test_one_picture_of_every_parameter_at_its_bounds(tmp_path):
    pytest.importorskip("matplotlib")
    case = surface_case(tmp_path, extra="min -0.3; max 0.6;")
    case.run(
        "morphSurface", "-dict", "boxes", "-preview", "cube.obj", "out.obj"
    )
    assert (tmp_path / "out.lattice/preview.png").stat().st_size > 5000


def test_without_bounds_there_is_no_picture_and_a_warning(tmp_path):
    pytest.importorskip("matplotlib")
    case = surface_case(tmp_path)
    output = case.run(
        "morphSurface", "-dict", "boxes", "-preview", "cube.obj", "out.obj"
    )
    assert "no picture" in output and "'min'" in output
