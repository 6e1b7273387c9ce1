# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures of a sweep: pictures.py STUDY, under withDisplay.

Meshes of the baseline, the highest and the lowest design; temperature and
velocity of the two that are best at one thing.
"""

import csv
import sys
from pathlib import Path

from morphfoam.pictures.picture import picture


study = Path(sys.argv[1])
results = Path("results")
with (study / "results.morph.csv").open() as file:
    rows = [
        row
        for row in csv.DictReader(file)
        if row["status"] == "done" and row["design"].isdigit()
    ]


def case(row):
    return study / "morph" / row["design"]


def extreme(name, best=max):
    return best(rows, key=lambda row: float(row[name]))


meshes = {
    "baseline": study / "baseline",
    "highest": case(extreme("h")),
    "lowest": case(extreme("h", min)),
    "narrowest": case(extreme("e", min)),
}
for name, folder in meshes.items():
    picture(
        folder,
        results / f"mesh.{name}.png",
        box=(-0.9, 0.9, -0.1, 0.6),
        width=1500,
    )
    picture(
        folder,
        results / f"corner.{name}.png",
        box=(-0.75, 0, -0.05, 0.4),
        width=1500,
    )
for name, row in (
    ("highestNu", extreme("Nu")),
    ("lowestCf", extreme("Cf", min)),
):
    for field, regions in (("T", ("fluid", "solid")), ("U", ("fluid",))):
        picture(
            case(row),
            results / f"{field}.{name}.png",
            field=field,
            regions=regions,
            lines=False,
            box=(-0.9, 0.9, -0.1, 1),
            width=1500,
        )
