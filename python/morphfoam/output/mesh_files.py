# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Points and patches of a mesh in ascii files.

    points = readVectors(case / "constant/polyMesh/points")
    on = patchPoints(case / "constant/polyMesh", "hull")      # labels
"""

import re
from pathlib import Path

import numpy as np

LIST = re.compile(r"\n\d+\s*\n?\((.*)\)", re.DOTALL)


def read_vectors(path):
    """The n x 3 array of a list of vectors, as of points."""
    body = LIST.search(Path(path).read_text()).group(1)
    return np.array(
        body.replace("(", " ").replace(")", " ").split(), float
    ).reshape(-1, 3)


def replace_vectors(path, vectors):
    """Puts others, with all digits, in the place of those of a file."""
    path = Path(path)
    text = path.read_text()
    body = "\n".join(
        "({!r} {!r} {!r})".format(*map(float, v)) for v in vectors
    )
    path.write_text(
        text[: LIST.search(text).start()] + f"\n{len(vectors)}\n(\n{body}\n)\n"
    )


def patch_points(mesh, name):
    """The labels of a patch's points."""
    mesh = Path(mesh)
    entry = re.search(
        rf"\b{name}\s*\{{(.*?)\}}", (mesh / "boundary").read_text(), re.DOTALL
    ).group(1)
    n, start = (
        int(re.search(rf"{key}\s+(\d+);", entry).group(1))
        for key in ("nFaces", "startFace")
    )
    faces = re.findall(r"\n\d+\(([\d ]+)\)", (mesh / "faces").read_text())
    return np.unique(
        [int(i) for face in faces[start : start + n] for i in face.split()]
    )
