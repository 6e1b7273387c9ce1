# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far may the throat open until its wall is at 80 % of its thickness? By
Newton's method on the tables of morphSurface."""

import subprocess
import sys
from pathlib import Path

value = 0.35
for step in range(8):
    Path("results/value").write_text(f"{value!r};\n")
    done = subprocess.run(
        [
            "morphSurface",
            "-dict",
            "constant/boxes",
            "-constraints",
            "results/input.stl",
            "results/nozzle.obj",
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    Path(f"log.morphSurface.{step}").write_text(done.stdout)
    if done.returncode:
        sys.exit(done.stdout)

    def table(name):
        rows = Path(f"results/nozzle.{name}.dat").read_text().splitlines()[1:]
        return {row.split()[0]: row.split()[1:] for row in rows}

    values, slopes = table("constraints"), table("constraintDerivatives")
    walls = [name for name in values if name.startswith("wall")]
    thinnest = min(walls, key=lambda name: float(values[name][0]))
    missed = float(values[thinnest][0]) - 0.8
    print(
        f"open {value:.6f} m: {thinnest} at {0.8 + missed:.9f} of its"
        f" thickness, volume {float(values['material'][0]):.6f}"
    )
    if abs(missed) < 1e-9:
        break
    value -= missed / float(slopes[thinnest][0])
