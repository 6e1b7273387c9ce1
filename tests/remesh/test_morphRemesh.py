# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphRemesh: what stays where cells are replaced by tetrahedra.

Source of truth: OpenFOAM's checkMesh, the volume of a box, the files before and
after, and linear fields, which linear mapping leaves exact.
"""

import re

import numpy as np
import pytest

from boxCase import box
from foamCase import ROOT, read_labels, read_vectors

PATCHES = {
    "xMin": "patch",
    "xMax": "patch",
    "yMin": "wall",
    "yMax": "wall",
    "zMin": "wall",
    "zMax": "patch",
}

LIMITS = "limits { nonOrthogonality 65; skewness 4; }"


def has_madlib():
    made = list((ROOT / "build").glob("*/engines"))
    return any("lMAdLib" in path.read_text() for path in made)


needs_madlib = pytest.mark.skipif(
    not has_madlib(), reason="libmorphRemesh is built without MAdLib"
)


def remesh_dict(case, entries):
    case.write("system/remeshDict", "dictionary", f"remesh {{ {entries} }}")


def write_points(case, points):
    rows = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in points.tolist())
    case.write(
        "constant/polyMesh/points",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


def sheared(path):
    """A box, 2 x 1 x 1, that is sheared by 70 degrees in the middle."""
    case = box(path, PATCHES, cells=(12, 8, 8), high=(2, 1, 1))
    x = case.points("constant/polyMesh/points")
    y, z = (x[:, 1] - 0.5) / 0.25, (x[:, 2] - 0.5) / 0.5
    wave = np.where(abs(y) < 1, np.sin(np.pi * y), 0)
    length = np.sin(np.pi * x[:, 0] / 2)
    x[:, 0] += 0.35 * length * wave * np.cos(np.pi * z / 2)
    write_points(case, x)
    return case


def figures(output):
    """Cells, non-orthogonality, skewness of the rows before and after."""
    rows = re.findall(r"^(before|after) +(.*)$", output, re.MULTILINE)
    return {
        name: dict(
            zip(
                ("cells", "volume", "nonOrthogonality", "skewness"),
                map(float, row.split()),
            )
        )
        for name, row in rows
    }


def mesh_cells(case, mesh):
    """The points of each cell, as a set of positions."""
    points = read_vectors(case.path / mesh / "points")
    text = (case.path / mesh / "faces").read_text()
    faces = [
        [int(i) for i in face.split()]
        for face in re.findall(r"^\d+\(([\d ]+)\)$", text, re.MULTILINE)
    ]
    cells = {}
    for name in ("owner", "neighbour"):
        for face, cell in enumerate(read_labels(case.path / mesh / name)):
            cells.setdefault(cell, set()).update(
                tuple(points[i]) for i in faces[face]
            )
    return {frozenset(x) for x in cells.values()}


@pytest.fixture(scope="module")
def cavity(tmp_path_factory):
    """The sheared box, with zones and a set, before and after."""
    case = sheared(tmp_path_factory.mktemp("cavity"))
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions
        (
            { name box; type cellZoneSet; action remove; }
            { name low; type cellSet; action new; source boxToCell;
              box (-1 -1 -1) (3 2 0.25); }
            { name low; type cellZoneSet; action new; source setToCellZone;
              set low; }
            { name middle; type faceSet; action new; source boxToFace;
              box (0.1 0.1 0.24) (1.9 0.9 0.26); }
            { name middle; type faceZoneSet; action new;
              source setsToFaceZone; faceSet middle; cellSet low; }
            { name probe; type pointSet; action new; source nearestToPoint;
              points ((1.01 0.51 0.51)); }
            { name probe; type pointZoneSet; action new;
              source setToPointZone; set probe; }
        );""",
    )
    case.run("topoSet")
    remesh_dict(case, f"{LIMITS} layers 1;")
    before = mesh_cells(case, "constant/polyMesh")
    output = case.run("morphRemesh")
    return case, before, output


@needs_madlib
def test_bad_cells_become_good_ones(cavity):
    case, _, output = cavity
    table = figures(output)
    assert table["before"]["nonOrthogonality"] > 65
    assert table["after"]["nonOrthogonality"] <= 65
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")
