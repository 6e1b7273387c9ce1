#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Do two builds move meshes to the same places, to the last bit?

    same_meshes.py TREE OTHER [-suite SUITE]... [-keep FOLDER]

TREE and OTHER are two checkouts of this repository, both built. Each runs its
own tests of the suites (default: tutorials), and every file of points that they
leave is compared with its namesake: a table says how many there are of each
test, how many are the same, and the largest difference of the others. A test
that only one of them has is not counted. Exit status 1 if any differs.
"""

import argparse
import collections
import gzip
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np


def run(tree, suites, folder):
    """Run the tests of a tree; what they leave is below the folder."""
    words = " ".join(f"tests/{suite}" for suite in suites)
    subprocess.run(
        [
            "bash",
            "-c",
            ". etc/bashrc && $(bin/python3With pytest numpy)"
            f" -m pytest -q -p no:cacheprovider --basetemp={folder} {words}",
        ],
        cwd=tree,
        check=False,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.STDOUT,
    )


def meshes(folder):
    """Path below the folder -> file, for all files of points."""
    return {
        path.relative_to(folder): path
        for path in sorted(folder.rglob("*"))
        if path.name in ("points", "points.gz") and path.is_file()
    }


def content(path):
    """The bytes after the header, which may name a version."""
    data = path.read_bytes()
    if path.suffix == ".gz":
        data = gzip.decompress(data)
    return data[data.index(b"// *") :] if b"// *" in data else data


def difference(one, other):
    """The largest difference of two ascii files of points, or nan."""
    values = []
    for data in (one, other):
        found = re.search(rb"\n(\d+)\s*\n?\((.*)\)", data, re.DOTALL)
        try:
            values.append(
                np.array(
                    found[2].replace(b"(", b" ").replace(b")", b" ").split(),
                    dtype=float,
                )
            )
        except (TypeError, ValueError):
            return float("nan")
    if len(values[0]) != len(values[1]):
        return float("nan")
    return float(np.abs(values[0] - values[1]).max(initial=0))


def compare(one, other):
    """Rows: test, number of meshes, number that are the same, difference."""
    rows = collections.defaultdict(lambda: [0, 0, 0.0])
    theirs = meshes(other)
    for name, path in meshes(one).items():
        if name in theirs:
            row = rows[name.parts[0]]
            mine, its = content(path), content(theirs[name])
            row[0] += 1
            row[1] += mine == its
            if mine != its:
                row[2] = np.fmax(row[2], difference(mine, its))
    return rows


def main():
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("trees", nargs=2, type=pathlib.Path)
    parser.add_argument("-suite", action="append")
    parser.add_argument("-keep", type=pathlib.Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = (given.keep or pathlib.Path(scratch)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        for name, tree in zip("ab", given.trees):
            run(tree, given.suite or ["tutorials"], folder / name)
        rows = compare(folder / "a", folder / "b")
    print("| test | meshes | the same | largest difference |")
    print("|---|---|---|---|")
    for name, (number, same, largest) in sorted(rows.items()):
        print(f"| {name} | {number} | {same} | {largest:.1e} |")
    number = sum(row[0] for row in rows.values())
    same = sum(row[1] for row in rows.values())
    print(f"\n{same} of {number} meshes are the same")
    return 0 if number and same == number else 1


if __name__ == "__main__":
    sys.exit(main())
