# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""bodies.py restart|trajectories FOLDER [MOTION ...]: OpenFOAM's floatingObject
with its body moved by us and by OpenFOAM's own solvers.

restart: run whole and restarted half-way, with schemes that leave less and less
to what a restart of the flow does not read. A table of the differences at the
end, of the largest displacement.

trajectories: by which the bodies of different solvers differ, and what a step
costs.

Cases are made in FOLDER, which keeps what has run; etc/bashrc is to be sourced.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from openfoam import header

STEPS = 24
DELTA_T = 0.005

BODY = """
    mass 15; centreOfMass (0.5 0.45 0.35);
    momentOfInertia (0.3625 0.425 0.1625);
    accelerationRelaxation 0.7; report on; solver { type Newmark; }
    constraints
    {
        fixedLine { sixDoFRigidBodyMotionConstraint line;
            centreOfRotation (0.5 0.45 0.1); direction (0 1 0); }
        fixedAxis { sixDoFRigidBodyMotionConstraint axis; axis (0 1 0); }
    }
"""

MOTION = {
    "rbf": """
dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (morphMotionSolvers);
motionSolver rbfMotionSolver;
rbfMotionSolverCoeffs
{
    supportRadius 0.6;
    controlPoints
    {
        body { type moving; patches (floatingObject);
            displacement { type sixDoFRigidBody; %s } }
        tank { type fixed; patches (stationaryWalls atmosphere); }
    }
}
"""
    % BODY,
    "OpenFOAM": """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (sixDoFRigidBodyMotion); motionSolver sixDoFRigidBodyMotion;
sixDoFRigidBodyMotionCoeffs { patches (floatingObject);
    innerDistance 0.05; outerDistance 0.35; %s }
"""
    % BODY,
    "prescribed": """
dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (morphMotionSolvers);
motionSolver rbfMotionSolver;
rbfMotionSolverCoeffs
{
    supportRadius 0.6;
    controlPoints
    {
        body { type moving; patches (floatingObject);
            displacement { type solidBody; solidBodyMotionFunction
            oscillatingLinearMotion; amplitude (0 0.01 0); omega 10; } }
        tank { type fixed; patches (stationaryWalls atmosphere); }
    }
}
""",
    "at rest": "dynamicFvMesh staticFvMesh;",
}

# The same body as the tutorial has it, of joints
JOINED = """
    report on; solver { type Newmark; } accelerationRelaxation 0.7;
    bodies { floatingObject
    {
        type cuboid; parent root; mass 15; L (0.3 0.2 0.5);
        centreOfMass (0 0 0.25); transform (1 0 0 0 1 0 0 0 1) (0.5 0.45 0.1);
        joint { type composite; joints ( { type Py; } { type Ry; } ); }
        patches (floatingObject); %s
    } }
"""
MOTION["rbf, joints"] = MOTION["rbf"].replace(
    f"type sixDoFRigidBody; {BODY}", f"type rigidBody; {JOINED % ''}"
)
MOTION["OpenFOAM, joints"] = (
    "dynamicFvMesh dynamicMotionSolverFvMesh;"
    "motionSolverLibs (rigidBodyMeshMotion); motionSolver rigidBodyMotion;"
    "rigidBodyMotionCoeffs {%s}"
    % (JOINED % "innerDistance 0.05; outerDistance 0.35;")
)

# What does not move by the flow cannot be compared with what does
PAIRS = {"rbf": "OpenFOAM", "rbf, joints": "OpenFOAM, joints"}

# What is changed, one after the other: file, pattern, what to write
CHANGES = {
    "as it is": [],
    "binary": [
        ("controlDict", r"writeFormat\s+\w+", "writeFormat binary"),
    ],
    "Euler": [
        ("fvSchemes", r"CrankNicolson 0.5", "Euler"),
    ],
    "no previous correction": [
        ("fvSolution", r"alphaApplyPrevCorr\s+yes", "alphaApplyPrevCorr no"),
    ],
    # OpenFOAM evaluates movingWallVelocity from it, before the mesh has moved
    "without meshPhi": [],
}


def run(case, *command):
    with open(case / f"log.{command[0]}", "a") as log:
        subprocess.run(
            command,
            cwd=case,
            check=True,
            stdout=log,
            stderr=subprocess.STDOUT,
            env={**os.environ, "PWD": str(case)},
        )


def substitute(path, pattern, text):
    former = path.read_text()
    path.write_text(re.sub(pattern, text, former))


def meshed(folder):
    """OpenFOAM's case with its mesh and initial fields, made once."""
    case = folder / "meshed"
    if case.exists():
        return case
    tutorials = pathlib.Path(os.environ["WM_PROJECT_DIR"]) / "tutorials"
    original = tutorials / "multiphase/interFoam/RAS/floatingObject"
    new = folder / "meshing"
    shutil.rmtree(new, ignore_errors=True)
    shutil.copytree(original, new)
    control = new / "system/controlDict"
    for key, value in {
        "deltaT": DELTA_T,
        "endTime": STEPS * DELTA_T,
        "writeControl": "timeStep",
        "writeInterval": STEPS // 2,
        "adjustTimeStep": "no",
        "startFrom": "latestTime",
        "runTimeModifiable": "no",
        "writePrecision": 12,
    }.items():
        substitute(control, rf"\n{key}\s+[^;]+", f"\n{key} {value}")
    (new / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict") + MOTION["at rest"]
    )
    run(new, "blockMesh")
    run(new, "topoSet")
    run(new, "subsetMesh", "-overwrite", "c0", "-patch", "floatingObject")
    shutil.copytree(new / "0.orig", new / "0", dirs_exist_ok=True)
    run(new, "setFields")
    new.rename(case)
    return case


