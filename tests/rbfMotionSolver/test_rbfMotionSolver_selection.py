# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The selection of control points: what it reports, warns of, and leaves out.

Sources of truth: the contract (log line, warnings) and what a greedy selection
is: no control point is off by more than the tolerance, which is a fraction of
the largest prescribed displacement.
"""

import re

import numpy as np
import pytest

from rbfCase import (
    SELECTED,
    bent_top,
    groups,
    move,
    rbf_case,
    reference,
    selections,
    side,
)

CELLS = (8, 8, 6)


def wavy(path, settings, cells=CELLS, **rest):
    """A box whose top bends, with other settings of the selection."""

    def height(x):
        return 0.1 * np.sin(4 * x[:, 0]) * np.cos(3 * x[:, 1])

    case, x = bent_top(path, height, settings, cells=cells, **rest)
    return case, np.abs(height(x)).max()


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3])
def test_no_control_point_is_off_by_more_than_the_tolerance(
    tmp_path, tolerance
):
    case, largest = wavy(tmp_path, f"greedy {{ tolerance {tolerance}; }}")
    ((selected, candidates, error, allowed),) = selections(
        case.run("moveDynamicMesh")
    )
    assert allowed == pytest.approx(tolerance * largest, rel=5e-3)  # 3 digits
    assert error <= allowed
    assert selected < candidates
    # All points of the boundary: every patch has a part
    assert candidates == 9 * 9 * 7 - 7 * 7 * 5


def test_a_smaller_tolerance_selects_more(tmp_path):
    counts = []
    for i, tolerance in enumerate((1e-1, 1e-2, 1e-3)):
        case, _ = wavy(
            tmp_path / str(i), f"greedy {{ tolerance {tolerance}; }}"
        )
        counts.append(selections(case.run("moveDynamicMesh"))[0][0])
    assert counts[0] < counts[1] < counts[2]


def test_interior_points_differ_from_those_of_all_points_by_the_tolerance(
    tmp_path,
):
    some, largest = wavy(tmp_path / "some", "greedy { tolerance 1e-3; }")
    all_, _ = wavy(tmp_path / "all", "selection all;")
    ((selected, candidates, error, _),) = selections(
        all_.run("moveDynamicMesh")
    )
    assert selected == candidates and error < 1e-12 * largest
    difference = move(some) - all_.points("1/polyMesh/points")
    assert 0 < np.abs(difference).max() < 10 * 1e-3 * largest


def with_debug(case):
    """The case with what the solver says at debug 1."""
    with open(case.path / "system/controlDict", "a") as control:
        # Switches are set for the libraries that are loaded by then
        control.write(
            "libs (morphMotionSolvers);\n"
            "DebugSwitches { rbfMotionSolver 1; }\n"
        )
    return case


def test_points_per_sweep_change_the_cost_not_the_tolerance(tmp_path):
    sweeps, selected = {}, {}
    for per_sweep in ("auto", "1", "20"):
        case, _ = wavy(
            tmp_path / per_sweep,
            "greedy { tolerance 1e-2;"
            f" pointsPerSweep {per_sweep}; algorithm incremental;"
            " }",
        )
        output = with_debug(case).run("moveDynamicMesh")
        ((selected[per_sweep], _, error, allowed),) = selections(output)
        assert error <= allowed
        sweeps[per_sweep] = int(re.search(r"(\d+) sweeps", output)[1])
    # One for each point and one that finds no more to add; at most twenty
    # points in one
    assert sweeps["1"] == selected["1"] + 1
    assert selected["20"] / 20 <= sweeps["20"] < sweeps["1"] / 5
    assert sweeps["auto"] < sweeps["1"] / 2


def test_the_log_has_one_line_for_each_selection(tmp_path):
    case, _ = wavy(tmp_path, "greedy { tolerance 1e-2; }", control={"end": 3})
    output = case.run("moveDynamicMesh")
    assert len(re.findall(SELECTED, output, re.MULTILINE)) == 1
    # That, and what the motion took at the end of the run
    assert output.count("rbfMotionSolver:") == 2
    assert "rbfMotionSolver: 3 steps, 1 selection," in output


def test_debug_adds_the_times_of_every_step(tmp_path):
    case, _ = wavy(tmp_path, "", control={"end": 3})
    output = with_debug(case).run("moveDynamicMesh")
    phases = r"^rbfMotionSolver: conditions \S+ s, .*propagation \S+ s"
    assert len(re.findall(phases, output, re.MULTILINE)) == 3


@pytest.mark.parametrize("ranks", [1, 2])
def test_reaching_maxPoints_is_a_warning_that_says_so(tmp_path, ranks):
    case, _ = wavy(tmp_path, "greedy { tolerance 1e-4; maxPoints 30; }")
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    ((selected, _, error, allowed),) = selections(output)
    assert selected == 30 and error > allowed
    assert "greedy/maxPoints is reached" in output
    assert "exceeds the tolerance" in output
    # The points that were told where to go are there nevertheless
    before = reference(case)
    top = side(before, "zMax")
    after = (
        case.decomposed_points("1/polyMesh/points")
        if ranks > 1
        else case.points("1/polyMesh/points")
    )
    np.testing.assert_allclose(
        after[top, 2] - 1,
        0.1 * np.sin(4 * before[top, 0]) * np.cos(3 * before[top, 1]),
        rtol=0,
        atol=1e-15,
    )


def test_enough_points_are_no_warning(tmp_path):
    case, _ = wavy(tmp_path, "greedy { tolerance 1e-4; maxPoints 10000; }")
    assert "Warning" not in case.run("moveDynamicMesh")


ADVICE = (
    r"At patch '(\w+)' the motion around the control points is off by"
    r" (\S+) heights of the first cell\s+.*?"
    r"greedy/tolerance ([-+0-9.e]+)"
)


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_warning_of_thin_first_cells_names_patch_and_tolerance_that_does(
    tmp_path, ranks
):
    # The cells at the top are some 2e-4 high, a hundredth of the tolerance
    thin = {"grading": (1, 1, 1e-3), "cells": (8, 8, 12)}
    case, largest = wavy(
        tmp_path / "loose",
        "greedy { tolerance 0.02; }"
        "surfaceCorrection no; onInvalidMesh ignore;",
        **thin,
    )
    if ranks > 1:
        case.decompose((2, 2, 1))
        ranks = 4
    output = case.run("moveDynamicMesh", ranks=ranks)
    said = re.search(ADVICE, output, re.DOTALL)
    assert said and said.group(1) == "zMax"
    assert float(said.group(2)) > 0.1
    tolerance = float(said.group(3))
    assert 0 < tolerance < 0.02

    case, _ = wavy(
        tmp_path / "advised",
        "surfaceCorrection no;" f" greedy {{ tolerance {tolerance}; }}",
        **thin,
    )
    assert "heights of the first cell" not in case.run("moveDynamicMesh")


def test_the_tolerance_of_a_coarse_mesh_is_no_warning(tmp_path):
    case, _ = wavy(tmp_path, "greedy { tolerance 0.01; }")
    assert "Warning" not in case.run("moveDynamicMesh")


def test_points_too_close_for_the_support_radius_are_a_warning(tmp_path):
    # In a gaussian a thousand times as wide as the box all points are one
    case, _ = wavy(
        tmp_path,
        "kernel gaussian; polynomial none;" "greedy { tolerance 1e-6; }",
    )
    text = (case.path / "constant/dynamicMeshDict").read_text()
    (case.path / "constant/dynamicMeshDict").write_text(
        text.replace("supportRadius 1;", "supportRadius 1000;")
    )
    output = case.run("moveDynamicMesh")
    assert re.search("too close|Round-off", output)
    assert "Reduce the support radius" in output


# --- the support radius where none is given


def tiny(path, coeffs):
    """Selected points for a lid that bends by much less than a cell."""
    case = rbf_case(
        path,
        coeffs=coeffs
        + groups(
            lid="type moving; patches (zMax); displacement { type polyline;"
            " vertices ((0 0 1) (1 0 1)); values ((0 0 1e-4) (0 0 0)); }",
            rest="type fixed; patches (zMin);",
        ),
        cells=(12, 12, 6),
    )
    ((selected, candidates, _, _),) = selections(case.run("moveDynamicMesh"))
    return selected, candidates


def test_by_default_a_tiny_first_step_does_not_let_every_point_move_alone(
    tmp_path,
):
    """With four displacements as radius the kernel matrix is the identity, and
    every point that moves has to be selected (156 of 169: the last row of the
    lid stands still); half the span of the lid is a smooth field instead."""
    alone, candidates = tiny(tmp_path / "factor", "supportRadiusFactor 4;")
    assert (alone, candidates) == (12 * 13, 2 * 13 * 13)
    selected, _ = tiny(tmp_path / "default", "greedy { tolerance 1e-2; }")
    assert selected < 100


# --- the algorithms


BEND = "supportRadius 1;" + groups(
    lid="type moving; patches (zMax); displacement { type polyline;"
    " vertices ((0 0 1) (0.5 0 1) (1 0 1));"
    " values ((0 0 0.1) (0 0 0) (0.05 0 0.1)); }",
    rest="type fixed; patches (zMin);",
    walls='type sliding; patches ("[xy].*");',
)


def test_the_algorithms_give_one_mesh_where_points_are_added_one_by_one(
    tmp_path,
):
    meshes, counts = {}, set()
    for name, entries in (
        ("incremental", "pointsPerSweep 1;"),
        ("standard", ""),
        ("schur", "restartFraction 0.2;"),
    ):
        case = rbf_case(
            tmp_path / name,
            coeffs=BEND + "greedy { tolerance 1e-2;"
            f" algorithm {name}; {entries} }}",
            cells=(6, 6, 6),
        )
        counts.add(selections(case.run("moveDynamicMesh"))[0][0])
        meshes[name] = case.points("1/polyMesh/points")
    assert len(counts) == 1
    for name in ("standard", "schur"):
        np.testing.assert_allclose(
            meshes[name], meshes["incremental"], rtol=0, atol=1e-11
        )


@pytest.mark.parametrize(
    "entries, word",
    [
        ("algorithm standard; pointsPerSweep 2;", "pointsPerSweep"),
        ("algorithm incremental; restartFraction 0.1;", "restartFraction"),
        ("algorithm schur; restartFraction -1;", "restartFraction"),
    ],
)
def test_an_entry_of_another_algorithm_is_an_error(tmp_path, entries, word):
    case = rbf_case(tmp_path, coeffs=BEND + f"greedy {{ {entries} }}")
    assert f"'{word}'" in case.run("moveDynamicMesh", status=1)


def test_a_reference_algorithm_without_polynomial_says_which_has_one(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=BEND + "polynomial linear;" " greedy { algorithm schur; }",
    )
    assert "algorithm incremental does" in case.run(
        "moveDynamicMesh", status=1
    )


def test_points_that_even_selection_all_leaves_out_are_announced(tmp_path):
    """1e-9 apart and told to part: the system with both is singular."""
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 1; selection all;"
        + groups(
            pair="type moving; points ((0.37 0.41 0.43) (0.370000001 0.41 0.43));"
            " displacement { type values;"
            " values ((0 0 0.01) (0 0 0.012)); }",
            rest='type fixed; patches (".*");',
        ),
    )
    output = case.run("moveDynamicMesh")
    assert "1 control point is too close" in output
    assert "Reduce the support radius" in output
