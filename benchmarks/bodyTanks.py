# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""bodyTanks.py FOLDER [N ...]: what moving one body costs in tanks N times as
wide as that of OpenFOAM's floatingObject, by us and by OpenFOAM's
sixDoFRigidBodyMotion: CPU of the motion in a call, median of those after the
first.

There is no flow, which would cost the same in both. Cases are made in FOLDER;
etc/bashrc is to be sourced, PYTHONPATH=../tests/dropIn:../tests/support given,
and tests/dropIn/motionClock built (wmake libso).
"""

import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np
from bodies import on_body, vectors
from openfoam import header, run
from tutorialCase import run_environment

STEPS = 24
DELTA_T = 0.005
INNER, OUTER = 0.05, 0.35

BODY = """
    mass 15; centreOfMass (0.5 0.45 0.35); g (0 0 -9.81); test yes;
    momentOfInertia (0.3625 0.425 0.1625); report off;
    solver { type Newmark; }
    restraints { spring { sixDoFRigidBodyMotionRestraint linearSpring;
        anchor (0.5 0.4 0.6); refAttachmentPt (0.5 0.4 0.6);
        stiffness 2000; damping 2; restLength 0; } }
"""
HEAD = """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (morphMotionSolvers sixDoFRigidBodyMotion);
"""
OURS = """
motionSolver rbfMotionSolver;
rbfMotionSolverCoeffs
{
    %s
    controlPoints
    {
        body { type moving; patches (floatingObject);
            displacement { type sixDoFRigidBody; %s %s } }
        tank { type fixed; patches (stationaryWalls atmosphere); }
    }
}
"""
MOTION = {
    "OpenFOAM": "motionSolver sixDoFRigidBodyMotion;"
    "sixDoFRigidBodyMotionCoeffs { patches (floatingObject);"
    f" innerDistance {INNER}; outerDistance {OUTER}; {BODY} }}",
    "supportRadius 0.35": OURS % (f"supportRadius {OUTER};", "", BODY),
}


def meshed(folder, n):
    """OpenFOAM's tank made wider, with the same body and the same cells."""
    case = folder / f"tank{n}"
    shutil.rmtree(case, ignore_errors=True)
    tutorials = pathlib.Path(os.environ["WM_PROJECT_DIR"]) / "tutorials"
    original = tutorials / "multiphase/interFoam/RAS/floatingObject"
    shutil.copytree(original, case)
    (case / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict") + "dynamicFvMesh staticFvMesh;"
    )
    path = case / "system/blockMeshDict"
    low, high = (1 - n) // 2, (1 + n) // 2
    corners = " ".join(
        f"({x} {y} {z})"
        for z in (0, 1.5)
        for x, y in ((low, low), (high, low), (high, high), (low, high))
    )
    head, rest = path.read_text().split("blocks", 1)
    rest = rest.replace("(20 20 30)", f"({20 * n} {20 * n} 30)")
    path.write_text(
        header("blockMeshDict")
        + f"scale 1; vertices ({corners});\nblocks"
        + rest
    )
    (case / "system/controlDict").write_text(
        header("controlDict")
        + f"application moveDynamicMesh; startFrom startTime; startTime 0;"
        f"stopAt endTime; endTime {STEPS * DELTA_T}; deltaT {DELTA_T};"
        f"writeControl timeStep; writeInterval {STEPS}; writeFormat binary;"
        "runTimeModifiable no;"
    )
    run(case, "blockMesh")
    run(case, "topoSet")
    run(case, "subsetMesh", "-overwrite", "c0", "-patch", "floatingObject")
    (case / "0").mkdir(exist_ok=True)
    shutil.copy(case / "0.orig/pointDisplacement", case / "0")
    return case


def moved(case, name):
    """Seconds of each call, and the points at the end."""
    (case / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict") + HEAD + MOTION[name]
    )
    shutil.rmtree(case / f"{STEPS * DELTA_T:g}", ignore_errors=True)
    with open(case / f"log.{name.replace(' ', '_')}", "w") as log:
        subprocess.run(
            ["moveDynamicMesh", "-noFunctionObjects"],
            cwd=case,
            env=run_environment(case),
            check=True,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    calls = np.array((case / "motionClock").read_text().split(), float)
    return calls, vectors(case / f"{STEPS * DELTA_T:g}/polyMesh/points")


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print(
        "| tank | points | moved by | points that move | the body [m] |"
        " CPU of a call [ms] | first call [ms] |\n"
        "|---|---|---|---|---|---|---|"
    )
    for n in [int(word) for word in sys.argv[2:]] or [1, 3, 7]:
        case = meshed(folder, n)
        first = vectors(case / "constant/polyMesh/points")
        for name in MOTION:
            calls, points = moved(case, name)
            far = np.abs(points - first).max(axis=1)
            print(
                f"| {n} | {len(first)} | {name} |"
                f" {(far > 1e-9 * far.max()).sum()} |"
                f" {far[on_body(first)].max():.9g} |"
                f" {1e3 * np.median(calls[1:]):.3g} | {1e3 * calls[0]:.3g} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
