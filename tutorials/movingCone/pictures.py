# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The mesh about the cone at the end, by OpenFOAM's solver and by ours:
results/cone.png."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

output = here / "results"
output.mkdir(exist_ok=True)
frames = []
for case in ("velocityComponentLaplacian", "rbf"):
    frames.append(output / f"mesh.{case}.png")
    picture(
        here / "runs" / case,
        frames[-1],
        box=(-0.0075, 0, 0, 0.0025),
        plane=((0, 0, 0), (0, 0, 1)),
        width=900,
    )
film_strip(frames, output / "cone.png", columns=1)
