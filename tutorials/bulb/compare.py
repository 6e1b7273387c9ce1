# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The thesis' table 5.1 beside what was computed: compare.py OUTPUT.csv"""

import csv
import sys
from pathlib import Path

from morphfoam.study import designs, outcomes
from morphfoam.study.study_file import StudyFile

# Koshakji (2011), table 5.1: drag [N], volume [m3]
THESIS = {"D": (1.389, 1.005), "V": (0.7156, 0.5725)}


def changes(name, study, number):
    """Of a design against the design at rest, in per cent."""
    rest = outcomes.read(study, outcomes.BASELINE).responses
    found = outcomes.read(study, "morph", number)
    row = {"case": name, "D0": rest["D"], "D": found.responses["D"]}
    for key in ("D", "pressure", "V"):
        row[f"{key}%"] = 100 * (found.responses[key] / rest[key] - 1)
    return row


def best(study):
    with (study.folder / "descend.morph/optima.csv").open() as file:
        return int(next(csv.DictReader(file))["design"])


def sampled(study):
    """The thesis' parameters, as a design."""
    return next(
        d.number for d in designs.read(study) if d.origin == designs.SAMPLED
    )


coarse, fine = StudyFile("descend.yaml"), StudyFile("fine.yaml")
drag, volume = THESIS["D"], THESIS["V"]
rows = [
    {
        "case": "thesis, 8.9k elements",
        "D0": drag[0],
        "D": drag[1],
        "D%": 100 * (drag[1] / drag[0] - 1),
        "pressure%": "",
        "V%": 100 * (volume[1] / volume[0] - 1),
    },
    changes("thesis' parameters, 20k cells", coarse, sampled(coarse)),
    changes("descent, 20k cells", coarse, best(coarse)),
    changes("descent, 52k cells", fine, 1),
]
path = Path(sys.argv[1])
with path.open("w", newline="") as file:
    writer = csv.DictWriter(file, list(rows[0]))
    writer.writeheader()
    writer.writerows(
        {k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()}
        for row in rows
    )
print(path.read_text())
