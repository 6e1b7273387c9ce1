# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's film strip, results/wake.png: vorticity of the wake and the
mesh at the cylinder, every quarter of a period."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

case = here / "runs/oscillating"
output = here / "results"
frames = []
for part, box, field in (
    (
        "wake",
        (-3, 12, -4, 4),
        dict(field="vorticity", component="Z", range=(-2, 2), lines=False),
    ),
    ("mesh", (-3, 4.5, -2, 2), dict()),
):
    for time in (72, 73.5, 75, 76.5):
        frames.append(output / f"{part}.{time}.png")
        picture(case, frames[-1], time=time, box=box, width=700, **field)
film_strip(frames, output / "wake.png", columns=4)
