# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Heave and pitch of the wing on its springs with our motion solver and
OpenFOAM's, at the times of the latter (results/trajectory.csv and .md)."""

import math
import re
from pathlib import Path

from morphfoam.output.trajectories import compare

here = Path(__file__).resolve().parent

number = r"([-+.\deE]+)"
step = re.compile(
    rf"^Time = {number}$|^    Centre of rotation: \({number} {number} {number}\)"
    rf"|^    Orientation: \({number} {number} ",
    re.MULTILINE,
)


def trajectory(name):
    """Times, heave [m] and pitch [deg] at the end of each step."""
    times, heave, pitch = [], [], []
    log = (here / "runs" / name / "log.pimpleFoam").read_text()
    for time, _, y, _, xx, xy in (f.groups() for f in step.finditer(log)):
        if time:
            times.append(float(time))
            heave.append(math.nan)
            pitch.append(math.nan)
        elif not times:
            continue
        elif y:
            heave[-1] = float(y) - 0.007
        else:
            pitch[-1] = math.degrees(math.atan2(float(xy), float(xx)))
    return times, heave, [angle - pitch[0] for angle in pitch]


compare(
    trajectory("rbf"),
    trajectory("sixDoF"),
    "sixDoF",
    ["heave [m]", "pitch [deg]"],
    here / "results/trajectory",
)
