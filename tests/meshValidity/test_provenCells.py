# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Cells that are proven valid without their geometry.

Sources of truth: the volumes, areas and centres that OpenFOAM's own polyMesh
has with its points moved (tests/programs/invalidCells); that the bounds hold
for each shape is tested with millions of cells in
tests/numerics/geometry/test_cellShapes.cpp.
"""

import re

import pytest

from boxCase import SCHEMES, SOLUTION, box, write_control
from foamCase import FoamCase, build_program
from mixedMesh import write_mixed_mesh


@pytest.fixture(scope="module", autouse=True)
def program():
    build_program("invalidCells")


def attempts(case, n, largest, ranks=1):
    output = case.run("invalidCells", n, largest, ranks=ranks)
    rows = re.findall(r"^attempt (\S+) (\d) (\d) (\d)$", output, re.M)
    assert len(rows) == n
    return [(float(a), b == "1", c == "1", d == "1") for a, b, c, d in rows]


def check(rows):
    for amplitude, valid, said, proven in rows:
        assert said == valid, amplitude
        assert valid or not proven, amplitude
    # Both kinds were there, and small motions take the short way
    assert any(valid for _, valid, _, _ in rows)
    assert not all(valid for _, valid, _, _ in rows)
    assert rows[0][3] and rows[5][3]


def mixed(path):
    case = FoamCase(path)
    write_control(case)
    case.write("system/fvSchemes", "dictionary", SCHEMES)
    case.write("system/fvSolution", "dictionary", SOLUTION)
    mesh = write_mixed_mesh(case)
    return case, mesh


def test_mixed_mesh_has_all_shapes(tmp_path):
    case, mesh = mixed(tmp_path)
    found = {
        (len(cell), sum(len(f) == 3 for f in cell)) for cell in mesh.cells
    }
    assert found == {(4, 4), (5, 4), (5, 2), (6, 0), (7, 2)}
    output = case.run("checkMesh")
    assert "Face pyramids OK" in output
    assert "Min volume" in output


def test_what_is_proven_is_valid_in_a_mixed_mesh(tmp_path):
    case, _ = mixed(tmp_path)
    check(attempts(case, 400, 0.4))


@pytest.mark.parametrize("ranks", [1, 3])
def test_what_is_proven_is_valid_in_thin_hexahedra(tmp_path, ranks):
    case = box(
        tmp_path,
        {"walls": ("patch", "xMin xMax yMin yMax zMin zMax")},
        cells=(6, 6, 8),
        high=(1, 1, 0.01),
    )
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    check(attempts(case, 300, 0.002, ranks=ranks))
