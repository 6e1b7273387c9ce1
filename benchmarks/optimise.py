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
import tempfile

import numpy as np

here = pathlib.Path(__file__).resolve().parent

FACES = {
    "xMin": "0 4 7 3",
    "xMax": "1 2 6 5",
    "yMin": "0 1 5 4",
    "yMax": "3 7 6 2",
    "zMin": "0 3 2 1",
    "zMax": "4 5 6 7",
}
CONTROL = """startFrom startTime; startTime 0; stopAt endTime; endTime 1;
deltaT 1; writeControl timeStep; writeInterval 1;"""
SCHEMES = """ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {}
interpolationSchemes {} snGradSchemes {}"""


def write(path, class_name, body):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        "FoamFile { version 2.0; format ascii; "
        f"class {class_name}; object {path.name}; }}\n\n{body}\n"
    )


def run(case, *command, check=True):
    out = subprocess.run(
        [*command], cwd=case, stdout=subprocess.PIPE, text=True, check=check
    )
    return out.stdout


def box(case, cells, planar):
    """A unit cube of so many cells."""
    sides = "\n".join(
        f"{side} {{ type {'empty' if planar and side[0] == 'z' else 'patch'}; "
        f"faces (({corners})); }}"
        for side, corners in FACES.items()
    )
    write(
        case / "system/blockMeshDict",
        "dictionary",
        "scale 1; vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) "
        "(1 1 1) (0 1 1));\nblocks (hex (0 1 2 3 4 5 6 7) "
        f"({' '.join(map(str, cells))}) simpleGrading (1 1 1));\n"
        f"edges ();\nboundary\n(\n{sides}\n);",
    )
    write(case / "system/controlDict", "dictionary", CONTROL)
    write(case / "system/fvSchemes", "dictionary", SCHEMES)
    write(case / "system/fvSolution", "dictionary", "")
    run(case, "blockMesh")


def read_points(file):
    body = re.search(r"\n(\d+)\s*\((.*)\)", file.read_text(), re.DOTALL)[2]
    numbers = body.replace("(", " ").replace(")", " ").split()
    return np.array(numbers, float).reshape(-1, 3)


def write_points(case, points, name):
    rows = "\n".join("(%.17g %.17g %.17g)" % tuple(x) for x in points)
    write(
        case / f"constant/polyMesh/{name}",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


def cpu_and_memory(case, *options):
    """Iterations, CPU seconds, the largest memory [kB] of any run so far."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = run(case, "morphMesh", "-optimise", "-dryRun", *options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (
        int(re.search(r"(\d+) iterations", out)[1]),
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        after.ru_maxrss,
    )


def cost(case, cells):
    planar = cells[2] == 1
    box(case, cells, planar)
    x = read_points(case / "constant/polyMesh/points")
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
        write(
            case / "system/optimiseDict",
            "dictionary",
            f"power 1; iterations {n};",
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
    command = ("morphMesh", "-dryRun", "-time", str(angle))
    out = run(folder, *command, check=False)
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
