#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Two versions of the selection, run in turn: compare.py COMMIT [-quick] [FILE]

Builds benchmarkSelection of a commit of this repository and of the tree as it
is, runs both in turn on sets of 3,225 to 1,000,000 candidates (-quick: to
100,000) and prints a table of medians of CPU time, which it also writes into
FILE. Other programs slow both down alike.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys

from measure import BUILD, ROOT, machine, point_set

# (set, count for generate.py, tolerance, times each is run)
RUNS = [
    ("rib", None, 1e-5, 7),
    ("fan13k", None, 4.5e-5, 5),
    ("box100k", 100_000, 2.85e-5, 3),
    ("box1000k", 1_000_000, 2.85e-5, 3),
    ("box1000k", 1_000_000, 3.6e-6, 1),
]


def built(tree):
    """The program of a tree, built."""
    program = tree / "build/benchmarks/benchmarkSelection"
    subprocess.run(
        ["make", "-s", "-j2", "-C", tree / "benchmarks", program], check=True
    )
    return program


def tree_of(commit):
    """A checkout of the commit below build/."""
    name = subprocess.run(
        ["git", "rev-parse", "--verify", "--short", f"{commit}^{{commit}}"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    ).stdout.strip()
    tree = BUILD / "compare" / name
    if not tree.exists():
        tree.mkdir(parents=True)
        archive = subprocess.Popen(
            ["git", "archive", name, "src", "benchmarks"],
            cwd=ROOT,
            stdout=subprocess.PIPE,
        )
        subprocess.run(
            ["tar", "-x", "-C", tree], stdin=archive.stdout, check=True
        )
        archive.wait()
    return name, tree


def run(program, path, tolerance):
    result = subprocess.run(
        [program, path, "-tolerance", str(tolerance)],
        stdout=subprocess.PIPE,
        check=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        text=True,
    )
    return json.loads(result.stdout)


def main(arguments):
    quick = "-quick" in arguments
    arguments = [a for a in arguments if a != "-quick"]
    if not arguments or arguments[0].startswith("-"):
        sys.exit(__doc__)
    name, other = tree_of(arguments[0])
    programs = (built(other), built(ROOT))

    lines = [
        f"CPU seconds of one core of {machine()['cpu']}, medians, run in turn.",
        "",
        f"| candidates | tolerance | {name}: points | s | MB |"
        " here: points | s | MB | here / there |",
        "|" + 9 * " --- |",
    ]
    for set_name, count, tolerance, times in RUNS:
        if quick and (count or 0) > 100_000:
            continue
        path = point_set(set_name, count)
        found = ([], [])
        for _ in range(times):
            for program, results in zip(programs, found):
                results.append(run(program, path, tolerance))
        there, here = (
            statistics.median(r["cpu"] for r in results) for results in found
        )
        cells = [f"{found[0][0]['candidates']:,}", f"{tolerance:g}"]
        for results, seconds in zip(found, (there, here)):
            cells += [
                str(results[0]["selected"]),
                f"{seconds:.3g}",
                f"{results[0]['peakMB']:.0f}",
            ]
        lines.append("| " + " | ".join(cells + [f"{here/there:.2f}"]) + " |")
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if arguments[1:]:
        pathlib.Path(arguments[1]).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1:])
