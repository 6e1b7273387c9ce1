# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""adjointOptimisationFoam moves its mesh by rbfMotionSolver.

Source of truth: OpenFOAM's tutorial of an S-bend (unconstrained/BFGS) on a
coarse mesh. Its own motion solver moves the same boundary in the first cycle,
by the same B-splines and sensitivities, and the losses must fall as there.
"""

import pathlib
import re
import shutil

import numpy as np
from boxCase import point_field
from foamCase import FoamCase, environment
from tutorialCase import Mesh

TUTORIAL = (
    "incompressible/adjointOptimisationFoam/shapeOptimisation/sbend/laminar/"
    "opt/unconstrained/BFGS"
)
WALLS = ("lower", "upper")


def lower(x):
    return -0.1 * (1 + np.tanh(4.4 * x) / np.tanh(4.4))


def mesh(nx=40, ny=16):
    """The tutorial's S-bend, between straight ducts."""
    ends = (-3, -1, 1, 3.8)
    corners = [
        (x, lower(np.clip(x, -1, 1)) + y, z)
        for z in (0, 0.1)
        for y in (0, 0.38)
        for x in ends
    ]
    blocks, sides, walls = [], [], {"lower": [], "upper": []}
    for i, n in enumerate((nx // 2, nx, nx // 2)):
        a, b, c, d = i, i + 1, i + 5, i + 4
        blocks.append(
            f"hex ({a} {b} {c} {d} {a+8} {b+8} {c+8} {d+8}) ({n} {ny} 1)"
            " simpleGrading (1 1 1)"
        )
        faces = {
            "lower": f"({a} {b} {b+8} {a+8})",
            "upper": f"({c} {d} {d+8} {c+8})",
        }
        for wall, face in faces.items():
            (walls[wall] if i == 1 else sides).append(face)
    edges = []
    x = np.linspace(-1, 1, 41)[1:-1]
    for first, y, z in ((1, 0, 0), (5, 0.38, 0), (9, 0, 0.1), (13, 0.38, 0.1)):
        between = " ".join(f"({u} {lower(u) + y} {z})" for u in x)
        edges.append(f"polyLine {first} {first + 1} ({between})")
    patches = {
        "sideWall": ("wall", sides),
        "lower": ("wall", walls["lower"]),
        "upper": ("wall", walls["upper"]),
        "Inlet": ("patch", ["(0 4 12 8)"]),
        "Outlet": ("patch", ["(3 11 15 7)"]),
    }
    boundary = " ".join(
        f"{name} {{ type {kind}; faces ({' '.join(faces)}); }}"
        for name, (kind, faces) in patches.items()
    )
    vertices = " ".join(f"({x} {y} {z})" for x, y, z in corners)
    return (
        f"scale 1; vertices ({vertices}); blocks ({' '.join(blocks)});"
        f" edges ({' '.join(edges)}); boundary ({boundary});"
        " defaultPatch { name frontBack; type empty; }"
    )


def conditions(optimised="fixedValue"):
    words = {
        name: "fixedValue; value uniform (0 0 0);"
        for name in ("sideWall", "Inlet", "Outlet")
    }
    for name in WALLS:
        words[name] = f"{optimised}; value uniform (0 0 0);"
    words["frontBack"] = "empty"
    return words


def substitute(path, *changes):
    text = path.read_text()
    for pattern, new in changes:
        text, n = re.subn(pattern, new, text)
        assert n, pattern
    path.write_text(text)


def make_case(path, cycles, ours=True, optimised="fixedValue"):
    folder = pathlib.Path(environment()["FOAM_TUTORIALS"]) / TUTORIAL
    shutil.copytree(folder, path, dirs_exist_ok=True)
    case = FoamCase(path)
    case.write("system/blockMeshDict", "dictionary", mesh())
    substitute(
        path / "system/controlDict",
        (r"endTime\s+\d+;", f"endTime {cycles};"),
        (r"writeCompression\s+true;", "writeCompression off;"),
    )
    substitute(
        path / "system/optimisationDict",
        (r"nIters 3000", "nIters 1000"),
        (r"1\.e-7", "1e-6"),
    )
    if ours:
        substitute(
            path / "system/optimisationDict",
            (
                r"type\s+volumetricBSplines;",
                "type volumetricBSplinesExternalMotionSolver;",
            ),
        )
        substitute(
            path / "constant/dynamicMeshDict",
            (
                r"solver volumetricBSplinesMotionSolver;",
                "solver rbfMotionSolver; motionSolverLibs"
                " (morphMotionSolvers); rbfMotionSolverCoeffs {"
                " supportRadius 0.5; greedy { tolerance 1e-6; } }",
            ),
        )
        control = path / "system/controlDict"
        control.write_text(control.read_text() + "libs (morphAdjointMotion);")
        case.write("0/pointDisplacement", *point_field(conditions(optimised)))
    case.run("blockMesh")
    return case


def losses(case):
    """Of each cycle."""
    found = sorted((case.path / "optimisation/objective").rglob("lossesas*"))
    rows = [
        line.split()
        for line in found[0].read_text().splitlines()
        if line.strip() and not line.strip().startswith("#")
    ]
    return [float(row[1]) for row in rows]


def test_an_optimisation_goes_as_with_openfoams_own_solver(tmp_path):
    cycles = 3
    runs = {}
    for name, ours in (("theirs", False), ("ours", True)):
        runs[name] = make_case(tmp_path / name, cycles, ours)
        output = runs[name].run("adjointOptimisationFoam")
        if ours:
            assert "displacementMethod type : rbfMotionSolver" in output
    first = runs["ours"].points("constant/polyMesh/points")
    patches = Mesh(tmp_path / "ours").patches
    walls = np.unique(np.concatenate([patches[name] for name in WALLS]))
    a, b = (run.points("2/polyMesh/points") for run in runs.values())
    largest = np.abs(a - first)[walls].max()
    assert largest > 1e-3
    np.testing.assert_allclose(a[walls], b[walls], rtol=0, atol=1e-4 * largest)
    inside = np.setdiff1d(np.arange(len(first)), walls)
    assert np.abs(b - first)[inside].max() > 0.3 * largest
    for name in ("sideWall", "Inlet", "Outlet"):
        still = np.setdiff1d(patches[name], walls)
        assert np.array_equal(b[still], first[still])

    theirs, ours = losses(runs["theirs"]), losses(runs["ours"])
    assert len(ours) == cycles
    assert ours[-1] < 0.99 * ours[0]
    np.testing.assert_allclose(ours, theirs, rtol=5e-3)
    runs["ours"].run("checkMesh", "-latestTime")


def test_what_adds_up_over_cycles_is_the_motion_at_once(tmp_path):
    """The mesh is that of its boundary, to the tolerance of the selection:
    morphMesh from the reference mesh."""
    case = make_case(tmp_path, 3)
    case.run("adjointOptimisationFoam")
    last = case.points("3/polyMesh/points")
    first = case.points("constant/polyMesh/points")
    largest = np.abs(last - first).max()
    assert largest > 2e-3
    field = case.path / "3/pointDisplacement"
    assert field.exists()
    shutil.copy(field, case.path / "0/pointDisplacement")
    case.run("morphMesh", "-time", "0")
    again = case.points("0/polyMesh/points")
    np.testing.assert_allclose(again, last, rtol=0, atol=1e-5 * largest)


def test_a_condition_that_takes_no_values_is_an_error(tmp_path):
    case = make_case(tmp_path, 1, optimised="slip")
    output = case.run("adjointOptimisationFoam", status=1)
    assert "is optimised, but its condition slip" in output
    assert "Give it the condition fixedValue there" in output
