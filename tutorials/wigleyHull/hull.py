# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The Wigley hull, and the one that it becomes.

    hull.py displacement  writes runs/hull.txt, which dynamicMeshDict reads
    hull.py figures       writes results/figures.md and .csv

The hull of length L, breadth B and draught T is (Wigley 1934)

    y = B/2 (1 - (2 x/L)^2) (1 - (z/T)^2)

so that the same hull of other dimensions is it stretched along the axes.
"""

import re
import sys
from pathlib import Path

import numpy as np

from morphfoam.output.mesh_files import patch_points, read_vectors
from morphfoam.output.tables import write_table

here = Path(__file__).resolve().parent

MESH = here / "constant/polyMesh"

HULL = np.array([1, 0.1, 0.0625])  # L, B, T
STRETCH = np.array([1.2, 1.3, 1.2])


def from_hull(points, dimensions):
    """The largest distance along y of points of the side from the hull."""
    x, y, z = (points / (dimensions / [2, 2, 1])).T
    side = (1 - x**2) * (1 - z**2)
    inside = (np.abs(x) < 0.98) & (z > -0.95)
    return np.abs(y - side)[inside].max() * dimensions[1] / 2


def displacement():
    points = read_vectors(MESH / "points")[patch_points(MESH, "body")]
    (here / "runs").mkdir(exist_ok=True)
    np.savetxt(
        here / "runs/hull.txt",
        np.hstack((points, points * (STRETCH - 1))),
        fmt="%.17g",
    )


def row(images):
    run = here / f"runs/images.{images}"
    log = (run / "log.morphMesh").read_text()
    before = read_vectors(MESH / "points")
    after = read_vectors(run / "1/polyMesh/points")
    hull, middle, water = (
        patch_points(MESH, name) for name in ("body", "middle", "water")
    )
    selected, of = re.search(r"selected (\d+) of (\d+)", log).groups()
    quality = {}
    for when in ("before", "after"):
        found = (
            re.search(rf"^{when} +(.*)", log, re.MULTILINE).group(1).split()
        )
        quality[f"non-orthogonality {when}"] = found[2]
        quality[f"skewness {when}"] = found[3]
        quality[f"wrong faces {when}"] = found[5]
    return {
        "images": images,
        "selected": selected,
        "control points": of,
        **quality,
        "off Wigley before": from_hull(before[hull], HULL),
        "off Wigley after": from_hull(after[hull], HULL * STRETCH),
        "off middle": np.abs(after[middle, 1] - before[middle, 1]).max(),
        "off water": np.abs(after[water, 2] - before[water, 2]).max(),
    }


def figures():
    write_table([row("auto"), row("no")], here / "results/figures")


if __name__ == "__main__":
    {"displacement": displacement, "figures": figures}[sys.argv[1]]()
