# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What many periods of a motion leave behind: the mesh after a hundred periods
beside that after one, and the memory of a thousand steps.

    drift.py FILE.md        (with the environment of etc/bashrc)

tutorials/oscillatingCylinder on its coarse mesh, ten steps to a period, each
motion solver for itself (benchmarks/moveSteps).
"""

import pathlib
import re
import sys
import tempfile

from openfoam import header, run
from timeSteps import MOTIONS, make_case, replace

PERIODS = 100
STEPS = 10

DRIFTING = {
    name: MOTIONS[name]
    for name in ("rbfMotionSolver", "displacementLaplacian")
}


def measure(path, name):
    library, coeffs = DRIFTING[name]
    (path / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        f"motionSolverLibs ({library});\nmotionSolver {name};\n{coeffs}"
    )
    output = run(path, "moveSteps", "-period", str(STEPS))
    memory = [int(kB) for kB in re.findall(r"memory (\d+)", output)]
    apart = [
        float(d)
        for d in re.findall(
            r"^period \d+ difference (\S+)", output, re.MULTILINE
        )
    ]
    return apart[-1], max(apart), memory


def main(file):
    lines = [
        f"| solver | after period {PERIODS} [diameters] | largest of all "
        "periods | memory after 100 steps [kB] | after "
        f"{PERIODS*STEPS} |",
        "|---|---|---|---|---|",
    ]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "case"
        make_case(path, 16, 44, 4)
        replace(
            path / "system/controlDict",
            (r"endTime +\S+;", f"endTime {6*PERIODS};"),
            (r"writeInterval +1.5", "writeInterval 10000"),
        )
        replace(path / "system/resolution", (r"deltaT +\S+;", "deltaT 0.6;"))
        for name in DRIFTING:
            last, largest, memory = measure(path, name)
            lines.append(
                f"| {name} | {last:.2g} | {largest:.2g} | "
                f"{memory[99]} | {memory[-1]} |"
            )
            print(lines[-1], flush=True)
    pathlib.Path(file).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
