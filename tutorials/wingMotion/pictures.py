# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorial's picture, results/wing.png: speed and mesh at the wing at the
end."""

from pathlib import Path

from morphfoam.pictures.film_strip import film_strip
from morphfoam.pictures.picture import picture

here = Path(__file__).resolve().parent

output = here / "results"
frames = [output / "speed.png", output / "mesh.png", output / "nose.png"]
whole, nose = (-0.4, 1.4, -0.7, 0.7), (-0.09, 0.09, -0.02, 0.12)
picture(
    here / "runs/rbf", frames[0], box=whole, field="U", lines=False, width=700
)
picture(here / "runs/rbf", frames[1], box=whole, width=700)
picture(here / "runs/rbf", frames[2], box=nose, width=700)
film_strip(frames, output / "wing.png", columns=3)
