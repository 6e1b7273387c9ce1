# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The twist of OpenFOAM's column at each step: by 180 degrees and back, and the
same to the other side.

    twist.py CASE       writes constant/boundaryData for the case's patches
"""

import math
import re
import sys
from pathlib import Path

HEIGHT = 8
STEPS = 40
PATCHES = ("sides", "floor", "top")


def angle(time):
    """Of the top."""
    return math.pi * math.sin(math.pi * time / 20)


def twisted(point, time):
    x, y, z = point
    a = angle(time) * z / HEIGHT
    return (
        x * math.cos(a) - y * math.sin(a),
        x * math.sin(a) + y * math.cos(a),
        z,
    )


def read_points(file):
    return [
        tuple(map(float, row.split()))
        for row in re.findall(
            r"^\((\S+ \S+ \S+)\)$", Path(file).read_text(), re.MULTILINE
        )
    ]


def list_of(vectors):
    return (
        "(\n"
        + "".join("({!r} {!r} {!r})\n".format(*v) for v in vectors)
        + ")\n"
    )


def main(case):
    points = [
        p
        for p in read_points(case / "constant/polyMesh/points")
        if abs(p[0]) > 0.4999 or abs(p[1]) > 0.4999 or p[2] in (0, HEIGHT)
    ]
    for patch in PATCHES:
        folder = case / "constant/boundaryData" / patch
        folder.mkdir(parents=True)
        (folder / "points").write_text(list_of(points))
        for time in range(STEPS + 1):
            (folder / str(time)).mkdir()
            (folder / str(time) / "pointDisplacement").write_text(
                list_of(
                    tuple(b - a for a, b in zip(p, twisted(p, time)))
                    for p in points
                )
            )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
