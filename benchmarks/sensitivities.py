# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The cost of dx/dmu of a whole mesh by the parameters of a lattice that radial
basis functions carry, beside that of a motion.

    sensitivities.py FILE.md [CELLS ...]    (with the environment of etc/bashrc)

A cube whose top a lattice of 5 x 5 x 3 deforms by twenty parameters; its sides
slide. CPU time of one core, medians of three runs, without reading and
writing: the propagation of a motion (debug 1), and all parameters together.
"""

import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from ffd import CONTROL, HEADER, MESH, SCHEMES

PARAMETERS = 20

MOTION = """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (morphMotionSolvers);
motionSolver rbfMotionSolver;
rbfMotionSolverCoeffs
{{
    supportRadius 1.5;
    subSteps 1;
    greedy {{ tolerance 1e-4; }}
    controlPoints
    {{
        top
        {{
            type moving; patches (top);
            displacement
            {{
                type ffd;
                boxes {{ box {{ origin (-0.1 -0.1 0.5); span (1.2 1.2 0.6);
                    order (4 4 2); parameters {{ {parameters} }} }} }}
            }}
        }}
        bottom {{ type fixed; patches (bottom); }}
        sides {{ type sliding; patches (sides); }}
    }}
}}
"""


def make_case(path, cells):
    places = [(i, j) for i in range(5) for j in range(4)][:PARAMETERS]
    parameters = " ".join(
        f"mu{n} {{ value 0.1; moves ( (({i} {j} 2) (0 0 0.3)) ); }}"
        for n, (i, j) in enumerate(places)
    )
    mesh = MESH.format(cells, cells, cells).replace(
        "boundary ();",
        "boundary ( top { type patch; faces ((4 5 6 7)); }"
        " bottom { type patch; faces ((0 3 2 1)); } );",
    )
    for name, body in (
        (
            "system/controlDict",
            CONTROL + "DebugSwitches { rbfMotionSolver 1; }"
            ' libs ("libmorphMotionSolvers.so");',
        ),
        ("system/fvSchemes", SCHEMES),
        ("system/fvSolution", ""),
        ("system/blockMeshDict", mesh),
        ("constant/dynamicMeshDict", MOTION.format(parameters=parameters)),
    ):
        file = path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(HEADER.format(file.name) + body)


def run(path, *command):
    return subprocess.run(
        command, cwd=path, check=True, stdout=subprocess.PIPE, text=True
    ).stdout


def measure(path):
    """Seconds of a motion and of all parameters, and selected points."""
    output = run(
        path, "morphMesh", "-time", "1", "-dryRun", "-derivatives", "(top)"
    )
    first = output.split("dx/dmu of parameter 0:")
    once = sum(
        float(s)
        for s in re.findall(r"dx/dmu of parameter \d+: (\S+) s", output)
    )
    # Volumes, then the file of the boundary: two passes over all parameters
    passes = len(first) - 1
    motion = re.search(r"propagation (\S+) s", output)
    selected = re.search(r"selected (\d+) of", output).group(1)
    return float(motion.group(1)), once / passes, int(selected)


def main(file, sizes):
    lines = [
        "| points | selected | propagation of a motion [s] | "
        f"dx/dmu by {PARAMETERS} parameters [s] | each, in motions |",
        "|---|---|---|---|---|",
    ]
    for cells in sizes:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            make_case(path, cells)
            run(path, "blockMesh")
            rows = [measure(path) for _ in range(3)]
        motion, all_of_them = (
            statistics.median(row[i] for row in rows) for i in (0, 1)
        )
        lines.append(
            f"| {(cells + 1)**3:,} | {rows[0][2]} | {motion:.3g} | "
            f"{all_of_them:.3g} | {all_of_them/PARAMETERS/motion:.2f} |"
        )
    pathlib.Path(file).write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main(sys.argv[1], [int(n) for n in sys.argv[2:]] or [45, 99])
