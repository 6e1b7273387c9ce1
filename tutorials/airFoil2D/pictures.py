# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's pictures, in results/: mesh and pressure before and after."""

from pathlib import Path

from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

whole = (-24, 24, -13, 13)
nose = (-20, -10, -3, 3.5)
tail = (12, 22, -1, 5.5)
pressure = dict(field="p", range=(-500, 500), lines=False)

for name, case in (("before", here), ("after", here / "runs/pitched10")):
    output = here / "results"
    picture(case, output / f"mesh.{name}.png", box=whole)
    picture(case, output / f"nose.{name}.png", box=nose)
    picture(case, output / f"tail.{name}.png", box=tail)
    picture(case, output / f"pressure.{name}.png", box=whole, **pressure)
