# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""bodyTutorials.py trajectories|restart FOLDER [CASE ...]: OpenFOAM's tutorials
with bodies, moved by us and by the solvers that they have.

trajectories: by which the bodies differ, of the largest displacement, over all
times written; CPU of the motion in a step, median of those after the first.

restart: the difference of all points between a whole run and one that is
restarted half-way, of the largest displacement: on one rank, and on two and
then three, beside a whole run on two. Schemes leave nothing to what a restart
of the flow does not read (bodies.py).

CASE is a part of a name below. Cases are made in FOLDER, which keeps what has
run; etc/bashrc is to be sourced, PYTHONPATH=../tests/dropIn:../tests/support
given, and tests/dropIn/motionClock built (wmake libso).
"""

import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from bodies import vectors
from foamCase import environment
from movingTutorials import tutorials
from openfoam import header
from tutorialCase import Mesh, TutorialCase

# Steps, and what is particular: a time step, or how far the mesh moves
CASES = {
    "RAS/floatingObject": dict(steps=40, deltaT=0.005),
    "RAS/floatingObject.sixDoF": dict(steps=40, deltaT=0.005),
    "RAS/DTCHullMoving": dict(steps=40),
    "RAS/DTCHullMoving.sixDoF": dict(steps=40),
    "wingMotion2D_pimpleFoam": dict(steps=40, deltaT=1e-4),
    "floatingBody/background": dict(steps=20),
    "floatingBodyWithSpring/background": dict(steps=20),
    "boatAndPropeller": dict(steps=8),
}
TIMES = 4

RESTARTABLE = (
    ("fvSchemes", r"CrankNicolson[^;]*", "Euler"),
    ("fvSolution", r"alphaApplyPrevCorr\s+\w+", "alphaApplyPrevCorr no"),
)


def chosen(parts):
    """(name, tutorial) of those that a part of the name selects."""
    source = pathlib.Path(environment()["FOAM_TUTORIALS"])
    every = tutorials(source)
    for name, changes in CASES.items():
        if not parts or any(part in name for part in parts):
            tutorial = next(t for t in every if t.name.endswith(name))
            yield name, source, dataclasses.replace(tutorial, **changes)


def prepared(source, tutorial, folder):
    """The case with its mesh, made once."""
    made = folder / "made"
    case = TutorialCase.__new__(TutorialCase)
    if not made.exists():
        case = TutorialCase(tutorial, source, folder)
        case.prepare()
        made.write_text(f"{case.case}\n{case.application}\n")
    case.tutorial, case.folder = tutorial, folder
    path, case.application = made.read_text().split()
    case.case = pathlib.Path(path)
    control = case.case / "system/controlDict"
    control.write_text(
        control.read_text() + f"writeInterval {tutorial.steps // TIMES};\n"
    )
    return case


def jointed(case):
    """Ours with the dictionary of OpenFOAM's rigidBodyMotion as it is."""
    text = re.sub(r"FoamFile\s*\{.*?\}", "", case.dictionary, flags=re.S)
    mesh = re.search(r"dynamicFvMesh\s+(\w+);", text)[1]
    text = re.sub(r"//[^\n]*", "", text)
    entries = re.sub(
        r"(dynamicFvMesh|motionSolverLibs|motionSolver)\s[^;]*;", "", text
    )
    if "rigidBodyMotionCoeffs" not in entries:
        entries = f"rigidBodyMotionCoeffs {{ {entries} }}"
    return (
        header("dynamicMeshDict")
        + f"dynamicFvMesh {mesh}; motionSolverLibs (morphMotionSolvers);"
        f"motionSolver rbfMotionSolver;\n{entries}\n"
        "rbfMotionSolverCoeffs { controlPoints { body { type moving;"
        f" patches ({' '.join(case.tutorial.bodies)}); displacement"
        " { type rigidBody; $:rigidBodyMotionCoeffs; } }"
        f" stay {{ type fixed; patches ({' '.join(case.others())}); }} }} }}\n"
    )


def ours(case):
    """The dictionary with the same body, and how far the mesh is to move."""
    text = case.dictionary
    outer = re.search(r"outerDistance\s+([\d.]+)", text)
    if re.search(r"^\s*motionSolver\s+rigidBodyMotion;", text, re.M):
        text = jointed(case)
    else:
        said = case.run("refused", case.two_lines()).message
        text = case.two_lines(case.tutorial.change(said, case.others()))
    if outer and float(outer[1]) < 10:
        text = text.replace(
            "rbfMotionSolverCoeffs\n{",
            "rbfMotionSolverCoeffs {",
        ).replace(
            "rbfMotionSolverCoeffs {",
            f"rbfMotionSolverCoeffs {{ supportRadius {outer[1]};",
        )
    return text


def positions(run):
    """Points at each time written."""
    return [run.points(time) for time in run.times()]


