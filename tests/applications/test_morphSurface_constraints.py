# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphSurface -constraints: tables of values and exact derivatives.

Sources of truth: closed forms of a stretched cube; central differences of the
program's own values.
"""

import pytest

from ffdCase import ffd_box, parameter
from surfaceCase import cube_surface, morphed, table, write_surface

CONSTRAINTS = """constraints
{
    spar    { type thickness; stations ((0.3 0.4 0.5) (0.5 0.25 0.5));
              direction (0 0 1); relative yes; min 0.9; }
    ratio   { type thicknessToChord; stations ((0.31 0.41 0.5));
              direction (0 0 1); leading ((0 0.41 0.5));
              trailing ((1 0.41 0.5)); max 0.5; }
    nose    { type edge; points ((0 0.4 0.5)); }
    bend    { type curvature; }
    front   { type projectedArea; direction (1 0.2 0.1); }
    wet     { type wettedArea; point (0 0 0.45); normal (0.1 0.2 1); }
    all     { type wettedArea; }
    engine  { type distance; surface "other.obj"; min 0.5; }
    tank    { type volume; relative yes; min 1; }
    middle  { type barycentre; }
}
"""


def boxes(a=0.2, b=-0.1):
    return ffd_box(
        "box",
        parameter(
            "a",
            [((1, 1, 1), (0.4, 0.3, 0.5)), ((2, 1, 2), (0.1, 0.2, 0.3))],
            repr(a),
        )
        + parameter("b", [((0, 1, 2), (0.3, -0.2, 0.6))], repr(b)),
    )


def evaluated(path, box, constraints=CONSTRAINTS):
    points, faces = cube_surface()
    path.mkdir(exist_ok=True)
    write_surface(
        path / "other.obj", [(-9, -9, 3), (9, -9, 3), (0, 9, 3)], [(0, 1, 2)]
    )
    morphed(path, points, faces, box, constraints, ["-constraints"])
    return (
        table(path / "out.constraints.dat"),
        table(path / "out.constraintDerivatives.dat"),
    )


def test_derivatives_are_those_of_central_differences(tmp_path):
    h = 1e-5
    _, derivatives = evaluated(tmp_path / "at", boxes())
    for column, change in ((0, dict(a=0.2 + h)), (1, dict(b=-0.1 + h))):
        up, _ = evaluated(tmp_path / "up", boxes(**change))
        down, _ = evaluated(
            tmp_path / "down",
            boxes(**{k: v - 2 * h for k, v in change.items()}),
        )
        assert set(up) == set(derivatives) and len(up) == 15
        for name in derivatives:
            slope = (float(up[name][0]) - float(down[name][0])) / (2 * h)
            exact = float(derivatives[name][column])
            assert exact == pytest.approx(slope, rel=1e-8, abs=1e-8), name


def stretched(value=0.3):
    """Linear in z: the cube becomes a box of height 1 + value."""
    moves = [((i, j, 1), (0, 0, 1)) for i in (0, 1) for j in (0, 1)]
    return ffd_box(
        "box",
        parameter("a", moves, repr(value)),
        order=(1, 1, 1),
        origin=(0, 0, 0),
        span=(1, 1, 1),
        extra="continuity none;",
    )


def test_values_and_violations_of_a_stretched_cube(tmp_path):
    values, derivatives = evaluated(tmp_path, stretched(-0.3))
    value = {name: float(row[0]) for name, row in values.items()}
    assert value["spar.0"] == pytest.approx(0.7, abs=1e-14)
    assert float(values["spar.0"][4]) == pytest.approx(0.2, abs=1e-14)
    assert values["spar.0"][3] == "none"
    assert value["ratio.0"] == pytest.approx(0.7, abs=1e-14)
    assert float(values["ratio.0"][4]) == pytest.approx(0.2, abs=1e-14)
    assert value["nose.0z"] == pytest.approx(-0.15, abs=1e-14)
    assert value["nose.0x"] == 0
    assert value["all"] == pytest.approx(2 + 4 * 0.7, abs=1e-13)
    assert value["tank"] == pytest.approx(0.7, abs=1e-14)
    assert float(values["tank"][1]) == pytest.approx(1, abs=1e-14)
    assert value["middle.z"] == pytest.approx(0.35, abs=1e-14)
    assert value["engine"] == pytest.approx(2.3, abs=1e-14)
    assert float(values["engine"][4]) == 0
    assert float(derivatives["tank"][0]) == pytest.approx(1, abs=1e-13)
    assert float(derivatives["all"][0]) == pytest.approx(4, abs=1e-13)


@pytest.mark.parametrize(
    "entries, words",
    [
        ("c { type girth; }", ["girth", "thickness", "volume"]),
        (
            "c { type thickness; stations ((5 5 5)); direction (0 0 1); }",
            ["'stations'", "(5 5 5)", "within the body"],
        ),
        (
            "c { type thicknessToChord; stations ((0.5 0.5 0.5)); direction (0 0 1);"
            " leading (); trailing (); }",
            ["1, 0 and 0", "for each station"],
        ),
        ("c { type volume; min 2; max 1; }", ["'max' is 1"]),
        ("c { type volume; colour 2; }", ["'colour'"]),
        (
            "c { type edge; points ((0 0 0)); relative yes; }",
            ["c.0x", "zero before"],
        ),
        ('c { type distance; surface "none.obj"; }', ["no file", "none.obj"]),
        ("c 1;", ["'c'", "dictionary"]),
    ],
)
def test_a_wrong_constraint_is_an_error_that_helps(tmp_path, entries, words):
    points, faces = cube_surface()
    output = " ".join(
        morphed(
            tmp_path,
            points,
            faces,
            boxes(),
            f"constraints {{ {entries} }}",
            ["-constraints"],
            status=1,
        ).split()
    )
    assert "FOAM FATAL IO ERROR" in output
    for word in words:
        assert word in output, (word, output)


def test_an_open_surface_has_no_volume(tmp_path):
    points, faces = cube_surface()
    output = morphed(
        tmp_path,
        points,
        faces[:-30],
        boxes(),
        "constraints { c { type volume; } }",
        ["-constraints"],
        status=1,
    )
    assert "open" in output and "close it" in output
