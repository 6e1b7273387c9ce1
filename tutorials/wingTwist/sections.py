# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How exactly the sections of the wing keep their shape."""

import numpy as np


def vertices(file):
    return np.array(
        [
            line.split()[1:]
            for line in open(file).read().splitlines()
            if line.startswith("v ")
        ],
        float,
    )


before, after = vertices("results/before.obj"), vertices("results/wing.obj")
worst = 0
for z in np.unique(before[:, 2]):
    section = before[:, 2] == z
    a, b = before[section], after[section]
    # Distances from the first point grow by one factor for the whole section
    old = np.linalg.norm(a[1:] - a[0], axis=1)
    new = np.linalg.norm(b[1:] - b[0], axis=1)
    factor = 1 - 0.15 * z / 3
    worst = max(worst, np.abs(new - factor * old).max())
    assert np.ptp(b[:, 2]) < 1e-12
tip = before[:, 2] == before[:, 2].max()
nose, tail = (
    after[tip][np.argmin(before[tip, 0])],
    after[tip][np.argmax(before[tip, 0])],
)
chord = tail - nose
angle = np.degrees(np.arctan2(chord[1], chord[0]))
print(f"Shape of the sections: kept to {worst:.1e} m")
print(f"Twist of the tip: {angle:.6f} degrees")
