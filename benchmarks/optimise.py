# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What optimising a mesh costs, and what it reaches.

    optimise.py FILE.md [-quick]        (with the environment of etc/bashrc)

Cost: CPU time per cell and iteration of morphMesh -optimise on boxes whose
inner points are shifted at random, from two runs that differ in the number of
iterations alone, and the memory of the larger.
Reach: airFoil2D turned about its mid-chord in one step.
"""

import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

import numpy as np

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "tests/support"))

from boxCase import box  # noqa: E402
from foamCase import FoamCase  # noqa: E402

SIDES = ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")


def write_points(case, points, name):
    rows = "\n".join("(%.17g %.17g %.17g)" % tuple(x) for x in points)
    case.write(
        f"constant/polyMesh/{name}",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


def cpu_and_memory(case, *options):
    """Iterations, CPU seconds, the largest memory [kB] of any run so far."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = case.run("morphMesh", "-optimise", "-dryRun", *options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (
        int(re.search(r"(\d+) iterations", out)[1]),
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        after.ru_maxrss,
    )


def cost(folder, cells):
    planar = cells[2] == 1
    patches = {
        side: "empty" if planar and side[0] == "z" else "patch"
        for side in SIDES
    }
    case = box(folder, patches, cells=cells, control={"digits": 17})
    x = case.points("constant/polyMesh/points")
    write_points(case, x, "points0")
    random = np.random.default_rng(0)
    axes = [0, 1] if planar else [0, 1, 2]
    inside = ((x > 1e-9) & (x < 1 - 1e-9))[:, axes].all(1)
    shift = random.uniform(-0.2, 0.2, x.shape) / cells[0]
    if planar:
        n = len(x) // 2
        shift[n:] = shift[:n]
    for axis in axes:
        x[inside, axis] += shift[inside, axis]
    write_points(case, x, "points")
    runs = []
    for n in (4, 24):
        case.write(
            "system/optimiseDict", "dictionary", f"power 1; iterations {n};"
        )
        runs.append(cpu_and_memory(case, "-noMotion"))
    n = int(np.prod(cells))
    (few, t0, _), (many, t1, memory) = runs
    return (t1 - t0) / (many - few) / n * 1e6, memory / n


def reach(folder, angle, optimised):
    tutorial = here.parent / "tutorials/turningAerofoil"
    for part in ("constant", "system"):
        shutil.copytree(tutorial / part, folder / part, dirs_exist_ok=True)
    mesh = "incompressible/simpleFoam/airFoil2D/constant/polyMesh"
    shutil.copytree(
        pathlib.Path(os.environ["FOAM_TUTORIALS"]) / mesh,
        folder / "constant/polyMesh",
        dirs_exist_ok=True,
    )
    (folder / "constant/motion").write_text(
        "onInvalidMesh ignore;"
        + ("optimise { when always; iterations 600; }" if optimised else "")
    )
    out = FoamCase(folder).run("morphMesh", "-dryRun", "-time", str(angle))
    row = re.search(r"^after.*", out, re.MULTILINE)[0].split()
    return "folded" if float(row[6]) else f"{float(row[3]):.1f}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("-quick", action="store_true")
    options = parser.parse_args()
    sizes = [(100, 100, 1), (20, 20, 20)]
    if not options.quick:
        sizes += [(400, 400, 1), (50, 50, 50)]
    lines = [
        "| cells | CPU per cell and iteration [us] | memory per cell [kB] |",
        "|---|---|---|",
    ]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for i, cells in enumerate(sizes):
            time, memory = cost(folder / str(i), cells)
            lines.append(
                f"| {' x '.join(map(str, cells))} | {time:.2f} | "
                f"{memory:.1f} |"
            )
            print(lines[-1], flush=True)
        lines += ["", "| angle | as moved | optimised |", "|---|---|---|"]
        for angle in (90,) if options.quick else (90, 120, 150, 180, 210):
            found = [
                reach(folder / f"{angle}.{o}", angle, o) for o in (False, True)
            ]
            lines.append(f"| {angle} | {found[0]} | {found[1]} |")
            print(lines[-1], flush=True)
    pathlib.Path(options.file).write_text("\n".join(lines) + "\n")


main()
