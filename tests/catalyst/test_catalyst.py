# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Function object catalyst: what a ParaView pipeline receives while the mesh
moves, serial and under mpirun.

Source of truth: the points files of the same run, the analytic volume of the
box, and the fields that the solver wrote.
"""

import json
import os
import re
import subprocess

import numpy as np
import pytest

import rbfCase
from boxCase import write_control
from foamCase import ROOT, environment

# Writes what it gets: one line of JSON each time, a file for each rank
RECORD = '''# script-version: 2.0
import json
from paraview.simple import *
from paraview import catalyst
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.util.numpy_support import vtk_to_numpy

options = catalyst.Options()
region = TrivialProducer(registrationName="region")
controls = TrivialProducer(registrationName="controls")


def blocks(data, name=""):
    """Leaves of a multiblock data set by their path"""
    for i in range(data.GetNumberOfBlocks()):
        path = name + "/" + data.GetMetaData(i).Get(data.NAME())
        block = data.GetBlock(i)
        if hasattr(block, "GetNumberOfBlocks"):
            yield from blocks(block, path)
        else:
            yield path, block


def volume(grid):
    size = vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    return vtk_to_numpy(
        size.GetOutput().GetCellData().GetArray("Volume")).tolist()


def catalyst_execute(info):
    record = {"time": info.time}
    for producer in (region, controls):
        producer.UpdatePipeline(info.time)
        whole = producer.GetClientSideObject().GetOutputDataObject(0)
        for path, block in blocks(whole):
            cells, points = block.GetCellData(), block.GetPointData()
            record[path] = {
                "cells": block.GetNumberOfCells(),
                "bounds": list(block.GetBounds()),
                "values": {
                    data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).tolist()
                    for data in (cells, points)
                    for i in range(data.GetNumberOfArrays())}}
            if path == "/internal":
                record[path]["volume"] = volume(block)
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    with open(f"record{rank}.json", "a") as file:
        print(json.dumps(record), file=file)
'''

MOTION = rbfCase.groups(
    top="type moving; patches (zMax); displacement { type solidBody;"
    " solidBodyMotionFunction linearMotion;"
    " linearMotionCoeffs { velocity (0.02 0 0.1); } }",
    bottom="type fixed; patches (zMin);",
)

MESH = 'region { patches ("z.*"); }'
CONTROLS = "controls { type controls; }"


@pytest.fixture(scope="module", autouse=True)
def library():
    found = list((ROOT / "build").glob("*/lib/libmorphCatalyst.so"))
    if not found and not os.environ.get("MORPHFOAM_OWN_OPENFOAM"):
        pytest.skip("ParaView's development files are not on this machine")


def in_situ_case(path, inputs=MESH + CONTROLS, scripts=("record.py",), **mesh):
    case = rbfCase.rbf_case(
        path,
        coeffs="supportRadius 1.5;\n" + MOTION,
        control={"end": 2, "deltaT": 1},
        **mesh,
    )
    (case.path / "system/record.py").write_text(RECORD)
    listed = " ".join(f'"<system>/{name}"' for name in scripts)
    control = (case.path / "system/controlDict").read_text()
    (case.path / "system/controlDict").write_text(
        control + "functions { catalyst { type catalyst; libs (morphCatalyst);"
        f" executeControl timeStep; scripts ({listed});"
        f" inputs {{ {inputs} }} }} }}\n"
    )
    return case


def run(case, *command, ranks=1, status=0):
    """As FoamCase.run, with a display for ParaView."""
    parallel = ["mpirun", "--oversubscribe", "-np", str(ranks)]
    result = subprocess.run(
        [
            str(ROOT / "bin/withDisplay"),
            *(parallel if ranks > 1 else []),
            *command,
            *(["-parallel"] if ranks > 1 else []),
        ],
        cwd=case.path,
        env={**environment(), "PWD": str(case.path)},
        timeout=60,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    output = result.stdout.decode(errors="replace")
    assert result.returncode == status, output[-4000:]
    return output


def records(case):
    """What each rank got at each time: [[rank 0, rank 1, ...], ...]."""
    return list(
        zip(
            *(
                [json.loads(line) for line in file.read_text().splitlines()]
                for file in sorted(
                    case.path.glob("postProcessing/catalyst/record*.json")
                )
            )
        )
    )


def merged(parts, path):
    """A block of all ranks."""
    blocks = [part[path] for part in parts if part[path]["cells"]]
    bounds = np.array([block["bounds"] for block in blocks]).reshape(-1, 3, 2)
    return {
        "cells": sum(block["cells"] for block in blocks),
        "low": bounds[:, :, 0].min(axis=0),
        "high": bounds[:, :, 1].max(axis=0),
        "volume": sum((block.get("volume", []) for block in blocks), []),
        "values": {
            name: np.concatenate([b["values"][name] for b in blocks])
            for name in blocks[0]["values"]
        },
    }


def test_control_points_of_several_steps_arrive(tmp_path):
    # Source of truth: morphMesh of one step has the same candidates
    case = in_situ_case(tmp_path)
    text = (case.path / "constant/dynamicMeshDict").read_text()
    (case.path / "constant/dynamicMeshDict").write_text(
        text.replace("supportRadius", "subSteps 3; supportRadius")
    )
    run(case, "moveDynamicMesh")
    last = records(case)[-1][0]
    shown = last["/controlPoints"]
    assert shown["cells"] == 50 and sum(shown["values"]["selected"]) > 0


@pytest.fixture(scope="module", params=[1, 2])
def recorded(request, tmp_path_factory):
    case = in_situ_case(tmp_path_factory.mktemp("inSitu") / "case")
    if request.param > 1:
        case.decompose((2, 1, 1))
    run(case, "moveDynamicMesh", ranks=request.param)
    return case, records(case)


def test_points_are_sent_when_they_moved(recorded):
    case, sent = recorded
    assert [parts[0]["time"] for parts in sent] == [1, 2]
    for parts in sent:
        time = parts[0]["time"]
        points = rbfCase.points_at(case, str(int(time)))
        cells = merged(parts, "/internal")
        np.testing.assert_array_equal(cells["low"], points.min(axis=0))
        np.testing.assert_array_equal(cells["high"], points.max(axis=0))
        assert cells["high"][2] == 1 + 0.1 * time


def test_cells_are_those_of_the_mesh(recorded):
    _, sent = recorded
    for parts in sent:
        cells = merged(parts, "/internal")
        assert cells["cells"] == 64
        assert min(cells["volume"]) > 0


def test_patches_are_blocks(recorded):
    _, sent = recorded
    for parts in sent:
        for part in parts:
            assert {path for path in part if path.startswith("/boundary")} == {
                "/boundary/zMin",
                "/boundary/zMax",
            }
        top = merged(parts, "/boundary/zMax")
        assert top["cells"] == 16
        assert top["low"][2] == top["high"][2] == 1 + 0.1 * parts[0]["time"]


def test_control_points_come_with_their_values(recorded):
    _, sent = recorded
    for parts in sent:
        controls = merged(parts, "/controlPoints")
        assert controls["cells"] == 50
        values = controls["values"]
        assert set(values) == {
            "conditions",
            "offMesh",
            "region",
            "selected",
            "weight",
            "displacement",
            "error",
        }
        np.testing.assert_allclose(
            np.linalg.norm(values["displacement"], axis=1).max(),
            parts[0]["time"] * np.hypot(0.02, 0.1),
            rtol=1e-14,
        )


def test_polyhedra_have_their_volume(tmp_path):
    case = in_situ_case(tmp_path / "case")
    case.run("polyDualMesh", "80", "-overwrite")
    run(case, "moveDynamicMesh")
    cells = merged(records(case)[0], "/internal")
    assert min(cells["volume"]) > 0
    write_control(case)
    output = case.run("checkMesh", "-time", "1")
    total = float(re.search(r"Total volume = ([^ ]+)\. ", output)[1])
    # VTK and OpenFOAM divide warped faces in different ways
    np.testing.assert_allclose(sum(cells["volume"]), total, rtol=1e-4)


def test_fields_are_those_that_are_written(tmp_path):
    case = in_situ_case(
        tmp_path / "case", "region { fields (U); boundary no; }"
    )
    case.write(
        "0/U",
        "volVectorField",
        "dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);"
        'boundaryField { ".*" { type slip; } "z.*" {'
        " type movingWallVelocity; value uniform (0 0 0); } "
        '"x.*" { type zeroGradient; } }',
    )
    case.write(
        "0/p",
        "volScalarField",
        "dimensions [0 2 -2 0 0 0 0]; internalField uniform 0;"
        'boundaryField { ".*" { type zeroGradient; } "x.*" {'
        " type fixedValue; value uniform 0; } }",
    )
    case.write(
        "constant/transportProperties",
        "dictionary",
        "transportModel Newtonian; nu 0.01;",
    )
    case.write(
        "constant/turbulenceProperties",
        "dictionary",
        "simulationType laminar;",
    )
    case.write(
        "system/fvSchemes",
        "dictionary",
        "ddtSchemes { default Euler; } gradSchemes { default Gauss"
        " linear; } divSchemes { default Gauss linear; } "
        "laplacianSchemes { default Gauss linear corrected; } "
        "interpolationSchemes { default linear; } "
        "snGradSchemes { default corrected; }",
    )
    case.write(
        "system/fvSolution",
        "dictionary",
        'solvers { ".*" { solver PCG; preconditioner DIC;'
        " tolerance 1e-10; relTol 0; }"
        ' "U.*" { solver PBiCGStab; preconditioner DILU;'
        " tolerance 1e-10; relTol 0; } }"
        " PIMPLE { nCorrectors 2; correctPhi no; }",
    )
    run(case, "pimpleFoam")
    for (part,) in records(case):
        written = case.points(f"{int(part['time'])}/U")
        assert np.abs(written).max() > 0.01
        np.testing.assert_allclose(
            part["/internal"]["values"]["U"], written, rtol=1e-14
        )
        assert not [path for path in part if path.startswith("/boundary")]


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_script_that_fails_is_a_warning(tmp_path, ranks):
    case = in_situ_case(
        tmp_path / "case", scripts=("broken.py", "missing.py", "record.py")
    )
    (case.path / "system/broken.py").write_text(
        "# script-version: 2.0\nfrom paraview.simple import *\n"
        'region = TrivialProducer(registrationName="region")\n'
        "def catalyst_execute(info):\n    raise RuntimeError('on purpose')\n"
    )
    if ranks > 1:
        case.decompose((1, 2, 1))
    output = run(case, "moveDynamicMesh", ranks=ranks)
    assert "there is no script" in output and "missing.py" in output
    assert output.count("a script failed at time") == 2
    assert [parts[0]["time"] for parts in records(case)] == [1, 2]


@pytest.mark.parametrize(
    "inputs, message",
    [
        ("", "'inputs' names no channel"),
        ("region { type volume; }", "Use one of (controls mesh)"),
        ("region { field (p); }", "field"),
        ("region yes;", "has to be a dictionary"),
    ],
)
def test_wrong_inputs_are_errors(tmp_path, inputs, message):
    case = in_situ_case(tmp_path / "case", inputs)
    output = run(case, "moveDynamicMesh", status=1)
    assert "FOAM FATAL IO ERROR" in output and message in output
