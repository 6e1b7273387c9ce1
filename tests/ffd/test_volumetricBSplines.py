# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""form position beside OpenFOAM's own volumetric B-splines, NURBS3DVolume of
libadjointOptimisation: the same moves of the same control points."""

import pathlib
import re
import subprocess

import pytest

from boxCase import box
from foamCase import build_program, environment
from ffdCase import ffd_box, parameter
from rbfCase import CUBE

LATTICE = (6, 5, 4)
MOVES = [
    ((2, 1, 1), (0.10, 0.03, -0.04)),
    ((3, 3, 2), (-0.05, 0.08, 0.02)),
    ((1, 2, 2), (0.02, -0.06, 0.09)),
]


@pytest.fixture(scope="module")
def program():
    adjoint = pathlib.Path(
        environment()["LIB_SRC"], "optimisation/adjointOptimisation/adjoint"
    )
    if not (adjoint / "lnInclude").exists():
        subprocess.run(
            ["wmakeLnInclude", adjoint],
            check=True,
            env=environment(),
            stdout=subprocess.DEVNULL,
        )
    build_program("volumetricBSplines")


@pytest.mark.parametrize(
    "form, least, most",
    [
        ("position", 0, 1e-10),
        # The forms are not the same: what the test can tell apart
        ("displacement", 1e-3, 1),
    ],
)
def test_it_is_that_of_openfoam(tmp_path, program, form, least, most):
    """Degrees 3, 2 and 3 in a lattice that is longer than the mesh. Their
    inversion, by Newton's method, is asked for 1e-14."""
    case = box(tmp_path, CUBE, cells=(5, 4, 3))
    degrees = (3, 2, 3)
    case.write(
        "constant/lattices",
        "dictionary",
        "boxes {"
        + ffd_box(
            "box",
            parameter("a", MOVES, "1"),
            order=tuple(n - 1 for n in LATTICE),
            origin=(-0.1, -0.2, -0.1),
            span=(1.3, 1.4, 1.2),
            extra="basis bSpline; degree (%d %d %d); units metres;" % degrees
            + f" continuity none; form {form};",
        )
        + "} volumetricBSplines { type cartesian; controlPointsDefinition"
        " axisAligned; lowerCpBounds (-0.1 -0.2 -0.1); upperCpBounds"
        " (1.2 1.2 1.1); readStoredData no; maxIterations 100; tolerance"
        " 1e-14; confineBoundaryControlPoints no;"
        + "".join(
            f" nCPs{d} {n}; degree{d} {p};"
            for d, n, p in zip("UVW", LATTICE, degrees)
        )
        + " }",
    )
    output = case.run("volumetricBSplines")
    moved, apart, control = map(
        float,
        re.search(
            r"moved (\S+) apart (\S+) controlPointsApart (\S+)", output
        ).groups(),
    )
    assert moved > 0.01 and control < 1e-12
    assert least <= apart < most
