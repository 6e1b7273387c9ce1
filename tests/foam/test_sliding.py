"""Points that slide on curved surfaces and onto others.

Sources of truth: the closed forms of cylinder and sphere; for a patch without a
named surface its own faces, which are flat and of equal angles around the axis.
"""

import numpy as np
import pytest

from rbfCase import groups, move, points_at, reference, selections
from slidingCases import annulus

# The hub turns about an axis that is not quite that of the casing
TURN = ("displacement { type solidBody; solidBodyMotionFunction rotatingMotion;"
        " rotatingMotionCoeffs { origin (0 0 0.5); axis (0.1 0 1); omega 0.6; } }")

CYLINDER = ("{ type searchableCylinder; point1 (0 0 0); point2 (0 0 1);"
            " radius 1; }")

TOLERANCE = 1e-3

CELLS = (6, 5, 8)


def casing_case(path, surface="", extra="", hub=TURN, **rest):
    return annulus(path, f"greedy {{ tolerance {TOLERANCE}; }}"
                   f" supportRadius 2; {extra}" + groups(
                       hub=f"type moving; patches (hub); {hub}",
                       casing=f"type sliding; patches (casing); {surface}",
                       ends="type sliding; patches (zMin zMax);"),
                   cells=CELLS, **rest)


def on_casing(points):
    return np.abs(np.hypot(points[:, 0], points[:, 1]) - 1) < 1e-9


def off_cylinder(points):
    return np.abs(np.hypot(points[:, 0], points[:, 1]) - 1).max()


def off_faces(points):
    """How far points are from the flat faces of the casing."""
    sector = np.pi/2/CELLS[0]
    angle = np.arctan2(points[:, 1], points[:, 0])
    middle = (np.floor(angle/sector) + 0.5)*sector
    return np.abs(np.hypot(points[:, 0], points[:, 1])*np.cos(angle - middle)
                  - np.cos(sector/2)).max()


def off_ends(before, after):
    ends = on_casing(before) & ((before[:, 2] < 1e-9) | (before[:, 2] > 1 - 1e-9))
    return np.abs((after - before)[ends, 2]).max()


@pytest.mark.parametrize("surface, off", [
    (f"surface {CYLINDER}", off_cylinder), ("", off_faces),
    ("surface curved;", off_faces)])
def test_points_end_on_the_curved_surface_and_on_the_rim(tmp_path, surface,
                                                         off):
    case = casing_case(tmp_path, surface)
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    moved = np.linalg.norm((after - before)[casing], axis=1).max()
    assert moved > 0.2
    assert off(after[casing]) < 1e-13
    assert off_ends(before, after) < 1e-13


@pytest.mark.parametrize("surface, off", [
    (f"surface {CYLINDER}", off_cylinder), ("", off_faces)])
def test_the_field_itself_is_on_the_surface_to_the_tolerance(tmp_path, surface,
                                                             off):
    case = casing_case(tmp_path, surface, extra="exactSliding no;")
    before = reference(case)
    output = case.run("moveDynamicMesh")
    (_, _, error, tolerance), = selections(output)
    assert error <= tolerance
    after = points_at(case, "1")
    distance = off(after[on_casing(before)])
    # Not by the last projection, which is off
    assert 1e-3*tolerance < distance < 1.1*tolerance
