# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Two regions, each with a motion solver of its own.

Source of truth: each region alone; and what both are told at the surface that
they share.
"""


import numpy as np
import pytest

from boxCase import SCHEMES, SOLUTION, block_mesh, write_control
from foamCase import FoamCase, build_program
from rbfCase import CUBE, DROP_IN, groups

# The surface between them tilts and rises
SHARED = (
    "type solidBody; solidBodyMotionFunction rotatingMotion;"
    " rotatingMotionCoeffs { origin (0.3 0.4 0.5); axis (1 3 0.5);"
    " omega 0.15; }"
)

REGIONS = {
    "fluid": (0.5, 1, "zMin", "zMax"),
    "solid": (0, 0.5, "zMax", "zMin"),
}


@pytest.fixture(scope="module")
def application():
    build_program("moveRegions")


def make_case(path):
    case = FoamCase(path)
    write_control(case, end=2, deltaT=0.5)
    for region, (low, high, shared, far) in REGIONS.items():
        case.write(f"system/{region}/fvSchemes", "dictionary", SCHEMES)
        case.write(f"system/{region}/fvSolution", "dictionary", SOLUTION)
        case.write(
            f"system/{region}/blockMeshDict",
            "dictionary",
            block_mesh(
                CUBE, cells=(4, 5, 3), low=(0, 0, low), high=(1, 1, high)
            ),
        )
        # Others in other regions, to tell them apart
        radius = 1.5 if region == "fluid" else 2
        case.write(
            f"constant/{region}/dynamicMeshDict",
            "dictionary",
            DROP_IN + "rbfMotionSolverCoeffs\n{\n"
            f"supportRadius {radius};"
            " greedy { tolerance 1e-2; }"
            + groups(
                shared=f"type moving; patches ({shared}); displacement"
                f" {{ {SHARED} }}",
                far=f"type fixed; patches ({far});",
                sides='type sliding; patches ("[xy].*");',
            )
            + "\n}",
        )
        case.run("blockMesh", "-region", region)
    return case


def moved(case, region, time=2):
    return case.points(f"{time}/{region}/polyMesh/points")


def at_shared(case, region):
    z = case.points(f"constant/{region}/polyMesh/points")[:, 2]
    return np.abs(z - 0.5) < 1e-9


def test_regions_meet_after_they_moved(tmp_path, application):
    case = make_case(tmp_path)
    output = case.run("moveRegions", "(fluid solid)")
    sides = []
    for region in REGIONS:
        x = case.points(f"constant/{region}/polyMesh/points")
        at = at_shared(case, region)
        sides.append(moved(case, region)[at][np.lexsort(np.round(x[at], 6).T)])
    # The meshes themselves differ by so much there
    np.testing.assert_allclose(*sides, rtol=0, atol=4.5e-16)
    assert np.ptp(sides[0][:, 2]) > 0.1
    for region in REGIONS:
        assert f"rbfMotionSolver({region}): 4 steps" in output


def test_a_region_moves_as_it_does_alone(tmp_path, application):
    together = make_case(tmp_path / "together")
    together.run("moveRegions", "(fluid solid)")
    alone = make_case(tmp_path / "alone")
    for region in REGIONS:
        alone.run("moveRegions", f"({region})")
        np.testing.assert_array_equal(
            moved(together, region), moved(alone, region)
        )


def test_regions_restart_to_the_last_bit(tmp_path, application):
    whole = make_case(tmp_path / "whole")
    whole.run("moveRegions", "(fluid solid)")
    parts = make_case(tmp_path / "parts")
    for end in (1, 2):
        write_control(parts, end=end, deltaT=0.5, startFrom="latestTime")
        parts.run("moveRegions", "(fluid solid)")
    for region in REGIONS:
        assert (
            parts.path / f"1/{region}/uniform/rbfMotionSolverProperties"
        ).exists()
        np.testing.assert_array_equal(
            moved(parts, region), moved(whole, region)
        )


@pytest.mark.parametrize("region", REGIONS)
def test_a_region_restarts_on_other_ranks(tmp_path, application, region):
    whole = make_case(tmp_path / "whole")
    whole.run("moveRegions", "(fluid solid)")
    parts = make_case(tmp_path / "parts")
    write_control(parts, end=1, deltaT=0.5, startFrom="latestTime")
    parts.run("moveRegions", f"({region})")
    write_control(parts, end=2, deltaT=0.5, startFrom="latestTime")
    parts.write(
        f"system/{region}/decomposeParDict",
        "dictionary",
        "numberOfSubdomains 2; method simple;"
        " simpleCoeffs { n (2 1 1); delta 0.001; }",
    )
    parts.decompose((2, 1, 1), "-region", region, "-latestTime")
    parts.run("moveRegions", f"({region})", ranks=2)
    parts.run("reconstructPar", "-region", region, "-latestTime")
    np.testing.assert_array_equal(moved(parts, region), moved(whole, region))
