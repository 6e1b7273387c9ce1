# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the mesh on a side wall, moved by each motion
solver as far as it can."""

import csv
from pathlib import Path

from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

with (here / "results/largest.csv").open() as file:
    for row in csv.DictReader(file):
        run = f"{row['motion']}.{row['walls']}"
        picture(
            here / "runs" / run,
            here / "results" / f"{run}.png",
            time=float(row["largest valid"]),
            box=(-6.1, 6.1, -1.6, 1.6),
            width=1600,
        )
