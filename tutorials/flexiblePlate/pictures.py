# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pressure and the moving plate, and its amplitude over time
(results/plate.png)."""

from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

from morphfoam.pictures.film_strip import film_strip  # noqa: E402
from morphfoam.pictures.picture import picture  # noqa: E402

here = Path(__file__).resolve().parent

output = here / "results"
output.mkdir(exist_ok=True)
time, amplitude = np.loadtxt(
    here / "runs/whole/plate/history.csv", delimiter=",", usecols=(0, 1)
).T
figure, axes = plt.subplots(figsize=(7, 7))
axes.plot(time, 1e3 * amplitude)
axes.axvspan(0, 0.5, alpha=0.1)
axes.set_xlabel("time [s] (pushed in the shaded part)")
axes.set_ylabel("amplitude of the plate [mm]")
axes.grid(alpha=0.3)
figure.tight_layout()
figure.savefig(output / "amplitude.png", dpi=100)

picture(
    here / "runs/whole",
    output / "pressure.png",
    time=float(time[np.argmax(np.abs(amplitude))]),
    box=(0, 1, 0, 1),
    towards=(0, 1, 0),
    up=(0, 0, 1),
    field="p",
    width=700,
)
film_strip(
    [output / "pressure.png", output / "amplitude.png"],
    output / "plate.png",
    columns=2,
)
