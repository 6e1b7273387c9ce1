# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures of Allrun.body, in results/: the body in its lattice before and
after, and the mesh about it in the plane of symmetry."""

import sys
from pathlib import Path

from morphfoam.pictures.scene import scene


body = sys.argv[1]
case = Path.cwd()
lattices = case / f"results/{body}.lattice"
views = {
    "ellipsoid": (-2, -3, 1.2),
    "bulb": (-2, -3, 1.2),
    "rudder": (-2, -3, 0.7),
}
planes = {"ellipsoid": "y", "bulb": "z", "rudder": "z"}

for state, surface, lattice in (
    ("before", case / "constant/triSurface/body.stl", "AtRest"),
    ("after", case / f"results/{body}.stl", ""),
):
    scene(
        case / f"results/{body}.{state}.png",
        surfaces=[surface],
        lattices=[lattices / f"{body}{lattice}.vtk"],
        direction=views[body],
    )
    scene(
        case / f"results/mesh.{state}.png",
        cases=[(case / "runs/before" if state == "before" else case, None)],
        cut=planes[body],
        surfaces=[],
        direction=None,
        zoom=2,
    )
