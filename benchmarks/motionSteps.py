# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What a step of the motion costs in OpenFOAM's tutorials: two builds of the
library and the original solver, in turn.

    PYTHONPATH=../tests/support:../tests/dropIn python3 motionSteps.py FILE.md \\
        [FOLDER] [-large] [-before LIBRARY] [-rounds N] [-cases CASE ...]

FOLDER: what tests/dropIn/Allrun -keep FOLDER left. LIBRARY: the
libmorphMotionSolvers.so of another build, measured in the same rounds. CPU
times of the motion solver's own part of a step (tests/dropIn/motionClock):
the medians of all steps after the first, of each round; of the rounds the
median, and of the ratios in each round as well.

-large: the cylinder of timeSteps.py, of a million cells, beside what fvMesh
takes to move, and SnakeRiverCanyon at full size beside displacementSBRStress,
all steps and the moving of the mesh together, as in tolerance.py.
"""

import argparse
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import timeSteps
import tolerance
from foamCase import environment


def program(folder):
    """The solver whose log is there."""
    for line in (folder / "log.run").read_text(errors="replace").splitlines():
        if line.startswith("Exec "):
            return line.split(":", 1)[1].split()
    sys.exit(f"{folder}/log.run names no program")


def seconds(folder, library, steps):
    """CPU time of a step after the first, and of the first."""
    env = dict(environment())
    clock = pathlib.Path(env["MORPHFOAM_LIBBIN"]) / "libmotionClock.so"
    env["LD_PRELOAD"] = ":".join(
        str(part) for part in (clock, library, env.get("LD_PRELOAD")) if part
    )
    env["MOTION_CLOCK"] = str(folder / "motionClock")
    env["PWD"] = str(folder)
    env["OMP_NUM_THREADS"] = env["OPENBLAS_NUM_THREADS"] = "1"
    done = subprocess.run(
        program(folder),
        cwd=folder,
        env=env,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode:
        sys.exit(f"{folder}: {done.stdout[-2000:].decode(errors='replace')}")
    calls = [
        float(line)
        for line in (folder / "motionClock").read_text().splitlines()
    ]
    n = max(1, len(calls) // steps)
    each = [sum(calls[i : i + n]) for i in range(0, n * steps, n)]
    return statistics.median(each[1:]), each[0]


def n_steps(folder):
    log = (folder / "log.run").read_text(errors="replace")
    return sum(line.startswith("Time = ") for line in log.splitlines())


def measured(case, before, rounds):
    ours = case / "change"
    if not (ours / "motionClock").exists():
        ours = case / "twoLines"
    runs = {"original": (case / "original", None), "now": (ours, None)}
    if before:
        runs["before"] = (ours, before)
    times = {name: [] for name in runs}
    for _ in range(rounds):
        for name, (folder, library) in runs.items():
            times[name].append(seconds(folder, library, n_steps(folder)))
    return times


def row(name, times):
    def figures(which, k):
        return statistics.median(t[k] for t in times[which])

    def ratio(which):
        return statistics.median(
            t[0] / o[0] for t, o in zip(times[which], times["original"])
        )

    cells = [name, f"{1e3*figures('original', 0):.3g}"]
    for which in ("before", "now"):
        if which in times:
            cells += [
                f"{1e3*figures(which, 0):.3g}",
                f"{ratio(which):.2f}",
                f"{1e3*figures(which, 1):.3g}",
            ]
        else:
            cells += ["", "", ""]
    return "| " + " | ".join(cells) + " |", {
        which: ratio(which) for which in times if which != "original"
    }


def move_steps(folder, library):
    """Of moveSteps: CPU times of the motion, and of moving the mesh."""
    env = dict(environment())
    env["LD_PRELOAD"] = ":".join(
        str(part) for part in (library, env.get("LD_PRELOAD")) if part
    )
    env["OMP_NUM_THREADS"] = env["OPENBLAS_NUM_THREADS"] = "1"
    for former in folder.glob("[1-9]*"):
        shutil.rmtree(former)
    output = subprocess.run(
        ["moveSteps"], cwd=folder, env=env, stdout=subprocess.PIPE, check=True
    ).stdout.decode()
    found = re.findall(
        r"^step \d+ motion (\S+) move (\S+)", output, re.MULTILINE
    )
    return [(float(a), float(b)) for a, b in found]


def large(before, rounds):
    """Tables of the large cases."""
    builds = {"before": before, "now": None} if before else {"now": None}
    lines = [
        "| cylinder, cells | build | first step [s] | each further step [s] | "
        "fvMesh::movePoints [s] |",
        "|---|---|---|---|---|",
    ]
    median = statistics.median
    with tempfile.TemporaryDirectory() as folder:
        for cells, size in timeSteps.SIZES.items():
            path = pathlib.Path(folder) / str(cells)
            timeSteps.make_case(path, *size)
            library, coeffs = timeSteps.MOTIONS["rbfMotionSolver"]
            (path / "constant/dynamicMeshDict").write_text(
                timeSteps.header("dynamicMeshDict")
                + "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
                f"motionSolverLibs ({library});\n"
                f"motionSolver rbfMotionSolver;\n{coeffs}"
            )
            runs = {name: [] for name in builds}
            for _ in range(rounds):
                for name, library in builds.items():
                    runs[name].append(move_steps(path, library))
            n = 4 * size[0] * size[1] * size[2]
            for name, all_of in runs.items():
                first = median(run[0][0] for run in all_of)
                later = median(s[0] for run in all_of for s in run[1:])
                move = median(s[1] for run in all_of for s in run[1:])
                lines.append(
                    f"| {n:,} | {name} | {first:.3f} | {later:.3f} | "
                    f"{move:.3f} |"
                )
            print("\n".join(lines[-2:]), flush=True)
        lines += [
            "",
            "| SnakeRiverCanyon, full size | all steps [s] | of it the motion "
            "[s] |",
            "|---|---|---|",
        ]
        path = pathlib.Path(folder) / "SnakeRiverCanyon"
        tolerance.snake_river_canyon(path)
        dictionary = path / "constant/dynamicMeshDict"
        ours = dictionary.read_text()
        theirs = (path / "constant/sbrStress").read_text()
        builds = dict({"displacementSBRStress": None}, **builds)
        runs = {name: [] for name in builds}
        for _ in range(rounds):
            for name, library in builds.items():
                dictionary.write_text(
                    theirs if name == "displacementSBRStress" else ours
                )
                runs[name].append(move_steps(path, library))
        for name, all_of in runs.items():
            both = median(sum(a + b for a, b in run) for run in all_of)
            motion = median(sum(a for a, _ in run) for run in all_of)
            lines.append(f"| {name} | {both:.2f} | {motion:.2f} |")
    return lines + [""]


def tutorials(arguments):
    """The table of the tutorials."""
    lines = [
        "| tutorial | original [ms] | before [ms] | ratio | first step [ms] "
        "| now [ms] | ratio | first step [ms] |",
        "|---|---|---|---|---|---|---|---|",
    ]
    ratios = []
    for case in sorted(arguments.folder.iterdir()):
        wanted = not arguments.cases or any(
            part in case.name for part in arguments.cases
        )
        ran = [
            (case / name / "motionClock").exists()
            for name in ("original", "change", "twoLines")
        ]
        if not wanted or not ran[0] or not any(ran[1:]):
            continue
        line, found = row(
            case.name.replace(".", "/"),
            measured(case, arguments.before, arguments.rounds),
        )
        lines.append(line)
        ratios.append(found)
        print(line, flush=True)
    for which in ("before", "now"):
        all_of = [r[which] for r in ratios if which in r]
        if all_of:
            lines.append("")
            lines.append(
                f"Ratio to the original, {which}: median "
                f"{statistics.median(all_of):.2f} of {len(all_of)}, above "
                f"1.1 in {sum(r > 1.1 for r in all_of)}, largest "
                f"{max(all_of):.2f}."
            )
    return lines + [""]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    parser.add_argument("folder", type=pathlib.Path, nargs="?")
    parser.add_argument("-large", action="store_true")
    parser.add_argument("-before")
    parser.add_argument("-rounds", type=int, default=5)
    parser.add_argument("-cases", nargs="+")
    arguments = parser.parse_args()

    lines = (
        large(arguments.before, arguments.rounds) if arguments.large else []
    )
    if arguments.folder:
        lines += tutorials(arguments)
    lines.append(
        f"Medians of {arguments.rounds} rounds, CPU times; load of the "
        f"machine {os.getloadavg()[1]:.1f}."
    )
    pathlib.Path(arguments.file).write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
