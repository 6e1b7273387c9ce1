# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Wrong entries of ffdMotionSolver are errors that say what is wrong and what
to do; nothing is written.

Source of truth: the section "ffdMotionSolver" of README.md and the tables of
ffdBox.H. The fold: a corner of a lattice of order 4 that moves inwards by mu
(as in Lombardi's fig. 2.9) has the determinant 1 - 4 mu there.
"""

import re

import pytest

from ffdCase import coeffs, ffd_box, ffd_case, parameter

ONE = parameter("a", [((1, 1, 1), (0.1, 0, 0))])


def moving(*at, value="0.1", extra="", vector=(0.1, 0, 0)):
    return parameter("a", [(at, vector)], value, extra)


RAW = "body {{ origin (0 0 0); {} order (2 2 2); parameters {{ {} }} }}"

FOLD = ffd_box(
    "flat",
    moving(0, 0, 0, value="0.6", vector=(0, 1, 0))
    + parameter("idle", [((3, 3, 0), (0.1, 0, 0))], "0.2"),
    order=(4, 4, 0),
    origin=(-0.1, -0.1, -1),
    span=(1.2, 1.2, 3),
)

# name: (boxes, more of the coefficients, what the message has)
WRONG = {
    "no boxes": ("", "", ["no box", "nothing would move"]),
    "unknown coefficient": (
        ffd_box("body", ONE),
        "kernel wendlandC2;",
        ["'kernel'", "boxes", "onInvalidMesh"],
    ),
    "unknown entry of a box": (
        ffd_box("body", ONE, extra="centre (0 0 0);"),
        "",
        ["'centre'", "origin", "continuity"],
    ),
    "unknown entry of a parameter": (
        ffd_box("body", moving(1, 1, 1, extra="bound 3;")),
        "",
        ["'bound'", "moves", "min"],
    ),
    "degree without bSpline": (
        ffd_box("body", ONE, extra="degree (2 2 2);"),
        "",
        ["'degree'"],
    ),
    "unknown basis": (
        ffd_box("body", ONE, extra="basis nurbs;"),
        "",
        ["'basis'", "nurbs", "bernstein", "bSpline"],
    ),
    "unknown units": (
        ffd_box("body", ONE, extra="units feet;"),
        "",
        ["'units'", "feet", "metres"],
    ),
    "unknown continuity": (
        ffd_box("body", ONE, extra="continuity C3;"),
        "",
        ["'continuity'", "C3", "none", "C2"],
    ),
    "unknown combination": (
        ffd_box("body", ONE),
        "combine product;",
        ["'combine'", "product", "chain", "sum"],
    ),
    "unknown type": (
        ffd_box("body", ONE, extra="type sphere;"),
        "",
        ["'type'", "sphere", "cylindrical"],
    ),
    "unknown policy": (
        ffd_box("body", ONE),
        "onInvalidMesh stop;",
        ["'onInvalidMesh'", "stop", "limit"],
    ),
    "zero span": (
        ffd_box("body", ONE, span=(1, 0, 1)),
        "",
        ["'span'", "(1 0 1)", "positive"],
    ),
    "negative span": (
        ffd_box("body", ONE, span=(1, 1, -1)),
        "",
        ["'span'", "(1 1 -1)", "positive"],
    ),
    "negative order": (
        ffd_box("body", ONE, order=(2, -1, 2)),
        "",
        ["'order'", "(2 -1 2)", "negative"],
    ),
    "index beyond the lattice": (
        ffd_box("body", moving(1, 3, 1)),
        "",
        ["'moves'", "(1 3 1)", "'body'", "(0 0 0) to (2 2 2)"],
    ),
    "negative index": (
        ffd_box("body", moving(-1, 0, 0)),
        "",
        ["'moves'", "(-1 0 0)", "(0 0 0) to (2 2 2)"],
    ),
    "degree as large as the number of points": (
        ffd_box("body", ONE, extra="basis bSpline; degree (2 3 2);"),
        "",
        ["'degree'", "(2 3 2)", "from 1 to 2", "3"],
    ),
    "degree of zero": (
        ffd_box("body", ONE, extra="basis bSpline; degree (2 0 2);"),
        "",
        ["'degree'", "from 1 to 2"],
    ),
    "no degree": (
        ffd_box("body", ONE, extra="basis bSpline;"),
        "",
        ["degree"],
    ),
    "value above its bound": (
        ffd_box("body", moving(1, 1, 1, value="2.5", extra="max 2;")),
        "",
        ["'a'", "2.5", "to 2", "'min'"],
    ),
    "value below its bound": (
        ffd_box(
            "body",
            moving(
                1, 1, 1, value="table ((0 0) (1 -3))", extra="min -2; max 2;"
            ),
        ),
        "",
        ["'a'", "-3", "from -2 to 2"],
    ),
    "bounds in the wrong order": (
        ffd_box("body", moving(1, 1, 1, extra="min 2; max 1;")),
        "",
        ["'max' is 1", "'min', 2"],
    ),
    "a parameter that moves nothing": (
        ffd_box("body", "a { value 1; moves (); }"),
        "",
        ["'moves' is empty"],
    ),
    "a parameter that is no dictionary": (
        ffd_box("body", "a 1;"),
        "",
        ["'a'", "dictionary", "moves"],
    ),
    "frozen layer": (
        ffd_box(
            "body",
            moving(0, 1, 1),
            origin=(0.4, -0.1, -0.1),
            extra="continuity C0;",
        ),
        "",
        ["(0 1 1)", "'body'", "frozen layer", "s = 0", "C0", "1 layer"],
    ),
    "frozen layer by default": (
        ffd_box("body", moving(2, 1, 1), origin=(-0.7, -0.1, -0.1)),
        "",
        ["(2 1 1)", "frozen layer", "s = 1"],
    ),
    "second frozen layer": (
        ffd_box(
            "body",
            moving(1, 3, 1),
            order=(2, 4, 2),
            origin=(-0.1, -0.6, -0.1),
            extra="continuity C1;",
        ),
        "",
        ["(1 3 1)", "frozen layer", "t = 1", "2 layer"],
    ),
    "third frozen layer": (
        ffd_box(
            "body",
            moving(1, 1, 2),
            order=(2, 2, 6),
            origin=(-0.1, -0.1, 0.3),
            extra="continuity C2;",
        ),
        "",
        ["(1 1 2)", "frozen layer", "p = 0", "3 layer"],
    ),
    "box beside the mesh": (
        ffd_box("body", ONE, origin=(2, 0, 0)),
        "",
        ["'body' contains no point", "(2 0 0)", "(3.2", "(1 1 1)"],
    ),
    "fold": (
        FOLD,
        "",
        ["'flat' folds", "(a)", "Largest safe scale: 0.41", "(0 0 0)"],
    ),
    "fold in a later step": (
        ffd_box(
            "flat",
            moving(
                0,
                0,
                0,
                value="table ((0 0) (1 0.2) (2 0.5))",
                vector=(0, 1, 0),
            ),
            order=(4, 4, 0),
            origin=(-0.1, -0.1, -1),
            span=(1.2, 1.2, 3),
        ),
        "",
        ["folds", "Largest safe scale: 0.49"],
    ),
    "corners that are too few": (
        "body { type corners; corners ((0 0 0) (1 0 0)); order (1 1 1);"
        " parameters {} }",
        "",
        ["'corners'", "2", "8"],
    ),
    "corners inside out": (
        "body { type corners; corners ((0 0 0) (1 0 0) (0 1 0) (1 1 0)"
        " (0 0 1) (1 0 1) (0 1 1) (1 1 1)); order (1 1 1); parameters {} }",
        "",
        ["'corners'", "hex"],
    ),
    "negative radius": (
        "body { type cylindrical; origin (0 0 0); axis (0 0 1);"
        " start (-1 0 0); span (2 90 1); order (1 1 1); parameters {} }",
        "",
        ["'start'", "radius"],
    ),
    "more than a turn": (
        "body { type cylindrical; origin (0 0 0); axis (0 0 1);"
        " start (0 0 0); span (2 400 1); order (1 1 1); parameters {} }",
        "",
        ["'span'", "360"],
    ),
    "points of the axis": (
        "body { type cylindrical; origin (0 0 0); axis (0 0 1);"
        " start (0 0 0); span (2 90 1); order (2 2 2); parameters { "
        + moving(0, 1, 1)
        + " } }",
        "",
        ["(0 1 1)", "axis"],
    ),
    "a point twice in a ring": (
        "body { type cylindrical; origin (0 0 0); axis (0 0 1);"
        " start (0 0 0); span (2 360 1); order (2 4 2); parameters { "
        + moving(1, 4, 1)
        + " } }",
        "",
        ["(1 4 1)", "(2 3 2)"],
    ),
    "a weight that is not positive": (
        ffd_box("body", ONE, extra="weights ( ((1 1 1) 0) );"),
        "",
        ["'weights'", "(1 1 1)", "positive"],
    ),
    "a weight beyond the lattice": (
        ffd_box("body", ONE, extra="weights ( ((1 1 3) 2) );"),
        "",
        ["'weights'", "(1 1 3)"],
    ),
    "neighbours that tear": (
        ffd_box(
            "left",
            moving(1, 1, 1, vector=(0, 0, 1)),
            order=(1, 1, 1),
            origin=(0, 0, 0),
            span=(0.5, 1, 1),
            extra="continuity none;",
        )
        + ffd_box(
            "right",
            moving(1, 1, 1),
            order=(1, 1, 1),
            origin=(0.5, 0, 0),
            span=(0.5, 1, 1),
            extra="continuity none;",
        ),
        "",
        ["'left' and 'right'", "(0.5 ", "differently", "common face alike"],
    ),
    "parameters without a dictionary": (
        "body { origin (0 0 0); span (1 1 1); order (1 1 1); parameters; }",
        "",
        ["'parameters'", "no dictionary"],
    ),
    "rotation without a dictionary": (
        ffd_box("body", ONE, extra="rotation;"),
        "",
        ["'rotation'", "no dictionary"],
    ),
    "a bound that is a dictionary": (
        ffd_box("body", moving(1, 1, 1, extra="max { a 1; }")),
        "",
        ["'max'", "number"],
    ),
    "a span beyond all measure": (
        ffd_box("body", ONE, span=(1e300, 1, 1)),
        "",
        ["'span'", "1e+300"],
    ),
    "an origin beyond all measure": (
        ffd_box("body", ONE, origin=(1e300, 1, 1)),
        "",
        ["'origin'", "1e+300"],
    ),
    "too many control points": (
        ffd_box("body", ONE, order=(100000, 3, 2)),
        "",
        ["'order'", "(100000 3 2)", "at most"],
    ),
    "no origin": (RAW.format("", ONE), "", ["span"]),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_entry_is_an_error_that_helps(tmp_path, name):
    boxes, extra, words = WRONG[name]
    later = name == "fold in a later step"
    case = ffd_case(tmp_path, boxes, extra, control={"end": 2 if later else 1})
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    assert "FOAM FATAL IO ERROR" in output
    message = " ".join(output.split("FOAM FATAL IO ERROR")[1].split())
    for word in words:
        assert word in message, (word, message)
    assert "dynamicMeshDict" in message
    assert later or case.tree() == before


@pytest.mark.parametrize(
    "name",
    [
        "frozen layer",
        "box beside the mesh",
        "neighbours that tear",
        "fold",
        "value above its bound",
    ],
)
def test_all_ranks_stop_with_the_message(tmp_path, name):
    boxes, extra, words = WRONG[name]
    case = ffd_case(tmp_path, boxes, extra)
    case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=2, status=1)
    message = " ".join(re.sub(r"\[\d\]", "", output).split())
    for word in words:
        assert word in message, (word, message)


def test_without_coefficients_the_message_says_what_is_missing(tmp_path):
    case = ffd_case(tmp_path, ffd_box("body", ONE))
    path = case.path / "constant/dynamicMeshDict"
    path.write_text(path.read_text().replace(coeffs(ffd_box("body", ONE)), ""))
    output = case.run("moveDynamicMesh", status=1)
    assert "no dictionary 'boxes'" in output


# Beside the coefficients, where OpenFOAM reads it up to v2206, and among them,
# where it does from v2212 on
@pytest.mark.parametrize("place", ["beside", "among"])
def test_a_zone_that_is_not_there_is_an_error(tmp_path, place):
    case = ffd_case(
        tmp_path,
        ffd_box("body", ONE),
        "cellZone nowhere;" if place == "among" else "",
    )
    if place == "beside":
        path = case.path / "constant/dynamicMeshDict"
        path.write_text(path.read_text() + "\ncellZone nowhere;\n")
    output = case.run("moveDynamicMesh", status=1)
    assert "nowhere" in output and "cellZone" in output


def test_a_safe_scale_is_one(tmp_path):
    # What the message of the fold says: 0.41 times the value is valid
    case = ffd_case(tmp_path, FOLD.replace("value 0.6", "value 0.249"))
    case.run("moveDynamicMesh")
