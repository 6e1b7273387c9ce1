# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far the aerofoil turns about its mid-chord, in steps of 15 degrees.

    turn.py [-motions NAME ...] [-angle DEGREES]

Runs moveDynamicMesh with each of the entries in motions/ until it refuses to
go on, and writes results/turn.csv and .md: the largest non-orthogonality that
its mesh check finds at some angles, and the angle that was refused.
"""

import argparse
import re
import shutil
import subprocess
from pathlib import Path

from morphfoam.output.tables import write_table

here = Path(__file__).resolve().parent
motions = ["fixed", "moving", "movingOptimised"]
angles = [90, 120, 150, 180, 270, 360, 450, 540, 720]


def turn(motion, last):
    """Non-orthogonality by angle, as far as the mesh is valid."""
    case = here / "runs" / motion
    shutil.rmtree(case, ignore_errors=True)
    for folder in ("constant", "system"):
        shutil.copytree(here / folder, case / folder)
    shutil.copy(here / "motions" / motion, case / "constant/motion")
    control = case / "system/controlDict"
    control.write_text(
        re.sub(r"(endTime +)\d+", rf"\g<1>{last}", control.read_text())
    )
    with (case / "log").open("w") as log:
        subprocess.run(
            ["moveDynamicMesh", "-case", case], stdout=log, stderr=log
        )
    found, angle = {}, 0
    for line in (case / "log").read_text().splitlines():
        if match := re.match(r"Time = (\d+)", line):
            angle = int(match[1])
        if match := re.search(r"non-orthogonality Max: ([\d.e+-]+)", line):
            found[angle] = float(match[1])
        if re.search(r"incorrectly oriented|negative.*volume", line):
            found.pop(angle, None)
            break
    return found


parser = argparse.ArgumentParser()
parser.add_argument("-motions", nargs="+", default=motions, choices=motions)
parser.add_argument("-angle", type=int, default=720)
options = parser.parse_args()

rows = []
for motion in options.motions:
    found = turn(motion, options.angle)
    refused = max(found, default=0) + 15
    rows.append(
        {"motion": motion}
        | {str(a): f"{found[a]:.1f}" if a in found else "-" for a in angles}
        | {"refused": str(refused) if refused <= options.angle else "-"}
    )

write_table(rows, here / "results/turn")
