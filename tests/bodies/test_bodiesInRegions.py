# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Bodies of one name in two regions, two of them in each.

Source of truth: the leapfrog method, which a mass on a spring follows in closed
form (test_sixDoFRigidBody.py), and the run that is not interrupted.
"""

import numpy as np
import pytest

from boxCase import SCHEMES, SOLUTION, block_mesh, write_control
from foamCase import FoamCase, build_program
from rbfCase import CUBE, DROP_IN, groups
from test_sixDoFRigidBody import MASS, swing

DT = 0.1
STEPS = 6
LOW = np.array([0.01, 0.02, -0.015])
HIGH = np.array([-0.02, 0.01, 0.03])
STIFFNESS = {"air": (50, 20), "water": (35, 60)}
REGIONS = ["air", "water"]


def spring(centre, anchor, stiffness):
    at = "({} {} {})".format(*(np.array(centre) + anchor))
    start = "({} {} {})".format(*(stiffness / MASS * anchor))
    centre = "({} {} {})".format(*centre)
    return (
        f"type sixDoFRigidBody; test true; mass {MASS}; centreOfMass {centre};"
        " momentOfInertia (1 1 1); solver { type symplectic; }"
        f" acceleration {start}; restraints {{ spring {{"
        " sixDoFRigidBodyMotionRestraint linearSpring;"
        f" anchor {at}; refAttachmentPt {centre}; stiffness {stiffness};"
        " damping 0; restLength 0; } }"
    )


@pytest.fixture(scope="module")
def application():
    build_program("moveRegions")


def make_case(path, **control):
    case = FoamCase(path)
    write_control(case, **dict(end=STEPS * DT, deltaT=DT, **control))
    for region in REGIONS:
        case.write(f"system/{region}/fvSchemes", "dictionary", SCHEMES)
        case.write(f"system/{region}/fvSolution", "dictionary", SOLUTION)
        case.write(
            f"system/{region}/blockMeshDict",
            "dictionary",
            block_mesh(CUBE, cells=(3, 3, 4)),
        )
        low, high = STIFFNESS[region]
        case.write(
            f"constant/{region}/dynamicMeshDict",
            "dictionary",
            DROP_IN
            + "rbfMotionSolverCoeffs { supportRadius 2;"
            + groups(
                low="type moving; patches (zMin); displacement {"
                + spring((0.5, 0.5, 0), LOW, low)
                + "}",
                high="type moving; patches (zMax); displacement {"
                + spring((0.5, 0.5, 1), HIGH, high)
                + "}",
            )
            + "}",
        )
        case.run("blockMesh", "-region", region)
    return case


def points(case, region, steps):
    return case.points(f"{steps * DT:g}/{region}/polyMesh/points")


def test_each_body_of_each_region_swings_on_its_own_spring(
    tmp_path, application
):
    case = make_case(tmp_path)
    case.run("moveRegions", "(air water)")
    for region in REGIONS:
        before = case.points(f"constant/{region}/polyMesh/points")
        d = points(case, region, STEPS) - before
        for z, anchor, k in zip((0, 1), (LOW, HIGH), STIFFNESS[region]):
            on = np.abs(before[:, 2] - z) < 1e-9
            expected = anchor * swing(STEPS, np.sqrt(k / MASS))
            assert np.abs(expected).max() > 0.005
            np.testing.assert_allclose(
                d[on], np.tile(expected, (on.sum(), 1)), rtol=0, atol=1e-13
            )


def test_bodies_of_two_regions_restart_to_the_last_bit(tmp_path, application):
    whole = make_case(tmp_path / "whole")
    whole.run("moveRegions", "(air water)")
    parts = make_case(tmp_path / "parts")
    for steps in (STEPS // 2, STEPS):
        write_control(parts, end=steps * DT, deltaT=DT, startFrom="latestTime")
        output = parts.run("moveRegions", "(air water)")
    assert output.count("sixDoFRigidBody.low: continues") == 2
    for region in REGIONS:
        half = parts.path / f"{STEPS // 2 * DT:g}/{region}/uniform"
        assert (half / "sixDoFRigidBody.high").is_file()
        np.testing.assert_array_equal(
            points(parts, region, STEPS), points(whole, region, STEPS)
        )
