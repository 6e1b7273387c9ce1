# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How the two floats move, by us and by OpenFOAM's rigidBodyMotion; whether the
hinge holds, and what a restart half-way changes (results/trajectory.md and
hinge.md)."""

import math
import re
from pathlib import Path

from morphfoam.output.tables import write_table
from morphfoam.output.trajectories import compare

here = Path(__file__).resolve().parent

number = r"([-+.\deE]+)"
step = re.compile(
    rf"^Time = {number}$|^Rigid-body motion of the (left|right)\n"
    rf"    Centre of rotation: \({number} {number} {number}\)\n"
    rf"    Orientation: \({number} {number} {number} ",
    re.MULTILINE,
)


def bodies(name):
    """Times, and at the end of each step of both floats (x, z, pitch [rad])."""
    times, motions = [], []
    log = (here / "runs" / name / "log.interFoam").read_text()
    for found in step.finditer(log):
        time, body, x, _, z, xx, _, xz = found.groups()
        if time:
            times.append(float(time))
            motions.append({})
        elif times:
            pitch = math.atan2(float(xz), float(xx))
            motions[-1][body] = float(x), float(z), pitch
    return times, motions


def trajectory(name):
    times, motions = bodies(name)
    return (
        times,
        [m["left"][0] - 0.4 for m in motions],
        [m["left"][1] - 0.5 for m in motions],
        [math.degrees(m["left"][2]) for m in motions],
        [math.degrees(m["right"][2]) for m in motions],
    )


MOTIONS = [
    "sway of the left [m]",
    "heave of the left [m]",
    "pitch of the left [deg]",
    "pitch of the right [deg]",
]


def hinge(motions):
    """Largest distance between the hinge on the left float, 0.15 m from its
    centre, and where the right float has it."""
    return max(
        math.hypot(
            m["left"][0] + 0.15 * math.cos(m["left"][2]) - m["right"][0],
            m["left"][1] + 0.15 * math.sin(m["left"][2]) - m["right"][1],
        )
        for m in motions
    )


compare(
    trajectory("rbf"),
    trajectory("rigidBodyMotion"),
    "rigidBodyMotion",
    MOTIONS,
    here / "results/trajectory",
)
rows = [{"figure": "hinge open by [m]", "value": hinge(bodies("rbf")[1])}]
if (here / "runs/restarted/log.interFoam").exists():
    whole, again = trajectory("rbf"), trajectory("restarted")
    for i, motion in enumerate(MOTIONS, 1):
        rows.append(
            {
                "figure": f"restarted on two ranks, difference of {motion}, of"
                " the largest",
                "value": abs(whole[i][-1] - again[i][-1])
                / max(map(abs, whole[i])),
            }
        )
write_table(rows, here / "results/hinge")
