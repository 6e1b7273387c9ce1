# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Meshes of several regions that are not connected, as overset meshes are: each
has control points of its own.

Sources of truth: points that rest in one region whatever moves in another,
rotation by Rodrigues' formula, one rank, an uninterrupted run, and a mesh of the
one region alone.
"""

import re

import numpy as np
import pytest

from boxCase import from_block_mesh, vectors, write_control
from rbfCase import DROP_IN, groups, points_at, reference, selections, ulps

# A background, and around a body in its middle a part that overlaps it
BACK = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (4, 0), (4, 4), (0, 4))]


def ring():
    """Vertices of four blocks around a square body."""
    corners = []
    for z in (0, 1):
        for half in (0.5, 1.2):
            corners += [
                (2 + half * a, 2 + half * b, z)
                for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))
            ]
    return corners


def mesh():
    """The blockMeshDict."""
    start = len(BACK)
    blocks = "hex (0 1 2 3 4 5 6 7) (8 8 3) simpleGrading (1 1 1)\n"
    body, outer = [], []
    for i in range(4):
        j = (i + 1) % 4
        a, b, c, d = (start + i, start + j, start + 4 + j, start + 4 + i)
        blocks += (
            f"hex ({d} {c} {b} {a} {d + 8} {c + 8} {b + 8} {a + 8}) ring"
            " (4 4 3) simpleGrading (1 1 1)\n"
        )
        body.append(f"({a} {b} {b + 8} {a + 8})")
        outer.append(f"({d} {d + 8} {c + 8} {c})")
    return f"""
