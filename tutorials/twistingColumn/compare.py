# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far points of the column are from where the twist takes them, and what
moveDynamicMesh says of the mesh (results/twist.csv and .md)."""

import math
import re
from pathlib import Path

from morphfoam.output.tables import write_table

from twist import angle, read_points, twisted

here = Path(__file__).resolve().parent

case = here / "runs/rbf"
log = (case / "log.moveDynamicMesh").read_text()
reference = read_points(case / "constant/polyMesh/points")


def quality(time):
    """Largest non-orthogonality and skewness, in the log of a step"""
    step = log[log.index(f"\nTime = {time}\n") :]
    return (
        float(re.search(r"non-orthogonality Max: (\S+)", step)[1]),
        float(re.search(r"Max skewness = (\S+)", step)[1]),
    )


rows = []
for time in (2, 5, 10, 20, 30, 40):
    points = read_points(case / str(time) / "polyMesh/points")
    non_orthogonality, skewness = quality(time)
    rows.append(
        {
            "time": time,
            "twist [deg]": round(math.degrees(angle(time)), 6),
            "largest distance": max(
                math.dist(a, twisted(x, time))
                for a, x in zip(points, reference)
            ),
            "non-orthogonality": non_orthogonality,
            "skewness": skewness,
        }
    )
write_table(rows, here / "results/twist")
