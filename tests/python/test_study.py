# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A study with OpenFOAM: conduction through a block whose top wall moves. Its
temperature is linear, so that its gradient at the wall is 1/height, on the morphed
mesh but for the little that its cells are skewed (4e-5 measured); a height below
zero folds the mesh."""

import csv
import pathlib
import re
import subprocess

import pytest

from boxCase import SCHEMES, SOLUTION, block_mesh, write_control
from foamCase import FoamCase, environment

ROOT = pathlib.Path(__file__).resolve().parents[2]
for module in ("yaml", "scipy", "snakemake"):
    pytest.importorskip(module)

STUDY = """
template: case
parametersFile: constant/parameters
parameters:
  height: {bounds: [0.5, 2], baseline: 1}
  diffusivity:
    bounds: [1, 3]
    baseline: 2
    file: constant/transportProperties
    entry: DT
derived:
  lift: height - baseline.height
sampling: {method: sobol, designs: 4}
baseline:
  steps: {mesh: blockMesh, solve: laplacianFoam}
strategies:
  morph:
    steps:
      morph: morphMesh
      solve: {run: laplacianFoam, expect: ^End$}
  remesh:
    start: template
    steps: {mesh: blockMesh, solve: laplacianFoam}
responses:
  gradient:
    file: postProcessing/top/*/surfaceFieldValue.dat
    column: 2
    window: 4
  flux: {expression: diffusivity*gradient}
notes:
  selected: {file: log.morph, regex: "selected (\\\\d+) of"}
"""

MOTION = """
#include "parameters"
motionSolverLibs (morphMotionSolvers);
motionSolver rbfMotionSolver;
rbfMotionSolverCoeffs
{
    supportRadius 4;
    controlPoints
    {
        top
        {
            type moving; patches (top);
            displacement { type uniform; value (0 $lift 0); }
        }
        bottom { type fixed; patches (bottom); }
        sides { type sliding; patches (sides); }
    }
}
"""

# Time steps so long that each is a steady state
CONTROL = """
application laplacianFoam;
startFrom latestTime; startTime 0; stopAt nextWrite; endTime 1e9;
deltaT 1000; writeControl timeStep; writeInterval 8; writePrecision 12;
functions
{
    grad { type grad; libs (fieldFunctionObjects); field T; }
    top
    {
        type surfaceFieldValue; libs (fieldFunctionObjects);
        regionType patch; name top; operation areaAverage; fields (grad(T));
        writeFields no;
    }
}
"""


def template(path):
    case = FoamCase(path)
    write_control(case)
    case.write("system/controlDict", "dictionary", CONTROL)
    case.write(
        "system/fvSchemes",
        "dictionary",
        SCHEMES
        + """
        ddtSchemes { default Euler; }""",
    )
    case.write(
        "system/fvSolution",
        "dictionary",
        SOLUTION.replace(
            "solvers {",
            "solvers { T { solver PCG; preconditioner DIC;"
            " tolerance 1e-12; relTol 0; }",
        )
        + "SIMPLE { nNonOrthogonalCorrectors 5; }",
    )
    mesh = block_mesh(
        {
            "bottom": ("wall", "yMin"),
            "top": ("wall", "yMax"),
            "sides": ("patch", "xMin xMax"),
            "front": ("empty", "zMin zMax"),
        },
        (6, 6, 1),
    )
    # The upper corners' y
    case.write(
        "system/blockMeshDict",
        "dictionary",
        '#include "../constant/parameters"\n'
        + re.sub(r"\((\S+) 1\.0 (\S+)\)", r"(\1 $height \2)", mesh),
    )
    case.write("constant/dynamicMeshDict", "dictionary", MOTION)
    case.write(
        "constant/transportProperties", "dictionary", "DT [0 2 -1 0 0 0 0] 1;"
    )
    case.write(
        "0/T",
        "volScalarField",
        """
        dimensions [0 0 0 1 0 0 0]; internalField uniform 0;
        boundaryField
        {
            bottom { type fixedValue; value uniform 0; }
            top { type fixedValue; value uniform 1; }
            sides { type zeroGradient; }
            front { type empty; }
        }""",
    )


def study(folder, text=STUDY):
    (folder / "study.yaml").write_text(text)
    return folder / "study.yaml"


def command(*words, status=0):
    done = subprocess.run(
        ["morphStudy", *map(str, words)],
        text=True,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    assert done.returncode == status, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """The rows of each strategy. Design 5 would fold the mesh."""
    folder = tmp_path_factory.mktemp("swept")
    template(folder / "case")
    file = study(folder)
    command("sample", file)
    with (folder / "study.study/designs.csv").open("a") as table:
        table.write("5,sample,-0.5,1\n")
    rows = {}
    for strategy in ("morph", "remesh"):
        command(
            "run",
            file,
            "-strategy",
            strategy,
            "-only",
            *([1, 2, 3, 4, 5] if strategy == "morph" else [1, 2]),
        )
        with (folder / f"study.study/results.{strategy}.csv").open() as table:
            rows[strategy] = {r["design"]: r for r in csv.DictReader(table)}
    return folder / "study.study", rows


def test_morphed_designs_have_the_exact_gradient(swept):
    rows = swept[1]["morph"]
    for name in ("baseline", "0001", "0002", "0003", "0004"):
        row = rows[name]
        assert row["status"] == "done", row["reason"]
        height, diffusivity = float(row["height"]), float(row["diffusivity"])
        assert float(row["gradient"]) == pytest.approx(1 / height, rel=1e-4)
        assert float(row["flux"]) == pytest.approx(
            diffusivity / height, rel=1e-4
        )
        assert row["iterations"] == "8"


def test_morphed_designs_go_on_from_the_baselines_time(swept):
    folder, _ = swept
    assert (folder / "baseline/8000/T").exists()
    case = folder / "morph/0001"
    assert (case / "8000/polyMesh/points").exists()
    assert (case / "16000/T").exists()
    assert (case / "8000/T").read_bytes() == (
        folder / "baseline/8000/T"
    ).read_bytes()
    assert not (folder / "remesh/0001/16000").exists()


def test_dictionaries_have_every_digit_of_a_parameter(swept):
    folder, rows = swept
    case = FoamCase(folder / "morph/0003")
    said = case.run(
        "foamDictionary",
        "-entry",
        "DT",
        "-value",
        "constant/transportProperties",
    )
    # It prints six digits itself
    assert float(said.split("]")[1]) == pytest.approx(
        float(rows["morph"]["0003"]["diffusivity"]), rel=1e-5
    )
    assert (
        rows["morph"]["0003"]["diffusivity"]
        in (case.path / "constant/transportProperties").read_text()
    )


def test_what_morphMesh_says_is_in_the_table(swept):
    rows = swept[1]["morph"]
    assert rows["0001"]["attainable"] == "1.0"
    assert float(rows["0001"]["mesh.cells"]) == 36
    assert int(float(rows["0001"]["selected"])) > 4
    assert "mesh.cells" not in swept[1]["remesh"]["0001"]


def test_a_folded_mesh_is_recorded_as_such(swept):
    row = swept[1]["morph"]["0005"]
    assert row["status"] == "failed"
    assert row["reason"].startswith(
        "morph: The motion makes the mesh invalid: "
    )
    said = re.search(r"valid up to the fraction (\S+)", row["reason"])
    assert float(said.group(1)) == pytest.approx(float(row["attainable"]))
    # The block has no height at 1/1.5 of the way
    assert 0.4 < float(row["attainable"]) <= 1 / 1.5
    assert row["flux"] == ""


def test_meshing_anew_gives_the_same(swept):
    for name, row in swept[1]["remesh"].items():
        assert float(row["flux"]) == pytest.approx(
            float(swept[1]["morph"][name]["flux"]), rel=1e-4
        )


def test_an_entry_that_is_not_there_is_named_with_those_that_are(tmp_path):
    template(tmp_path / "case")
    said = command(
        "check",
        study(tmp_path, STUDY.replace("entry: DT", "entry: DX")),
        status=1,
    )
    assert (
        "diffusivity/entry: constant/transportProperties: there is no entry"
        " DX in the file, but FoamFile DT"
    ) in said
