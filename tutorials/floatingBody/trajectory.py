# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sway and pitch of the floating box with our motion solver and OpenFOAM's, at
the times of the latter, and what a restart half-way changes, in tables
(results/trajectory and restart, .csv and .md)."""

import math
import re
from pathlib import Path

from morphfoam.output.tables import write_table
from morphfoam.output.trajectories import compare

here = Path(__file__).resolve().parent

number = r"([-+.\deE]+)"
step = re.compile(
    rf"^Time = {number}$|^    Centre of mass: \({number} {number} "
    rf"{number}\)|^    Orientation: \({number} {number} {number} ",
    re.MULTILINE,
)


def trajectory(name):
    """Times, sway [m] and pitch [deg] at the end of each step."""
    times, sway, pitch = [], [], []
    for found in step.finditer(
        (here / "runs" / name / "log.interFoam").read_text()
    ):
        time, _, y, _, xx, _, xz = found.groups()
        if time:
            times.append(float(time))
            sway.append(math.nan)
            pitch.append(math.nan)
        elif y:
            sway[-1:] = [float(y) - 0.45]
        else:
            pitch[-1:] = [math.degrees(math.atan2(float(xz), float(xx)))]
    return times, sway, pitch


MOTIONS = ["sway [m]", "pitch [deg]"]

compare(
    trajectory("rbf"),
    trajectory("rigidBody"),
    "rigidBody",
    MOTIONS,
    here / "results/trajectory",
)
if (here / "runs/restarted/log.interFoam").exists():
    whole, again = trajectory("rbf"), trajectory("restarted")
    write_table(
        [
            {
                "figure": f"restarted, difference of {motion}, of the largest",
                "value": abs(whole[i][-1] - again[i][-1])
                / max(map(abs, whole[i])),
            }
            for i, motion in enumerate(MOTIONS, 1)
        ],
        here / "results/restart",
    )
