# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphMesh -lattice and -derivatives: what controls a motion, before a flow.

Sources of truth: a cube whose height a lattice of eight points scales by 1 + mu:
volume 1 + mu, area 2 + 4 (1 + mu), centroid at half the height.
"""

import numpy as np
import pytest

import rbfCase
from ffdCase import ffd_box, ffd_case, parameter

MU = 0.25

RISE = [((i, j, 1), (0, 0, 1)) for i in (0, 1) for j in (0, 1)]


def cube(path, extra="min -0.5; max 2;"):
    return ffd_case(path, ffd_box("cube", parameter("mu", RISE, MU, extra),
                                  order=(1, 1, 1), origin=(0, 0, 0),
                                  span=(1, 1, 1)), cells=(4, 3, 2))


def table(file):
    return [line.split() for line in file.read_text().splitlines()]


@pytest.mark.parametrize("ranks", [1, 2])
def test_derivatives_of_a_closed_boundary(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((2, 1, 1))
    case.run("morphMesh", "-time", "1", "-dryRun", "-derivatives", '(".*")',
             ranks=ranks)
    folder = tmp_path/"postProcessing/morphMesh/1"
    head, before, after = table(folder/"measures.dat")
    assert head == "# shape area volume volumeCx volumeCy volumeCz".split()
    np.testing.assert_allclose(
        np.array(before[1:], float), [6, 1, 0.5, 0.5, 0.5], rtol=1e-14)
    np.testing.assert_allclose(
        np.array(after[1:], float),
        [2 + 4*(1 + MU), 1 + MU, 0.5, 0.5, (1 + MU)/2], rtol=1e-14)
    head, row = table(folder/"derivatives.dat")
    assert row[0] == "cube.mu" and float(row[1]) == MU
    np.testing.assert_allclose(
        np.array(row[2:], float), [4, 1, 0, 0, 0.5], atol=1e-14)
    assert (folder/"derivatives.vtp").stat().st_size > 100
    assert not (tmp_path/"1/polyMesh").exists()


def test_an_open_patch_has_an_area_and_no_volume(tmp_path):
    case = cube(tmp_path)
    case.run("morphMesh", "-time", "1", "-dryRun", "-derivatives", "(xMin)")
    head, _, after = table(
        tmp_path/"postProcessing/morphMesh/1/measures.dat")
    assert head == "# shape area areaCx areaCy areaCz".split()
    np.testing.assert_allclose(
        np.array(after[1:], float), [1 + MU, 0, 0.5, (1 + MU)/2], atol=1e-14)


@pytest.mark.parametrize("ranks", [1, 2])
def test_lattice_and_bounds_are_shown(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((1, 1, 2))
    case.run("morphMesh", "-time", "1", "-lattice", ranks=ranks)
    folder = tmp_path/"postProcessing/morphMesh/1/controls"
    assert {path.name for path in folder.iterdir()} == {
        "cube.vtk", "cubeAtRest.vtk", "cube.mu.min.vtp", "cube.mu.max.vtp"}
    lines = (folder/"cube.vtk").read_text().splitlines()
    first = next(i for i, line in enumerate(lines)
                 if line.startswith("POINTS 8")) + 1
    points = np.array([line.split() for line in lines[first:first + 8]], float)
    assert sorted(points[:, 2]) == [0]*4 + [1 + MU]*4


def test_control_points_of_radial_basis_functions_are_shown(tmp_path):
    case = rbfCase.rbf_case(tmp_path, coeffs=rbfCase.groups(
        top="type moving; patches (zMax);"
            " displacement { type uniform; value (0 0 0.1); }",
        bottom="type fixed; patches (zMin);"))
    output = case.run("morphMesh", "-time", "1", "-lattice", "-derivatives",
                      "(zMax)")
    assert (tmp_path/"postProcessing/morphMesh/1/controls"
            "/controlPoints.vtk").exists()
    assert "has no parameters: option -derivatives is" in output


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_patch_that_is_not_there_is_an_error(tmp_path, ranks):
    case = cube(tmp_path)
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("morphMesh", "-time", "1", "-derivatives", "(hull)",
                      ranks=ranks, status=1)
    assert "no patch or patch group is called" in output
    assert "zMax" in output
    assert not list(tmp_path.glob("**/1/polyMesh/points"))
