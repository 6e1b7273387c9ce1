# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Function object motionControls: control points as VTK files.

Source of truth: the displacement that was prescribed, and the definition of the
interpolant, s(x) = sum_j phi(|x - x_j|/r0) gamma_j with Wendland's C2.
"""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

import rbfCase
from ffdCase import ffd_box, ffd_case, parameter

RADIUS = 1.5


def read_vtk(path):
    """Points and point data of a legacy ASCII file."""
    words = path.read_text().split()
    at = words.index("POINTS")
    n = int(words[at + 1])
    points = np.array(words[at + 3 : at + 3 + 3 * n], float).reshape(n, 3)
    at = words.index("FIELD")
    data, count = {}, int(words[at + 2])
    at += 3
    for _ in range(count):
        name, width = words[at], int(words[at + 1])
        values = np.array(words[at + 4 : at + 4 + width * n], float)
        data[name] = values.reshape(n, width) if width > 1 else values
        at += 4 + width * n
    return points, data


def controlled_case(path, functions, **control):
    case = rbfCase.rbf_case(
        path,
        control=control,
        coeffs=f"supportRadius {RADIUS};\n"
        + rbfCase.groups(
            top="type moving; patches (zMax);"
            " displacement { type uniform; value (0.01 0 0.05); }",
            bottom="type fixed; patches (zMin);",
            walls='type sliding; patches ("[xy].*");',
            probe="type moving; points ((0.5 0.5 0.45));"
            " displacement { type values; values ((0 0 0.03)); }",
        ),
    )
    control = (case.path / "system/controlDict").read_text()
    (case.path / "system/controlDict").write_text(
        control + f"functions {{ controls {{ type motionControls;"
        f" libs (morphMotionSolvers); {functions} }} }}\n"
    )
    return case


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    case = controlled_case(
        tmp_path_factory.mktemp("controls"), "writeControl writeTime;"
    )
    moved = rbfCase.move(case)
    return (
        case,
        moved,
        *read_vtk(case.path / "postProcessing/controls/1/controlPoints.vtk"),
    )


def test_control_points_are_where_they_went(shown):
    case, moved, points, data = shown
    before = points - data["displacement"]
    top = before[:, 2] > 1 - 1e-9
    assert top.sum() == 25
    np.testing.assert_allclose(
        data["displacement"][top], [[0.01, 0, 0.05]] * 25, atol=1e-15
    )
    # All but the listed one are mesh points
    off = [x for x in points if np.abs(moved - x).max(axis=1).min() > 1e-14]
    np.testing.assert_allclose(off, [[0.5, 0.5, 0.48]], atol=1e-14)


def test_kinds_are_told(shown):
    _, _, points, data = shown
    before = points - data["displacement"]
    on_wall = np.abs(before[:, :2] - 0.5) > 0.5 - 1e-9
    inside = (before[:, 2] > 1e-9) & (before[:, 2] < 1 - 1e-9)
    expected = np.where(
        inside & on_wall.all(axis=1),
        2,
        np.where(inside & on_wall.any(axis=1), 1, 3),
    )
    np.testing.assert_array_equal(data["conditions"], expected)


def test_weights_make_the_field(shown):
    _, moved, points, data = shown
    centres = points - data["displacement"]
    selected = data["selected"] == 1
    assert 10 < selected.sum() < len(selected)
    assert not data["weight"][~selected].any()
    x = moved[np.abs(moved - [0.5, 0.5, 0.5]).max(axis=1) < 0.2]
    assert len(x) == 1
    r = np.linalg.norm([0.5, 0.5, 0.5] - centres, axis=1) / RADIUS
    phi = np.where(r < 1, (1 - r) ** 4 * (4 * r + 1), 0)
    np.testing.assert_allclose(
        x[0] - [0.5, 0.5, 0.5], phi @ data["weight"], atol=1e-14
    )


def test_ranks_show_the_same(shown, tmp_path):
    _, _, points, data = shown
    case = controlled_case(tmp_path / "parallel", "writeControl writeTime;")
    case.decompose((2, 1, 1))
    case.run("moveDynamicMesh", ranks=2)
    x, values = read_vtk(
        case.path / "postProcessing/controls/1/controlPoints.vtk"
    )
    order, reference = np.lexsort(x.T), np.lexsort(points.T)
    np.testing.assert_array_equal(x[order], points[reference])
    for name in data:
        np.testing.assert_array_equal(
            values[name][order], data[name][reference]
        )


def test_a_mesh_without_our_solver_is_a_warning(tmp_path):
    case = controlled_case(tmp_path / "other", "writeControl writeTime;")
    case.write(
        "constant/dynamicMeshDict", "dictionary", "dynamicFvMesh staticFvMesh;"
    )
    output = case.run("moveDynamicMesh")
    assert re.search("has no motion solver that could", output)
    assert not (case.path / "postProcessing/controls").exists()


def test_weights_of_points_that_have_images(tmp_path):
    case = rbfCase.rbf_case(
        tmp_path,
        patches={
            **rbfCase.CUBE,
            "yMin": "symmetryPlane",
            "xMin": "cyclic; neighbourPatch xMax;",
            "xMax": "cyclic; neighbourPatch xMin;",
        },
        coeffs="images yes;\nsupportRadius 0.8;\n"
        + rbfCase.groups(
            top="type moving; patches (zMax);"
            " displacement { type uniform; value (0 0 0.05); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    control = (case.path / "system/controlDict").read_text()
    (case.path / "system/controlDict").write_text(
        control + "functions { controls { type motionControls;"
        " libs (morphMotionSolvers); writeControl writeTime; } }\n"
    )
    case.run("moveDynamicMesh")
    _, data = read_vtk(
        case.path / "postProcessing/controls/1/controlPoints.vtk"
    )
    selected = data["selected"] == 1
    assert selected.any()
    weight = np.linalg.norm(data["weight"], axis=1)
    assert (weight[selected] > 0).any() and not weight[~selected].any()


def times_of(series):
    """(time, file) of a .vtk.series"""
    return [
        (row["time"], row["name"])
        for row in json.loads(series.read_text())["files"]
    ]


@pytest.mark.parametrize("ranks", [1, 2])
def test_times_are_one_series_also_after_a_restart(tmp_path, ranks):
    """Of the times that controlDict writes. A run that begins again at one of
    them goes on with the list."""
    case = controlled_case(
        tmp_path, "writeControl writeTime;", end=1, deltaT=0.25
    )
    if ranks > 1:
        case.decompose((2, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    series = tmp_path / "postProcessing/controls/controlPoints.vtk.series"
    expected = [(t, f"{t:g}/controlPoints.vtk") for t in (0.25, 0.5, 0.75, 1)]
    assert times_of(series) == expected
    for _, name in expected:
        assert (series.parent / name).is_file()
    control = case.path / "system/controlDict"
    text = control.read_text()
    text = re.sub(r"startFrom\s+\w+;", "startFrom latestTime;", text)
    text = re.sub(r"endTime\s+1;", "endTime 1.5;", text)
    control.write_text(text)
    case.run("moveDynamicMesh", ranks=ranks)
    assert times_of(series)[:4] == expected
    assert [time for time, _ in times_of(series)][4:] == [1.25, 1.5]


READ = """
import sys
from paraview import simple as pv
from paraview.servermanager import Fetch
reader = pv.OpenDataFile(sys.argv[1])
reader.UpdatePipelineInformation()
print("times", *reader.TimestepValues)
for time in reader.TimestepValues:
    pv.UpdatePipeline(time=time, proxy=reader)
    bounds = Fetch(reader).GetBounds()
    print("top", repr(time), repr(bounds[5]))
