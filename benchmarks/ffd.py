# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Times of free-form deformation: preparation once, evaluation per new value.

    ffd.py FOLDER           (with the environment of etc/bashrc)

Writes into the folder: ffd.md, tables; ffd.png, times against the number of
parameters in 2D and 3D (fig. 2.12 of Lombardi's thesis, where the time is that
of making the map); data.json. CPU seconds of one core, medians of seven; those
of OpenFOAM's volumetric B-splines are one run.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

HEADER = (
    "FoamFile {{ version 2.0; format ascii; class dictionary; "
    "object {}; }}\n"
)

# Cells in each direction, of cubes and of a square: about 10^5 points
CUBE, SQUARE = 45, 223

# Control points in each direction
LATTICE = 7

MESH = """
scale 1;
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) ({0} {1} {2}) simpleGrading (1 1 1));
edges ();
defaultPatch {{ name sides; type patch; }}
boundary ();
"""

SCHEMES = """
divSchemes {} gradSchemes {} laplacianSchemes {} interpolationSchemes {}
snGradSchemes {}
"""

CONTROL = """
startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1; writeFormat ascii; writePrecision 12;
"""


def box(name, n, parameters, basis):
    """A box around the unit cube whose first so many components move."""
    moves = [
        ((i, j, k), d)
        for k in range(n[2])
        for j in range(n[1])
        for i in range(n[0])
        for d in range(3 if n[2] > 1 else 2)
    ]
    step = max(1, len(moves) // parameters)
    entries = ""
    for number, ((i, j, k), d) in enumerate(moves[::step][:parameters]):
        vector = " ".join("1" if a == d else "0" for a in range(3))
        entries += (
            f"mu{number} {{ value 0; moves "
            f"( (({i} {j} {k}) ({vector})) ); }}\n"
        )
    return (
        f"{name} {{ boxes {{ cube {{ origin (0 0 0); span (1 1 1);"
        f" order ({n[0] - 1} {n[1] - 1} {n[2] - 1}); {basis}"
        f" parameters {{ {entries} }} }} }} }}\n"
    )


def make_case(path, cells):
    for name, body in (
        ("system/controlDict", CONTROL),
        ("system/fvSchemes", SCHEMES),
        ("system/fvSolution", ""),
        ("system/blockMeshDict", MESH.format(*cells)),
    ):
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_text(HEADER.format(pathlib.Path(name).name) + body)
    (path / "constant").mkdir()
    run(path, "blockMesh")


def run(path, *command):
    return subprocess.run(
        command,
        cwd=path,
        check=True,
        text=True,
        stdout=subprocess.PIPE,
        env={
            **os.environ,
            "PWD": str(path),
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
        },
    ).stdout


def measure(path, cases, more=""):
    (path / "constant/benchmarkDict").write_text(
        HEADER.format("benchmarkDict") + f"cases {{ {cases} }}\n{more}"
    )
    ours, theirs = [], None
    for line in run(path, "benchmarkFfd").splitlines():
        words = line.split()
        if words[:1] == ["ours"]:
            ours.append(
                dict(
                    zip(
                        (
                            "name",
                            "parameters",
                            "preparation",
                            "evaluation",
                            "certificate",
                        ),
                        [words[1], int(words[2]), *map(float, words[3:6])],
                    )
                )
            )
        elif words[:1] == ["theirs"]:
            theirs = dict(
                zip(
                    ("points", "preparation", "evaluation"),
                    [int(words[1]), *map(float, words[2:4])],
                )
            )
    return ours, theirs


def build():
    adjoint = pathlib.Path(
        os.environ["LIB_SRC"], "optimisation/adjointOptimisation/adjoint"
    )
    if not (adjoint / "lnInclude").exists():
        run(HERE, "wmakeLnInclude", str(adjoint))
    run(HERE.parent, "wmake", "benchmarks/benchmarkFfd")


def picture(data, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7, 4.5))
    for name, marker in (("2D", "o"), ("3D", "s")):
        rows = data[name]
        x = [row["parameters"] for row in rows]
        for key, style in (("preparation", "-"), ("evaluation", "--")):
            axes.plot(
                x,
                [1e3 * row[key] for row in rows],
                style,
                marker=marker,
                color="C0" if name == "2D" else "C3",
                label=f"{name}, {key}",
            )
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("parameters")
    axes.set_ylabel("CPU time for 10$^5$ points [ms]")
    axes.legend()
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(file, dpi=120)


def table(data):
    lines = [
        "| lattice | points | preparation | evaluation | fold certificate"
        " |",
        "| --- | --- | --- | --- | --- |",
    ]
    for row in data["bases"]:
        lines.append(
            f"| {row['name']}, 7 x 7 x 7 | {(CUBE + 1)**3:,} "
            f"| {1e3*row['preparation']:.0f} ms "
            f"| {1e3*row['evaluation']:.1f} ms "
            f"| {1e3*row['certificate']:.0f} ms |"
        )
    theirs = data["volumetricBSplines"]
    lines.append(
        f"| OpenFOAM's volumetric B-splines, degree 3, 7 x 7 x 7 "
        f"| {theirs['points']:,} | {theirs['preparation']:.1f} s "
        f"| {theirs['evaluation']:.2f} s | – |"
    )
    for name in ("2D", "3D"):
        lines += [
            "",
            f"| {name}: parameters | preparation | evaluation |",
            "| --- | --- | --- |",
        ]
        lines += [
            f"| {row['parameters']} | {1e3*row['preparation']:.0f} ms "
            f"| {1e3*row['evaluation']:.1f} ms |"
            for row in data[name]
        ]
    return "\n".join(lines) + "\n"


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    build()
    n = (LATTICE,) * 3
    data = {}
    with tempfile.TemporaryDirectory() as scratch:
        cube, square = pathlib.Path(scratch, "cube"), pathlib.Path(
            scratch, "2D"
        )
        make_case(cube, (CUBE,) * 3)
        make_case(square, (SQUARE, SQUARE, 1))
        data["bases"], data["volumetricBSplines"] = measure(
            cube,
            box("bernstein", n, 1029, "")
            + box("bSpline", n, 1029, "basis bSpline; degree (3 3 3);"),
            "volumetricBSplines { type cartesian; "
            "controlPointsDefinition axisAligned; lowerCpBounds (-1e-6 -1e-6"
            " -1e-6); upperCpBounds (1.000001 1.000001 1.000001);"
            + "".join(f" nCPs{d} {LATTICE}; degree{d} 3;" for d in "UVW")
            + " readStoredData no; }",
        )
        data["2D"], _ = measure(
            square,
            "".join(
                box(f"p{m}", (LATTICE, LATTICE, 1), m, "")
                for m in (1, 4, 16, 49, 98)
            ),
        )
        data["3D"], _ = measure(
            cube,
            "".join(box(f"p{m}", n, m, "") for m in (1, 4, 16, 64, 256, 1029)),
        )
    (folder / "data.json").write_text(json.dumps(data, indent=1) + "\n")
    (folder / "ffd.md").write_text(table(data))
    picture(data, folder / "ffd.png")
    print(table(data))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
