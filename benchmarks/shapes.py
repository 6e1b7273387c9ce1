# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Times of global variables and of constraints of shapes with their
derivatives, for a surface of about 10^5 points.

    shapes.py FILE.md       (with the environment of etc/bashrc)

The boundary of a plate of 223 x 223 cells. Six variables of a reference axis,
on the points and through a lattice; constraints of every type. CPU seconds of
one core, medians of seven.
"""

import pathlib
import sys
import tempfile

from ffd import HEADER, HERE, SQUARE, make_case, run

VARIABLES = """
through ((0.3 0.5 -0.1) (0.3 0.5 1.1)); chord (1 0 0);
variables
{
    a { type twist; value 5; } b { type chord; value 0.1; }
    c { type thickness; value 0.1; } d { type sweep; value 0.1; }
    e { type dihedral; value 0.1; } f { type span; value 0.1; }
}
"""

BOXES = {
    "on points": f"axis {{ type axis; {VARIABLES} }}",
    "through a lattice of 7 x 7 x 7": "lattice { origin (-0.1 -0.1 -0.1);"
    " span (1.2 1.2 1.2); order (6 6 6); continuity none;"
    f" axis {{ {VARIABLES} }} }}",
}

STATIONS = " ".join(
    f"({x:g} {y:g} 0.5)" for x in (0.2, 0.4, 0.6, 0.8) for y in (0.2, 0.5, 0.8)
)

CONSTRAINTS = {
    "thickness at 12 stations": "thickness { type thickness; direction"
    f" (0 0 1); stations ({STATIONS}); }}",
    "thickness to chord at 1": "slender { type thicknessToChord; direction"
    " (0 0 1); stations ((0.4 0.5 0.5)); leading ((0 0.5 0.5));"
    " trailing ((1 0.5 0.5)); }",
    "edge": "edge { type edge; points ((0 0.5 0) (0 0.5 1)); }",
    "curvature": "curvature { type curvature; }",
    "projected area": "area { type projectedArea; direction (0 0 1); }",
    "wetted area": "wetted { type wettedArea; point (0 0.5 0);"
    " normal (0 1 0); }",
    "volume": "tank { type volume; }",
    "barycentre": "trim { type barycentre; }",
}


def measure(path, cases):
    text = "".join(
        f'"{name}" {{ boxes {{ {boxes} }} constraints {{ {bounds} }} }}\n'
        for name, boxes, bounds in cases
    )
    (path / "constant/benchmarkDict").write_text(
        HEADER.format("benchmarkDict") + f"cases {{ {text} }}\n"
    )
    return [
        line.split()[1:]
        for line in run(path, "benchmarkShapes").splitlines()
        if line.startswith("shapes ")
    ]


def main(file):
    run(HERE.parent, "wmake", "benchmarks/benchmarkShapes")
    cases = [
        (f"v{i}", boxes, CONSTRAINTS["volume"])
        for i, boxes in enumerate(BOXES.values())
    ]
    cases += [
        (f"c{i}", BOXES["on points"], bounds)
        for i, bounds in enumerate(CONSTRAINTS.values())
    ]
    cases.append(("all", BOXES["on points"], "\n".join(CONSTRAINTS.values())))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        make_case(path, (SQUARE, SQUARE, 1))
        rows = measure(path, cases)
    points = int(rows[0][1])
    lines = [
        f"CPU time for {points:,} points of a surface, of one core.",
        "",
        "| six variables of an axis | the points move [s]"
        " | dx/dmu by the six [s] |",
        "| --- | --- | --- |",
    ]
    for name, row in zip(BOXES, rows):
        lines.append(f"| {name} | {float(row[4]):.4f} | {float(row[5]):.4f} |")
    lines += [
        "",
        "| constraints | once [s] | values and derivatives by six variables"
        " [s] |",
        "| --- | --- | --- |",
    ]
    for name, row in zip((*CONSTRAINTS, "all of them"), rows[len(BOXES) :]):
        lines.append(f"| {name} | {float(row[3]):.3f} | {float(row[6]):.4f} |")
    pathlib.Path(file).write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main(sys.argv[1])
