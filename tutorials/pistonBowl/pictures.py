# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: the mesh on the symmetry plane, and on
the head, before and after each motion."""

from pathlib import Path

from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

side = dict(
    box=(-0.042, 0.042, -0.016, 0.032), towards=(0, 1, 0), up=(0, 0, 1)
)
top = dict(box=(-0.042, 0.042, -0.002, 0.042))

for name, case, time in [("before", here, None)] + [
    (motion, here / "runs" / motion, 1.0)
    for motion in ("stroke", "offset", "reentrant")
]:
    picture(case, here / f"results/side.{name}.png", time=time, **side)
    picture(case, here / f"results/top.{name}.png", time=time, **top)
