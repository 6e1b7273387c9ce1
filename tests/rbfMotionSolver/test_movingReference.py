# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""reference moving: each time step goes on from the mesh of the one before.

Sources of truth: where the dictionary says that points go; an uninterrupted
run; one rank; the reference mesh, to which only 'reference fixed' returns.
"""

import numpy as np
import pytest

from boxCase import write_control
from rbfCase import groups, points_at, rbf_case, reference, ulps

CELLS = (10, 4, 4)
MOVING = "supportRadius 1.2; reference moving;"


def middle(table, points=None):
    """A sheet across the middle of a box that moves along it, by a table of
    time and distance; ends are fixed, the four sides slide."""
    sheet = points or " ".join(
        f"(0.5 {y} {z})" for y in np.arange(5) / 4 for z in np.arange(5) / 4
    )
    motion = " ".join(f"({t} ({d} 0 0))" for t, d in table)
    return groups(
        sheet=f"type moving; points ({sheet}); displacement {{ type uniform;"
        f" value table ({motion}); }}",
        ends="type fixed; patches (xMin xMax);",
        sides="type sliding; patches (yMin yMax zMin zMax);",
    )


THERE = [(0, 0), (4, 0.24)]
AND_BACK = [(0, 0), (2, 0.16), (4, 0)]


def run(path, coeffs, end=4, ranks=None, **control):
    case = rbf_case(
        path,
        coeffs=coeffs,
        cells=CELLS,
        control={"end": end, "format": "ascii", "digits": 17, **control},
    )
    if ranks:
        case.decompose(ranks)
    case.run("moveDynamicMesh", ranks=int(np.prod(ranks or 1)))
    return case


def test_prescribed_points_end_where_they_should(tmp_path):
    case = run(tmp_path, MOVING + middle(THERE))
    x = reference(case)
    sheet = np.abs(x[:, 0] - 0.5) < 1e-9
    points = points_at(case, 4)
    np.testing.assert_allclose(
        points[sheet], x[sheet] + [0.24, 0, 0], rtol=0, atol=ulps(x)
    )
    for axis in range(3):
        for plane in (0, 1):
            on = np.abs(x[:, axis] - plane) < 1e-9
            np.testing.assert_allclose(points[on, axis], plane, atol=1e-15)


def test_it_goes_another_way_than_from_the_reference(tmp_path):
    moving = run(tmp_path / "moving", MOVING + middle(THERE))
    fixed = run(tmp_path / "fixed", "supportRadius 1.2;" + middle(THERE))
    # The first step is the same; the selection meets the tolerance twice
    first = np.abs(points_at(moving, 1) - points_at(fixed, 1)).max()
    assert first < 1e-5
    difference = np.abs(points_at(moving, 4) - points_at(fixed, 4)).max()
    assert 1e-4 < difference < 0.05


def test_only_a_fixed_reference_returns(tmp_path):
    """What is lost: points inside come back to within some hundredths of the
    way, not to the last bit."""
    fixed = run(tmp_path / "fixed", "supportRadius 1.2;" + middle(AND_BACK))
    assert np.array_equal(points_at(fixed, 4), reference(fixed))
    moving = run(tmp_path / "moving", MOVING + middle(AND_BACK))
    x = reference(moving)
    off = np.abs(points_at(moving, 4) - x).max(1)
    assert off[np.abs(x[:, 0] - 0.5) < 1e-9].max() == 0
    assert 1e-4 < off.max() < 0.03


def test_restart_goes_on_to_the_last_digit(tmp_path):
    whole = run(tmp_path / "whole", MOVING + middle(THERE))
    case = run(tmp_path / "restarted", MOVING + middle(THERE), end=2)
    write_control(case, end=4, startFrom="latestTime")
    case.run("moveDynamicMesh")
    assert np.array_equal(points_at(case, 4), points_at(whole, 4))


def test_restart_of_a_fixed_number_of_sub_steps(tmp_path):
    """These select nothing in the reference mesh, which is all that the state
    for a restart could keep."""
    coeffs = "supportRadius 1.2; subSteps 2;" + middle(THERE)
    whole = run(tmp_path / "whole", coeffs)
    case = run(tmp_path / "restarted", coeffs, end=2)
    write_control(case, end=4, startFrom="latestTime")
    case.run("moveDynamicMesh")
    assert np.array_equal(points_at(case, 4), points_at(whole, 4))


@pytest.mark.parametrize("ranks", [(2, 1, 1), (1, 3, 1), (2, 2, 1)])
def test_ranks_agree_to_the_last_bit(tmp_path, ranks):
    serial = run(tmp_path / "serial", MOVING + middle(THERE))
    parallel = run(tmp_path / "parallel", MOVING + middle(THERE), ranks=ranks)
    assert np.array_equal(points_at(parallel, 4), points_at(serial, 4))


@pytest.mark.parametrize(
    "coeffs, says",
    [
        (MOVING + "subSteps auto;" + middle(THERE), "Remove subSteps"),
        ("reference mobile;" + middle(THERE), "moving"),
        (MOVING + middle(THERE, "(0.51 0.5 0.5)"), "points of the mesh"),
    ],
)
def test_what_it_excludes(tmp_path, coeffs, says):
    case = rbf_case(tmp_path, coeffs=coeffs, cells=CELLS)
    tree = case.tree()
    log = case.run("morphMesh", "-time", "1", status=1)
    assert "FATAL IO ERROR" in log and says in log
    assert case.tree() == tree
