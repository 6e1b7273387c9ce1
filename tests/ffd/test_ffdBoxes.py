# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Boxes of free-form deformation without a mesh, and their derivatives.

Source of truth: central differences of the deformed points and of the volume,
area and centroids of the surface they make.
"""

import re

import pytest

from boxCase import vectors, write_control
from ffdCase import ffd_box, parameter
from foamCase import FoamCase, build_program

MOVES = [((1, 1, 1), (0.5, 0.3, -0.2)), ((1, 2, 1), (0, 0.2, 0))]

PLAIN = ffd_box(
    "plain",
    parameter("a", MOVES, "0.3")
    + parameter("b", [((2, 2, 2), (0.3, 0, 0.4))], "-0.2"),
)

TURNED = ffd_box(
    "turned",
    parameter("a", MOVES, "-0.2"),
    order=(3, 3, 3),
    origin=(0.1, -0.1, 0),
    extra="basis bSpline; degree (2 3 1);"
    " weights ( ((1 1 1) 3) ((1 2 1) 0.5) ); continuity none;"
    " rotation { type axisAngle; axis (1 2 3); angle 10; }",
)

RING = (
    "ring { type cylindrical; origin (0.5 0.45 0); axis (0 0.1 1);"
    " start (0 0 -0.5); span (2 360 2); order (3 5 2); basis bSpline;"
    " degree (2 3 2); parameters {"
    + parameter(
        "a", [((1, 2, 1), (0.1, 0.05, 0.2)), ((2, 2, 1), (0.2, 0.1, 0))], "0.4"
    )
    + "} }"
)

CORNERS = (
    "corners { type corners; corners "
    + vectors(
        [
            (-0.2, -0.1, 0),
            (1.2, 0, -0.1),
            (1.1, 1.1, 0),
            (-0.2, 1, 0),
            (-0.1, 0, 1),
            (1.1, -0.1, 1.2),
            (1.1, 1, 1.1),
            (-0.1, 1.1, 1.1),
        ]
    )
    + "; order (2 2 2); parameters {"
    + parameter("a", MOVES, "0.3")
    + "} }"
)


@pytest.mark.parametrize("combine", ["chain", "sum"])
def test_derivatives_are_those_of_central_differences(tmp_path, combine):
    build_program("ffdDerivatives")
    case = FoamCase(tmp_path)
    write_control(case)
    case.write(
        "constant/ffdDict",
        "dictionary",
        f"boxes {{ {PLAIN} {TURNED} {RING} {CORNERS} }}"
        f" combine {combine};",
    )
    output = case.run("ffdDerivatives")
    assert "closed 1" in output
    found = re.findall(
        r"parameter (\S+) dx (\S+) error (\S+) measures (\S+)" r" error (\S+)",
        output,
    )
    assert [name for name, *_ in found] == [
        "plain.a",
        "plain.b",
        "turned.a",
        "ring.a",
        "corners.a",
    ]
    for _, dx, error, measures, measures_error in found:
        assert float(dx) > 0.02 and float(measures) > 1e-3
        assert float(error) < 1e-7 * max(1, float(dx))
        assert float(measures_error) < 1e-7 * max(1, float(measures))
