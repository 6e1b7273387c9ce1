# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's picture, results/meshes.png: each mesh under its lattice."""

from pathlib import Path

from morphfoam.pictures.scene import scene

here = Path(__file__).resolve().parent

for name, box in (
    ("inside", "whole"),
    ("boundary", "whole"),
    ("local", "local"),
    ("rotated", "local"),
):
    case = here / "runs" / name
    scene(
        here / f"results/{name}.png",
        cases=[(case, None)],
        cut="z",
        direction=None,
        lattices=[case / "postProcessing/morphMesh/1/controls" / f"{box}.vtk"],
        box=(-0.1, 1.1, -0.6, 1.1, 0, 0.1),
        width=900,
        height=900,
    )
