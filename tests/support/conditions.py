# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Conditions of pointDisplacement that move the top of a box, each with the
displacement that OpenFOAM's formula gives there.

    case = rbf_case(path, {**SLIPPING, "zMax": CONDITIONS[name][0]})
    expected = CONDITIONS[name][1](points)
"""

import numpy as np

from boxCase import fixed, vectors
from rbfCase import CUBE

HELD = fixed(0, 0, 0)

# The top moves on a box with a fixed bottom and sides that slip
SLIPPING = {**{name: "slip" for name in CUBE}, "zMin": HELD}

OMEGA, TIME = 0.7, 1.0


def rotation(points, angle, origin, axis):
    """Displacement of a rotation by Rodrigues' formula."""
    r = points - origin
    k = np.array(axis) / np.linalg.norm(axis)
    turned = (
        r * np.cos(angle)
        + np.cross(k, r) * np.sin(angle)
        + np.outer(r @ k, k) * (1 - np.cos(angle))
    )
    return turned - r


def mapped(x):
    """A displacement that no condition with one number could have."""
    return np.stack(
        [0.02 * x[:, 1], -0.03 * x[:, 0] ** 2, 0.05 + 0.01 * x[:, 0]], 1
    )


def boundary_data(case, points, values):
    """What timeVaryingMappedFixedValue reads for zMax: lists, no headers."""
    for file, rows in (("points", points), ("0/pointDisplacement", values)):
        path = case.path / "constant/boundaryData/zMax" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"{len(rows)}\n{vectors(rows)}\n")


CONDITIONS = {
    "fixedValue": (
        fixed(0.03, -0.01, 0.1),
        lambda x: np.tile([0.03, -0.01, 0.1], (len(x), 1)),
    ),
    "uniformFixedValue": (
        "uniformFixedValue; uniformValue table"
        " ((0 (0 0 0)) (2 (0.06 0 0.2)));",
        lambda x: np.tile([0.03, 0, 0.1], (len(x), 1)),
    ),
    "oscillatingDisplacement": (
        f"oscillatingDisplacement; amplitude (0.01 0.02 0.1); omega {OMEGA};"
        " value uniform (0 0 0);",
        lambda x: np.tile(
            np.sin(OMEGA * TIME) * np.array([0.01, 0.02, 0.1]), (len(x), 1)
        ),
    ),
    "angularOscillatingDisplacement": (
        "angularOscillatingDisplacement; axis (0 1 2); origin (0.5 0.4 1);"
        f" angle0 0.05; amplitude 0.2; omega {OMEGA}; value uniform (0 0 0);",
        lambda x: rotation(
            x, 0.05 + 0.2 * np.sin(OMEGA * TIME), [0.5, 0.4, 1], [0, 1, 2]
        ),
    ),
    "solidBodyMotionDisplacement": (
        "solidBodyMotionDisplacement;"
        " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
        " { origin (0.5 0.4 1); axis (0 1 2); omega 0.2; }",
        lambda x: rotation(x, 0.2 * TIME, [0.5, 0.4, 1], [0, 1, 2]),
    ),
    "waveDisplacement": (
        f"waveDisplacement; amplitude (0 0 0.05); omega {OMEGA};"
        " waveNumber (4 1 0); value uniform (0 0 0);",
        lambda x: np.outer(np.cos(OMEGA * TIME - x @ [4, 1, 0]), [0, 0, 0.05]),
    ),
    "timeVaryingMappedFixedValue": (
        "timeVaryingMappedFixedValue; mapMethod nearest;",
        mapped,
    ),
}
