# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The largest angle by which each motion solver can pitch the aerofoil.

    angles.py [-motions NAME ...] [-largest DEGREES] [-smallSteps]

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

from morphfoam.output.motion_runs import run_until_invalid
from morphfoam.output.tables import read_columns, write_table

here = Path(__file__).resolve().parent

motions = [
    "laplacianUniform",
    "laplacianInverse",
    "laplacianQuadratic",
    "SBRStress",
    "rbf",
]
invalid = re.compile(r"incorrectly oriented|negative cell volume")


def make_case(motion, linear_solver, step=1):
    """A fresh case in runs/angles: the shared dictionaries and the mesh"""
    case = here / "runs/angles" / f"{motion}.{linear_solver}.{step:g}"
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(
        here / "angles",
        case,
        ignore=shutil.ignore_patterns("motions", "linearSolvers"),
    )
    shutil.copytree(here / "constant/polyMesh", case / "constant/polyMesh")
    shutil.copy(here / "angles/motions" / motion, case / "constant/motion")
    shutil.copy(
        here / "angles/linearSolvers" / linear_solver,
        case / "system/linearSolver",
    )
    (case / "system/angleStep").write_text(f"deltaT {step};\n")
    (case / "0.orig").rename(case / "0")
    return case


def one_step(case, angle):
    """Applies the motion once to the undeformed mesh; whether the result is
    valid. What an earlier angle wrote goes first: it would be the mesh to
    start from."""
    for time in case.glob("[1-9]*"):
        shutil.rmtree(time)
    shutil.copytree(case / "0", case / str(angle))
    with (case / f"log.morphMesh.{angle}").open("w") as log:
        status = subprocess.run(
            ["morphMesh", "-case", case, "-time", str(angle)],
            stdout=log,
            stderr=subprocess.STDOUT,
        ).returncode
    text = (case / f"log.morphMesh.{angle}").read_text()
    failed = "FOAM FATAL" in text and "invalid" not in text
    if failed or status not in (0, 1):
        sys.exit(f"Error: morphMesh failed, see {log.name}")
    return status == 0


def in_one_step(motion, linear_solver, angles):
    case = make_case(motion, linear_solver)
    valid = 0
    for angle in angles:
        if not one_step(case, angle):
            return row(motion, linear_solver, "one", valid, angle)
        valid = angle
    return row(
        motion,
        linear_solver,
        "one",
        valid,
        "none found",
        read_columns(
            case / "postProcessing/morphMesh" / str(valid) / "quality.dat"
        ),
    )


def in_many_steps(motion, linear_solver, step):
    case = make_case(motion, linear_solver, step)
    valid, first_invalid = run_until_invalid(case, invalid)
    if first_invalid is None:
        first_invalid = "none found"
    return row(motion, linear_solver, f"of {step:g} deg", valid, first_invalid)


def row(motion, linear_solver, steps, valid, first_invalid, quality=None):
    return {
        "motion": motion,
        "linear solver": "" if motion == "rbf" else linear_solver,
        "steps": steps,
        "largest valid [deg]": valid,
        "first invalid [deg]": first_invalid,
        "max non-orthogonality": quality["maxNonOrthogonality"][-1]
        if quality
        else "",
        "max skewness": quality["maxSkewness"][-1] if quality else "",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "-motions", nargs="+", default=motions, choices=motions
    )
    parser.add_argument("-largest", type=int, default=90)
    parser.add_argument("-smallSteps", dest="small_steps", action="store_true")
    options = parser.parse_args()

    rows = []
    for motion in options.motions:
        if motion == "rbf":
            continue
        for linear_solver in ("usual", "converged"):
            rows.append(
                in_one_step(
                    motion, linear_solver, range(1, options.largest + 1)
                )
            )
            rows.append(in_many_steps(motion, linear_solver, 1))
        if options.small_steps:
            rows.append(in_many_steps(motion, "converged", 0.1))
    if "rbf" in options.motions:
        rows.append(
            in_one_step("rbf", "usual", range(10, options.largest + 1, 10))
        )
    write_table(rows, here / "results/angles")


if __name__ == "__main__":
    main()
