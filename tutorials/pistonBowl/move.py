# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Moves piston or bowl and says what becomes of the mesh.

    move.py [-motions NAME ...]

Each motion in motions/ is made once by morphMesh. Writes results/motions.csv
and .md and prints the table: figures of quality, and how far points of liner,
crown, head and symmetry plane are from their surfaces, in diameters of the bore.
"""

import argparse
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

from morphfoam.output.tables import read_columns, write_table

here = Path(__file__).resolve().parent

motions = ["stroke", "offset", "reentrant"]
radius, head = 0.04, 0.03


def points(path):
    body = re.search(r"\n\d+\s*\n\((.*)\n\)", path.read_text(), re.DOTALL)
    return [
        [float(x) for x in point.split()]
        for point in re.findall(r"\(([^()]*)\)", body.group(1))
    ]


def off_surfaces(before, after, crown):
    """Largest distances of points from the surfaces that they were on.

    crown: how far the piston goes up"""
    near = 1e-9
    off = {"liner": 0.0, "crown": 0.0, "head": 0.0, "symmetry": 0.0}

    def note(name, distance):
        off[name] = max(off[name], abs(distance) / (2 * radius))

    for (x, y, z), (u, v, w) in zip(before, after):
        if abs(math.hypot(x, y) - radius) < near:
            note("liner", math.hypot(u, v) - radius)
        if abs(z - head) < near:
            note("head", w - head)
        if abs(z) < near and math.hypot(x, y) > 0.022 - near:
            note("crown", w - crown)
        if abs(y) < near:
            note("symmetry", v)
    return off


def move(motion):
    case = here / "runs" / motion
    shutil.rmtree(case, ignore_errors=True)
    for folder in ("constant", "system"):
        shutil.copytree(here / folder, case / folder)
    shutil.copy(here / "motions" / motion, case / "constant/motion")
    log = case / "log.morphMesh"
    with log.open("w") as file:
        status = subprocess.run(
            ["morphMesh", "-case", case, "-time", "1"],
            stdout=file,
            stderr=subprocess.STDOUT,
        )
    if status.returncode:
        sys.exit(f"Error: morphMesh failed, see {log}")

    folder = case / "postProcessing/morphMesh/1"
    quality = read_columns(folder / "quality.dat")
    steps = re.search(r"subSteps\s+(\d+);", (folder / "motion").read_text())
    off = off_surfaces(
        points(case / "constant/polyMesh/points"),
        points(case / "1/polyMesh/points"),
        0.028 if motion == "stroke" else 0,
    )
    return {
        "motion": motion,
        "steps": int(steps.group(1)),
        "max non-orthogonality": quality["maxNonOrthogonality"][-1],
        "max skewness": quality["maxSkewness"][-1],
        "wrong faces": quality["wronglyOrientedFaces"][-1],
        **{f"off {name}": f"{value:.1e}" for name, value in off.items()},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-motions", nargs="+", default=motions)
    rows = [move(motion) for motion in parser.parse_args().motions]
    write_table(rows, here / "results/motions")


if __name__ == "__main__":
    main()
