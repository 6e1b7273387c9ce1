# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The pictures that the running solver left, side by side:
results/contactSheet.png"""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip

here = Path(__file__).resolve().parent

pictures = sorted(here.glob("runs/case/postProcessing/catalyst/**/*.png"))
every = max(1, len(pictures) // 8)
film_strip(pictures[every - 1 :: every], here / "results/contactSheet.png", 4)
print(
    f"{len(pictures)} pictures, results/contactSheet.png has "
    f"{len(pictures[every - 1::every])} of them"
)
