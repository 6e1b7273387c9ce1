# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's film strip, results/floating.png: water and mesh in the middle
of the tank, seen from the side."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

output = here / "results"
output.mkdir(exist_ok=True)
frames = []
for time in (0.1, 0.2, 0.3):
    frames.append(output / f"water.{time:g}.png")
    picture(
        here / "runs/rbf",
        frames[-1],
        time=time,
        box=(0, 1, 0, 1),
        plane=((0, 0.46, 0), (0, 1, 0)),
        towards=(0, 1, 0),
        up=(0, 0, 1),
        field="alpha.water",
        range=(0, 1),
        width=700,
    )
film_strip(frames, output / "floating.png", columns=3)
