# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A mesh with a boundary layer as thin as in flows of high Reynolds number.

An ellipse of chord 1 and thickness 0.12 in an O-grid out to radius 10, one cell
deep between empty sides; the first cell is as high as asked for.
"""

import math

import numpy as np

from boxCase import from_block_mesh
from rbfCase import DROP_IN

AROUND = 64  # cells around each quarter
CHORD = 1.0
THICKNESS = 0.12
FAR = 10.0


def layers(first, growth=1.25, far=FAR):
    """Number of cells from the wall to the far field, and the grading."""
    n = math.ceil(math.log(1 + far / first * (growth - 1), growth))
    return n, growth ** (n - 1)


def on_ellipse(angle):
    return 0.5 * CHORD * math.cos(angle), 0.5 * THICKNESS * math.sin(angle)


def on_circle(angle):
    return FAR * math.cos(angle), FAR * math.sin(angle)


def block_mesh_dict(first):
    """blockMeshDict of the mesh with a first cell of this height."""
    corners = [0.5 * math.pi * q for q in range(4)]
    points = [
        (*shape(a), z)
        for z in (0, 0.1)
        for shape in (on_ellipse, on_circle)
        for a in corners
    ]
    n, grading = layers(first)
    blocks, edges, wall, far = [], [], [], []
    for q in range(4):
        p = (q + 1) % 4
        low = [p, q, 4 + q, 4 + p]
        high = [8 + i for i in low]
        blocks.append(
            f"hex ({' '.join(map(str, low + high))}) "
            f"({AROUND} {n} 1) simpleGrading (1 {grading:.12g} 1)"
        )
        wall.append(f"({q} {p} {8 + p} {8 + q})")
        far.append(f"({4 + q} {4 + p} {12 + p} {12 + q})")
        inner = np.linspace(corners[q], corners[q] + 0.5 * math.pi, 200)[1:-1]
        for shift, z in ((0, 0), (8, 0.1)):
            for shape, a, b in ((on_ellipse, q, p), (on_circle, 4 + q, 4 + p)):
                line = " ".join(
                    f"({x:.15g} {y:.15g} {z})" for x, y in map(shape, inner)
                )
                edges.append(f"polyLine {a + shift} {b + shift} ({line})")
    return (
        "scale 1;\nvertices ("
        + " ".join(f"({x:.15g} {y:.15g} {z:.15g})" for x, y, z in points)
        + ");\n"
        "blocks ("
        + "\n".join(blocks)
        + ");\nedges ("
        + "\n".join(edges)
        + ");\nboundary\n(\n"
        f"wall {{ type wall; faces ({' '.join(wall)}); }}\n"
        f"far {{ type patch; faces ({' '.join(far)}); }}\n);\n"
        "defaultPatch { name sides; type empty; }\n"
    )


def pitched(path, coeffs, degrees=20, first=1e-6, control=None):
    """The case of a pitch by so many degrees at time 1."""
    case = from_block_mesh(path, block_mesh_dict(first), control)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        f"""{DROP_IN}
rbfMotionSolverCoeffs
{{
    supportRadius 5;
    {coeffs}
    controlPoints
    {{
        wall
        {{
            type moving; patches (wall);
            displacement
            {{
                type solidBody; solidBodyMotionFunction axisRotationMotion;
                axisRotationMotionCoeffs
                {{ origin (0 0 0); radialVelocity (0 0 {degrees}); }}
            }}
        }}
        far {{ type fixed; patches (far); }}
    }}
}}""",
    )
    return case
