# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Cases whose mesh ffdMotionSolver moves, and what it should do.

    case = ffd_case(tmp_path, boxes=box_entry("body", order="(2 2 2)", ...))
    points = move(case)
    expected = deformed(points, ...)        # the formula, by itself
"""

from math import comb

import numpy as np

from boxCase import box, words
from rbfCase import CUBE, move, points_at, reference  # noqa: F401

SOLVER = """
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (morphMotionSolvers);
motionSolver        ffdMotionSolver;
"""


def parameter(name, moves, value="0.1", extra=""):
    """An entry of parameters; moves: ((i, j, k), (x, y, z)), ..."""
    listed = " ".join(
        f"(({' '.join(map(str, at))}) ({words(vector)}))"
        for at, vector in moves
    )
    return f"{name} {{ value {value}; {extra} moves ( {listed} ); }}\n"


def ffd_box(
    name,
    parameters,
    order=(2, 2, 2),
    origin=(-0.1, -0.1, -0.1),
    span=(1.2, 1.2, 1.2),
    extra="",
):
    """An entry of boxes."""
    return f"""{name}
    {{
        origin ({words(origin)}); span ({words(span)});
        order ({' '.join(map(str, order))}); {extra}
        parameters {{ {parameters} }}
    }}
    """


def coeffs(boxes, extra=""):
    return f"ffdMotionSolverCoeffs\n{{\nboxes\n{{\n{boxes}}}\n{extra}\n}}\n"


def ffd_case(path, boxes, extra="", patches=None, control=None, **mesh):
    """A box of a mesh that ffdMotionSolver moves."""
    case = box(path, patches or CUBE, control, **mesh)
    write_boxes(case, boxes, extra)
    return case


def write_boxes(case, boxes, extra=""):
    case.write(
        "constant/dynamicMeshDict", "dictionary", SOLVER + coeffs(boxes, extra)
    )


def bernstein(n, i, s):
    return comb(n, i) * s**i * (1 - s) ** (n - i)


def displaced(points, moves, order, origin, span, axes=np.eye(3)):
    """Sederberg and Parry's deformation of a box with Bernstein polynomials:
    moves are ((i, j, k), vector in fractions of the span) times a value."""
    origin, span = np.array(origin, float), np.array(span, float)
    xi = ((points - origin) @ axes) / span
    inside = ((xi > -1e-8) & (xi < 1 + 1e-8)).all(axis=1)
    d = np.zeros_like(points)
    for (i, j, k), vector in moves:
        b = np.prod(
            [bernstein(order[a], (i, j, k)[a], xi[:, a]) for a in range(3)],
            axis=0,
        )
        d += np.outer(b * inside, axes @ (span * np.array(vector, float)))
    return d


def rotation(axis, degrees):
    """The matrix that turns about an axis (Rodrigues)."""
    k = np.array(axis, float) / np.linalg.norm(axis)
    K = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    a = np.radians(degrees)
    return np.eye(3) + np.sin(a) * K + (1 - np.cos(a)) * (K @ K)
