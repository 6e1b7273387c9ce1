# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""rbfMotionSolver on several ranks moves the mesh as it does on one.

Source of truth: the serial run. Selections and meshes are the same, whatever
ranks have: random decompositions leave ranks with points of a patch but no
face of it, and cells that meet by an edge or a point alone.
"""

import numpy as np
import pytest

from boxCase import fixed
from rbfCase import (
    CUBE,
    groups,
    move,
    points_at,
    rbf_case,
    reference,
    selections,
    side,
)

SPAN = np.sqrt(3)

ROTATING = (
    "displacement { type solidBody; solidBodyMotionFunction"
    " rotatingMotion; rotatingMotionCoeffs { origin (0.3 0.4 1);"
    " axis (0 0 1); omega 0.2; } }"
)

SLIDING = groups(
    top="type moving; patches (zMax);" + ROTATING,
    inside="type moving; points ((0.5 0.4 0.5) (0.52 0.41 0.3)); displacement"
    " { type values; values ((0.02 0 0.01) (0 0.03 0)); }",
    bottom="type fixed; patches (zMin);",
    walls='type sliding; patches ("[xy].*");',
)

EMPTY = {**CUBE, "zMin": "empty", "zMax": "empty"}

CYCLIC = {
    **CUBE,
    "xMin": "cyclic; neighbourPatch xMax;",
    "xMax": "cyclic; neighbourPatch xMin;",
}

THIN = groups(
    top="type moving; patches (yMax);" + ROTATING,
    bottom="type fixed; patches (yMin);",
    walls='type sliding; patches ("x.*");',
)

# (decomposePar of v1912 cannot decompose solidBodyMotionDisplacement)
TURNING = (
    "angularOscillatingDisplacement; axis (0 1 2); origin (0.3 0.4 1);"
    " angle0 0; amplitude 0.2; omega 1; value uniform (0 0 0);"
)

SOME = "greedy { tolerance 0.01; }"

CELLS = (6, 5, 4)

KINDS = {
    "3D with sliding": dict(
        coeffs=SOME + "supportRadius 1;" + SLIDING, cells=CELLS
    ),
    "one point at a time": dict(
        coeffs="greedy { tolerance 0.01; pointsPerSweep 1; }"
        " supportRadius 1;" + SLIDING,
        cells=CELLS,
    ),
    "3D with a polynomial": dict(
        coeffs=SOME + "polynomial linear; supportRadius 1;" + SLIDING,
        cells=CELLS,
    ),
    "all points": dict(
        coeffs="selection all; supportRadius 1;" + SLIDING, cells=CELLS
    ),
    "drop-in": dict(
        conditions={
            **{name: "slip" for name in CUBE},
            "zMin": fixed(0, 0, 0),
            "zMax": TURNING,
        },
        coeffs="",
        cells=CELLS,
    ),
    "2D with sliding": dict(
        coeffs=SOME + "supportRadius 1;" + THIN, patches=EMPTY, cells=(9, 8, 1)
    ),
    "cyclic": dict(
        coeffs="greedy { tolerance 1e-3; } supportRadius 1;"
        + groups(
            one="type moving; points ((0.25 0.4 0.5)); displacement"
            " { type uniform; value (0.03 0.02 0.05); }",
            ends="type fixed; patches (zMin zMax);",
        ),
        patches=CYCLIC,
        cells=CELLS,
    ),
}


def run(path, kind, ranks=None):
    """The log and the points of a run where these ranks have the cells."""
    case = rbf_case(path, **KINDS[kind])
    if ranks is None:
        output = case.run("moveDynamicMesh")
    else:
        case.decompose_cells(ranks)
        output = case.run("moveDynamicMesh", ranks=max(ranks) + 1)
    return selections(output), points_at(case, "1")


@pytest.fixture(scope="module", params=KINDS)
def serial(request, tmp_path_factory):
    kind = request.param
    return kind, *run(tmp_path_factory.mktemp("serial"), kind)


def slabs(n, kind):
    nx, ny, nz = KINDS[kind]["cells"]
    return np.arange(nx * ny * nz) * n // (nx * ny * nz)


def at_random(n, kind):
    return np.random.default_rng(n).integers(0, n, slabs(n, kind).size)


@pytest.mark.parametrize(
    "split, n",
    [(slabs, 2), (slabs, 3), (at_random, 2), (at_random, 3), (at_random, 4)],
)
def test_every_decomposition_selects_and_moves_alike(
    tmp_path, serial, split, n
):
    kind, selected, points = serial
    ((n_selected, n_candidates, _, _),) = selected
    assert n_selected > 10
    assert n_selected < n_candidates or "greedy" not in KINDS[kind]["coeffs"]
    parallel_selected, parallel_points = run(tmp_path, kind, split(n, kind))
    assert parallel_selected == pytest.approx(selected, rel=1e-6, abs=1e-15)
    assert parallel_selected[0][:2] == selected[0][:2]
    # Bit for bit when this was written; a unit in the last place is allowed
    np.testing.assert_allclose(parallel_points, points, rtol=0, atol=1e-15)


def test_ranks_without_control_points_take_part(tmp_path):
    # Rank 1 has cells inside, whose points are on no patch; rank 2 one cell
    kind = "3D with sliding"
    selected, points = run(tmp_path / "serial", kind)
    i, j, k = np.unravel_index(np.arange(120), CELLS, order="F")
    inside = (i == 2) & (j == 2) & (k > 0) & (k < 3)
    ranks = np.where(inside, 1, 0)
    ranks[0] = 2
    parallel_selected, parallel_points = run(
        tmp_path / "parallel", kind, ranks
    )
    assert parallel_selected[0][:2] == selected[0][:2]
    np.testing.assert_allclose(
        parallel_points, points, rtol=0, atol=1e-12 * SPAN
    )


LID = """
actions ( { name lid; type faceSet; action new; source boxToFace;
             box (-1 -1 0.99) (0.5 0.5 2); } );
