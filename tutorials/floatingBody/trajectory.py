# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sway and pitch of the floating box with our motion solver and OpenFOAM's, at
the times of the latter, in a table (results/trajectory.csv and .md)."""

import math
import re
from pathlib import Path

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


compare(
    trajectory("rbf"),
    trajectory("rigidBody"),
    "rigidBody",
    ["sway [m]", "pitch [deg]"],
    here / "results/trajectory",
)