scale 1;
vertices {vectors(BACK + ring())};
blocks ( {blocks} );
edges ();
defaultPatch {{ name ends; type patch; }}
boundary
(
    far {{ type patch; faces ((0 4 7 3) (1 2 6 5) (0 1 5 4) (3 7 6 2)); }}
    body {{ type wall; faces ( {' '.join(body)} ); }}
    outer {{ type patch; faces ( {' '.join(outer)} ); }}
);
"""


TURN = groups(
    body="type moving; patches (body); displacement { type solidBody;"
    " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
    " { origin (2 2 0); axis (0 0 1); omega table ((0 0.3) (9 0.3)); } }",
    far="type fixed; patches (far);",
)
TABLE = groups(
    body="type moving; patches (body); displacement { type uniform; value"
    " table ((0 (0 0 0)) (1 (0.3 0.1 0)) (2 (0.2 0.5 0.1))); }",
    far="type fixed; patches (far);",
)


def overset_case(path, coeffs, **control):
    """The mesh, with a dictionary of these coefficients."""
    case = from_block_mesh(path, mesh(), control)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        DROP_IN + f"rbfMotionSolverCoeffs {{ {coeffs} }}",
    )
    return case


def in_ring(case):
    """Which points are those of the part around the body."""
    n = 9 * 9 * 4
    x = reference(case)
    inside = np.arange(len(x)) >= n
    assert np.abs(x[inside] - [2, 2, 0.5]).max() < 1.3
    return inside


def turned(x, angle):
    """A rotation about the axis of the body."""
    c, s = np.cos(angle), np.sin(angle)
    r = x - [2, 2, 0]
    return np.stack(
        [
            2 + c * r[:, 0] - s * r[:, 1],
            2 + s * r[:, 0] + c * r[:, 1],
            r[:, 2],
        ],
        1,
    )


@pytest.mark.parametrize("ranks", [1, 2, 3])
def test_the_background_rests_and_the_part_follows_its_body(tmp_path, ranks):
    case = overset_case(tmp_path, TURN)
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    x, after = reference(case), points_at(case, "1")
    part = in_ring(case)
    assert np.array_equal(after[~part], x[~part])
    np.testing.assert_allclose(
        after[part], turned(x[part], 0.3), rtol=0, atol=1e-13
    )
    # A linear map: the part needs no radial functions
    assert all(n <= 4 for n, *_ in selections(output))


def test_a_part_that_something_holds_is_morphed(tmp_path):
    case = overset_case(
        tmp_path,
        groups(
            body="type moving; patches (body); displacement { type uniform;"
            " value (0.1 0 0); }",
            rest="type fixed; patches (far outer);",
        ),
    )
    output = case.run("moveDynamicMesh")
    x, after = reference(case), points_at(case, "1")
    part = in_ring(case)
    assert np.array_equal(after[~part], x[~part])
    rim = part & (np.abs(x[:, :2] - 2).max(axis=1) > 1.2 - 1e-9)
    assert np.array_equal(after[rim], x[rim])
    body = part & (np.abs(x[:, :2] - 2).max(axis=1) < 0.5 + 1e-9)
    np.testing.assert_allclose(
        after[body], x[body] + [0.1, 0, 0], rtol=0, atol=ulps(x)
    )
    assert max(n for n, *_ in selections(output)) > 4


@pytest.mark.parametrize("kind", ["TURN", "TABLE"])
def test_ranks_and_restarts_do_not_matter(tmp_path, kind):
    coeffs = {"TURN": TURN, "TABLE": "polynomial none;" + TABLE}[kind]
    whole = overset_case(tmp_path / "whole", coeffs, end=2)
    whole.run("moveDynamicMesh")
    parts = overset_case(tmp_path / "parts", coeffs, end=1)
    parts.decompose((2, 2, 1))
    parts.run("moveDynamicMesh", ranks=4)
    write_control(parts, end=2, startFrom="latestTime")
    parts.run("moveDynamicMesh", ranks=4)
    assert np.array_equal(points_at(parts, "2"), points_at(whole, "2"))


def test_regions_are_as_they_would_be_alone(tmp_path):
    # The same ring, with no background
    case = overset_case(
        tmp_path / "both", "polynomial none; supportRadius 2;" + TABLE
    )
    case.run("moveDynamicMesh")
    lone = re.sub(r"hex \(0 1 2 3.*\n", "", mesh())
    lone = lone.replace(
        "far { type patch; faces ((0 4 7 3) (1 2 6 5)"
        " (0 1 5 4) (3 7 6 2)); }",
        "",
    )
    alone = from_block_mesh(tmp_path / "alone", lone)
    alone.write(
        "constant/dynamicMeshDict",
        "dictionary",
        DROP_IN + "rbfMotionSolverCoeffs { polynomial none;"
        " supportRadius 2;"
        + TABLE.replace("far { type fixed; patches (far); }", "")
        + "}",
    )
    alone.run("moveDynamicMesh")
    part = in_ring(case)
    assert np.array_equal(points_at(case, "1")[part], points_at(alone, "1"))


# --- zones: a part of the mesh by 'cellZone' or 'cellSet'

SHIFT = "velocity (0.1 0 0.2)"
SOLID = (
    "motionSolverLibs (fvMotionSolvers); motionSolver solidBody;"
    " solver solidBody; solidBodyMotionFunction linearMotion;"
    " solidBodyCoeffs { cellZone back;"
    " solidBodyMotionFunction linearMotion;"
    f" linearMotionCoeffs {{ {SHIFT}; }} }}"
    f" linearMotionCoeffs {{ {SHIFT}; }}"
)


def zoned_case(path, dictionary, **control):
    """The mesh with zones ring and back."""
    case = from_block_mesh(path, mesh(), control)
    case.write(
        "system/topoSetDict",
        "dictionary",
        "actions ( { name ring; type cellSet; action new;"
        " source zoneToCell; zone ring; }"
        " { name back; type cellSet; action new; source zoneToCell;"
        " zone ring; } { name back; type cellSet; action invert; }"
        " { name back; type cellZoneSet; action new;"
        " source setToCellZone; set back; } );",
    )
    case.run("topoSet")
    case.write("constant/dynamicMeshDict", "dictionary", dictionary)
    return case


def ours(extra=""):
    return (
        f"motionSolverLibs (morphMotionSolvers); motionSolver"
        f" rbfMotionSolver; solver rbfMotionSolver; {extra}"
        f" rbfMotionSolverCoeffs {{ {TURN} }}"
    )


# OpenFOAM's base class reads the entry beside the coefficients up to v2206 and
# among them from v2212 on: an entry in either place is heard everywhere
@pytest.mark.parametrize("among", [True, False])
@pytest.mark.parametrize("entry", ["cellZone", "cellSet"])
@pytest.mark.parametrize(
    "name, ranks", [("ring", 1), ("ring", 2), ("back", 1)]
)
def test_a_zone_is_what_moves(tmp_path, entry, name, ranks, among):
    chosen = f"{entry} {name};"
    dictionary = ours("" if among else chosen)
    if among:
        dictionary = dictionary.replace("Coeffs {", "Coeffs { " + chosen)
    case = zoned_case(
        tmp_path, "dynamicFvMesh dynamicMotionSolverFvMesh;" + dictionary
    )
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    x, after = reference(case), points_at(case, "1")
    part = in_ring(case)
    assert np.array_equal(after[~part], x[~part])
    expected = turned(x[part], 0.3) if name == "ring" else x[part]
    np.testing.assert_allclose(after[part], expected, rtol=0, atol=1e-13)


LISTS = {
    "list": "dynamicFvMesh dynamicMotionSolverListFvMesh; solvers {{ one {{"
    " {ours} }} two {{ {solid} }} }}",
    "multi": "dynamicFvMesh dynamicMultiMotionSolverFvMesh;"
    " dynamicMultiMotionSolverFvMeshCoeffs {{ one {{ {ours} }}"
    " two {{ {solid} }} }}",
}


@pytest.mark.parametrize("kind", LISTS)
def test_beside_another_solver_each_moves_its_zone(tmp_path, kind):
    case = zoned_case(
        tmp_path,
        LISTS[kind].format(
            ours=ours("cellZone ring;"), solid=SOLID + " cellZone back;"
        ),
        end=2,
    )
    case.run("moveDynamicMesh")
    x, after = reference(case), points_at(case, "2")
    part = in_ring(case)
    np.testing.assert_allclose(
        after[part], turned(x[part], 0.6), rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(
        after[~part], x[~part] + [0.2, 0, 0.4], rtol=0, atol=1e-13
    )
