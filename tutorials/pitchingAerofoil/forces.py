# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Lift and drag of the aerofoil over the last period, on the mesh that is
morphed and on the one that turns as a whole, in a table (results/forces.csv)
and a plot."""

import math
from pathlib import Path

from morphfoam.output.tables import read_columns, write_table

here = Path(__file__).resolve().parent

period = 8
amplitude = 40


def columns(name):
    (path,) = (here / "runs" / name / "postProcessing/forces").glob(
        "*/coefficient.dat"
    )
    all = read_columns(path)
    # The start is impulsive: pressure of the first quarter of a period is not
    # of this motion
    first = max(all["Time"][-1] - period, min(2, all["Time"][-1] / 2))
    keep = [i for i, t in enumerate(all["Time"]) if t > first]
    return {key: [values[i] for i in keep] for key, values in all.items()}


def row(name, reference, forces):
    lift, drag = forces["Cl"], forces["Cd"]
    scale = max(map(abs, reference["Cl"]))
    difference = math.sqrt(
        sum((a - b) ** 2 for a, b in zip(lift, reference["Cl"])) / len(lift)
    )
    return {
        "run": name,
        "max Cl": max(lift),
        "min Cl": min(lift),
        "mean Cd": sum(drag) / len(drag),
        "rms difference of Cl, of its largest": difference / scale,
    }


forces = {name: columns(name) for name in ("morphed", "rigid")}
write_table(
    [row(name, forces["rigid"], forces[name]) for name in forces],
    here / "results/forces",
)
