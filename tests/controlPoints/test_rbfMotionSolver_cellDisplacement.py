# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The field cellDisplacement, through which couplings talk to a motion solver.

Sources of truth: displacementLaplacian, which registers the field by that
name; interpolation by inverse distances, which is exact for what is uniform
and, on uniform faces, for what is linear, in the inside of a patch; OpenFOAM's
own interpolation to points (primitivePatchInterpolation).
"""

import re

import numpy as np
import pytest

from boxCase import fixed, write_control
from foamCase import build_program
from rbfCase import CUBE, points_at, rbf_case, reference, side, ulps


@pytest.fixture(scope="module", autouse=True)
def program():
    build_program("coupledMesh")


CONDITIONS = {
    **{name: "slip" for name in CUBE},
    "zMin": fixed(0, 0, 0),
    "zMax": fixed(0, 0, 0),
}

CONTROL = {"end": 3}

RAMP = "table ((0 (0 0 0)) (1 (0 0 0)) (2 (0 0 0.05)) (3 (0 0 0.1)))"


def coupled(path, at, conditions=CONDITIONS, gradient=(0, 0, 0), control=None):
    case = rbf_case(path, conditions, control=control or CONTROL)
    case.write(
        "system/couplingDict",
        "dictionary",
        f"patch zMax; at {at}; value {RAMP};"
        f" gradient ({gradient[0]} {gradient[1]} {gradient[2]});",
    )
    return case


@pytest.mark.parametrize("at", ["faces", "both", "nodes"])
@pytest.mark.parametrize("ranks", [1, 2])
def test_what_a_coupling_writes_moves_the_patch(tmp_path, at, ranks):
    """Zero in the first step, one warning; then it follows."""
    case = coupled(tmp_path, at)
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("coupledMesh", ranks=ranks)
    assert output.count("FOAM Warning") == 1
    assert output.count("Nothing moves the mesh") == 1
    top = side(before, "zMax")
    for time, up in ((1, 0), (2, 0.05), (3, 0.1)):
        np.testing.assert_allclose(
            points_at(case, time)[top],
            before[top] + (0, 0, up),
            rtol=0,
            atol=ulps(before),
        )


@pytest.mark.parametrize("ranks", [1, 3])
def test_faces_are_interpolated_to_points(tmp_path, ranks):
    """Linear in x: exact at inner points of uniform faces, half a face short
    at the rim, on any number of ranks; as OpenFOAM's interpolation on one."""
    case = coupled(tmp_path / "faces", "faces", gradient=(0.5, 0, 0))
    before = reference(case)
    if ranks > 1:
        case.decompose((3, 1, 1))
    case.run("coupledMesh", ranks=ranks)
    after = points_at(case, 3)
    top = side(before, "zMax")
    x = before[top, 0].clip(0.125, 0.875)
    np.testing.assert_allclose(
        after[top, 2] - 1, 0.1 * (1 + 0.5 * x), rtol=0, atol=1e-14
    )
    both = coupled(tmp_path / "both", "both", gradient=(0.5, 0, 0))
    both.run("coupledMesh")
    np.testing.assert_allclose(
        points_at(both, 3)[top], after[top], rtol=0, atol=1e-14
    )


def test_nodes_are_not_smoothed(tmp_path):
    case = coupled(tmp_path, "nodes", gradient=(0.5, 0, 0))
    before = reference(case)
    case.run("coupledMesh")
    top = side(before, "zMax")
    np.testing.assert_allclose(
        points_at(case, 3)[top, 2] - 1,
        0.1 * (1 + 0.5 * before[top, 0]),
        rtol=0,
        atol=ulps(before),
    )


@pytest.mark.parametrize("at", ["faces", "nodes"])
def test_a_restart_goes_on_to_the_last_bit(tmp_path, at):
    whole = coupled(tmp_path / "whole", at, gradient=(0.5, 0, 0))
    whole.run("coupledMesh")
    parts = coupled(
        tmp_path / "parts", at, gradient=(0.5, 0, 0), control={"end": 2}
    )
    parts.run("coupledMesh")
    write_control(parts, end=3, startFrom="latestTime")
    parts.run("coupledMesh")
    np.testing.assert_array_equal(points_at(parts, 3), points_at(whole, 3))


