# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The largest angle by which each motion solver can pitch the aerofoil.

    angles.py [-rbfOnly] [-largest DEGREES] [-smallSteps]

One step: the motion solver is applied once to the undeformed mesh, by
morphMesh, for 1, 2, ... degrees until a mesh is invalid: a wrongly oriented
face or a cell without volume. Steps of 1 degree (-smallSteps: of 0.1 degree as
well): moveDynamicMesh, until its mesh check finds such a mesh.
rbfMotionSolver: once for each tenth degree up to the largest.

Writes results/angles.csv and .md and prints the table.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "scripts"))
from foamOutput import readColumns, writeTable  # noqa: E402

laplacians = ["laplacianUniform", "laplacianInverse", "laplacianQuadratic"]
invalid = re.compile(r"incorrectly oriented|negative cell volume")


def makeCase(motion, linearSolver, step=1):
    """A fresh case in runs/angles: the shared dictionaries and the mesh"""
    case = here / "runs/angles" / f"{motion}.{linearSolver}.{step:g}"
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(here / "angles", case,
                    ignore=shutil.ignore_patterns("motions", "linearSolvers"))
    shutil.copytree(here / "constant/polyMesh", case / "constant/polyMesh")
    shutil.copy(here / "angles/motions" / motion, case / "constant/motion")
    shutil.copy(here / "angles/linearSolvers" / linearSolver,
                case / "system/linearSolver")
    (case / "system/angleStep").write_text(f"deltaT {step};\n")
    (case / "0.orig").rename(case / "0")
    return case


def oneStep(case, angle):
    """Applies the motion once to the undeformed mesh; whether the result is
    valid. What an earlier angle wrote goes first: it would be the mesh to
    start from."""
    for time in case.glob("[1-9]*"):
        shutil.rmtree(time)
    shutil.copytree(case / "0", case / str(angle))
    with (case / f"log.morphMesh.{angle}").open("w") as log:
        status = subprocess.run(
            ["morphMesh", "-case", case, "-time", str(angle)],
            stdout=log, stderr=subprocess.STDOUT).returncode
    text = (case / f"log.morphMesh.{angle}").read_text()
    failed = "FOAM FATAL" in text and "invalid" not in text
    if failed or status not in (0, 1):
        sys.exit(f"Error: morphMesh failed, see {log.name}")
    return status == 0


def inOneStep(motion, linearSolver, angles):
    case = makeCase(motion, linearSolver)
    valid = 0
    for angle in angles:
        if not oneStep(case, angle):
            return row(motion, linearSolver, "one", valid, angle)
        valid = angle
    return row(motion, linearSolver, "one", valid, "none found",
               readColumns(case / "postProcessing/morphMesh" / str(valid) /
                           "quality.dat"))


def inManySteps(motion, linearSolver, step):
    case = makeCase(motion, linearSolver, step)
    time, valid = 0.0, 0.0
    with (case / "log.moveDynamicMesh").open("w") as log:
        process = subprocess.Popen(
            ["moveDynamicMesh", "-case", case], text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for line in process.stdout:
            log.write(line)
            if line.startswith("Time = "):
                valid, time = time, float(line.split()[2])
            elif invalid.search(line):
                process.kill()
                process.wait()
                return row(motion, linearSolver, f"of {step:g} deg",
                           valid, time)
        if process.wait():
            sys.exit(f"Error: moveDynamicMesh failed, see {log.name}")
    return row(motion, linearSolver, f"of {step:g} deg", time, "none found")


def row(motion, linearSolver, steps, valid, firstInvalid, quality=None):
    return {
        "motion": motion,
        "linear solver": "" if motion == "rbf" else linearSolver,
        "steps": steps,
        "largest valid [deg]": valid,
        "first invalid [deg]": firstInvalid,
        "max non-orthogonality": quality["maxNonOrthogonality"][-1]
        if quality else "",
        "max skewness": quality["maxSkewness"][-1] if quality else "",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-rbfOnly", action="store_true")
    parser.add_argument("-largest", type=int, default=90)
    parser.add_argument("-smallSteps", action="store_true")
    options = parser.parse_args()

    rows = []
    for motion in [] if options.rbfOnly else laplacians + ["SBRStress"]:
        for linearSolver in ("usual", "converged"):
            rows.append(inOneStep(motion, linearSolver,
                                  range(1, options.largest + 1)))
            rows.append(inManySteps(motion, linearSolver, 1))
        if options.smallSteps:
            rows.append(inManySteps(motion, "converged", 0.1))
    rows.append(inOneStep("rbf", "usual", range(10, options.largest + 1, 10)))
    writeTable(rows, here / "results/angles")


if __name__ == "__main__":
    main()
