# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Fields of cells: write them by a formula, read them, sum them up."""

import re

import numpy as np

from boxCase import words

CLASSES = {1: "Scalar", 3: "Vector", 6: "SymmTensor", 9: "Tensor"}


def read_internal(case, file):
    """The values of an ascii field in cells, in rows of components."""
    text = (case.path / file).read_text()
    body = re.search(
        r"internalField\s+nonuniform List<\w+>\s*(\d+)\s*\((.*?)\n\)",
        text,
        re.DOTALL,
    )
    if not body:
        value = re.search(r"internalField\s+uniform\s+([^;]*);", text)[1]
        return np.array([value.strip("() ").split()], float)
    numbers = body[2].replace("(", " ").replace(")", " ").split()
    return np.array(numbers, float).reshape(int(body[1]), -1)


def measure(case, time):
    """Centres and volumes of the cells, as OpenFOAM has them."""
    case.run(
        *f"postProcess -time {time} -funcs (writeCellCentres writeCellVolumes)".split(
            " ", 4
        )
    )
    return (
        read_internal(case, f"{time}/C"),
        read_internal(case, f"{time}/V")[:, 0],
    )


def write_field(case, file, values, boundary="type zeroGradient;"):
    """A field of cells with these rows of values."""
    values = np.asarray(values, float).reshape(len(values), -1)
    n = values.shape[1]
    rows = [words(row) if n == 1 else f"({words(row)})" for row in values]
    kind = "scalar" if n == 1 else CLASSES[n][0].lower() + CLASSES[n][1:]
    case.write(
        file,
        f"vol{CLASSES[n]}Field",
        "dimensions [0 0 0 0 0 0 0];\n"
        f"internalField nonuniform List<{kind}> {len(rows)}\n("
        + "\n".join(rows)
        + f'\n);\nboundaryField {{ ".*" {{ {boundary} }} }}',
    )
