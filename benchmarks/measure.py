# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Runs the two benchmark programs and collects what they print."""

import bisect
import csv
import datetime
import json
import lzma
import pathlib
import platform
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
BUILD = ROOT / "build" / "benchmarks"

# The algorithms as options of benchmarkSelection
ALGORITHMS = {
    "standard": ["-algorithm", "standard"],
    "schur": ["-algorithm", "schur"],
    "one point": ["-pointsPerSweep", "1"],
    "blocks": [],
}

# From what a full run measures, and a quick one
FULL = {
    # Figure 1(a), fan13k
    "fractions": [0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.6],
    "sizes": [200, 300, 500, 1000],
    # Figure 1(b), fan13k: 44 to 1352 points
    "fan": [4.5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1.15e-4, 4.5e-5],
    "fanRows": [1e-3, 1.15e-4, 4.5e-5],
    "rib": [1e-3, 3e-4, 1e-4, 3e-5, 1e-5],
    "ribRows": [1e-5],
    "box": [1e-2, 1.7e-3, 3e-4, 1e-4, 2.85e-5],
    "boxRows": [1.7e-3, 2.85e-5],
    "boxStandard": 1.7e-3,
    "repeats": 7,
    "kernelRepetitions": 5,
}
QUICK = dict(
    FULL,
    fractions=[0.01, 0.05, 0.1, 0.2, 0.6],
    sizes=[200, 300, 400],
    fan=[4.5e-2, 1e-2, 5e-3, 2e-3, 1e-3],
    fanRows=[1e-3],
    box=[1e-2, 1.7e-3],
    boxRows=[1.7e-3],
    boxStandard=1e-2,
    repeats=3,
    kernelRepetitions=1,
)


def machine():
    """What the figures were measured on."""

    def said(*command):
        done = subprocess.run(
            command,
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            check=False,
        )
        return done.stdout.decode().strip()

    info = pathlib.Path("/proc/cpuinfo").read_text().split("\n")
    words = dict(line.split(":", 1) for line in info if ":" in line)
    words = {key.strip(): value.strip() for key, value in words.items()}
    flags = words.get("flags", "").split()
    package = (
        said("dpkg-query", "-W", "-f=${Version}", "libopenblas0-serial")
        or "unknown"
    )
    changed = said("git", "status", "--porcelain", "src", "benchmarks/*.cpp")
    return {
        "date": datetime.date.today().isoformat(),
        "cpu": "{} (family {}, model {}), {}".format(
            words.get("model name", platform.processor()),
            words.get("cpu family", "?"),
            words.get("model", "?"),
            words.get("cache size", "? KB") + " L2",
        ),
        "instructions": "AVX-512"
        if "avx512f" in flags
        else "AVX2"
        if "avx2" in flags
        else "SSE2",
        "compiler": said("g++", "--version").split("\n")[0],
        "blas": f"OpenBLAS {package}"
        if "openblas" in said("ldd", str(BUILD / "benchmarkSelection"))
        else "none",
        "commit": said("git", "rev-parse", "--short=10", "HEAD")
        + (" and changes" if changed else ""),
        "load": pathlib.Path("/proc/loadavg").read_text().split()[0],
    }


def point_sets():
    """The files of the three sets, unpacked and generated."""
    return {
        "rib": point_set("rib"),
        "fan": point_set("fan13k"),
        "box": point_set("box100k", 100_000),
    }


def point_set(name, count=None):
    """The file of a set, unpacked; with a count generated."""
    folder = BUILD / "points"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.txt"
    if count is None:
        with lzma.open(HERE / "points" / f"{name}.txt.xz") as source:
            path.write_bytes(source.read())
    elif not path.exists():
        generate = HERE / "points/generate.py"
        subprocess.run(
            [sys.executable, generate, path, str(count)], check=True
        )
    return path


