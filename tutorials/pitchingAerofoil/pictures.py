# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's film strip, results/pitching.png: velocity and mesh of a
period, and the mesh at the tail."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

case = here / "runs/morphed"
output = here / "results"
frames = []
for part, box, field in (
    ("flow", (-45, 45, -32, 32), dict(field="U", range=(0, 60), lines=False)),
    ("mesh", (-45, 45, -32, 32), dict()),
    ("nose", (-20, -8, -4.1, 4.4333), dict()),
):
    for time in (4, 6, 8, 10):
        frames.append(output / f"{part}.{time}.png")
        picture(case, frames[-1], time=time, box=box, width=700, **field)
film_strip(frames, output / "pitching.png", columns=4)
