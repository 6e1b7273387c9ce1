# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the water plane, before and after, and
the hull in its domain."""

from pathlib import Path

from morphfoam.pictures.picture import picture
from morphfoam.pictures.scene import scene

here = Path(__file__).resolve().parent

before = here / "runs/before"
(before / "constant").mkdir(parents=True, exist_ok=True)
link = before / "constant/polyMesh"
if not link.exists():
    link.symlink_to(here / "constant/polyMesh")

for name, case, time in (
    ("before", before, None),
    ("images.auto", here / "runs/images.auto", 1.0),
    ("images.no", here / "runs/images.no", 1.0),
):
    picture(
        case,
        here / f"results/water.{name}.png",
        time=time,
        box=(-0.75, 0.75, 0, 0.35),
        width=1600,
    )
    scene(
        here / f"results/hull.{name}.png",
        cases=[(case, time)],
        patches=["body", "middle"],
        direction=(-1, 2, -1),
        lines=True,
        box=(-0.7, 0.7, 0, 0.2, -0.2, 0),
    )
