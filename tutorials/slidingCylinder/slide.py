# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far each motion solver can move the cylinder along the duct.

    slide.py [-motions NAME ...] [-walls NAME ...] [-smallSteps]

One step: morphMesh moves the undeformed mesh; the largest valid displacement
is enclosed between one that is valid and one that is not, to within 0.02.
Beside it, from one motion by 5.4: the fraction of it that morphMesh says is
attainable. A motion solver whose field is proportional to the displacement has
to give the same. rbfSubSteps is one step of morphMesh as well, within which
rbfMotionSolver takes as many as it needs. Steps of 0.1 (-smallSteps):
moveDynamicMesh, until its mesh check finds a wrongly oriented face or a cell
without volume.

Writes results/largest.csv and .md and prints the table. The meshes at the
largest valid displacement are left in runs/.
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
    "rbf",
    "rbfSubSteps",
    "laplacianUniform",
    "laplacianQuadratic",
    "SBRStress",
]
resolution, largest = 0.02, 5.4
stopped = re.compile(r"incorrectly oriented|negative cell volume|FOAM FATAL")


def make_case(motion, walls):
    case = here / "runs" / f"{motion}.{walls}"
    shutil.rmtree(case, ignore_errors=True)
    for folder in ("constant", "system"):
        shutil.copytree(here / folder, case / folder)
    shutil.copytree(here / "0.orig", case / "0")
    shutil.copy(here / "motions" / motion, case / "constant/motion")
    shutil.copy(here / "walls" / walls, case / "0/onWalls")
    return case


def name(displacement):
    return f"{displacement:.8g}"


def move(case, displacement):
    """Whether the mesh that morphMesh makes of the undeformed one is valid"""
    time = name(displacement)
    for former in case.glob("[0-9]*"):
        if former.name != "0":
            shutil.rmtree(former)
    shutil.copytree(case / "0", case / time)
    log = case / f"log.morphMesh.{time}"
    with log.open("w") as file:
        status = subprocess.run(
            ["morphMesh", "-case", case, "-time", time],
            stdout=file,
            stderr=subprocess.STDOUT,
        )
    refused = "\nFailed: the moved mesh would be invalid\n" in log.read_text()
    if (status.returncode != 0) != refused:
        sys.exit(f"Error: morphMesh failed, see {log}")
    return not refused


def attainable(case, displacement):
    """Of the motion by this displacement, as morphMesh says"""
    record = case / f"postProcessing/morphMesh/{name(displacement)}/motion"
    return displacement * float(
        re.search(r"attainable\s+(\S+);", record.read_text()).group(1)
    )


def in_one_step(motion, walls):
    case = make_case(motion, walls)
    broken = round(largest / resolution)
    valid = broken if move(case, largest) else 0
    said = attainable(case, largest)
    while broken - valid > 1:
        middle = (valid + broken) // 2
        if move(case, middle * resolution):
            valid = middle
        else:
            broken = middle
    displacement = valid * resolution
    move(case, displacement)
    quality = read_columns(
        case / f"postProcessing/morphMesh/{name(displacement)}/quality.dat"
    )
    return {
        "motion": motion,
        "walls": walls,
        "largest valid": displacement,
        "attainable": said,
        "max non-orthogonality": quality["maxNonOrthogonality"][-1],
        "max skewness": quality["maxSkewness"][-1],
        "off the walls": distance(case, name(displacement)),
    }


def in_small_steps(motion, walls, step=0.1):
    case = make_case(motion, walls)
    control = case / "system/controlDict"
    control.write_text(
        control.read_text()
        .replace("deltaT              1;", f"deltaT              {step};")
        .replace("writeInterval       1;", "writeInterval       1000;")
    )
    valid, _ = run_until_invalid(case, stopped)
    return valid


def points(path):
    body = re.search(r"\n\d+\s*\n\((.*)\n\)", path.read_text(), re.DOTALL)
    return [
        [float(x) for x in point.split()]
        for point in re.findall(r"\(([^()]*)\)", body.group(1))
    ]


def distance(case, time):
    """Of the points of the walls from their planes y = +-1.5, z = +-1, in the
    length of the duct"""
    before = points(case / "constant/polyMesh/points")
    after = points(case / time / "polyMesh/points")
    return max(
        abs(q[i] - p[i]) / 12
        for p, q in zip(before, after)
        for i, plane in ((1, 1.5), (2, 1))
        if abs(abs(p[i]) - plane) < 1e-9
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-motions", nargs="+", default=motions)
    parser.add_argument("-walls", nargs="+", default=["sliding", "fixed"])
    parser.add_argument("-smallSteps", dest="small_steps", action="store_true")
    options = parser.parse_args()

    rows = []
    runs = [
        (motion, walls)
        for walls in options.walls
        for motion in options.motions
        if (motion, walls) != ("rbfSubSteps", "fixed")
    ]  # minutes
    for motion, walls in runs:
        small = (
            {"steps of 0.1": in_small_steps(motion, walls)}
            if options.small_steps
            else {}
        )
        rows.append({**in_one_step(motion, walls), **small})
    write_table(rows, here / "results/largest")


if __name__ == "__main__":
    main()
