#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""constant/parameters (h/H, e/2H, E/2H of the rib) -> constant/geometry.

What the dictionaries of this case take from there: vertices and cell counts
for blockMesh, where the morph takes each corner, the mean velocity that
carries the flow rate. Lengths in units of the channel's height H.

    geometry.py [-baselineCells] [-refine N]

-baselineCells: the numbers of cells of the baseline's mesh instead of those
that keep its cell size. -refine: so many times the cells in each direction.
"""

import math
import re
import sys
from pathlib import Path

LENGTH = 1.8  # pitch of the ribs
BASE = 0.1  # thickness of the solid base
LAYER = 0.05  # thickness of the boundary layer's mesh
DEPTH = 0.1
BASELINE = {"h": 0.15, "e": 0.305, "E": 0.435}
CELL, FLANK_CELL = 0.0165, 0.0125
BASE_CELLS, LAYER_CELLS, OUTER_CELLS = 6, 10, 49


def read(path):
    text = Path(path).read_text()
    return {
        name: float(re.search(rf"^\s*{name}\s+([^\s;]+)\s*;", text, re.M)[1])
        for name in BASELINE
    }


class Rib:
    """The left half of a rib's outline and of the mesh around it."""

    def __init__(self, h, e, E):
        self.h, self.top, self.width = h, 2 * e, 2 * E
        self.foot = (-E, 0.0)
        self.corner = (-e, h)
        dx, dy = E - e, h
        self.flank = math.hypot(dx, dy)
        along = (dx / self.flank, dy / self.flank)
        normal = (-along[1], along[0])

        # Both corners are between a horizontal line and the flank: the outline
        # of the boundary layer has its corners on their bisectors
        bisector = (normal[0], normal[1] + 1)
        length = math.hypot(*bisector)
        self.bisector = (bisector[0] / length, bisector[1] / length)
        offset = LAYER / self.bisector[1]
        self.outer_foot = self.beyond(self.foot, offset)
        self.outer_corner = self.beyond(self.corner, offset)

        # On the top wall each block has a share as below,
        floor = LENGTH / 2 + self.outer_foot[0]
        flank = math.dist(self.outer_foot, self.outer_corner)
        top = -self.outer_corner[0]
        scale = LENGTH / 2 / (floor + flank + top)
        # and more where the flank is so steep that lines fan out from it
        steep = min(max((-self.bisector[0] - 0.5) / 0.2, 0), 1)
        left = min(self.outer_foot[0], self.outer_corner[0])
        self.above_foot = (
            (1 - steep) * -scale * (top + flank)
            + steep * (left - 0.5 * (LENGTH / 2 + left)),
            1.0,
        )
        self.above_corner = (-scale * top, 1.0)

        self.area = h * (e + E)

    def corners(self):
        """Of the rib and of its layer, as the dictionaries name them."""
        return {
            "foot": self.foot,
            "corner": self.corner,
            "outerFoot": self.outer_foot,
            "outerCorner": self.outer_corner,
        }

    def above(self):
        """Where the lines from there end at the upper wall."""
        return {
            "aboveFoot": self.above_foot,
            "aboveCorner": self.above_corner,
        }

    def beyond(self, x, distance):
        return tuple(a + distance * b for a, b in zip(x, self.bisector))

    def upwards(self, start, end, n=12):
        """Points between, of a curve that leaves along the bisector and
        arrives vertically at the top wall."""
        room = (
            0.5
            * (LENGTH / 2 + self.outer_foot[0])
            / max(-self.bisector[0], 1e-9)
        )
        first = tuple(
            a + min(0.3, room) * b for a, b in zip(start, self.bisector)
        )
        last = (end[0], end[1] - 0.3)
        curve = []
        for i in range(1, n):
            t = i / n
            weights = (
                (1 - t) ** 3,
                3 * t * (1 - t) ** 2,
                3 * t**2 * (1 - t),
                t**3,
            )
            curve.append(
                tuple(
                    sum(
                        w * p[c]
                        for w, p in zip(weights, (start, first, last, end))
                    )
                    for c in (0, 1)
                )
            )
        return curve

    def cells(self, refine=1):
        def number(length, size):
            return refine * max(8, round(length / size))

        return {
            "nBase": refine * BASE_CELLS,
            "nLayer": refine * LAYER_CELLS,
            "nOuter": refine * OUTER_CELLS,
            "nFloor": number(LENGTH / 2 - self.width / 2, CELL),
            "nFlank": number(self.flank, FLANK_CELL),
            "nTop": number(self.top, CELL),
        }


def xy(name, point):
    return [f"{name}X {point[0]:.12g};", f"{name}Y {point[1]:.12g};"]


def polyline(name, points):
    """The same edge on both sides of the rib, at the back and at the front."""
    lines = []
    for side, sign in (("Left", 1), ("Right", -1)):
        for face, z in (("Back", 0), ("Front", DEPTH)):
            text = " ".join(
                f"({sign*x:.12g} {y:.12g} {z:g})" for x, y in points
            )
            lines.append(f"{name}{side}{face} ({text});")
    return lines


def moves(name, old, new):
    d = (new[0] - old[0], new[1] - old[1])
    return [
        f"{name}Dx {d[0]:.12g};",
        f"{name}MinusDx {-d[0]:.12g};",
        f"{name}Dy {d[1]:.12g};",
    ]


def geometry(rib, cells):
    start = Rib(**BASELINE)
    lines = ["// Written by geometry.py from constant/parameters", ""]
    lines += [
        f"xMin {-LENGTH/2};",
        f"xMax {LENGTH/2};",
        f"yMin {-BASE};",
        f"layer {LAYER};",
        f"depth {DEPTH};",
        f"middle {DEPTH/2};",
        "",
    ]
    for name, point in {**rib.corners(), **rib.above()}.items():
        lines += xy(name, point)
        lines.append(f"{name}MinusX {-point[0]:.12g};")
    lines += [""] + polyline(
        "aboveFoot", rib.upwards(rib.outer_foot, rib.above_foot)
    )
    lines += polyline(
        "aboveCorner", rib.upwards(rib.outer_corner, rib.above_corner)
    )
    lines += [""] + [f"{name} {n};" for name, n in cells.items()]

    lines += ["", "// The baseline, and from there"]
    for (name, old), new in zip(
        start.corners().items(), rib.corners().values()
    ):
        lines += xy(f"{name}0", old)
        lines.append(f"{name}0MinusX {-old[0]:.12g};")
        lines += moves(name, old, new)

    volume = LENGTH - rib.area
    lines += ["", f"meanVelocity {LENGTH/volume:.12g};"]
    return "\n".join(lines) + "\n"


def main():
    rib = Rib(**read("constant/parameters"))
    same = "-baselineCells" in sys.argv[1:]
    refine = (
        int(sys.argv[sys.argv.index("-refine") + 1])
        if "-refine" in sys.argv
        else 1
    )
    cells = (Rib(**BASELINE) if same else rib).cells(refine)
    Path("constant/geometry").write_text(geometry(rib, cells))


if __name__ == "__main__":
    main()
