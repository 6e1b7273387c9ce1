# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""remesh.py FOLDER: the tutorial slidingCylinder re-meshed.

whole: all cells replaced at once by morphRemesh.
slide: the cylinder goes 5.4 along its duct and back in steps of 0.1, by
moveDynamicMesh with morphRemeshFvMesh, until a mesh exceeds 80 degrees.

Cases are made in FOLDER; etc/bashrc is to be sourced. Prints a table.
"""

import pathlib
import re
import resource
import shutil
import subprocess
import sys

from openfoam import header, run

TUTORIAL = pathlib.Path(__file__).parents[1] / "tutorials/slidingCylinder"

REMESH = header("remeshDict") + "remesh { region all; }"

DYNAMIC = (
    header("dynamicMeshDict")
    + """
dynamicFvMesh       morphRemeshFvMesh;
dynamicFvMeshLibs   (morphRemesh);
motionSolverLibs    (morphMotionSolvers);
motionSolver        rbfMotionSolver;
rbfMotionSolverCoeffs
{
    supportRadius   12;
    greedy          { tolerance 1e-3; }
}
remesh
{
    limits          { nonOrthogonality 72; skewness 4; }
    layers          3;
    keepLayers      0;
    keepPatches     (cylinder);
    maxRemeshes     100;
}
"""
)
THERE_AND_BACK = "table ((0 (0 0 0)) (5.4 (5.4 0 0)) (10.8 (0 0 0)))"
MOST = 80.0


def made(folder):
    """The tutorial's mesh and fields."""
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("constant", "system"):
        shutil.copytree(TUTORIAL / part, folder / part)
    shutil.rmtree(folder / "constant/polyMesh", ignore_errors=True)
    shutil.copytree(TUTORIAL / "0.orig", folder / "0")
    shutil.copy(TUTORIAL / "walls/sliding", folder / "0/onWalls")
    run(folder, "blockMesh")
    return folder


def used():
    """Processor time of what has run [s]."""
    times = resource.getrusage(resource.RUSAGE_CHILDREN)
    return times.ru_utime + times.ru_stime


def whole(folder):
    case = made(folder)
    (case / "system/remeshDict").write_text(REMESH)
    before = used()
    told = run(case, "morphRemesh", "-overwrite")
    seconds = used() - before
    for name in ("before", "after"):
        row = re.search(rf"^{name} +(\S+) +\S+ +(\S+) +(\S+)", told, re.M)
        cost = f"{seconds:.1f}" if name == "after" else ""
        print(f"| {name} | {row[1]} | {row[2]} | {row[3]} | {cost} |")
    print("\nVolume, relative change:", re.search(r"change (\S+)", told)[1])
    checked = run(case, "checkMesh")
    print("checkMesh:", re.search(r"Mesh OK|Failed .* checks", checked)[0])


def slide(folder):
    case = made(folder)
    (case / "constant/dynamicMeshDict").write_text(DYNAMIC)
    field = case / "0/pointDisplacement"
    text = re.sub(r"table \(\(.*\)\)", THERE_AND_BACK, field.read_text())
    field.write_text(text)
    control = case / "system/controlDict"
    text = re.sub(r"(endTime +)\S+;", r"\g<1>10.8;", control.read_text())
    text = re.sub(r"(deltaT +)\S+;", r"\g<1>0.1;", text)
    control.write_text(text)
    before = used()
    process = subprocess.Popen(
        ["moveDynamicMesh"],
        cwd=case,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    time = largest = remeshes = 0
    with (case / "log").open("w") as log:
        for line in process.stdout:
            log.write(line)
            if match := re.match(r"Time = (\S+)", line):
                time = float(match[1])
            remeshes += line.startswith("Re-meshing")
            match = re.search(r"non-orthogonality Max: (\S+)", line)
            if match and float(match[1]) > MOST:
                process.kill()
                break
            if match:
                largest = max(largest, float(match[1]))
    process.wait()
    at = time if time <= 5.4 else 10.8 - time
    way = "there" if time <= 5.4 else "back"
    print(
        f"\nAt most {largest:.1f} degrees, re-meshed {remeshes} times; "
        f"{MOST:g} degrees "
        + (f"passed at {at:.1f} on the way {way}" if match else "never passed")
        + f", {used() - before:.0f} CPU s"
    )


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1]).resolve()
    print("| mesh | cells | non-orthogonality | skewness | CPU [s] |")
    print("| --- | --- | --- | --- | --- |")
    whole(folder / "whole")
    slide(folder / "slide")


if __name__ == "__main__":
    main()
