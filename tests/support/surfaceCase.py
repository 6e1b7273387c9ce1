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
