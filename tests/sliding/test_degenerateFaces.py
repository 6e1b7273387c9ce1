# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Faces without area and edges without length on surfaces that points slide on.

Source of truth: the plane of the patch. Points of a plane patch stay in it,
whatever its faces; at a point all of whose faces have none, there is no normal.
"""

import numpy as np
import pytest

from boxCase import fixed, vectors
from rbfCase import rbf_case, reference

CONDITIONS = {
    "zMax": fixed(0, 0, 0.05),
    "zMin": fixed(0, 0, 0),
    "xMin": "slip",
    "xMax": "slip",
    "yMin": "slip",
    "yMax": "slip",
}


def write_points(case, points):
    file = case.path / "constant/polyMesh/points"
    head = file.read_text().split("\n\n")[0]
    text = file.read_text()
    start = text.index("}", text.index("FoamFile")) + 1
    file.write_text(text[:start] + f"\n{len(points)}\n{vectors(points)}\n")
    assert head


def at(points, x):
    return int(np.argmin(np.linalg.norm(points - x, axis=1)))


@pytest.mark.parametrize("surface", ["planar", "curved"])
def test_an_edge_without_length_leaves_the_plane_as_it_is(tmp_path, surface):
    case = rbf_case(
        tmp_path,
        cells=(4, 4, 4),
        conditions=CONDITIONS,
        coeffs="""
        supportRadius 2; onInvalidMesh ignore; controlPoints {
        top { type moving; patches (zMax); } bottom { type fixed; patches (zMin); }
        side { type sliding; patches (xMin); surface %s; } }"""
        % surface,
    )
    points = reference(case)
    points[at(points, (0, 0.5, 0.5))] = points[at(points, (0, 0.5, 0.25))]
    write_points(case, points)
    case.run("moveDynamicMesh")
    moved = case.points("1/polyMesh/points")
    side = points[:, 0] < 1e-12
    assert np.abs(moved[side, 0]).max() < 1e-12
    assert np.abs(moved - points)[side].max() > 0.01


def test_a_point_without_any_area_around_it_is_named(tmp_path):
    case = rbf_case(
        tmp_path,
        cells=(4, 4, 4),
        conditions=CONDITIONS,
        coeffs="""
        supportRadius 2; onInvalidMesh ignore; controlPoints {
        top { type moving; patches (zMax); } bottom { type fixed; patches (zMin); }
        side { type sliding; patches (xMin); surface curved; } }""",
    )
    points = reference(case)
    # All points of the side between y = 0.25 and 0.75 are one
    middle = (points[:, 0] == 0) & (
        np.abs(points[:, 1:] - 0.5).max(axis=1) < 0.26
    )
    points[middle] = (0, 0.5, 0.5)
    write_points(case, points)
    output = case.run("moveDynamicMesh", status=1)
    assert "(0 0.5 0.5) has an area" in output