def volume_field(conditions):
    boundary = "".join(
        f"{patch} {{ type {body} }}" for patch, body in conditions.items()
    )
    return (
        "volVectorField",
        "dimensions [0 1 0 0 0 0 0];"
        f"internalField uniform (0 0 0); boundaryField {{ {boundary} }}",
    )


@pytest.mark.parametrize("point_condition", ["calculated", "fixedValue"])
def test_a_field_in_a_file_is_heard_from_the_start(tmp_path, point_condition):
    top_condition = (
        fixed(0, 0, 0) if point_condition == "fixedValue" else point_condition
    )
    case = rbf_case(tmp_path, {**CONDITIONS, "zMax": top_condition})
    case.write(
        "0/cellDisplacement",
        *volume_field(
            {
                **{
                    name: "calculated; value uniform (0 0 0);" for name in CUBE
                },
                "zMax": fixed(0, 0, 0.1),
            }
        ),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    top = side(before, "zMax")
    np.testing.assert_allclose(
        points_at(case, 1)[top],
        before[top] + (0, 0, 0.1),
        rtol=0,
        atol=ulps(before),
    )
    assert (tmp_path / "1/cellDisplacement").exists()


def test_points_that_move_count_more_than_a_file_of_zeros(tmp_path):
    case = rbf_case(tmp_path, {**CONDITIONS, "zMax": fixed(0, 0, 0.1)})
    case.write(
        "0/cellDisplacement",
        *volume_field(
            {
                **{
                    name: "calculated; value uniform (0 0 0);" for name in CUBE
                },
                "zMax": fixed(0, 0, 0),
            }
        ),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    top = side(before, "zMax")
    np.testing.assert_array_equal(
        points_at(case, 1)[top], before[top] + (0, 0, 0.1)
    )


def test_it_is_written_only_where_somebody_used_it(tmp_path):
    case = rbf_case(tmp_path, {**CONDITIONS, "zMax": fixed(0, 0, 0.1)})
    case.run("moveDynamicMesh")
    assert not (tmp_path / "1/cellDisplacement").exists()


def test_faces_of_a_condition_that_finds_its_own_values_warn(tmp_path):
    case = coupled(
        tmp_path,
        "faces",
        {**CONDITIONS, "zMax": "uniformFixedValue; uniformValue (0 0 0.02);"},
    )
    output = case.run("coupledMesh")
    assert output.count("have no effect") == 1 and "'zMax'" in output


def test_values_of_faces_follow_the_points(tmp_path):
    """What displacementLaplacian has there: the mean over each face."""
    case = rbf_case(tmp_path, {**CONDITIONS, "zMax": fixed(0, 0, 0.1)})
    write_control(case)
    with open(tmp_path / "system/controlDict", "a") as control:
        control.write(
            "functions { look { type writeObjects; libs"
            " (utilityFunctionObjects); writeControl timeStep;"
            " objects (cellDisplacement); } }"
        )
    case.run("moveDynamicMesh")
    text = (tmp_path / "1/cellDisplacement").read_text()
    top = text[text.index("zMax") :]
    assert "cellMotion" in top
    value = re.search(r"value +uniform \(0 0 (\S+)\)", top).group(1)
    assert float(value) == pytest.approx(0.1, abs=1e-15)


@pytest.mark.parametrize("ranks", [1, 2])
def test_values_that_are_none_are_an_error(tmp_path, ranks):
    case = rbf_case(tmp_path, {**CONDITIONS, "zMax": "calculated"})
    case.write(
        "0/cellDisplacement",
        *volume_field(
            {
                **{
                    name: "calculated; value uniform (0 0 0);" for name in CUBE
                },
                "zMax": fixed(0, 0, 1e200),
            }
        ),
    )
    if ranks > 1:
        case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    assert "'zMax'" in output and "not finite" in output
