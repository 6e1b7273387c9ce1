# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the motor bike in its lattice."""

from pathlib import Path

from morphfoam.pictures.scene import scene

here = Path(__file__).resolve().parent

lattices = here / "results/motorBike.lattice"
for state, surface, lattice in (
    ("before", "before.obj", "bikeAtRest"),
    ("after", "motorBike.obj", "bike"),
):
    scene(
        here / f"results/motorBike.{state}.png",
        surfaces=[here / "results" / surface],
        lattices=[lattices / f"{lattice}.vtk"],
        direction=(-0.6, -3, 0.7),
        zoom=1.2,
        box=(-0.9, 2.2, -0.5, 0.5, -0.1, 1.6),
    )
