# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Meshes with curved sides on which points slide.

    case = annulus(tmp_path, groups(...))
    off = np.abs(np.linalg.norm(points[:, :2], axis=1) - 1)
"""

import numpy as np

from boxCase import from_block_mesh, vectors
from rbfCase import DROP_IN


def annulus_mesh(
    cells=(6, 5, 8), inner=0.5, outer=1.0, length=1.0, ends="patch"
):
    """Between two cylinders along z: patches hub, casing, zMin, zMax.

    cells: around in each quarter, radial, along.
    ends: type of the patches zMin and zMax.
    """
    angles = np.arange(4) * np.pi / 2
    corners = [
        (r * np.cos(a), r * np.sin(a), z)
        for z in (0, length)
        for r in (inner, outer)
        for a in angles
    ]
    blocks, arcs = "", ""
    hub, casing, low, high = "", "", "", ""
    for i in range(4):
        j = (i + 1) % 4
        # Of each level: inner 0-3, outer 4-7; the upper level is 8 on
        base = (i, 4 + i, 4 + j, j)
        top = tuple(v + 8 for v in base)
        label = " ".join(map(str, base + top))
        blocks += (
            f"hex ({label}) ({cells[1]} {cells[0]} {cells[2]})"
            " simpleGrading (1 1 1)\n"
        )
        middle = (i + 0.5) * np.pi / 2
        for level, z in ((0, 0), (8, length)):
            for ring, r in ((0, inner), (4, outer)):
                x = r * np.cos(middle), r * np.sin(middle), z
                arcs += (
                    f"arc {level + ring + i} {level + ring + j} "
                    f"{vectors([x])[1:-1]}\n"
                )
        hub += f"({i} {j} {8 + j} {8 + i}) "
        casing += f"({4 + i} {4 + j} {12 + j} {12 + i}) "
        low += f"({' '.join(map(str, base))}) "
        high += f"({' '.join(map(str, top))}) "
    return f"""
scale 1;
vertices ( {vectors(corners)[1:-1]} );
blocks ( {blocks} );
edges ( {arcs} );
boundary
(
    hub {{ type wall; faces ( {hub} ); }}
    casing {{ type wall; faces ( {casing} ); }}
    zMin {{ type {ends}; faces ( {low} ); }}
    zMax {{ type {ends}; faces ( {high} ); }}
);
"""


def annulus(path, coeffs, control=None, **mesh):
    case = from_block_mesh(path, annulus_mesh(**mesh), control)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        DROP_IN + f"rbfMotionSolverCoeffs\n{{\n{coeffs}\n}}",
    )
    return case


def duct_obj(radius, sectors, low=-0.5, high=1.5):
    """An OBJ file of a polygonal duct: its flat sides begin at angle zero.

    (Numbers of STL files are read in single precision.)
    """
    angles = np.arange(sectors) * 2 * np.pi / sectors
    text = "".join(
        f"v {float(radius*np.cos(a))!r} {float(radius*np.sin(a))!r} {z!r}\n"
        for z in (low, high)
        for a in angles
    )
    for i in range(sectors):
        a, b = 1 + i, 1 + (i + 1) % sectors
        text += f"f {a} {b} {b + sectors}\nf {a} {b + sectors} {a + sectors}\n"
    return text


def stl_of(obj):
    """The triangles of an OBJ file as an ascii STL file."""
    lines = [line.split() for line in obj.splitlines()]
    vertices = [" ".join(line[1:]) for line in lines if line[0] == "v"]
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {vertices[int(i) - 1]}\n" for i in line[1:])
        + "endloop\nendfacet\n"
        for line in lines
        if line[0] == "f"
    )
    return f"solid duct\n{facets}endsolid duct\n"
