# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Where the time of one morphMesh goes, on one rank and on two, and what
surfaceCorrection costs in each of several steps.

    morph.py FILE.md        (with the environment of etc/bashrc)

Two of OpenFOAM's own meshes: airFoil2D pitched by 90 degrees, and the bed of
SnakeRiverCanyon, 12,002 control points, at its first time step. Steps: airFoil2D
again, and a block that swings in a box of 100,448 cells. Medians of five
runs; the phases are those that the debug switch of rbfMotionSolver reports.
"""

import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from openfoam import header, run

TUTORIALS = pathlib.Path(os.environ["FOAM_TUTORIALS"])
RUNS = 5

CASES = {
    "airFoil2D, 90 degrees": (
        "incompressible/simpleFoam/airFoil2D",
        """
    supportRadius 250;
    controlPoints
    {
        aerofoil
        {
            type moving; patches (walls);
            displacement
            {
                type solidBody; solidBodyMotionFunction axisRotationMotion;
                axisRotationMotionCoeffs
                { origin (0 0 0); radialVelocity (0 0 -90); }
            }
        }
        farField { type fixed; patches (inlet outlet); }
    }
    greedy { tolerance 1e-6; }""",
    ),
    "SnakeRiverCanyon": (
        "mesh/moveDynamicMesh/SnakeRiverCanyon",
        "greedy { tolerance 1e-5; }",
    ),
}

# What is reported, and where in the output of morphMesh it stands
PHASES = {
    "selected": r"selected (\d+) of",
    "sweeps [s]": r"sweep (\S+) s,",
    "lists [s]": r"list (\S+) s,",
    "algebra [s]": r"list \S+ s, solve (\S+) s",
    "propagation [s]": r"propagation (\S+) s,",
    "mesh check in the solver [s]": r"mesh check (\S+) s",
    "all of solve [s]": r"construction \S+, solve ([^,\s]+)",
    "reading [s]": r"reading ([^,\s]+)",
    "solver construction [s]": r"solver construction ([^,\s]+)",
    "check of morphMesh [s]": r"check ([^,\s]+), write",
    "writing [s]": r"write (\S+)$",
    "collectives of selection": r"sweeps, (\d+) collectives",
    "received by them [B]": r"collectives, (\S+) B",
}


def make_case(path, tutorial, coeffs):
    """A copy of the tutorial that rbfMotionSolver moves at time 1."""
    shutil.copytree(TUTORIALS / tutorial, path)
    (path / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        "motionSolverLibs (morphMotionSolvers);\n"
        "motionSolver rbfMotionSolver;\n"
        f"rbfMotionSolverCoeffs\n{{{coeffs}\n}}\n"
    )
    with open(path / "system/controlDict", "a") as control:
        control.write(
            "\nlibs (morphMotionSolvers);\n"
            "DebugSwitches { rbfMotionSolver 1; }\n"
        )
    (path / "system/decomposeParDict").write_text(
        header("decomposeParDict") + "numberOfSubdomains 2; method simple;\n"
        "simpleCoeffs { n (2 1 1); delta 0.001; }\n"
    )
    if (path / "system/blockMeshDict").exists():
        run(path, "blockMesh")
    if (path / "0").exists():
        shutil.copytree(path / "0", path / "1")
    run(path, "decomposePar", "-time", "1")


def measure(path, ranks):
    """The median of each phase."""
    command = ["morphMesh", "-time", "1"]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), *command, "-parallel"]
    outputs = [run(path, *command) for _ in range(RUNS)]
    return {
        phase: statistics.median(
            float(re.search(pattern, output, re.MULTILINE)[1])
            for output in outputs
        )
        for phase, pattern in PHASES.items()
    }


STEPS = 10

SWING = """
            type moving; patches (%s);
            displacement
            {
                type solidBody;
                solidBodyMotionFunction oscillatingRotatingMotion;
                oscillatingRotatingMotionCoeffs
                { origin (%s); amplitude (%s); omega 0.1; }
            }"""


def body_in_box(path):
    """47 x 47 x 47 cells without the 15 x 15 x 15 of a block in the middle."""
    (path / "system").mkdir(parents=True)
    ticks, cells = (0, 1.2, 2.2, 3.4), (16, 15, 16)
    points = [f"({x} {y} {z})" for z in ticks for y in ticks for x in ticks]
    blocks, body = [], ""
    for k in range(3):
        for j in range(3):
            for i in range(3):
                low = [i + 4 * j + 16 * k + d for d in (0, 1, 5, 4)]
                v = low + [a + 16 for a in low]
                if (i, j, k) == (1, 1, 1):
                    body = " ".join(
                        "(" + " ".join(str(v[c]) for c in face) + ")"
                        for face in (
                            (0, 3, 2, 1),
                            (4, 5, 6, 7),
                            (0, 4, 7, 3),
                            (1, 2, 6, 5),
                            (0, 1, 5, 4),
                            (3, 7, 6, 2),
                        )
                    )
                    continue
                blocks.append(
                    f"hex ({' '.join(map(str, v))}) ({cells[i]} "
                    f"{cells[j]} {cells[k]}) simpleGrading (1 1 1)"
                )
    (path / "system/blockMeshDict").write_text(
        header("blockMeshDict")
        + "scale 1;\nvertices ("
        + "\n".join(points)
        + ");\nblocks ("
        + "\n".join(blocks)
        + ");\nedges ();\n"
        f"boundary (body {{ type wall; faces ({body}); }});\n"
        "defaultPatch { name box; type patch; }\n"
    )


def make_steps(path, patch, fixed, origin, amplitude, settings):
    """A case that moves its mesh several times."""
    groups = (
        f"controlPoints {{ body {{{SWING % (patch, origin, amplitude)}}}"
        f" rest {{ type fixed; patches ({fixed}); }} }}"
    )
    (path / "constant").mkdir(exist_ok=True)
    (path / "constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        "motionSolverLibs (morphMotionSolvers);\n"
        "motionSolver rbfMotionSolver;\n"
        f"rbfMotionSolverCoeffs {{ {groups} {settings} "
        '#includeIfPresent "correction" }\n'
    )
    (path / "system/controlDict").write_text(
        header("controlDict") + "application moveDynamicMesh;\n"
        "startFrom startTime; startTime 0; stopAt endTime;\n"
        f"endTime {STEPS}; deltaT 1; writeControl timeStep;\n"
        "writeInterval 1000; libs (morphMotionSolvers);\n"
        "DebugSwitches { rbfMotionSolver 1; }\n"
    )
    for name in ("fvSchemes", "fvSolution"):
        (path / "system" / name).write_text(
            header(name)
            + (
                "ddtSchemes {} gradSchemes {} divSchemes {} "
                "laplacianSchemes {}\n"
                if name == "fvSchemes"
                else "\n"
            )
        )
    if (path / "system/blockMeshDict").exists():
        run(path, "blockMesh")


def measure_steps(path, correction):
    """Seconds of each phase in the median step (the first apart), CPU seconds
    and peak memory [MB] of the whole run."""
    (path / "constant/correction").write_text(
        f"surfaceCorrection {correction};\n"
    )
    process = subprocess.Popen(
        ["moveDynamicMesh"],
        cwd=path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    output = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"moveDynamicMesh failed:\n{output[-3000:]}")
    steps = [
        [float(x) for x in found]
        for found in re.findall(
            r"conditions (\S+) s, selection (\S+) s, propagation (\S+) s, "
            r"mesh check (\S+) s",
            output,
        )
    ][:STEPS]
    propagations = [step[2] for step in steps[1:]]
    return {
        "first step [s]": sum(steps[0]),
        "a later step [s]": statistics.median(map(sum, steps[1:])),
        "its propagation [s]": statistics.median(propagations),
        "CPU time of the run [s]": usage.ru_utime + usage.ru_stime,
        "peak memory [MB]": usage.ru_maxrss / 1024,
    }


def steps_table(folder):
    aerofoil = folder / "aerofoilSteps"
    shutil.copytree(
        TUTORIALS / "incompressible/simpleFoam/airFoil2D", aerofoil
    )
    make_steps(
        aerofoil,
        "walls",
        "inlet outlet",
        "0 0 0",
        "0 0 20",
        "supportRadius 250; greedy { tolerance 1e-6; }",
    )
    box = folder / "boxSteps"
    body_in_box(box)
    make_steps(
        box,
        "body",
        "box",
        "1.7 1.7 1.7",
        "10 5 20",
        "greedy { tolerance 1e-3; }",
    )

    columns = {}
    for name, path in (("airFoil2D", aerofoil), ("block in a box", box)):
        runs = {"no": [], "yes": []}
        for _ in range(RUNS):
            for correction, results in runs.items():
                results.append(measure_steps(path, correction))
        for correction, results in runs.items():
            columns[f"{name}, surfaceCorrection {correction}"] = {
                key: statistics.median(r[key] for r in results)
                for key in results[0]
            }
    return columns


def table(columns):
    rows = list(next(iter(columns.values())))
    lines = [
        "| | " + " | ".join(columns) + " |",
        "|---|" + "---|" * len(columns),
    ]
    for row in rows:
        lines.append(
            f"| {row} | "
            + " | ".join(f"{column[row]:.4g}" for column in columns.values())
            + " |"
        )
    return "\n".join(lines) + "\n"


def main(file):
    columns = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, (tutorial, coeffs) in CASES.items():
            path = pathlib.Path(folder) / pathlib.Path(tutorial).name
            make_case(path, tutorial, coeffs)
            for ranks in (1, 2):
                columns[f"{name}, {ranks} rank{'s'[:ranks - 1]}"] = measure(
                    path, ranks
                )
        text = table(columns) + "\n" + table(steps_table(pathlib.Path(folder)))
    print(text)
    pathlib.Path(file).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1])
