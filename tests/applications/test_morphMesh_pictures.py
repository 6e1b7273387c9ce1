# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphMesh -pictures: the sheet of a motion, and the data that it is drawn of.

Sources of truth: edges and diagonals of the mesh that is written, by numpy; the
counts of points of a box of cells; quality.dat.
"""

import itertools
import re

import numpy as np
import pytest

import rbfCase
from boxCase import from_block_mesh

pytest.importorskip("matplotlib")

from morphfoam.pictures import motion, vtk_files  # noqa: E402

SHEET = "postProcessing/morphMesh/1/controls"


def sheet_data(folder):
    """Windows and worst cells by name, and the faces of the windows as sets of
    corners, rounded: ranks write them in another order."""
    windows = {
        row["window"]: row for row in motion.table(folder / "windows.dat")
    }
    faces = {}
    for name in windows:
        points, polygons, data = vtk_files.read_surface_data(
            folder / f"{name}.vtp"
        )
        after = points + data["displacement"].reshape(-1, 3)
        faces[name] = sorted(
            sorted(
                map(tuple, np.round(np.hstack([points, after])[f], 5) + 0.0)
            )
            for f in polygons
        )
    return windows, motion.table(folder / "worstCells.dat"), faces


def bump(path, patches=None, cells=(6, 4, 5), extra=""):
    """The middle of the floor rises; a point inside is told to move as well."""
    case = rbfCase.rbf_case(
        path,
        coeffs="supportRadius 1.5; subSteps 1;"
        + rbfCase.groups(
            middle="type moving; points ((0.5 0.5 0)); displacement {"
            " type values; values ((0 0 0.15)); }",
            probe="type moving; points ((0.52 0.47 0.61)); displacement {"
            " type values; values ((0.02 0 0.05)); }",
            sides='type sliding; patches ("(x|y).*");',
            top="type fixed; patches (zMax);",
        )
        + extra,
        patches=patches,
        cells=cells,
    )
    return case


def test_the_sheet_of_a_motion_is_the_same_on_all_ranks(tmp_path):
    data = {}
    for ranks in (1, 3):
        case = bump(tmp_path / str(ranks))
        if ranks > 1:
            case.decompose((3, 1, 1))
        output = case.run("morphMesh", "-time", "1", "-pictures", ranks=ranks)
        assert output.count("motion.png") == 1
        folder = case.path / SHEET
        assert (folder / "motion.png").stat().st_size > 20000
        data[ranks] = sheet_data(folder)
    windows, worst, faces = data[1]
    for name in faces:
        np.testing.assert_allclose(data[3][2][name], faces[name], atol=2e-5)
    rows = [*windows.values(), *worst]
    others = [*data[3][0].values(), *data[3][1]]
    assert len(rows) == len(others) == 12
    for one, other in zip(rows, others):
        for name in set(one) - {"window"}:
            assert float(other[name]) == pytest.approx(
                float(one[name]), abs=1e-9
            )


def test_the_sheet_shows_where_the_mesh_changed_most(tmp_path):
    """Edges and diagonals of all faces, by numpy; the section is made of faces
    between cells on both sides of its plane; control points by kind."""
    case = bump(tmp_path)
    case.run("morphMesh", "-time", "1", "-pictures")
    folder = tmp_path / SHEET
    before, after = (
        case.points(f"{when}/polyMesh/points") for when in ("constant", "1")
    )
    mesh = case.path / "constant/polyMesh"
    polygons = [
        [int(i) for i in words.split()]
        for words in re.findall(
            r"\d+\(([\d ]+)\)", (mesh / "faces").read_text()
        )
    ]
    change, place = 0, None
    for polygon in polygons:
        for i, j in itertools.combinations(polygon, 2):
            value = abs(
                np.log(
                    np.linalg.norm(after[i] - after[j])
                    / np.linalg.norm(before[i] - before[j])
                )
            )
            if value > change * (1 + 1e-12):
                change, place = value, (before[i] + before[j]) / 2
    windows, worst, faces = sheet_data(folder)
    assert change > 0.2
    assert float(windows["change"]["value"]) == pytest.approx(change, rel=1e-9)
    at = motion.vector_of(windows["change"], "Before")
    np.testing.assert_allclose(at, place, atol=1e-12)

    # Sections of a box of cells, which are planes of it before the motion
    normal = motion.vector_of(windows["change"], "Normal")
    assert sorted(normal) == [0, 0, 1]
    heights = {
        round(corner[list(normal).index(1)], 5)
        for face in faces["change"]
        for corner in face
    }
    assert len(faces["change"]) >= 12 and len(heights) == 1

    # The worst cell is that of quality.dat
    quality = tmp_path / "postProcessing/morphMesh/1/quality.dat"
    rows = [line.split() for line in quality.read_text().splitlines()]
    largest = float(rows[2][rows[0].index("maxNonOrthogonality") - 1])
    assert max(float(row["nonOrthogonality"]) for row in worst) == (
        pytest.approx(largest, rel=1e-5)
    )
    assert (folder / "histogram.dat").read_text() == (
        folder.parent / "histogram.dat"
    ).read_text()

    points, data = motion.control_points(folder)
    kinds = motion.kinds_of(data, 3)
    names, counts = np.unique(kinds.astype(str), return_counts=True)
    found = dict(zip(names, counts))
    assert found["off the mesh"] == 1 and found["prescribed"] == 1
    assert found["at rest"] == 5 * 3
    assert found["on an edge"] == 4 * 6
    assert found["on a surface"] == 2 * (5 + 3) * 6
    off = points[kinds == "off the mesh"][0]
    np.testing.assert_allclose(off, [0.54, 0.47, 0.66], atol=1e-14)


@pytest.mark.parametrize(
    "patches, cells, across",
    [
        ({"sides": ("empty", "yMin yMax")}, (6, 1, 5), 1),
        ({"sides": ("empty", "xMin xMax")}, (1, 6, 5), 0),
    ],
)
def test_in_two_dimensions_the_sheet_shows_an_empty_side(
    tmp_path, patches, cells, across
):
    sides = {
        name: "patch"
        for name in ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")
        if name not in patches["sides"][1]
    }
    case = rbfCase.rbf_case(
        tmp_path,
        coeffs="supportRadius 1.5;"
        + rbfCase.groups(
            top="type moving; patches (zMax); displacement {"
            " type uniform; value (0 0 0.2); }",
            bottom="type fixed; patches (zMin);",
        ),
        patches={**sides, **patches},
        cells=cells,
    )
    case.run("morphMesh", "-time", "1", "-pictures", "-dryRun")
    folder = tmp_path / SHEET
    assert (folder / "motion.png").stat().st_size > 20000
    windows, _, faces = sheet_data(folder)
    assert windows["change"]["dimensions"] == "2"
    assert motion.vector_of(windows["change"], "Normal")[across] == 1
    # One face of each cell
    assert len(faces["change"]) == 30
    kinds = motion.kinds_of(motion.control_points(folder)[1], 2)
    assert set(kinds) == {"prescribed", "at rest"}


def test_an_invalid_motion_has_a_sheet(tmp_path):
    """Where cells turn over the worst of them are those."""
    case = rbfCase.rbf_case(
        tmp_path,
        coeffs="supportRadius 1.5; onInvalidMesh ignore; subSteps 1;"
        + rbfCase.groups(
            top="type moving; patches (zMax); displacement {"
            " type uniform; value (0 0 -1.5); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    case.run("morphMesh", "-time", "1", "-pictures", status=1)
    _, worst, _ = sheet_data(tmp_path / SHEET)
    assert float(worst[0]["volume"]) < 0
    assert (tmp_path / SHEET / "motion.png").stat().st_size > 20000


TWO = """
scale 1;
vertices
(
    (0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1)
    (3 0 0) (4 0 0) (4 1 0) (3 1 0) (3 0 1) (4 0 1) (4 1 1) (3 1 1)
);
blocks
(
    hex (0 1 2 3 4 5 6 7) (4 4 4) simpleGrading (1 1 1)
    hex (8 9 10 11 12 13 14 15) (4 4 4) simpleGrading (1 1 1)
);
edges ();
defaultPatch { name rest; type patch; }
boundary
(
    one { type patch; faces ((4 5 6 7)); }
    other { type patch; faces ((12 13 14 15)); }
);
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_several_regions_and_bodies_are_in_one_sheet(tmp_path, ranks):
    """Two boxes that no faces connect, each with control points of its own; the
    window is where the body is that moves by more."""
    case = from_block_mesh(tmp_path, TWO)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        rbfCase.DROP_IN
        + "rbfMotionSolverCoeffs {"
        + rbfCase.groups(
            one="type moving; patches (one); displacement { type uniform;"
            " value (0 0 0.05); }",
            other="type moving; patches (other); displacement { type uniform;"
            " value (0 0 0.3); }",
            rest="type fixed; patches (rest);",
        )
        + "}",
    )
    if ranks > 1:
        case.decompose((2, 1, 1))
    case.run("morphMesh", "-time", "1", "-pictures", ranks=ranks)
    folder = tmp_path / SHEET
    points, data = motion.control_points(folder)
    assert len(np.unique(data["region"])) == 2
    for region in np.unique(data["region"]):
        assert np.ptp(points[data["region"] == region][:, 0]) < 1.1
    windows, _, _ = sheet_data(folder)
    assert motion.vector_of(windows["change"], "Before")[0] > 2.9
    assert (folder / "motion.png").stat().st_size > 20000
