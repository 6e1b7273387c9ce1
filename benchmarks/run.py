#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Measures, and writes what was measured: run.py [-quick | -report FILE]

    -quick          a few minutes; into build/benchmarks/results
    -report FILE    no measurement: tables and pictures from a former data.json

A full run writes benchmarks/results/<date>.md with its pictures and tables in
benchmarks/results/<date>, and the figures in benchmarks/README.md.
"""

import json
import pathlib
import sys
import time

import measure
import report


def main(arguments):
    if arguments[:1] == ["-report"]:
        data = json.loads(pathlib.Path(arguments[1]).read_text())
        report.write(data, pathlib.Path(arguments[1]).resolve().parent.parent)
        return

    quick = arguments == ["-quick"]
    if arguments and not quick:
        sys.exit(__doc__)
    start = time.time()
    data = measure.everything(measure.QUICK if quick else measure.FULL)
    data["minutes"] = (time.time() - start) / 60
    data["quick"] = quick
    where = measure.BUILD / "results" if quick else measure.HERE / "results"
    print("Written:", report.write(data, where))


if __name__ == "__main__":
    main(sys.argv[1:])
