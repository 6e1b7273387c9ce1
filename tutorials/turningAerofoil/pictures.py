# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the last valid mesh of each motion."""

import csv
from pathlib import Path

from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

with (here / "results/turn.csv").open() as file:
    for row in csv.DictReader(file):
        picture(
            here / "runs" / row["motion"],
            here / "results" / f"{row['motion']}.png",
            box=(-60, 60, -60, 60),
            width=1200,
        )
