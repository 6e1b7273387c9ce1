# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A mesh of cells of all shapes, written as OpenFOAM's polyMesh.

    write_mixed_mesh(case, n=4)

A box of n x n x n cubes. Cubes are divided into six pyramids each, pairs of
prisms, or stay hexahedra; those between cubes and prisms have a side of two
triangles and are polyhedra. Beside the box there are pairs of tetrahedra.
"""

import numpy as np

# The faces of a cube, outward: corners as bits x + 2 y + 4 z
CUBE = [
    (0, 4, 6, 2),
    (1, 3, 7, 5),
    (0, 1, 5, 4),
    (2, 6, 7, 3),
    (0, 2, 3, 1),
    (4, 5, 7, 6),
]


class MixedMesh:
    def __init__(self, n):
        self.points = []
        self.labels = {}
        self.cells = []
        # Columns of prisms, which divide what is below and above them
        self.divided = {(i, j) for i in range(n) for j in range(n)}
        self.divided = {c for c in self.divided if sum(c) % 3 == 1}
        for k in range(n):
            for j in range(n):
                for i in range(n):
                    self.cube(i, j, k, n)
        for m in range(3 * n):
            self.tetrahedra(n + 1 + m % 3, m // 3)

    def point(self, *x):
        if x not in self.labels:
            self.labels[x] = len(self.points)
            self.points.append(x)
        return self.labels[x]

    def cube(self, i, j, k, n):
        corner = [
            self.point(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2))
            for b in range(8)
        ]
        faces = [[corner[c] for c in f] for f in CUBE]
        if (i, j) in self.divided:
            halves = [(0, 1, 3), (0, 3, 2)]
            if k < n // 2:
                for a, b, c in halves:
                    base = [corner[v] for v in (a, b, c)]
                    top = [corner[v + 4] for v in (a, b, c)]
                    self.cells.append(
                        [base[::-1], top]
                        + [
                            [
                                base[m],
                                base[(m + 1) % 3],
                                top[(m + 1) % 3],
                                top[m],
                            ]
                            for m in range(3)
                        ]
                    )
                return
            if k == n // 2:
                faces[4:5] = [
                    [corner[v] for v in half[::-1]] for half in halves
                ]
        elif (i + 2 * j + k) % 4 == 0:
            middle = self.point(i + 0.5, j + 0.5, k + 0.5)
            for f in faces:
                self.cells.append(
                    [f] + [[f[m], middle, f[(m + 1) % 4]] for m in range(4)]
                )
            return
        self.cells.append(faces)

    def tetrahedra(self, i, k):
        a, b, c = (
            self.point(i, 0, 2 * k),
            self.point(i + 0.7, 0, 2 * k),
            self.point(i, 0.7, 2 * k),
        )
        for base, tip in (
            ((a, c, b), self.point(i + 0.2, 0.2, 2 * k + 0.6)),
            ((a, b, c), self.point(i + 0.2, 0.2, 2 * k - 0.6)),
        ):
            self.cells.append(
                [list(base)]
                + [[base[m], tip, base[(m + 1) % 3]] for m in range(3)]
            )

    def sorted_faces(self):
        """Faces, owners and neighbours in OpenFOAM's order."""
        sides = {}
        for cell, faces in enumerate(self.cells):
            for f in faces:
                sides.setdefault(tuple(sorted(f)), []).append((cell, f))
        assert all(len(s) <= 2 for s in sides.values())
        inner = sorted(
            (s for s in sides.values() if len(s) == 2),
            key=lambda s: (s[0][0], s[1][0]),
        )
        outer = sorted(
            (s for s in sides.values() if len(s) == 1), key=lambda s: s[0][0]
        )
        faces = [s[0][1] for s in inner + outer]
        owner = [s[0][0] for s in inner + outer]
        return faces, owner, [s[1][0] for s in inner]


def write_mixed_mesh(case, n=4):
    mesh = MixedMesh(n)
    faces, owner, neighbour = mesh.sorted_faces()

    def block(rows):
        return f"{len(rows)}\n(\n" + "\n".join(rows) + "\n)\n"

    def put(name, kind, body):
        case.write(f"constant/polyMesh/{name}", kind, body)

    points = np.array(mesh.points, float)
    put(
        "points",
        "vectorField",
        block([f"({x!r} {y!r} {z!r})" for x, y, z in points.tolist()]),
    )
    put(
        "faces",
        "faceList",
        block([f"{len(f)}({' '.join(map(str, f))})" for f in faces]),
    )
    put("owner", "labelList", block([str(c) for c in owner]))
    put("neighbour", "labelList", block([str(c) for c in neighbour]))
    put(
        "boundary",
        "polyBoundaryMesh",
        "1\n(\n all { type patch; nFaces %d; startFace %d; }\n)\n"
        % (len(faces) - len(neighbour), len(neighbour)),
    )
    return mesh
