# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""adapt.py cavity.mesh cavity.sol new.mesh: an engine for tests. Cuts every
tetrahedron whose edges are longer than asked for into four about its centre;
the surface stays.
"""

import sys

import numpy as np


def read(path):
    """The tables of a file of Medit's format, by keyword."""
    words = open(path).read().split()
    columns = {
        "Vertices": 4,
        "Tetrahedra": 5,
        "Triangles": 4,
        "Edges": 3,
        "SolAtVertices": 1,
    }
    tables = {}
    i = 4  # after version and dimension
    while words[i] != "End":
        name, n = words[i], int(words[i + 1])
        i += 2
        if name == "SolAtVertices":
            i += 2
        width = columns.get(name, 1)
        tables[name] = np.array(words[i : i + n * width], dtype=float)
        tables[name] = tables[name].reshape(n, width)
        i += n * width
    return tables


def main(mesh, sol, new):
    tables = read(mesh)
    x = tables["Vertices"][:, :3]
    tets = tables["Tetrahedra"].astype(int)
    sizes = read(sol)["SolAtVertices"][:, 0]
    points, cells = list(x), []
    for *corners, zone in tets:
        at = x[np.array(corners) - 1]
        length = np.mean(
            [np.linalg.norm(at[i] - at[j]) for i in range(4) for j in range(i)]
        )
        if length < np.mean(sizes[np.array(corners) - 1]):
            cells.append((*corners, zone))
            continue
        points.append(at.mean(axis=0))
        for i in range(4):
            part = list(corners)
            part[i] = len(points)
            cells.append((*part, zone))
    with open(new, "w") as file:
        print("MeshVersionFormatted 2\nDimension 3", file=file)
        print(f"Vertices\n{len(points)}", file=file)
        for p in points:
            print(*(repr(float(c)) for c in p), 0, file=file)
        print(f"Tetrahedra\n{len(cells)}", file=file)
        for cell in cells:
            print(*cell, file=file)
        print(f"Triangles\n{len(tables['Triangles'])}", file=file)
        for triangle in tables["Triangles"].astype(int):
            print(*triangle, file=file)
        print("End", file=file)


if __name__ == "__main__":
    main(*sys.argv[1:])
