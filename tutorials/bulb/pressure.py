# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures of Allrun.descent, in results/: pressure about the bulb in its plane
of symmetry, before and after."""

import csv

from morphfoam.pictures.scene import scene

with open("descend.study/descend.morph/optima.csv") as table:
    best = next(csv.DictReader(table))["design"]
for state, case in (("before", "baseline"), ("after", f"morph/{best}")):
    scene(
        f"results/pressure.{state}.png",
        cases=[(f"descend.study/{case}", None)],
        cut="z",
        surfaces=[],
        direction=None,
        field="p",
        range=(-15, 30),
        zoom=1.9,
        width=1000,
        height=430,
    )
