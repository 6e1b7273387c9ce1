# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What tolerance a selection of control points needs: the default, which
follows what the mesh can notice, beside fixed fractions of the motion.

    PYTHONPATH=../tests/support python3 tolerance.py FILE.md [-cases NAME ...]

With the environment of etc/bashrc. The meshes of our tutorials, a box whose
floor turns, thin layers, and OpenFOAM's SnakeRiverCanyon at full size move
without a flow solver (moveSteps). CPU times of the motion and of moving the mesh
by it, all steps, of one run each; quality by checkMesh at the end; the error is
what the last selection leaves at control points, over the least height of a
first cell there. displacementSBRStress beside it for SnakeRiverCanyon, which
OpenFOAM moves by that.
"""

import argparse
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from boundaryLayer import pitched
from boxCase import MESH, SIDES, from_block_mesh
from openfoam import header, run

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
TUTORIALS = ROOT / "tutorials"

VARIANTS = {
    "1e-5": "greedy { tolerance 1e-5; }",
    "1e-3": "greedy { tolerance 1e-3; }",
    "default": "",
}

DROP_IN = """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (morphMotionSolvers);
motionSolver rbfMotionSolver;
"""


def control(path, end, step=1, form="binary"):
    (path / "system/controlDict").write_text(
        header("controlDict")
        + f"startFrom startTime; startTime 0; stopAt endTime; endTime {end};\n"
        f"deltaT {step}; writeControl timeStep;\n"
        f"writeInterval {round(end/step)}; writeFormat {form};\n"
        "writePrecision 16; timeFormat general; timePrecision 8;\n"
        "libs (morphMotionSolvers);\n"
    )


def of_tutorial(path, name, *changes):
    """A tutorial's case, whose selection is to be told by constant/greedy."""
    shutil.copytree(
        TUTORIALS / name,
        path,
        ignore=shutil.ignore_patterns("runs", "results"),
    )
    if (path / "0.orig").exists():
        shutil.copytree(path / "0.orig", path / "0")
    for file, old, new in changes:
        text = (path / file).read_text()
        (path / file).write_text(re.sub(old, new, text))


def greedy_included(path, file="constant/dynamicMeshDict"):
    """The selection's settings from constant/greedy alone."""
    text = (path / file).read_text()
    text = re.sub(r"\n +greedy\s*\{[^}]*\}", "", text)
    include = '#include "$FOAM_CASE/constant/greedy"'
    if "rbfMotionSolverCoeffs" in text:
        text = re.sub(r"(rbfMotionSolverCoeffs\s*\{)", rf"\1 {include}", text)
    else:
        text += f"\nrbfMotionSolverCoeffs {{ {include}\n}}\n"
    (path / file).write_text(text)


def openfoam(*parts):
    return pathlib.Path(os.environ["FOAM_TUTORIALS"]).joinpath(*parts)


def snake_river_canyon(path):
    shutil.copytree(openfoam("mesh/moveDynamicMesh/SnakeRiverCanyon"), path)
    text = (path / "constant/dynamicMeshDict").read_text()
    (path / "constant/sbrStress").write_text(text)
    (path / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + DROP_IN.replace("(morph", "(fvMotionSolvers morph")
    )
    for packed in (path / "constant/triSurface").glob("*.gz"):
        subprocess.run(["gzip", "-d", packed], check=True)
    control(path, 24)
    run(path, "blockMesh")


def box(path):
    """A million cells, whose floor turns by 0.1 about its middle line."""
    n = 100
    corners = " ".join(
        f"({x} {y} {z})"
        for z in (0, 1)
        for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))
    )
    patches = " ".join(
        f"{name} {{ type patch; faces (({face})); }}"
        for name, face in SIDES.items()
    )
    case = from_block_mesh(
        path,
        MESH.format(
            vertices=corners,
            block="0 1 2 3 4 5 6 7",
            cells=f"{n} {n} {n}",
            grading="1 1 1",
            boundary=patches,
        ),
    )
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        DROP_IN
        + """rbfMotionSolverCoeffs
{
    controlPoints
    {
        floor
        {
            type moving; patches (zMin);
            displacement
            {
                type solidBody; solidBodyMotionFunction axisRotationMotion;
                axisRotationMotionCoeffs
                { origin (0.5 0.5 0); radialVelocity (0 5.7295779513 0); }
            }
        }
        top { type fixed; patches (zMax); }
        walls { type sliding; patches ("[xy].*"); }
    }
}""",
    )
    control(path, 1)


def thin_layers(path):
    pitched(path, "")
    control(path, 1)


def air_foil(path):
    of_tutorial(path, "airFoil2D")
    mesh = openfoam("incompressible/simpleFoam/airFoil2D/constant/polyMesh")
    shutil.copytree(mesh, path / "constant/polyMesh")
    control(path, 1)


def pitching_aerofoil(path):
    of_tutorial(path, "pitchingAerofoil")
    mesh = openfoam("incompressible/simpleFoam/airFoil2D/constant/polyMesh")
    shutil.copytree(mesh, path / "constant/polyMesh")
    control(path, 10, 0.1)


