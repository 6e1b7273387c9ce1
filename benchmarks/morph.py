"""Where the time of one morphMesh goes, on one rank and on two.

    morph.py FILE.md        (with the environment of etc/bashrc)

Two of OpenFOAM's own meshes: airFoil2D pitched by 90 degrees, and the bed of
SnakeRiverCanyon, 12,002 control points, at its first time step. Medians of five
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

TUTORIALS = pathlib.Path(os.environ["FOAM_TUTORIALS"])
RUNS = 5

CASES = {
    "airFoil2D, 90 degrees": (
        "incompressible/simpleFoam/airFoil2D", """
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
    greedy { tolerance 1e-6; }"""),
    "SnakeRiverCanyon": (
        "mesh/moveDynamicMesh/SnakeRiverCanyon", "greedy { tolerance 1e-5; }"),
}

# What is reported, and where in the output of morphMesh it stands
PHASES = {
    "selected": r"selected (\d+) of",
    "sweeps [s]": r"sweep (\S+) s,",
    "lists [s]": r"list (\S+) s,",
    "algebra [s]": r"list \S+ s, solve (\S+) s",
    "propagation [s]": r"propagation (\S+) s",
    "mesh check in the solver [s]": r"propagation \S+ s, mesh check (\S+) s",
    "all of solve [s]": r"construction \S+, solve ([^,\s]+)",
    "reading [s]": r"reading ([^,\s]+)",
    "solver construction [s]": r"solver construction ([^,\s]+)",
    "check of morphMesh [s]": r"check ([^,\s]+), write",
    "writing [s]": r"write (\S+)$",
    "collectives of selection": r"sweeps, (\d+) collectives",
    "received by them [B]": r"collectives, (\S+) B",
}


def header(name):
    return ("FoamFile { version 2.0; format ascii; class dictionary; "
            f"object {name}; }}\n")


def make_case(path, tutorial, coeffs):
    """A copy of the tutorial that rbfMotionSolver moves at time 1."""
    shutil.copytree(TUTORIALS/tutorial, path)
    (path/"constant/dynamicMeshDict").write_text(
        header("dynamicMeshDict")
        + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        "motionSolverLibs (morphMotionSolvers);\n"
        "motionSolver rbfMotionSolver;\n"
        f"rbfMotionSolverCoeffs\n{{{coeffs}\n}}\n")
    with open(path/"system/controlDict", "a") as control:
        control.write("\nlibs (morphMotionSolvers);\n"
                      "DebugSwitches { rbfMotionSolver 1; }\n")
    (path/"system/decomposeParDict").write_text(
        header("decomposeParDict") + "numberOfSubdomains 2; method simple;\n"
        "simpleCoeffs { n (2 1 1); delta 0.001; }\n")
    if (path/"system/blockMeshDict").exists():
        run(path, "blockMesh")
    if (path/"0").exists():
        shutil.copytree(path/"0", path/"1")
    run(path, "decomposePar", "-time", "1")


def run(path, *command):
    done = subprocess.run(command, cwd=path, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    output = done.stdout.decode()
    if done.returncode:
        sys.exit(f"{command} failed:\n{output[-3000:]}")
    return output


def measure(path, ranks):
    """The median of each phase."""
    command = ["morphMesh", "-time", "1"]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), *command, "-parallel"]
    outputs = [run(path, *command) for _ in range(RUNS)]
    return {
        phase: statistics.median(
            float(re.search(pattern, output, re.MULTILINE)[1])
            for output in outputs)
        for phase, pattern in PHASES.items()}


def main(file):
    columns = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, (tutorial, coeffs) in CASES.items():
            path = pathlib.Path(folder)/pathlib.Path(tutorial).name
            make_case(path, tutorial, coeffs)
            for ranks in (1, 2):
                columns[f"{name}, {ranks} rank{'s'[:ranks - 1]}"] = \
                    measure(path, ranks)

    lines = ["| | " + " | ".join(columns) + " |",
             "|---|" + "---|"*len(columns)]
    for phase in PHASES:
        lines.append(f"| {phase} | " + " | ".join(
            f"{column[phase]:.4g}" for column in columns.values()) + " |")
    text = "\n".join(lines) + "\n"
    print(text)
    pathlib.Path(file).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1])
