# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""dx/dmu of meshes that radial basis functions carry: morphMesh
-sensitivityFields, -derivatives and -constraints with rbfMotionSolver.

The independent value is a central difference of fourth order of the mesh that
the same solver writes, with every control point selected, so that the selection
is the same on both sides.
"""

import re

import numpy as np
import pytest

from ffdCase import ffd_box, parameter
from rbfCase import groups, rbf_case, reference
from slidingCases import annulus, duct_obj

H = 1e-3
SETTINGS = "supportRadius 2; onInvalidMesh ignore;"
ALL = SETTINGS + "selection all;"

# Bottom at rest, the sides slide, the top moves as told
SIDES = {
    "bottom": "type fixed; patches (zMin);",
    "sides": 'type sliding; patches ("[xy].*");',
}


def case_of(path, displacement, ranks=1, extra=ALL, cells=(3, 4, 3), **mesh):
    case = rbf_case(
        path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement {"
            + displacement
            + "}",
            **SIDES,
        )
        + extra,
        cells=cells,
        **mesh,
    )
    if ranks > 1:
        case.decompose((1, ranks, 1))
    return case


def field(case, name, ranks=1):
    file = f"1/d_{name}"
    return case.decomposed_points(file) if ranks > 1 else case.points(file)


def moved(path, displacement, **options):
    case = case_of(path, displacement, **options)
    case.run("morphMesh", "-time", "1")
    return case.points("1/polyMesh/points")


def difference(tmp_path, text, value, h=H, **options):
    """Of fourth order, by the number {} of a displacement."""
    at = {
        i: moved(
            tmp_path / f"at{i}",
            text.replace("{}", repr(value + i * h)),
            **options,
        )
        for i in (-2, -1, 1, 2)
    }
    return (8 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12 * h)


def check(exact, expected):
    scale = np.abs(expected).max()
    assert scale > 1e-3
    np.testing.assert_allclose(exact, expected, rtol=0, atol=1e-8 * scale)


ROTATION = (
    "type solidBody; solidBodyMotionFunction rotatingMotion;"
    " rotatingMotionCoeffs { origin (0.4 %s 0.9); axis (0.1 %s 1);"
    " omega %s; }"
)
POLYLINE = (
    "type polyline; scale %s; vertices ((-0.1 0.2 1) (%s 0.55 1.1)"
    " (1.2 0.3 0.9)); values ((0 0 0.05) (0.02 0.03 %s) (0 0 -0.04));"
)


@pytest.mark.parametrize(
    "name, text, value",
    [
        ("value.x", "type uniform; value ({} 0.02 -0.1);", 0.05),
        ("value.z", "type uniform; value (0.03 0.02 {});", -0.1),
        ("value.y", "type velocity; value (0.1 {} 0.05); start -1;", 0.02),
        ("value", "type velocity; value {}; direction (0.3 0.4 1);", 0.05),
        (
            "direction.z",
            "type velocity; value table ((0 0) (1 0.2)); direction (0.3 0 {});",
            0.5,
        ),
        ("omega", ROTATION % (0.3, 0.2, "{}"), 0.3),
        ("origin.y", ROTATION % ("{}", 0.2, 0.3), 0.3),
        ("axis.y", ROTATION % (0.3, "{}", 0.3), 0.2),
        (
            "pitch.amplitude.y",
            "type solidBody; solidBodyMotionFunction multiMotion;"
            " multiMotionCoeffs { pitch { solidBodyMotionFunction"
            " oscillatingRotatingMotion; oscillatingRotatingMotionCoeffs {"
            " origin (0 0 1); amplitude (2 {} 1); omega 1.3; } } heave {"
            " solidBodyMotionFunction linearMotion; linearMotionCoeffs {"
            " velocity (0 0 0.05); } } }",
            5.0,
        ),
        ("scale", POLYLINE % ("{}", 0.5, 0.1), 1.1),
        ("vertices.1.x", POLYLINE % (1.1, "{}", 0.1), 0.47),
        ("values.1.z", POLYLINE % (1.1, 0.47, "{}"), 0.1),
        (
            "box.t",
            "type ffd; boxes { box { type corners; corners ((-.1 -.1 .5)"
            " (1.1 -.1 .5) (1.2 1.1 .5) (-.1 1.1 .5) (-.1 -.1 1.2)"
            " (1.1 -.1 1.2) (1.2 1.2 1.2) (-.1 1.2 1.1)); order (2 2 2);"
            " units metres; continuity none; parameters { a { value 0.1;"
            " moves ( ((1 1 1) (0.1 0.2 0.3)) ); } } axis { through"
            " ((.5 .5 .5) (.5 .5 1.2)); variables { t { type twist;"
            " value {}; along ((0 0) (1 1)); } } } } }",
            8.0,
        ),
    ],
)
def test_every_parameter_is_a_central_difference(tmp_path, name, text, value):
    h = 0.02 if value > 4 else H
    full = name if name.startswith("box.") else f"top.{name}"
    case = case_of(tmp_path / "case", text.replace("{}", repr(value)))
    case.run("morphMesh", "-time", "1", "-sensitivityFields")
    check(field(case, full), difference(tmp_path, text, value, h))


def test_values_of_listed_points(tmp_path):
    """Some on the mesh and some inside a cell, two of a kind at one place."""

    def case(value, folder):
        return rbf_case(
            tmp_path / folder,
            coeffs=groups(
                few="type moving; points ((0.5 0.5 1) (0.4 0.55 0.35)"
                " (0.5 0.5 1)); displacement { type values; scale 0.5; values"
                f" ((0 0 0.1) (0 {value!r} 0.1) (0 0 0.1)); }}",
                rest='type fixed; patches (".*");',
            )
            + ALL,
            cells=(4, 4, 4),
        )

    at = {}
    for i in (-1, 1):
        one = case(0.05 + i * H, f"at{i}")
        one.run("morphMesh", "-time", "1")
        at[i] = one.points("1/polyMesh/points")
    one = case(0.05, "case")
    one.run("morphMesh", "-time", "1", "-sensitivityFields")
    check(field(one, "few.values.1.y"), (at[1] - at[-1]) / (2 * H))
    names = {path.name for path in (one.path / "1").glob("d_*")}
    assert len(names) == 10 and "d_few.scale" in names


UNIFORM = "type uniform; value (0.03 0.02 {});"


@pytest.mark.parametrize(
    "extra, mesh",
    [
        # Mirror images of control points at planes of symmetry
        (
            ALL,
            {
                "patches": {
                    "xMin": "symmetryPlane",
                    "zMax": "patch",
                    "zMin": "patch",
                    "rest": ("patch", "yMin yMax xMax"),
                }
            },
        ),
        # A mesh of one cell between empty sides
        (
            ALL,
            {
                "patches": {
                    "zMax": "patch",
                    "zMin": "patch",
                    "xMax": "patch",
                    "xMin": "patch",
                    "sides": ("empty", "yMin yMax"),
                },
                "cells": (4, 1, 4),
            },
        ),
        (ALL + "kernel multiQuadric;", {}),
        (ALL + "images no;", {}),
        (ALL + "cellZone none;", {}),
    ][:4],
    ids=["symmetry", "empty", "polynomial", "noImages"],
)
def test_constraints_of_the_mesh(tmp_path, extra, mesh):
    def case(value, folder):
        patches = mesh.get("patches")
        sides = "" if not patches else "x"
        return rbf_case(
            tmp_path / folder,
            coeffs=groups(
                top="type moving; patches (zMax); displacement {"
                + UNIFORM.replace("{}", repr(value))
                + "}",
                bottom="type fixed; patches (zMin);",
                **(
                    {"rest": 'type sliding; patches ("(xMax|rest)");'}
                    if sides
                    else {"sides": SIDES["sides"]}
                ),
            )
            + extra,
            patches=patches,
            cells=mesh.get("cells", (3, 4, 3)),
        )

    at = {}
    for i in (-1, 1):
        one = case(-0.1 + i * H, f"at{i}")
        one.run("morphMesh", "-time", "1")
        at[i] = one.points("1/polyMesh/points")
    one = case(-0.1, "case")
    one.run("morphMesh", "-time", "1", "-sensitivityFields")
    check(field(one, "top.value.z"), (at[1] - at[-1]) / (2 * H))


CURVED = {
    "cylinder": "surface { type searchableCylinder; point1 (0 0 0);"
    " point2 (0 0 1); radius 1; }",
    "own triangles": "surface curved;",
    "triangles of a file": 'target "duct.obj";',
    "sphere": "target { type searchableSphere; centre (0 0 0.5);"
    " radius 1.2; }",
}


@pytest.mark.parametrize("name", CURVED)
def test_points_that_slide_on_curved_surfaces(tmp_path, name):
    """The hub of an annulus turns, about an axis that is not that of the casing
    on which points slide. The tolerance is that of the mesh's own iteration:
    the motion stops at a tenth of it, the derivative goes on to the fixed point,
    so that with the default of 1e-5 the meshes of the difference are off by
    2e-6. On triangles the step is small: where a point crosses one of their
    edges there is no derivative."""

    def case(omega, folder):
        one = annulus(
            tmp_path / folder,
            SETTINGS
            + "subSteps 1; greedy { tolerance 1e-11; }"
            + groups(
                hub="type moving; patches (hub); displacement {"
                " type solidBody; solidBodyMotionFunction rotatingMotion;"
                " rotatingMotionCoeffs { origin (0 0 0.5); axis (0.1 0 1);"
                f" omega {omega!r}; }} }}",
                casing=f"type sliding; patches (casing); {CURVED[name]}",
                ends="type sliding; patches (zMin zMax);",
            ),
            cells=(4, 3, 4),
        )
        surfaces = one.path / "constant/triSurface"
        surfaces.mkdir(parents=True)
        (surfaces / "duct.obj").write_text(duct_obj(1.05, 40))
        return one

    h, at = 1e-4, {}
    for i in (-2, -1, 1, 2):
        one = case(0.6 + i * h, f"at{i}")
        one.run("morphMesh", "-time", "1")
        at[i] = one.points("1/polyMesh/points")
    one = case(0.6, "case")
    one.run("morphMesh", "-time", "1", "-sensitivityFields")
    x = reference(one)
    casing = np.abs(np.hypot(*x[:, :2].T) - 1) < 1e-9
    derivative = field(one, "hub.omega")
    assert np.linalg.norm(derivative[casing], axis=1).min() > 1e-3
    check(derivative, (8 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12 * h))


LATTICE = (
    "type ffd; boxes {"
    + ffd_box(
        "box",
        parameter("a", [((1, 1, 1), (0.1, 0.2, 0.3))], "{}")
        + parameter("b", [((1, 0, 2), (0.3, 0, 0.1))], "0"),
        origin=(-0.1, -0.1, 0.5),
        span=(1.2, 1.2, 0.7),
    )
    + "}"
)


@pytest.mark.parametrize("correction", ["no", "yes"])
def test_a_greedy_selection_is_held(tmp_path, correction):
    """The motion is proportional to its one parameter that is not zero, so that
    at both ends of the difference the same points are selected. The same to the
    bit on other numbers of ranks."""
    extra = (
        SETTINGS + f"surfaceCorrection {correction};"
        "greedy { tolerance 1e-2; }"
    )

    def at(i, ranks=1, options=()):
        case = case_of(
            tmp_path / f"at{i}.{ranks}",
            LATTICE.replace("{}", repr(0.3 + i * H)),
            extra=extra,
            cells=(6, 6, 4),
            ranks=ranks,
        )
        output = case.run("morphMesh", "-time", "1", *options, ranks=ranks)
        n, of = re.search(r"selected (\d+) of (\d+)", output).groups()
        assert int(n) < 0.5 * int(of)
        return case, n

    case, n = at(0, options=["-sensitivityFields"])
    ends = {}
    for i in (-1, 1):
        one, same = at(i)
        assert same == n
        ends[i] = one.points("1/polyMesh/points")
    exact = field(case, "box.a")
    check(exact, (ends[1] - ends[-1]) / (2 * H))
    assert np.abs(field(case, "box.b")).max() > 1e-2
    for ranks in (2, 3, 4):
        parallel, same = at(0, ranks, ["-sensitivityFields"])
        assert same == n
        for name in ("box.a", "box.b"):
            np.testing.assert_array_equal(
                field(parallel, name, ranks), field(case, name)
            )


def test_at_rest_points_are_selected_for_the_parameters(tmp_path):
    """All parameters zero: the derivative by a lattice is that of the surface
    on the surface, and where the mesh goes for a small value elsewhere, to the
    tolerance."""
    at_rest = case_of(
        tmp_path / "rest",
        LATTICE.replace("{}", "0"),
        extra=SETTINGS + "greedy { tolerance 1e-4; }",
        cells=(6, 6, 4),
    )
    at_rest.run("morphMesh", "-time", "1", "-sensitivityFields")
    exact = field(at_rest, "box.a")
    small = case_of(
        tmp_path / "small",
        LATTICE.replace("{}", "1e-3"),
        extra=SETTINGS + "greedy { tolerance 1e-5; }",
        cells=(6, 6, 4),
    )
    small.run("morphMesh", "-time", "1")
    x = reference(small)
    expected = (small.points("1/polyMesh/points") - x) / 1e-3
    scale = np.abs(expected).max()
    np.testing.assert_allclose(exact, expected, rtol=0, atol=1e-3 * scale)
    top = x[:, 2] == 1
    np.testing.assert_allclose(exact[top], expected[top], atol=1e-11 * scale)
    assert np.abs(field(at_rest, "box.b")).max() > 1e-2


def test_groups_share_a_lattice(tmp_path):
    """Boxes of one name are one design variable: their effects add up."""
    box = LATTICE.replace("{}", "0.3")

    def case(path, text):
        one = rbf_case(path, coeffs=text + ALL, cells=(3, 3, 3))
        one.run("morphMesh", "-time", "1", "-sensitivityFields")
        return field(one, "box.a")

    whole = case(
        tmp_path / "one",
        groups(
            all=f"type moving; patches (zMax xMax); displacement {{ {box} }}",
            rest="type fixed; patches (zMin);",
        ),
    )
    shared = case(
        tmp_path / "two",
        groups(
            top=f"type moving; patches (zMax); displacement {{ {box} }}",
            side=f"type moving; patches (xMax); displacement {{ {box} }}",
            rest="type fixed; patches (zMin);",
        ),
    )
    np.testing.assert_allclose(shared, whole, atol=1e-13)


def test_volume_and_constraints(tmp_path):
    """The top of a unit cube rises: V = 1 + dz, by the formula; its sides
    slide along with it."""
    case = case_of(
        tmp_path,
        "type uniform; value (0 0 0.2);",
        extra=ALL
        + 'constraints { patches (".*"); tank { type volume; relative yes; }'
        " height { type thickness; stations ((0.4 0.3 0.5));"
        " direction (0 0 1); } }",
    )
    case.run(
        "morphMesh",
        "-time",
        "1",
        "-dryRun",
        "-derivatives",
        '(".*")',
        "-constraints",
    )
    folder = tmp_path / "postProcessing/morphMesh/1"
    rows = [
        line.split()
        for line in (folder / "derivatives.dat").read_text().splitlines()
    ]
    assert rows[0][:4] == ["#", "parameter", "value", "darea"]
    slopes = {row[0]: [float(x) for x in row[1:]] for row in rows[1:]}
    assert slopes["top.value.z"][0] == 0.2
    np.testing.assert_allclose(
        slopes["top.value.z"][1:], [4, 1, 0, 0, 0.5], atol=1e-12
    )
    # Of the shear by x no volume
    assert slopes["top.value.x"][2] == pytest.approx(0, abs=1e-12)
    table = [
        line.split()
        for line in (folder / "constraintDerivatives.dat")
        .read_text()
        .splitlines()
    ]
    column = table[0].index("top.value.z") - 1
    for row in table[1:]:
        assert float(row[column]) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("ranks", [1, 2])
def test_what_has_no_derivative_says_so(tmp_path, ranks):
    """Each with what to do instead."""

    def refused(folder, displacement, extra, sides=None):
        case = rbf_case(
            tmp_path / folder,
            coeffs=groups(
                top="type moving; patches (zMax); displacement {"
                + displacement
                + "}",
                bottom="type fixed; patches (zMin);",
                sides=sides or SIDES["sides"],
            )
            + extra,
            cells=(3, 4, 3),
        )
        if ranks > 1:
            case.decompose((1, ranks, 1))
        return case.run(
            "morphMesh",
            "-time",
            "1",
            "-derivatives",
            "(zMax)",
            ranks=ranks,
            status=1,
        )

    text = "type uniform; value (0 0 0.1);"
    output = refused("steps", text, "supportRadius 2; subSteps 3;")
    assert "in 3 steps" in output and "'subSteps 1'" in output
    output = refused(
        "limit",
        "type uniform; value (0 0 -1.5);",
        "supportRadius 2; subSteps 1; onInvalidMesh limit;",
    )
    assert "was limited to" in output
    output = refused(
        "surface",
        text,
        SETTINGS,
        'type sliding; patches ("[xy].*"); displacement { type uniform; value'
        " (0.01 0 0); }",
    )
    assert "slides on a surface that moves" in output
    output = refused(
        "rest", "type uniform; value (0 0 0);", "supportRadiusFactor 4;"
    )
    assert "Nothing moves at these values" in output
