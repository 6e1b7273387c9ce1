# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the body in its lattice."""

from pathlib import Path

from morphfoam.pictures.scene import scene

here = Path(__file__).resolve().parent

for state, surface, lattice in (
    ("before", "before.obj", "bodyAtRest"),
    ("after", "body.obj", "body"),
):
    scene(
        here / f"results/body.{state}.png",
        surfaces=[here / "results" / surface],
        lattices=[here / f"results/body.lattice/{lattice}.vtk"],
        direction=(-1, -2, 0.7),
        zoom=1.2,
    )
