# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reads what OpenFOAM's applications and morphMesh write, and writes tables.

Needs nothing but Python itself, so that every tutorial can use it.
"""

import csv
import re
from pathlib import Path


def read_columns(path):
    """The columns of a table as function objects and morphMesh write it: the
    last comment line before the first row names them. {name: [values]}, each
    value a float, or a word where it is no number."""
    names, rows = [], []
    for line in Path(path).read_text().splitlines():
        if line.startswith("#"):
            names = line[1:].split() if not rows else names
        elif line.strip():
            rows.append([number_or_word(word) for word in line.split()])
    if not rows:
        raise ValueError(f"{path} has no row of values")
    if len(names) != len(rows[0]):
        raise ValueError(
            f"{path} names {len(names)} columns and has {len(rows[0])}"
        )
    return {name: list(column) for name, column in zip(names, zip(*rows))}


def number_or_word(text):
    try:
        return float(text)
    except ValueError:
        return text


def iterations(log):
    """The number of steps a steady solver's log has, and whether its
    residualControl ended it."""
    text = Path(log).read_text()
    steps = len(re.findall(r"^Time = ", text, re.MULTILINE))
    return steps, bool(re.search(r"solution converged in", text))


def format(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def markdown(rows):
    """A Markdown table of dictionaries that have the same keys."""
    cells = [list(rows[0])] + [
        [format(v) for v in row.values()] for row in rows
    ]
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    lines = [
        "| " + " | ".join(c.ljust(w) for c, w in zip(row, widths)) + " |"
        for row in cells
    ]
    rule = "|" + "|".join("-" * (w + 2) for w in widths) + "|"
    return "\n".join([lines[0], rule] + lines[1:]) + "\n"


def write_table(rows, stem):
    """Writes the rows to stem.csv and stem.md and prints them."""
    stem = Path(stem)
    stem.parent.mkdir(parents=True, exist_ok=True)
    with stem.with_suffix(".csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    text = markdown(rows)
    stem.with_suffix(".md").write_text(text)
    print(text, end="")
