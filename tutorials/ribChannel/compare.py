# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Morphed restarts beside uniform starts on the same and on new meshes.

    compare.py STUDY -> results/restart

Time is that of the processor, as the solver's log has it: what else runs on
the machine hardly touches it.
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


def seconds(study, strategy, design):
    log = (Path(study) / strategy / design / "log.solve").read_text()
    return float(re.findall(r"ExecutionTime = (\S+) s", log)[-1])


def quality(study, strategy, design):
    """Largest non-orthogonality [deg] and skewness, as checkMesh says."""
    log = (Path(study) / strategy / design / "log.quality").read_text()
    return (
        float(re.search(r"non-orthogonality Max: (\S+)", log)[1]),
        float(re.search(r"[Mm]ax skewness = ([\d.e+-]+)", log)[1]),
    )


def differs(new, old):
    return 100 * (float(new) / float(old) - 1)


def compare(study):
    """A row for each design that is done by restart and on a new mesh; the
    uniform start on the morphed mesh may have diverged."""
    morph, uniform, remesh = (
        results(study, name) for name in ("morph", "uniform", "remesh")
    )
    rows = []
    for design in sorted(set(morph) & set(remesh)):
        a, b, c = (found.get(design) for found in (morph, uniform, remesh))
        here, there = (
            quality(study, name, design) for name in ("morph", "remesh")
        )
        rows.append(
            {
                "design": design,
                **{x: float(a[x]) for x in ("h", "e", "E")},
                "iterations": int(a["iterations"]),
                "uniform": int(b["iterations"]) if b else "",
                "remeshed": int(c["iterations"]),
                "time [s]": seconds(study, "morph", design),
                "uniform [s]": seconds(study, "uniform", design) if b else "",
                "remeshed [s]": seconds(study, "remesh", design),
                "Nu": float(a["Nu"]),
                "Nu uniform [%]": differs(b["Nu"], a["Nu"]) if b else "",
                "Nu remeshed [%]": differs(c["Nu"], a["Nu"]),
                "Cf": float(a["Cf"]),
                "Cf uniform [%]": differs(b["Cf"], a["Cf"]) if b else "",
                "Cf remeshed [%]": differs(c["Cf"], a["Cf"]),
                "non-orth. [deg]": here[0],
                "non-orth. remeshed": there[0],
                "skewness": here[1],
                "skewness remeshed": there[1],
            }
        )
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
    complete = [row for row in rows if row["uniform"] != ""] or rows
    values = [abs(row[name]) for row in complete if row[name] != ""]
    return sum(values) / len(values) if values else ""


if __name__ == "__main__":
    write_table(compare(sys.argv[1]), "results/restart")