def trajectory(name, source, tutorial, folder):
    case = prepared(source, tutorial, folder)
    theirs = case.run("original")
    mine = case.run("ours", ours(case))
    for run in (theirs, mine):
        if not run.good:
            return f"| {name} | {run.folder.name}: {run.message} |"
    first = theirs.points()
    patches = Mesh(theirs.folder).patches
    body = np.unique(np.concatenate([patches[p] for p in tutorial.bodies]))
    far = off = 0
    for a, b in zip(positions(theirs), positions(mine)):
        far = max(far, np.linalg.norm(a - first, axis=1)[body].max())
        off = max(off, np.linalg.norm(a - b, axis=1)[body].max())
    steps = [np.median(run.motion_seconds()[1:]) for run in (theirs, mine)]
    whole = [run.cpu / tutorial.steps for run in (theirs, mine)]
    return (
        f"| {name} | {len(first)} | {far:.3g} | {off / far:.1e} |"
        f" {1e3 * steps[0]:.3g} → {1e3 * steps[1]:.3g} |"
        f" {steps[1] / steps[0]:.2f} | {whole[0]:.3g} → {whole[1]:.3g} |"
        f" {whole[1] / whole[0]:.2f} |"
    )


def call(case, *command):
    with open(case / "log.run", "a") as log:
        done = subprocess.run(
            command,
            cwd=case,
            env=dict(environment(), PWD=str(case)),
            stdout=log,
            stderr=subprocess.STDOUT,
        )
    if done.returncode:
        raise RuntimeError(f"{case}: {' '.join(command)} failed")


def in_parallel(case, ranks, program):
    (case / "system/decomposeParDict").write_text(
        header("decomposeParDict")
        + f"numberOfSubdomains {ranks}; method simple;"
        f" simpleCoeffs {{ n ({ranks} 1 1); delta 0.001; }}"
    )
    call(case, "decomposePar", "-force", "-latestTime")
    call(
        case, "mpirun", "-np", str(ranks), "--oversubscribe", program,
        "-parallel",
    )  # fmt: skip
    call(case, "reconstructPar", "-latestTime")


def at_end(case):
    times = [
        path
        for path in case.iterdir()
        if re.fullmatch(r"[0-9.e+-]+", path.name) and float(path.name) > 0
    ]
    last = max(times, key=lambda path: float(path.name))
    return vectors(last / "polyMesh/points")


def run_to(case, program, end, ranks):
    control = case / "system/controlDict"
    control.write_text(control.read_text() + f"endTime {end!r};\n")
    if ranks == 1:
        call(case, program)
    else:
        in_parallel(case, ranks, program)


def differences(case, dictionary, folder):
    """On one rank, and on two and then three; and the largest displacement."""
    base = folder / "base"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(case.case, base)
    (base / "constant/dynamicMeshDict").write_text(dictionary)
    for file, pattern, text in RESTARTABLE:
        path = base / "system" / file
        path.write_text(re.sub(pattern, text, path.read_text()))
    control = base / "system/controlDict"
    text = control.read_text()
    step = float(re.findall(r"deltaT ([^;]+);", text)[-1])
    n = case.tutorial.steps // 2
    control.write_text(
        text + "writeFormat binary; startFrom latestTime;\n"
        f"writeInterval {n // 2};\n"
    )
    half, end = step * (n // 2), step * n
    first = vectors(base / "constant/polyMesh/points")
    found = []
    for before, after in ((1, 1), (2, 3)):
        whole, again = folder / f"whole{before}", folder / f"again{before}"
        for path in (whole, again):
            shutil.copytree(base, path)
        run_to(whole, case.application, end, before)
        run_to(again, case.application, half, before)
        run_to(again, case.application, end, after)
        a, b = at_end(whole), at_end(again)
        far = np.linalg.norm(a - first, axis=1).max()
        found.append(np.linalg.norm(a - b, axis=1).max() / far)
    return found, far


def restart(name, source, tutorial, folder):
    case = prepared(source, tutorial, folder)
    cells = [f"| {name} "]
    for which, text in (("ours", ours(case)), ("theirs", case.dictionary)):
        try:
            found, far = differences(case, text, folder / f"restart.{which}")
            cells.append(f"{far:.3g} | {found[0]:.1e} | {found[1]:.1e}")
        except RuntimeError as error:
            cells.append(f"{error} | | ")
    return " | ".join(cells) + " |"


MODES = {
    "trajectories": (
        trajectory,
        "| case | points | displacement [m] | difference of the bodies |"
        " CPU of the motion a step, OpenFOAM → here [ms] | ratio |"
        " whole run a step [s] | ratio |\n|---|---|---|---|---|---|---|---|",
    ),
    "restart": (
        restart,
        "| case | displacement [m] | one rank | 2 → 3 ranks |"
        " OpenFOAM's [m] | one rank | 2 → 3 ranks |\n"
        "|---|---|---|---|---|---|---|",
    ),
}


def main():
    mode, head = MODES[sys.argv[1]]
    folder = pathlib.Path(sys.argv[2]).resolve()
    os.environ.update(environment())
    print(head, flush=True)
    for name, source, tutorial in chosen(sys.argv[3:]):
        where = folder / name.replace("/", ".")
        where.mkdir(parents=True, exist_ok=True)
        print(mode(name, source, tutorial, where), flush=True)


if __name__ == "__main__":
    main()
