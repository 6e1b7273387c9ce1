# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""subSteps auto | n: a motion in several steps, each from where the former left
the mesh.

Sources of truth: where the dictionary says that points go, planes, checkMesh,
one rank, an uninterrupted run.
"""

import re

import numpy as np
import pytest

from boxCase import write_control
from rbfCase import groups, points_at, rbf_case, reference, selections, ulps

CELLS = (10, 3, 3)


def middle(table):
    """A sheet across the middle of a box that moves along it, by a table of
    time and distance; ends are fixed, the four sides slide."""
    sheet = " ".join(
        f"(0.5 {y!r} {z!r})"
        for y in np.arange(4) / 3
        for z in np.arange(4) / 3
    )
    motion = " ".join(f"({t} ({d} 0 0))" for t, d in table)
    return groups(
        sheet=f"type moving; points ({sheet}); displacement {{ type uniform;"
        f" value table ({motion}); }}",
        ends="type fixed; patches (xMin xMax);",
        sides="type sliding; patches (yMin yMax zMin zMax);",
    )


FAR = "supportRadius 1.2;" + middle([(0, 0), (1, 0.42)])
TOO_FAR = "supportRadius 1.2;" + middle([(0, 0), (1, 0.55)])


def in_sheet(points):
    return np.abs(points[:, 0] - 0.5) < 1e-9


def steps(output):
    return [int(n) for n in re.findall(r"moved in (\d+) sub-steps", output)]


def ends_where_it_should(case, points, distance):
    x = reference(case)
    sheet = in_sheet(x)
    assert sheet.sum() == 16
    np.testing.assert_allclose(
        points[sheet], x[sheet] + [distance, 0, 0], rtol=0, atol=ulps(x)
    )
    for axis, plane in ((0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)):
        on = np.abs(x[:, axis] - plane) < 1e-9
        np.testing.assert_allclose(points[on, axis], plane, atol=1e-15)
    ends = (x[:, 0] < 1e-9) | (x[:, 0] > 1 - 1e-9)
    assert np.array_equal(points[ends], x[ends])


def test_auto_takes_as_many_steps_as_a_valid_mesh_needs(tmp_path):
    one = rbf_case(tmp_path / "one", coeffs="subSteps 1;" + FAR, cells=CELLS)
    assert "makes the mesh invalid" in one.run("moveDynamicMesh", status=1)

    case = rbf_case(
        tmp_path / "auto", coeffs="subSteps auto;" + FAR, cells=CELLS
    )
    (n,) = steps(case.run("moveDynamicMesh"))
    assert n in (2, 4, 8, 16, 32)
    ends_where_it_should(case, points_at(case, "1"), 0.42)
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")

    # So it does without being asked to, and says so
    default = rbf_case(tmp_path / "default", coeffs=FAR, cells=CELLS)
    output = default.run("moveDynamicMesh")
    assert output.count("one step would make the mesh invalid") == 1
    assert np.array_equal(points_at(default, "1"), points_at(case, "1"))

    # As many as that and no fewer
    fixed = rbf_case(
        tmp_path / "fixed", coeffs=f"subSteps {n};" + FAR, cells=CELLS
    )
    fixed.run("moveDynamicMesh")
    assert np.array_equal(points_at(fixed, "1"), points_at(case, "1"))
    fewer = rbf_case(
        tmp_path / "fewer", coeffs=f"subSteps {n//2};" + FAR, cells=CELLS
    )
    assert "makes the mesh invalid" in fewer.run("moveDynamicMesh", status=1)


def test_a_motion_that_one_step_can_make_is_made_in_one(tmp_path):
    near = "supportRadius 1.2;" + middle([(0, 0), (1, 0.1)])
    one = rbf_case(tmp_path / "one", coeffs=near, cells=CELLS)
    auto = rbf_case(
        tmp_path / "auto", coeffs="subSteps auto;" + near, cells=CELLS
    )
    one.run("moveDynamicMesh")
    assert steps(auto.run("moveDynamicMesh")) == []
    assert np.array_equal(points_at(one, "1"), points_at(auto, "1"))


def test_a_motion_that_no_number_of_steps_makes_is_refused_as_of_one(
    tmp_path,
):
    said = []
    for name, entry in (("one", "subSteps 1;"), ("default", "")):
        case = rbf_case(tmp_path / name, coeffs=entry + TOO_FAR, cells=CELLS)
        output = case.run("moveDynamicMesh", status=1)
        assert ("Leave out 'subSteps'" in output) == (name == "one")
        assert ("more steps than one did not help" in output) == (
            name == "default"
        )
        said.append(re.search(r"valid up to the fraction (\S+) of", output)[1])
    assert said[0] == said[1]


@pytest.mark.parametrize("entry", ["subSteps auto;", ""])
def test_sub_steps_are_the_same_on_any_number_of_ranks(tmp_path, entry):
    results = []
    for ranks, split in (
        (1, None),
        (2, (2, 1, 1)),
        (3, (1, 3, 1)),
        (4, (2, 1, 2)),
    ):
        case = rbf_case(tmp_path / str(ranks), coeffs=entry + FAR, cells=CELLS)
        if split:
            case.decompose(split)
        case.run("moveDynamicMesh", ranks=ranks)
        results.append(points_at(case, "1"))
    for other in results[1:]:
        assert np.array_equal(other, results[0])


def test_a_motion_that_returns_brings_the_mesh_back(tmp_path):
    there = "subSteps 4; supportRadius 1.2;" + middle(
        [(0, 0), (1, 0.3), (2, 0)]
    )
    case = rbf_case(tmp_path, coeffs=there, cells=CELLS, control={"end": 2})
    # Back at rest there is nothing to step
    assert steps(case.run("moveDynamicMesh")) == [4]
    np.testing.assert_allclose(
        points_at(case, "2"),
        reference(case),
        rtol=0,
        atol=ulps(reference(case)),
    )


@pytest.mark.parametrize("entry", ["subSteps auto;", ""])
def test_a_restart_continues_the_uninterrupted_run(tmp_path, entry):
    coeffs = (
        entry + "supportRadius 1.2;" + middle([(0, 0), (1, 0.35), (2, 0.42)])
    )
    whole = rbf_case(
        tmp_path / "whole", coeffs=coeffs, cells=CELLS, control={"end": 2}
    )
    whole.run("moveDynamicMesh")
    parts = rbf_case(
        tmp_path / "parts", coeffs=coeffs, cells=CELLS, control={"end": 1}
    )
    parts.run("moveDynamicMesh")
    write_control(parts, end=2, startFrom="latestTime")
    parts.run("moveDynamicMesh")
    assert np.array_equal(points_at(parts, "2"), points_at(whole, "2"))


COARSE = "subSteps 4; greedy { maxPoints 12; } supportRadius 1.2;" + middle(
    [(0, 0), (1, 0.2), (2, 0.3)]
)

SHOWN = (
    "functions { controls { type motionControls;"
    " libs (morphMotionSolvers); writeControl writeTime; } }\n"
)


def test_the_log_says_of_several_steps_what_it_says_of_one(tmp_path):
    # The counts follow from what the entries allow: 12 points in each of the
    # 4 sub-steps of 2 time steps
    case = rbf_case(tmp_path, coeffs=COARSE, cells=CELLS, control={"end": 2})
    output = case.run("moveDynamicMesh")
    assert [n for n, *_ in selections(output)] == [12, 12]
    assert steps(output) == [4, 4]
    warnings = re.findall(
        r"The largest error, (\S+) m, exceeds the tolerance"
        r" of (\S+) m:\s+greedy/maxPoints is reached",
        output,
    )
    assert len(warnings) == 2
    assert all(float(error) > float(limit) for error, limit in warnings)
    (summary,) = re.findall(
        r"rbfMotionSolver: 2 steps, 8 selections, 12 of (\d+) control points,\s+"
        r"largest error (\S+) m of a displacement of (\S+) m",
        output,
    )
    of, error, displacement = map(float, summary)
    assert of > 100 and 0 < error < displacement < 0.1


def points_of(path):
    """The control points of a VTK file, and which are selected."""
    words = path.read_text().split()
    at = words.index("POINTS")
    n = int(words[at + 1])
    x = np.array(words[at + 3 : at + 3 + 3 * n], float).reshape(n, 3)
    at = words.index("selected")
    return x, np.array(words[at + 4 : at + 4 + n], float)


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_control_points_of_several_steps_are_shown(tmp_path, ranks):
    case = rbf_case(tmp_path, coeffs=COARSE, cells=CELLS)
    control = case.path / "system/controlDict"
    control.write_text(control.read_text() + SHOWN)
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    x, selected = points_of(
        case.path / "postProcessing/controls/1/controlPoints.vtk"
    )
    assert selected.sum() == 12
    # The sheet is where it was told to go
    assert (np.abs(x[:, 0] - 0.7) < 1e-12).sum() == 16


def test_morphMesh_shows_the_control_points_of_several_steps(tmp_path):
    case = rbf_case(tmp_path, coeffs=COARSE, cells=CELLS)
    case.run("morphMesh", "-time", "1", "-lattice")
    (shown,) = case.path.glob(
        "postProcessing/morphMesh/1/controls/controlPoints.vtk"
    )
    x, selected = points_of(shown)
    assert len(x) > 100 and selected.sum() == 12


def record(case):
    text = (case.path / "postProcessing/morphMesh/1/motion").read_text()
    return {
        key: value
        for key, value in re.findall(r"^(\w+)\s+(.*);$", text, re.MULTILINE)
    }


def test_limited_sub_steps_go_further_than_one_limited_step(tmp_path):
    # 0.55 is beyond the end of the box
    attained = {}
    for n in (1, 8):
        case = rbf_case(
            tmp_path / str(n),
            cells=CELLS,
            coeffs=f"onInvalidMesh limit; subSteps {n};" + TOO_FAR,
        )
        case.run("morphMesh", "-time", 1)
        attained[n] = float(record(case)["attainable"])
        moved = float(record(case)["moved"])
        assert moved == pytest.approx(0.9 * attained[n], rel=1e-9)
        ends_where_it_should(case, points_at(case, "1"), moved * 0.55)
        assert int(record(case)["subSteps"]) == n
    # At most up to the end of the box
    assert attained[1] < attained[8] < 0.5 / 0.55


@pytest.mark.parametrize("value", ["0", "-2", "some", "1.5"])
def test_a_wrong_number_of_steps_is_an_error_that_names_it(tmp_path, value):
    case = rbf_case(tmp_path, coeffs=f"subSteps {value};" + FAR, cells=CELLS)
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    assert "FOAM FATAL IO ERROR" in output and "subSteps" in output
    assert case.tree() == before


def turning(angle):
    """A cube in the middle of a box that turns about its axis of y [deg]."""
    cube = " ".join(
        f"({x} {y} {z})"
        for x in (0.4, 0.6)
        for y in (0.4, 0.6)
        for z in (0.4, 0.6)
    )
    return "supportRadius 0.8;" + groups(
        cube=f"type moving; points ({cube}); displacement {{"
        " type solidBody; solidBodyMotionFunction rotatingMotion;"
        " rotatingMotionCoeffs { origin (0.5 0.5 0.5); axis (0 1 0);"
        f" omega {np.radians(angle)!r}; }} }}",
        sides="type fixed; patches (xMin xMax yMin yMax zMin zMax);",
    )


def test_steps_turn_with_a_body_on_any_number_of_ranks(tmp_path):
    """On the chord of half a turn, through the centre, no mesh can go."""
    results = []
    for ranks, split in ((1, None), (2, (2, 1, 1)), (3, (1, 3, 1))):
        case = rbf_case(
            tmp_path / str(ranks),
            coeffs="subSteps 8; onInvalidMesh ignore;" + turning(178),
            cells=(10, 10, 10),
        )
        if split:
            case.decompose(split)
        output = case.run("moveDynamicMesh", ranks=ranks)
        assert steps(output) == [8]
        results.append(points_at(case, "1"))
    for other in results[1:]:
        assert np.array_equal(other, results[0])
    # Corners are prescribed; the point between two of them follows
    x = reference(case)
    c, s = np.cos(np.radians(178)), np.sin(np.radians(178))
    for at, tolerance in (
        ((0.4, 0.4, 0.4), 1e-14),
        ((0.6, 0.6, 0.6), 1e-14),
        ((0.4, 0.4, 0.5), 0.03),
    ):
        (i,) = np.flatnonzero(np.abs(x - at).max(axis=1) < 1e-9)
        r = np.array(at) - 0.5
        turned = 0.5 + np.array(
            [c * r[0] + s * r[2], r[1], c * r[2] - s * r[0]]
        )
        np.testing.assert_allclose(results[0][i], turned, atol=tolerance)


def test_a_body_that_turns_over_is_refused(tmp_path):
    case = rbf_case(
        tmp_path / "case",
        coeffs="subSteps 8; onInvalidMesh ignore;" + turning(170),
        cells=(10, 10, 10),
        control={"end": 2},
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "Control points 'cube' have turned by more than half" in output
    assert "reference moving" in output


def test_a_body_that_comes_back_may_turn_the_other_way(tmp_path):
    """Where it needs steps it turns by 125 degrees one way and, a quarter of
    the period of rest between, the other: not over."""
    case = rbf_case(
        tmp_path / "case",
        coeffs="subSteps auto;"
        + turning(0).replace(
            "rotatingMotion; rotatingMotionCoeffs { origin (0.5 0.5 0.5);"
            " axis (0 1 0); omega 0.0; }",
            "oscillatingRotatingMotion; oscillatingRotatingMotionCoeffs {"
            " origin (0.5 0.5 0.5); amplitude (0 125 0);"
            f" omega {np.pi/2!r}; }}",
        ),
        cells=(10, 10, 10),
        control={"end": 3},
    )
    output = case.run("moveDynamicMesh")
    # At rest in one step
    assert len(steps(output)) == 2
    assert output.count("Mesh OK") == 3
