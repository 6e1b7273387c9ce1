# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The passage of a blade row, and what the blade is to do.

    passage.py mesh          maps the box that blockMesh made onto the passage
    passage.py displacement  writes runs/blade.txt, which dynamicMeshDict reads

In the box, X is along the axis in chords, Y the pitch from one periodic side
to the other, Z the height from hub to casing. The blade is the hole between
X = 0 and 1, Y = 0.45 and 0.55, Z = 0 and 0.98: above it is the tip gap.
"""

import re
import sys
from pathlib import Path

import numpy as np

from morphfoam.output.mesh_files import (
    patch_points,
    read_vectors,
    replace_vectors,
)

here = Path(__file__).resolve().parent

MESH = here / "constant/polyMesh"

BLADES = 12
HUB, CASING = 0.5, 1.0
CHORD = 0.4
PITCH = 2 * np.pi / BLADES
TIP = HUB + 0.98 * (CASING - HUB)

TWIST = np.radians(20)  # of the tip about the blade's own axis
LEAN = np.radians(6)  # of the tip about the machine's axis


def polar(points):
    """x, angle and radius around the x-axis."""
    x, y, z = points.T
    return x, np.arctan2(y, z), np.hypot(y, z)


def cartesian(x, angle, r):
    return np.column_stack((x, r * np.sin(angle), r * np.cos(angle)))


def passage(box):
    X, Y, Z = box.T
    inside = np.clip(X, 0, 1)
    # In pitches: half the blade's thickness, blunt at its ends, and camber
    half = 0.006 + 0.12 * inside * (1 - inside) * (1 - 0.4 * inside)
    camber = 0.55 * inside * (1 - 0.55 * inside) + 0.55 * (
        1 - 1.1
    ) * np.maximum(X - 1, 0)
    edge = 0.45
    Y = np.select(
        [Y < edge, Y > 1 - edge],
        [Y / edge * (0.5 - half), 1 - (1 - Y) / edge * (0.5 - half)],
        0.5 + (Y - 0.5) / (0.5 - edge) * half,
    )
    return cartesian(
        CHORD * X, PITCH * (Y - 0.5 + camber - 0.2), HUB + (CASING - HUB) * Z
    )


def mesh():
    replace_vectors(MESH / "points", passage(read_vectors(MESH / "points")))
    boundary = (MESH / "boundary").read_text()
    (MESH / "boundary").write_text(
        re.sub(
            r"transform\s+\w+;",
            "transform rotational; rotationAxis (1 0 0); rotationCentre (0 0 0);",
            boundary,
        )
    )


def blade(points):
    """Where they go: each section turns about (0.5 chord, camber) on its
    cylinder, by an angle that grows from the hub, and leans. The radius stays,
    and with it the tip gap."""
    x, angle, r = polar(points)
    s = (r - HUB) / (TIP - HUB)
    middle = PITCH * (0.55 * 0.5 * (1 - 0.55 * 0.5) - 0.2)
    a, b = x - 0.5 * CHORD, r * (angle - middle)
    c, d = np.cos(TWIST * s), np.sin(TWIST * s)
    return cartesian(
        0.5 * CHORD + c * a - d * b, middle + (d * a + c * b) / r + LEAN * s, r
    )


def displacement():
    points = read_vectors(MESH / "points")[patch_points(MESH, "blade")]
    (here / "runs").mkdir(exist_ok=True)
    np.savetxt(
        here / "runs/blade.txt",
        np.hstack((points, blade(points) - points)),
        fmt="%.17g",
    )


if __name__ == "__main__":
    {"mesh": mesh, "displacement": displacement}[sys.argv[1]]()