"""

LID_PATCH = """
pointSync false;
patches ( { name lid; patchInfo { type wall; }
            constructFrom set; set lid; } );
"""


def test_ranks_that_meet_a_patch_by_an_edge_or_a_point_alone_move_with_it(
    tmp_path,
):
    # The lid is a quarter of zMax; beside it lie, on ranks of their own, a
    # cell that shares an edge with it and one that shares a point
    value = np.array([0.02, 0.01, -0.05])

    def lid_case(path):
        case = rbf_case(
            path,
            coeffs="supportRadius 1;"
            + groups(
                lid="type moving; patches (lid); displacement { type uniform;"
                f" value ({' '.join(map(str, value))}); }}",
                bottom="type fixed; patches (zMin);",
            ),
        )
        case.write("system/topoSetDict", "dictionary", LID)
        case.run("topoSet")
        case.write("system/createPatchDict", "dictionary", LID_PATCH)
        case.run("createPatch", "-overwrite")
        return case

    serial = lid_case(tmp_path / "serial")
    before = reference(serial)
    lid = side(before, "zMax") & (before[:, :2] <= 0.5).all(axis=1)
    assert lid.sum() == 9
    expected = move(serial)
    np.testing.assert_array_equal(expected[lid], before[lid] + value)

    case = lid_case(tmp_path / "parallel")
    ranks = np.zeros((4, 4, 4), int)
    ranks[2, 2, 3] = 1
    ranks[2, 0, 3] = 2
    case.decompose_cells(ranks.flatten(order="F"))
    for rank, n in (("1", 1), ("2", 2)):
        own = case.points(f"processor{rank}/constant/polyMesh/points")
        assert (side(own, "zMax") & (own[:, :2] <= 0.5).all(axis=1)).sum() == n
    np.testing.assert_allclose(
        move(case, ranks=3), expected, rtol=0, atol=1e-15
    )
