# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far points of the column are from where the twist takes them, and what
moveDynamicMesh says of the mesh (results/twist.csv and .md)."""

import math
import re
import sys
from pathlib import Path

from twist import angle, readPoints, twisted

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "scripts"))
from foamOutput import writeTable  # noqa: E402

case = here / "runs/rbf"
log = (case / "log.moveDynamicMesh").read_text()
reference = readPoints(case / "constant/polyMesh/points")


def quality(time):
    """Largest non-orthogonality and skewness, in the log of a step"""
    step = log[log.index(f"\nTime = {time}\n"):]
    return (float(re.search(r"non-orthogonality Max: (\S+)", step)[1]),
            float(re.search(r"Max skewness = (\S+)", step)[1]))


rows = []
for time in (2, 5, 10, 20, 30, 40):
    points = readPoints(case / str(time) / "polyMesh/points")
    nonOrthogonality, skewness = quality(time)
    rows.append({
        "time": time,
        "twist [deg]": round(math.degrees(angle(time)), 6),
        "largest distance": max(
            math.dist(a, twisted(x, time)) for a, x in zip(points, reference)),
        "non-orthogonality": nonOrthogonality,
        "skewness": skewness,
    })
writeTable(rows, here / "results/twist")
