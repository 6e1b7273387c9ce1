# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Morphed restarts beside uniform starts on the same and on new meshes.

    compare.py STUDY -> results/restart

Time is that of the processor, which what else runs on the machine hardly
touches. A run is at its end earlier than its criterion says: of each the
iterations are counted after which Nu and C_f stay within 1 and 0.1 per cent of
what they end with.
"""

import csv
import re
import sys
from pathlib import Path

from morphfoam.output.tables import write_table


def results(study, strategy):
    with (Path(study) / f"results.{strategy}.csv").open() as file:
        return {
            row["design"]: row
            for row in csv.DictReader(file)
            if row["status"] == "done" and row["design"].isdigit()
        }


def series(case, region, name):
    """The last column of a table, over all times from which it was written."""
    files = sorted(
        case.glob(f"postProcessing/{region}/{name}/*/surfaceFieldValue.dat"),
        key=lambda path: float(path.parent.name),
    )
    return [
        float(line.split()[-1])
        for path in files
        for line in path.read_text().splitlines()
        if not line.startswith("#")
    ]


def histories(case):
    """What Nu and C_f are proportional to, over the iterations."""
    wall = series(case, "solid", "wallTemperature")
    ends = zip(
        series(case, "fluid", "bulkTemperature"),
        series(case, "fluid", "outletTemperature"),
    )
    gradient = re.findall(
        r"pressure gradient = (\S+)", (case / "log.solve").read_text()
    )
    # Printed by the predictor and by the corrector
    gradient = gradient[1::2]
    return [
        [1 / (w - 0.5 * (a + b)) for w, (a, b) in zip(wall, ends)],
        [float(value) for value in gradient],
    ]


def rests(values, share):
    """The number of values after which all are so near to the last one."""
    for i, value in reversed(list(enumerate(values))):
        if abs(value - values[-1]) > share * abs(values[-1]):
            return i + 1
    return 0


def effort(study, strategy, row):
    """Iterations and time [s] of a run, by the names of their columns."""
    case = Path(study) / strategy / row["design"]
    found = histories(case)
    return {
        "iterations": int(row["iterations"]),
        "to 1%": max(rests(values, 0.01) for values in found),
        "to 0.1%": max(rests(values, 0.001) for values in found),
        "time [s]": float(row["cpuTime.solve"]),
    }


def quality(study, strategy, design):
    """Largest non-orthogonality [deg] and skewness, as checkMesh says."""
    log = (Path(study) / strategy / design / "log.quality").read_text()
    return (
        float(re.search(r"non-orthogonality Max: (\S+)", log)[1]),
        float(re.search(r"[Mm]ax skewness = ([\d.e+-]+)", log)[1]),
    )


def differs(new, old):
    return 100 * (float(new) / float(old) - 1)


EFFORT = ("iterations", "to 1%", "to 0.1%", "time [s]")
STRATEGIES = ("morph", "uniform", "remesh")


def compare(study):
    """A row for each design that is done by restart and on a new mesh; the
    uniform start on the morphed mesh may have diverged."""
    tables = {name: results(study, name) for name in STRATEGIES}
    rows = []
    for design in sorted(set(tables["morph"]) & set(tables["remesh"])):
        found = {name: tables[name].get(design) for name in STRATEGIES}
        efforts = {
            name: effort(study, name, row) if row else {}
            for name, row in found.items()
        }
        row = {
            "design": design,
            **{x: float(found["morph"][x]) for x in ("h", "e", "E")},
        }
        for kind in EFFORT:
            for name in STRATEGIES:
                row[f"{name}: {kind}"] = efforts[name].get(kind, "")
        for response in ("Nu", "Cf"):
            row[response] = float(found["morph"][response])
            for name in STRATEGIES[1:]:
                row[f"{response} {name} [%]"] = (
                    differs(found[name][response], row[response])
                    if found[name]
                    else ""
                )
        for name in ("morph", "remesh"):
            (
                row[f"{name}: non-orth. [deg]"],
                row[f"{name}: skewness"],
            ) = quality(study, name, design)
        rows.append(row)
    if not rows:
        sys.exit("Error: no design is done in both ways")
    return rows + [
        {
            "design": "mean",
            "h": "",
            "e": "",
            "E": "",
            **{name: mean(rows, name) for name in list(rows[0])[4:]},
        }
    ]


def mean(rows, name):
    """Of magnitudes; of the designs for which all starts are there, so that
    means of one row are of the same designs."""
    complete = [row for row in rows if "" not in row.values()] or rows
    values = [abs(row[name]) for row in complete if row[name] != ""]
    return sum(values) / len(values) if values else ""


if __name__ == "__main__":
    write_table(compare(sys.argv[1]), "results/restart")