def median(values):
    values = sorted(values)
    n = len(values)
    return (values[(n - 1) // 2] + values[n // 2]) / 2


class Run:
    """Repetitions of one selection, and the trajectory of the first."""

    def __init__(self, points, algorithm, tolerance, *more, repeats=1):
        self.trajectory_file = BUILD / "trajectory.csv"
        self.selected_file = BUILD / "selected.txt"
        command = [
            BUILD / "benchmarkSelection",
            points,
            "-tolerance",
            tolerance,
            "-repeats",
            repeats,
            "-trajectory",
            self.trajectory_file,
            "-selected",
            self.selected_file,
            *ALGORITHMS[algorithm],
            *more,
        ]
        print(
            "   ",
            points.stem,
            algorithm,
            f"to {tolerance:g}",
            *more,
            flush=True,
        )
        done = subprocess.run(
            list(map(str, command)), check=True, stdout=subprocess.PIPE
        )
        runs = [json.loads(line) for line in done.stdout.decode().splitlines()]
        self.result = dict(runs[0])
        for phase in ("sweep", "list", "solve", "total"):
            self.result[phase] = median([run[phase] for run in runs])
        self.result["spread"] = max(run["total"] for run in runs) / min(
            run["total"] for run in runs
        )
        self.result["repeats"] = repeats
        self.selected = self.selected_file.read_text().split()
        self.trajectory = self._trajectory(repeats)

    def _trajectory(self, repeats):
        """(selected, error, median seconds) after each sweep."""
        steps = {}
        with open(self.trajectory_file) as table:
            for row in csv.DictReader(table):
                steps.setdefault(int(row["selected"]), []).append(
                    (float(row["error"]), float(row["seconds"]))
                )
        return [
            (n, step[0][0], median([seconds for _, seconds in step]))
            for n, step in sorted(steps.items())
            if len(step) == repeats
        ]

    def at_size(self, n):
        """Seconds until n points were selected, and the rest known."""
        sizes = [step[0] for step in self.trajectory]
        return self.trajectory[bisect.bisect_left(sizes, n)][2]

    def at_tolerance(self, tolerance):
        """(selected, seconds) of a run to this tolerance."""
        for n, error, seconds in self.trajectory:
            if error <= tolerance:
                return n, seconds
        return None


def restart_fractions(points, plan):
    """Figure 1(a): seconds by fraction and size, assembly apart."""
    rows = []
    small = [n for n in plan["sizes"] if n <= 300]
    for fraction in plan["fractions"]:
        row = {"fraction": fraction}
        options = ["-restartFraction", str(fraction), "-maxPoints"]
        for sizes, repeats in ((small, 3), (plan["sizes"], 1)):
            run = Run(
                points, "schur", 0, *options, str(sizes[-1]), repeats=repeats
            )
            row["assembly"] = run.trajectory[0][2]
            for n in sizes:
                row.setdefault(n, run.at_size(n) - row["assembly"])
        rows.append(row)
    return rows


def compare(points, plan, name):
    """The algorithms on one set, at every tolerance of the plan."""
    tolerances = plan[name]
    last = {
        "standard": tolerances[-1],
        "schur": tolerances[-1],
        "one point": tolerances[-1],
    }
    if name == "box":
        # Standard's n^3 and schur's 81 GB would not end
        last["standard"] = plan["boxStandard"]
        del last["schur"]

    cells, ends, sets = [], {}, {}
    for tolerance in tolerances:
        cells.append(
            {
                "tolerance": tolerance,
                "blocks": Run(
                    points, "blocks", tolerance, repeats=plan["repeats"]
                ).result,
            }
        )
    ends["blocks"] = cells[-1]["blocks"]
    for algorithm, tolerance in last.items():
        repeats = (
            3
            if name == "rib" or algorithm == "one point" and name == "fan"
            else 1
        )
        run = Run(points, algorithm, tolerance, repeats=repeats)
        ends[algorithm] = run.result
        sets[algorithm] = run
        for cell in cells:
            reached = run.at_tolerance(cell["tolerance"])
            if reached:
                cell[algorithm] = dict(zip(("selected", "total"), reached))
    same = (
        sets["standard"].selected == sets["one point"].selected
        if last["standard"] == last["one point"]
        else None
    )
    schur = "schur" in sets and (
        sets["schur"].selected == sets["one point"].selected
    )
    return {
        "cells": cells,
        "ends": ends,
        "onePointIsStandard": same,
        "onePointIsSchur": schur,
    }


def kernels(plan):
    """Seconds per pair by name of benchmark and instruction set."""
    result = {}
    for level in ("", ".v3", ".baseline"):
        command = [
            str(BUILD / ("benchmarkKernels" + level)),
            "--benchmark_format=json",
            "--benchmark_min_time=0.2",
            f"--benchmark_repetitions={plan['kernelRepetitions']}",
        ]
        if level:
            command.append("--benchmark_filter=limit|wendlandC2|naive")
        print("    kernels", level, flush=True)
        done = subprocess.run(
            command,
            check=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        samples = {}
        for run in json.loads(done.stdout.decode())["benchmarks"]:
            if run.get("run_type") == "iteration":
                samples.setdefault(run["run_name"], []).append(run)
        result[level[1:] or "best"] = {
            name: {
                "pair": median([run["pair"] for run in runs]),
                "reached": runs[0].get("reached"),
            }
            for name, runs in samples.items()
        }
    return result


def everything(plan):
    """All measurements."""
    files = point_sets()
    data = {"machine": machine(), "plan": plan}
    data["kernels"] = kernels(plan)
    for name in ("rib", "fan", "box"):
        data[name] = compare(files[name], plan, name)
    data["restart"] = restart_fractions(files["fan"], plan)
    return json.loads(json.dumps(data))
