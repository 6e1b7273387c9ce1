# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's film strip, results/twist.png: the column from the side."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

output = here / "results"
frames = []
for time in (1, 3, 5, 8, 10):
    frames.append(output / f"column.{time}.png")
    picture(
        here / "runs/rbf",
        frames[-1],
        time=time,
        box=(-1.2, 1.2, -0.5, 8.5),
        towards=(0, 1, 0),
        up=(0, 0, 1),
        width=300,
    )
film_strip(frames, output / "twist.png", columns=5)