def oscillating_cylinder(path):
    of_tutorial(path, "oscillatingCylinder")
    run(path, "blockMesh")
    control(path, 1.5, 0.03)


def sliding_cylinder(path):
    of_tutorial(path, "slidingCylinder")
    shutil.copy(path / "motions/rbf", path / "constant/motion")
    shutil.copy(path / "walls/sliding", path / "0/onWalls")
    run(path, "blockMesh")
    control(path, 4, 4)
    greedy_included(path, "constant/motion")


def twisting_column(path):
    shutil.copytree(openfoam("mesh/moveDynamicMesh/twistingColumn"), path)
    shutil.copytree(
        TUTORIALS / "twistingColumn/0.orig", path / "0", dirs_exist_ok=True
    )
    shutil.copy(
        TUTORIALS / "twistingColumn/constant/dynamicMeshDict",
        path / "constant/dynamicMeshDict",
    )
    mesh = path / "system/blockMeshDict"
    mesh.write_text(mesh.read_text().replace("(2 2 8)", "(8 8 40)"))
    control(path, 10, form="ascii")
    run(path, "blockMesh")
    run(path, sys.executable, str(TUTORIALS / "twistingColumn/twist.py"), ".")
    control(path, 10)


def piston_bowl(path):
    of_tutorial(path, "pistonBowl")
    shutil.copy(path / "motions/stroke", path / "constant/motion")
    run(path, "blockMesh")
    control(path, 1)


def blade_tip(path):
    of_tutorial(path, "bladeTip")
    run(path, "blockMesh")
    for what in ("mesh", "displacement"):
        run(path, sys.executable, "passage.py", what)
    shutil.copy(path / "runs/blade.txt", path / "constant/blade.txt")
    (path / "constant/images").write_text("images auto;\n")
    control(path, 1)


# By name, what makes a case
CASES = {
    "SnakeRiverCanyon": snake_river_canyon,
    "box": box,
    "thin layers": thin_layers,
    "airFoil2D": air_foil,
    "pitchingAerofoil": pitching_aerofoil,
    "oscillatingCylinder": oscillating_cylinder,
    "slidingCylinder": sliding_cylinder,
    "twistingColumn": twisting_column,
    "pistonBowl": piston_bowl,
    "bladeTip": blade_tip,
}


def first_height(path):
    """The least height of a first cell at a control point, by the log."""
    (path / "constant/greedy").write_text("")
    output = run(path, "moveSteps")
    found = re.search(r"first cells' height of (\S+) m", output)
    return float(found[1]) if found else math.nan


def measured(path, settings):
    for former in path.glob("[1-9]*"):
        shutil.rmtree(former)
    (path / "constant/greedy").write_text(settings)
    output = run(path, "moveSteps")
    cpu = sum(
        float(motion) + float(move)
        for motion, move in re.findall(
            r"^step \d+ motion (\S+) move (\S+)", output, re.MULTILINE
        )
    )
    check = run(path, "checkMesh", "-latestTime")
    angle = re.search(r"non-orthogonality Max: (\S+)", check)[1]
    skewness = re.search(r"Max skewness = ([\d.e+-]+)", check)[1]
    selected = re.findall(
        r"selected (\d+) of (\d+) control points, largest error (\S+) ",
        output,
    )
    return {
        "cpu": cpu,
        "angle": float(angle),
        "skewness": float(skewness),
        "selections": len(selected),
        "selected": selected[-1] if selected else None,
        "corrected": "surfaceCorrection is on" in output,
    }


def row(name, how, figures, height):
    points, error = "", ""
    if figures["selected"]:
        n, of, left = figures["selected"]
        points = f"{int(n):,} of {int(of):,}"
        error = f"{float(left)/height:.2g}"
        if figures["corrected"]:
            error += ", corrected"
    return (
        f"| {name} | {how} | {points} | {figures['selections'] or ''} | "
        f"{figures['cpu']:.2f} | {figures['angle']:.1f} | "
        f"{figures['skewness']:.3f} | {error} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument(
        "-cases", nargs="+", default=list(CASES), choices=list(CASES)
    )
    arguments = parser.parse_args()
    lines = [
        "| case | tolerance | control points | selections | CPU [s] | "
        "non-orthogonality | skewness | error / first cell |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name in arguments.cases:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "case"
            CASES[name](path)
            if not (path / "constant/greedy").exists():
                text = (path / "constant/dynamicMeshDict").read_text()
                if '#include "motion"' not in text or name == "pistonBowl":
                    greedy_included(path)
            height = first_height(path)
            for how, settings in VARIANTS.items():
                lines.append(row(name, how, measured(path, settings), height))
            if (path / "constant/sbrStress").exists():
                shutil.copy(
                    path / "constant/sbrStress",
                    path / "constant/dynamicMeshDict",
                )
                figures = measured(path, "")
                lines.append(
                    row(name, "displacementSBRStress", figures, height)
                )
    table = "\n".join(lines)
    print(table)
    pathlib.Path(arguments.file).write_text(table + "\n")


if __name__ == "__main__":
    main()
