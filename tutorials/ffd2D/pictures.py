# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's picture, results/meshes.png: each mesh under its lattice."""

import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "scripts"))
from scene import scene  # noqa: E402

for name, box in (("inside", "whole"), ("boundary", "whole"),
                  ("local", "local"), ("rotated", "local")):
    case = here / "runs" / name
    scene(here / f"results/{name}.png", cases=[(case, None)], cut="z",
          direction=None, lattices=[case / "postProcessing/morphMesh/1/controls"
                    / f"{box}.vtk"],
          box=(-0.1, 1.1, -0.6, 1.1, 0, 0.1), width=900, height=900)
