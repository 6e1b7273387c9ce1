# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Surface files that morphSurface deforms.

    moved = morphed(tmp_path, points, faces, boxes)
"""

import numpy as np

from foamCase import FoamCase


def write_surface(path, points, faces):
    """An obj file with all digits."""
    path.write_text(
        "".join(
            "v " + " ".join(repr(float(x)) for x in point) + "\n"
            for point in points
        )
        + "".join(
            "f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces
        )
    )


def vertices(path):
    return np.array(
        [
            line.split()[1:]
            for line in path.read_text().splitlines()
            if line.startswith("v ")
        ],
        float,
    )


def morphed(
    path, points, faces, boxes, extra="", options=(), status=0, output=False
):
    """Where the points end, in their order; the log where it is to fail.

    Points that no face uses are kept by a face of their own.
    """
    path.mkdir(exist_ok=True)
    used = {i for face in faces for i in face}
    faces = list(faces) + [
        (i, i - 1, i - 2) for i in range(len(points)) if i not in used
    ]
    write_surface(path / "in.obj", points, faces)
    case = FoamCase(path)
    case.write("boxes", "dictionary", f"boxes\n{{\n{boxes}\n}}\n{extra}")
    log = case.run(
        "morphSurface",
        "-dict",
        "boxes",
        *options,
        "in.obj",
        "out.obj",
        status=status,
    )
    if status:
        return log
    moved = vertices(path / "out.obj")
    assert len(moved) == len(points)
    return (moved, log) if output else moved


def table(path):
    """Rows of numbers by their name, of a file that morphSurface writes."""
    lines = path.read_text().splitlines()
    return {line.split()[0]: line.split()[1:] for line in lines[1:]}


def cube_surface(n=6):
    """A unit cube with n x n squares on each side, cut into triangles."""
    index, points, faces = {}, [], []

    def vertex(x):
        key = tuple(np.round(np.array(x) * n).astype(int))
        if key not in index:
            index[key] = len(points)
            points.append(tuple(k / n for k in key))
        return index[key]

    for axis in range(3):
        for end in (0, 1):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for u, v in (
                        (i, j),
                        (i + 1, j),
                        (i + 1, j + 1),
                        (i, j + 1),
                    ):
                        x = np.empty(3)
                        x[axis] = end
                        x[(axis + 1) % 3], x[(axis + 2) % 3] = u / n, v / n
                        corners.append(vertex(x))
                    if not end:
                        corners.reverse()
                    faces += [
                        corners[:3],
                        [corners[0], corners[2], corners[3]],
                    ]
    return np.array(points), faces
