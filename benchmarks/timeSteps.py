# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What a time step of a moving mesh costs: the motion solvers beside each other,
and beside the flow solver's own step.

    timeSteps.py FILE.md [-cells N ...]     (with the environment of etc/bashrc)

tutorials/oscillatingCylinder, two diameters wide: the cylinder moves, points of
the sides slide. Every solver moves the same mesh through the same steps, one
after the other on one core, for its own (benchmarks/moveSteps: no flow); CPU
times, since other programs may run. "flow" is a step of pimpleFoam on that mesh
at rest.
"""

import argparse
import os
import pathlib
import re
import shutil
import statistics
import sys
import tempfile
from openfoam import header, run

HERE = pathlib.Path(__file__).resolve().parent
TUTORIAL = HERE.parent / "tutorials/oscillatingCylinder"

# Cells around a quarter of the cylinder, away from it, and along it
SIZES = {100_000: (32, 80, 10), 1_000_000: (64, 160, 25)}
STEPS = 5

MOTIONS = {
    "rbfMotionSolver": (
        "morphMotionSolvers",
        """
rbfMotionSolverCoeffs { supportRadius 15; }
libs (morphMotionSolvers);""",
    ),
    "displacementLaplacian": (
        "fvMotionSolvers",
        """
displacementLaplacianCoeffs { diffusivity quadratic inverseDistance (cylinder); }
""",
    ),
    "displacementSBRStress": (
        "fvMotionSolvers",
        """
displacementSBRStressCoeffs { diffusivity quadratic inverseDistance (cylinder); }
""",
    ),
}

# As in OpenFOAM's wingMotion
LINEAR_SOLVER = """
    cellDisplacement
    {
        solver          GAMG;
        tolerance       1e-5;
        relTol          0;
        smoother        GaussSeidel;
    }
"""


def replace(path, *changes):
    text = path.read_text()
    for old, new in changes:
        if not re.search(old, text):
            sys.exit(f"{path} has no {old}")
        text = re.sub(old, new, text)
    path.write_text(text)


def make_case(path, around, away, along):
    """The tutorial's case with a mesh of three dimensions."""
    shutil.copytree(
        TUTORIAL, path, ignore=shutil.ignore_patterns("runs", "results")
    )
    (path / "0").mkdir()
    for file in (path / "0.orig").iterdir():
        text = file.read_text().replace("empty", "symmetry")
        (path / "0" / file.name).write_text(text)
    replace(
        path / "system/blockMeshDict",
        (r" 0\.1\)", " 2)"),
        (r"\$around 1\)", f"$around {along})"),
        ("empty", "symmetry"),
    )
    replace(
        path / "system/resolution",
        (r"around +\d+", f"around {around}"),
        (r"away +\d+", f"away {away}"),
    )

    replace(
        path / "system/controlDict",
        (r"endTime +78", f"endTime {0.03*STEPS}"),
        (r"functions\n\{(.|\n)*\n\}", ""),
    )
    replace(
        path / "system/fvSchemes",
        ("default         none", "default Gauss linear"),
    )
    replace(
        path / "system/fvSolution",
        (r"solvers\n\{", "solvers\n{" + LINEAR_SOLVER),
    )
    run(path, "blockMesh")


def motion_times(path, name):
    """CPU time of the first step, of the others (median), what the mesh takes
    (median), and what the log says of the selection."""
    library, coeffs = MOTIONS[name]
    (path / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        f"motionSolverLibs ({library});\nmotionSolver {name};\n{coeffs}"
    )
    output = run(path, "moveSteps")
    steps = [
        [float(x) for x in row]
        for row in re.findall(
            r"^step \d+ motion (\S+) move (\S+)", output, re.MULTILINE
        )
    ]
    selected = re.findall(r"selected (\d+ of \d+)", output)
    return (
        steps[0][0],
        statistics.median(s[0] for s in steps[1:]),
        statistics.median(s[1] for s in steps[1:]),
        selected[-1] if selected else "",
    )


def flow_time(path):
    """CPU time of a step of the flow solver, median without the first."""
    dictionary = path / "constant/dynamicMeshDict"
    dictionary.unlink()
    output = run(path, "pimpleFoam")
    times = [
        float(t)
        for t in re.findall(r"^ExecutionTime = (\S+) s", output, re.MULTILINE)
    ]
    return statistics.median(b - a for a, b in zip(times, times[1:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument(
        "-cells", type=int, nargs="+", default=list(SIZES), choices=list(SIZES)
    )
    arguments = parser.parse_args()

    lines = [
        "| cells | solver | first step [s] | each further step [s] | of a "
        "step of the flow | control points |",
        "|---|---|---|---|---|---|",
    ]
    for cells in arguments.cells:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "case"
            make_case(path, *SIZES[cells])
            rows = {name: motion_times(path, name) for name in MOTIONS}
            flow = flow_time(path)
        n = f"{4*SIZES[cells][0]*SIZES[cells][1]*SIZES[cells][2]:,}"
        for name, (first, further, _, selected) in rows.items():
            lines.append(
                f"| {n} | {name} | {first:.3f} | {further:.3f} | "
                f"{100*further/flow:.1f} % | {selected} |"
            )
        mesh = statistics.median(row[2] for row in rows.values())
        lines.append(
            f"| {n} | any: fvMesh::movePoints | | {mesh:.3f} | "
            f"{100*mesh/flow:.1f} % | |"
        )
        lines.append(f"| {n} | pimpleFoam, flow | | {flow:.3f} | | |")
        print("\n".join(lines), flush=True)

    load = os.getloadavg()[1]
    cpu = re.search(
        r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text()
    )[1]
    pathlib.Path(arguments.file).write_text(
        "\n".join(lines) + f"\n\nOne core of {cpu}, CPU times; load of the "
        f"machine while it ran {load:.1f}.\n"
    )


if __name__ == "__main__":
    main()