"""


def test_paraview_reads_the_series_of_a_lattice(tmp_path):
    """The top of the lattice rises by 0.3 m in a second: where the reader has it
    at each time."""
    if not shutil.which("pvbatch") or not shutil.which("xvfb-run"):
        pytest.skip("needs ParaView and xvfb")
    case = ffd_case(
        tmp_path,
        ffd_box(
            "cube",
            parameter(
                "mu",
                [((i, j, 1), (0, 0, 1)) for i in (0, 1) for j in (0, 1)],
                "table ((0 0) (1 0.3))",
            ),
            order=(1, 1, 1),
            origin=(0, 0, 0),
            span=(1, 1, 1),
            extra="continuity none;",
        ),
        control={"deltaT": 0.25},
        cells=(2, 2, 2),
    )
    control = case.path / "system/controlDict"
    control.write_text(
        control.read_text() + "functions { controls { type motionControls;"
        " libs (morphMotionSolvers); writeControl writeTime; } }\n"
    )
    case.run("moveDynamicMesh")
    (tmp_path / "read.py").write_text(READ)
    output = subprocess.run(
        ["xvfb-run", "-a", "pvbatch", "read.py"]
        + ["postProcessing/controls/cube.vtk.series"],
        cwd=tmp_path,
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    ).stdout
    assert re.search(r"^times 0.25 0.5 0.75 1.0$", output, re.MULTILINE)
    rows = re.findall(r"^top (\S+) (\S+)$", output, re.MULTILINE)
    assert len(rows) == 4
    for time, top in rows:
        assert float(top) == pytest.approx(1 + 0.3 * float(time), abs=1e-6)
