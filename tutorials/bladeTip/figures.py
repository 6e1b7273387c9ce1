# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""results/figures.md and .csv: what each run keeps, and the mesh it gives."""

import re
from pathlib import Path

import numpy as np

from morphfoam.output.mesh_files import patch_points, read_vectors
from morphfoam.output.tables import write_table

from passage import CASING, MESH, PITCH, TIP, blade, polar

here = Path(__file__).resolve().parent
before = read_vectors(here / "constant/polyMesh/points")
points = {
    name: patch_points(MESH, name)
    for name in ("left", "right", "casing", "blade")
}


def turned(x):
    c, s = np.cos(PITCH), np.sin(PITCH)
    return x @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]]).T


def pairs():
    """Of each point of the left side the one on the right."""
    there = before[points["right"]]
    order = np.lexsort(np.round(there, 7).T)
    here_ = np.lexsort(np.round(turned(before[points["left"]]), 7).T)
    a, b = points["left"][here_], points["right"][order]
    assert np.abs(turned(before[a]) - before[b]).max() < 1e-9
    return a, b


def row(images):
    run = here / f"runs/images.{images}"
    after = read_vectors(run / "1/polyMesh/points")
    log = (run / "log.morphMesh").read_text()
    a, b = pairs()
    on = points["blade"]
    tip = on[np.abs(polar(before[on])[2] - TIP) < 1e-9]
    quality = re.search(r"^after +(.*)", log, re.MULTILINE).group(1).split()
    selected, of = re.search(r"selected (\d+) of (\d+)", log).groups()
    return {
        "images": images,
        "selected": selected,
        "control points": of,
        "max non-orthogonality": quality[2],
        "max skewness": quality[3],
        "wrong faces": quality[5],
        "off casing": np.abs(polar(after[points["casing"]])[2] - CASING).max(),
        "tip gap": np.abs(polar(after[tip])[2] - TIP).max(),
        "off blade": np.abs(after[on] - blade(before[on])).max(),
        "pairs": np.abs(turned(after[a]) - after[b]).max(),
        "motion of the sides": np.linalg.norm(
            after[a] - before[a], axis=1
        ).max(),
    }


write_table([row("auto"), row("no")], here / "results/figures")
