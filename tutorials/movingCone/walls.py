# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Where the walls of the cone are at the end, by us and by OpenFOAM's
velocityComponentLaplacian, and where a velocity of 1 m/s takes them
(results/walls.md)."""

import re
from pathlib import Path

import numpy as np

from morphfoam.output.tables import write_table

here = Path(__file__).resolve().parent
SPEED = 1.0


def numbers(path):
    text = path.read_text()
    start = re.search(r"\n(\d+)\s*\(", text)
    body = text[start.end() :].rsplit(")", 1)[0]
    flat = body.replace("(", " ").replace(")", " ").split()
    return np.array(flat, float)


def points(case, time):
    return numbers(here / "runs" / case / time / "polyMesh/points").reshape(
        -1, 3
    )


def patch(name):
    """Labels of the points of a patch."""
    mesh = here / "runs/rbf/constant/polyMesh"
    found = re.search(
        rf"\b{name}\s*\{{.*?nFaces\s+(\d+);\s*startFace\s+(\d+);",
        (mesh / "boundary").read_text(),
        re.DOTALL,
    )
    n, start = int(found[1]), int(found[2])
    faces = re.findall(r"^\d+\(([\d ]+)\)", (mesh / "faces").read_text(), re.M)
    return sorted(
        {int(i) for face in faces[start : start + n] for i in face.split()}
    )


end = max(
    (path.name for path in (here / "runs/rbf").glob("[0-9]*")), key=float
)
first = points("rbf", "constant")
ours, theirs = (
    points(case, end) for case in ("rbf", "velocityComponentLaplacian")
)
largest = SPEED * float(end)
rows = []
for name, velocity in (("movingWall", SPEED), ("fixedWall", 0), ("left", 0)):
    on = patch(name)
    told = first[on] + [velocity * float(end), 0, 0]
    rows.append(
        {
            "patch": name,
            "from OpenFOAM's": np.abs(ours[on] - theirs[on]).max() / largest,
            "from the integral of its velocity": np.abs(ours[on] - told).max()
            / largest,
        }
    )
write_table(rows, here / "results/walls")