def prepared(folder, name, motion, changes):
    case = folder / name
    shutil.copytree(meshed(folder), case)
    (case / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict") + MOTION[motion]
    )
    for change in changes:
        for file, pattern, text in CHANGES[change]:
            substitute(case / "system" / file, pattern, text)
    return case


def vectors(path):
    """A list or the internal field of vectors, ascii or binary."""
    data = path.read_bytes()
    start = re.search(rb"(?:nonuniform List<vector>\s*|\n)(\d+)\s*\(", data)
    n = int(start[1])
    if re.search(rb"format\s+binary", data[:1000]):
        flat = np.frombuffer(data, float, 3 * n, start.end())
    else:
        text = data[start.end() :].split(b"\n)", 1)[0]
        flat = np.array(
            text.replace(b"(", b" ").replace(b")", b" ").split(), float
        )[: 3 * n]
    return flat.reshape(-1, 3)


def compared(folder, motion, changes):
    """Differences of points and velocities at the end, of the largest."""
    name = f"{motion} {' '.join(changes)}".replace(" ", "_")
    end = f"{STEPS * DELTA_T:g}"
    whole, again = folder / name, folder / f"{name}.restarted"
    if not (whole / end).exists():
        shutil.rmtree(whole, ignore_errors=True)
        run(prepared(folder, name, motion, changes), "interFoam")
    if not (again / end).exists():
        shutil.rmtree(again, ignore_errors=True)
        shutil.copytree(whole, again)
        shutil.rmtree(again / end)
        (again / "log.interFoam").unlink()
        if "without meshPhi" in changes:
            (again / f"{STEPS // 2 * DELTA_T:g}/meshPhi").unlink()
        run(again, "interFoam")
    result = {}
    a, b = (vectors(c / end / "U") for c in (whole, again))
    result["velocity"] = np.abs(a - b).max() / np.abs(a).max()
    if motion != "at rest":
        a, b, first = (
            vectors(path / "polyMesh/points")
            for path in (whole / end, again / end, whole / "constant")
        )
        result["points"] = np.abs(a - b).max() / np.abs(a - first).max()
        result["moved"] = np.abs(a - first).max()
    return result


def on_body(points):
    """Those of the box that the tutorial cuts out of its mesh."""
    low, high = np.array([[0.35, 0.35, 0.1], [0.65, 0.55, 0.6]])
    return ((points > low - 1e-9) & (points < high + 1e-9)).all(axis=1)


def cpu(case):
    """Seconds a step."""
    times = re.findall(
        r"ExecutionTime = ([\d.]+)", (case / "log.interFoam").read_text()
    )
    return (float(times[-1]) - float(times[0])) / (len(times) - 1)


def trajectories(folder, motions):
    print(
        "| body by | displacement | difference from OpenFOAM | points that move"
        " | CPU a step [s] | OpenFOAM's |\n|---|---|---|---|---|---|"
    )
    end = f"{STEPS * DELTA_T:g}"
    cases = {}
    for motion in MOTION:
        if motion in PAIRS or motion in PAIRS.values():
            name = "trajectory_" + motion.replace(" ", "_").replace(",", "")
            case = cases[motion] = folder / name
            if not (case / end).exists():
                shutil.rmtree(case, ignore_errors=True)
                prepared(folder, name, motion, [])
                # As far from the body as OpenFOAM's outerDistance
                substitute(
                    case / "constant/dynamicMeshDict",
                    "supportRadius 0.6",
                    "supportRadius 0.35",
                )
                run(case, "interFoam")
    for motion, theirs in PAIRS.items():
        first = vectors(cases[motion] / "constant/polyMesh/points")
        a, b = (
            vectors(cases[m] / end / "polyMesh/points") - first
            for m in (motion, theirs)
        )
        body = on_body(first)
        largest = np.abs(b[body]).max()
        rests = (np.abs(a).max(axis=1) > 1e-9 * largest).sum()
        there = (np.abs(b).max(axis=1) > 1e-9 * largest).sum()
        print(
            f"| {motion} | {largest:.3g} | "
            f"{np.abs(a - b)[body].max() / largest:.1e} | {rests} ({there}) of"
            f" {len(first)} | {cpu(cases[motion]):.2f} | "
            f"{cpu(cases[theirs]):.2f} |",
            flush=True,
        )


def restart(folder, motions):
    steps = list(CHANGES)
    print(
        "| what is changed, with what is above | body by | displacement | "
        "difference of displacement | of velocity |\n|---|---|---|---|---|"
    )
    for i, change in enumerate(steps):
        for motion in motions or ("rbf", "OpenFOAM", "prescribed", "at rest"):
            found = compared(folder, motion, steps[: i + 1])
            print(
                f"| {change} | {motion} | {found.get('moved', 0):.3g} | "
                f"{found.get('points', 0):.1e} | {found['velocity']:.1e} |",
                flush=True,
            )


def main():
    folder = pathlib.Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    {"restart": restart, "trajectories": trajectories}[sys.argv[1]](
        folder, sys.argv[3:]
    )


if __name__ == "__main__":
    main()
