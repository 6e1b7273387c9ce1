# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Water, floats and mesh at the start and later, results/floats.png."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

output = here / "results"
output.mkdir(exist_ok=True)
frames = []
for time in (0.2, 0.4):
    frames.append(output / f"floats.{time:g}.png")
    picture(
        here / "runs/rbf",
        frames[-1],
        time=time,
        box=(0, 1.4, 0.1, 0.9),
        towards=(0, 1, 0),
        up=(0, 0, 1),
        field="alpha.water",
        range=(0, 1),
        width=900,
    )
film_strip(frames, output / "floats.png", columns=2)
