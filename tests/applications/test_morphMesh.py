# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphMesh: one motion, checked, written or refused.

Sources of truth: with a uniform diffusivity, a box whose top is displaced by d
and whose bottom is held has the displacement d z/H (the exact solution of
Laplace's equation, linear, so that finite volumes have it exactly on an
orthogonal mesh); the quality figures are those that checkMesh prints.
"""

import re
import shutil

import numpy as np
import pytest

from boxCase import box, fixed, point_field
from foamCase import FoamCase

HEIGHT = 1.0

LAPLACIAN = """
motionSolverLibs (fvMotionSolvers);
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity uniform; }
"""


def field(dimensions, top, sides="patch"):
    """A point field that holds the bottom and gives the top a value."""
    return point_field(
        {
            "bottom": fixed(0, 0, 0),
            "top": fixed(*map(float, top.split())),
            "ends": "zeroGradient",
            "sides": "empty" if sides == "empty" else "zeroGradient",
        },
        dimensions,
    )


def make_box(
    path,
    top="0 0 0.5",
    region="",
    sides="patch",
    cells=(4, 4, 4),
    z=(0, HEIGHT),
    x=(0, 2),
    grading=1,
    format="ascii",
    deltaT=1,
):
    """A meshed box with a displacement of its top."""
    case = box(
        path,
        {
            "bottom": ("wall", "zMin"),
            "top": ("wall", "zMax"),
            "ends": ("patch", "xMin xMax"),
            "sides": (sides, "yMin yMax"),
        },
        cells=cells,
        low=(x[0], 0, z[0]),
        high=(x[1], 1, z[1]),
        grading=(1, 1, grading),
        control={"format": format, "deltaT": deltaT, "digits": 6},
    )
    if region:
        shutil.copytree(case.path / "system", case.path / "system" / region)
        shutil.move(case.path / "constant", case.path / region)
        (case.path / "constant").mkdir()
        shutil.move(case.path / region, case.path / "constant")
    case.write(f"constant/{region}/dynamicMeshDict", "dictionary", LAPLACIAN)
    case.write(
        f"0/{region}/pointDisplacement", *field("0 1 0 0 0 0 0", top, sides)
    )
    return case


def linear(points, top, z=(0, HEIGHT)):
    """The exact position of points whose displacement is linear in z."""
    return points + np.outer((points[:, 2] - z[0]) / (z[1] - z[0]), top)


NAMES = [
    "cells",
    "minVolume",
    "maxNonOrthogonality",
    "maxSkewness",
    "maxAspectRatio",
    "wronglyOrientedFaces",
    "nonPositiveCells",
]


def quality(text):
    """The rows 'before' and 'after' of a table, as dictionaries."""
    assert re.search(
        r"^# mesh\s+" + r"\s+".join(NAMES) + r"\s*$", text, re.MULTILINE
    )
    rows = re.findall(r"^(before|after)\s+(.*)$", text, re.MULTILINE)
    assert [name for name, _ in rows] == ["before", "after"]
    return {
        name: dict(zip(NAMES, map(float, row.split()))) for name, row in rows
    }


def quality_file(case, time="0"):
    path = case.path / "postProcessing" / "morphMesh" / time / "quality.dat"
    return quality(path.read_text())


def check_mesh(case, *options, **kwargs):
    """The figures that checkMesh prints."""
    output = case.run("checkMesh", *options, **kwargs)

    def figure(pattern):
        found = re.search(pattern + r"\s*(-?[0-9][-+0-9.e]*)", output)
        return float(found.group(1).rstrip(".")) if found else 0.0

    return {
        "cells": figure(r"\n    cells:"),
        "minVolume": figure(r"(?:Min volume =|Minimum negative volume:)"),
        "maxNonOrthogonality": figure(r"non-orthogonality Max:"),
        "maxSkewness": figure(r"[Mm]ax skewness ="),
        "maxAspectRatio": figure(r"[Mm]ax aspect ratio[:=\s]*?[:=]"),
        "wronglyOrientedFaces": figure(
            r"Writing(?= \d+ faces with incorrect orientation)"
        ),
        "nonPositiveCells": figure(r"Number of negative volume cells:"),
    }


def same_figures(ours, checked, digits=6):
    """checkMesh prints six digits, and so does quality.dat; the log has 3."""
    for name in NAMES:
        assert ours[name] == pytest.approx(
            checked[name], rel=10 ** (1 - digits), abs=1e-4
        ), name


# --- what it moves and writes


def test_moves_the_mesh_as_the_solver_says_and_writes_it_to_the_time(tmp_path):
    case = make_box(tmp_path)
    before = case.points("constant/polyMesh/points")
    mesh = {f: h for f, h in case.tree().items() if f.startswith("constant")}

    case.run("morphMesh")

    np.testing.assert_allclose(
        case.points("0/polyMesh/points"),
        linear(before, (0, 0, 0.5)),
        atol=1e-10,
    )
    after = case.tree()
    assert {f: h for f, h in after.items() if f.startswith("constant")} == mesh
    assert [f for f in after if f.startswith("0/polyMesh/")] == [
        "0/polyMesh/points"
    ]


def test_leaves_other_fields_of_the_time_and_the_zones_as_they_are(tmp_path):
    case = make_box(tmp_path)
    case.write("0/U", "volVectorField", '#include "$FOAM_CASE/nowhere"')
    case.write("0/p", "volScalarField", "p0 1; // as the user wrote it")
    before = case.tree()
    assert "constant/polyMesh/cellZones" in before

    case.run("morphMesh", "-overwrite")

    after = case.tree()
    changed = {f for f in before if after.get(f) != before[f]}
    assert changed == {"constant/polyMesh/points"}
    assert set(after) - set(before) == {
        "constant/polyMesh/points0",
        "postProcessing",
        "postProcessing/morphMesh",
        "postProcessing/morphMesh/0",
        "postProcessing/morphMesh/0/quality.dat",
        "postProcessing/morphMesh/0/histogram.dat",
        "postProcessing/morphMesh/0/motion",
    }


def test_displacement_written_to_the_time_is_that_of_the_points(tmp_path):
    case = make_box(tmp_path)
    case.run("morphMesh")
    moved = case.points("0/polyMesh/points")
    text = (case.path / "0/pointDisplacement").read_text()
    body = re.search(
        r"internalField\s+nonuniform List<vector>\s+\d+\s+\(" r"(.*?)\n\)",
        text,
        re.DOTALL,
    ).group(1)
    values = np.array(re.sub("[()]", " ", body).split(), float).reshape(-1, 3)
    np.testing.assert_allclose(
        case.points("constant/polyMesh/points") + values, moved, atol=1e-14
    )


def test_a_second_run_at_the_time_gives_the_same_points(tmp_path):
    case = make_box(tmp_path)
    case.run("morphMesh")
    first = case.points("0/polyMesh/points")
    case.run("morphMesh")
    np.testing.assert_allclose(
        case.points("0/polyMesh/points"), first, atol=1e-10
    )


def test_overwrite_keeps_the_reference_and_a_second_run_changes_nothing(
    tmp_path,
):
    case = make_box(tmp_path)
    reference = case.points("constant/polyMesh/points")
    case.run("morphMesh", "-overwrite")
    first = case.points("constant/polyMesh/points")
    np.testing.assert_array_equal(
        case.points("constant/polyMesh/points0"), reference
    )
    np.testing.assert_allclose(
        first, linear(reference, (0, 0, 0.5)), atol=1e-10
    )
    kept = case.tree()["constant/polyMesh/points0"]

    case.run("morphMesh", "-overwrite")

    assert case.tree()["constant/polyMesh/points0"] == kept
    np.testing.assert_allclose(
        case.points("constant/polyMesh/points"), first, atol=1e-10
    )
    assert not (case.path / "0/polyMesh").exists()


def test_overwrite_warns_of_points_that_hide_what_it_wrote(tmp_path):
    case = make_box(tmp_path)
    case.run("morphMesh")
    assert "they hide what was written" in case.run("morphMesh", "-overwrite")


@pytest.mark.parametrize("options", [(), ("-overwrite",)])
def test_dry_run_writes_nothing(tmp_path, options):
    case = make_box(tmp_path)
    before = case.tree()
    output = case.run("morphMesh", "-dryRun", *options)
    assert case.tree() == before
    where = "constant" if options else "0"
    assert f"{where}/polyMesh/points and postProcessing/" in output
    assert quality(output)["after"]["minVolume"] == pytest.approx(
        2 * 1.5 / 64, rel=5e-3
    )  # the volume of the box over 64


def test_points_keep_the_digits_that_thin_cells_need(tmp_path):
    # The lowest cells, about 4e-6 high at z = 1000, vanish with the six
    # digits of writePrecision; the mesh is to be that which was checked
    z = (1000, 1001)
    case = make_box(tmp_path, z=z, cells=(2, 2, 20), grading=1e5)
    output = case.run("morphMesh")
    assert "17 digits" in output
    same_figures(quality_file(case)["after"], check_mesh(case))
    assert quality_file(case)["after"]["minVolume"] > 0


def test_follows_the_write_format_binary(tmp_path):
    case = make_box(tmp_path, format="binary")
    case.run("morphMesh")
    assert b"binary" in (case.path / "0/polyMesh/points").read_bytes()[:1000]
    figures = quality_file(case)["after"]
    assert figures["minVolume"] == pytest.approx(2 * 1.5 / 64, rel=1e-5)
    same_figures(figures, check_mesh(case))


def test_moves_the_region_it_is_told_to(tmp_path):
    case = make_box(tmp_path, region="solid")
    before = case.points("constant/solid/polyMesh/points")
    case.run("morphMesh", "-region", "solid")
    np.testing.assert_allclose(
        case.points("0/solid/polyMesh/points"),
        linear(before, (0, 0, 0.5)),
        atol=1e-10,
    )
    assert (
        case.path / "postProcessing/solid/morphMesh/0/quality.dat"
    ).exists()


def test_case_option_moves_a_case_elsewhere(tmp_path):
    case = make_box(tmp_path / "there")
    here = FoamCase(tmp_path)
    here.run("morphMesh", "-case", "there")
    assert (case.path / "0/polyMesh/points").exists()
    assert (case.path / "postProcessing/morphMesh/0/quality.dat").exists()


def test_moves_to_the_time_it_is_told(tmp_path):
    case = make_box(tmp_path)
    shutil.copytree(tmp_path / "0", tmp_path / "0.5")
    output = case.run("morphMesh", "-time", "5e-1")
    assert "0.5/polyMesh/points" in output
    assert (tmp_path / "0.5/polyMesh/points").exists()
    assert not (tmp_path / "0/polyMesh").exists()
    assert quality_file(case, "0.5")


def test_adds_the_displacements_of_a_list_of_solvers(tmp_path):
    # Two translations x = v t: at t = 0.5 half the sum of the velocities.
    # The time has no folder, and these solvers need none
    case = make_box(tmp_path)
    motion = """{{ motionSolver solidBody;
        solidBodyMotionFunction linearMotion;
        linearMotionCoeffs {{ velocity ({}); }} }}"""
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        "solvers {{ one {} two {} }}".format(
            motion.format("1 0 0"), motion.format("0 3 0")
        ),
    )
    before = case.points("constant/polyMesh/points")
    output = case.run("morphMesh", "-time", "0.5")
    assert "has no folder" in output
    np.testing.assert_allclose(
        case.points("0.5/polyMesh/points"), before + [0.5, 1.5, 0], atol=1e-14
    )


def test_a_solver_of_velocities_moves_the_mesh_by_one_time_step(tmp_path):
    case = make_box(tmp_path, deltaT=2)
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        LAPLACIAN.replace("displacementL", "velocityL"),
    )
    case.write("0/pointMotionU", *field("0 1 -1 0 0 0 0", "0 0 0.1"))
    before = case.points("constant/polyMesh/points")
    case.run("morphMesh")
    np.testing.assert_allclose(
        case.points("0/polyMesh/points"),
        linear(before, (0, 0, 0.2)),
        atol=1e-10,
    )


# --- the figures


@pytest.mark.parametrize("sides", ["patch", "empty"])
def test_figures_are_those_of_checkMesh(tmp_path, sides):
    # Sheared, so that non-orthogonality is not zero; empty: a 2D mesh, whose
    # aspect ratio leaves out the third direction
    case = make_box(
        tmp_path,
        top="0.2 0 0.1",
        sides=sides,
        grading=3,
        cells=(7, 1, 5) if sides == "empty" else (7, 3, 5),
    )
    case.write(
        "0/pointDisplacement",
        "pointVectorField",
        field("0 1 0 0 0 0 0", "0.2 0 0.1", sides)[1].replace(
            "ends { type zeroGradient; }",
            "ends { type fixedValue; value uniform (0 0 0); }",
        ),
    )
    unmoved = check_mesh(case)
    case.run("morphMesh")
    figures = quality_file(case)
    same_figures(figures["before"], unmoved)
    moved = check_mesh(case)
    same_figures(figures["after"], moved)
    assert moved["maxNonOrthogonality"] > 10
    assert moved["maxSkewness"] > 0.1
    assert moved != unmoved


def move_one_point(case, start, end):
    """Move the point at start of the mesh to end."""
    points = case.points("constant/polyMesh/points")
    distance = np.linalg.norm(points - start, axis=1)
    assert distance.min() < 1e-9
    points[distance.argmin()] = end
    rows = "\n".join("({!r} {!r} {!r})".format(*map(float, p)) for p in points)
    case.write(
        "constant/polyMesh/points",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


@pytest.fixture
def tangled(tmp_path):
    """A box with one point, in the plane x = 1, pulled through cells."""
    case = make_box(tmp_path, top="0 0 0")
    move_one_point(case, (1, 0.5, 0.5), (1.1, 0.5, 1.9))
    return case


def test_wrong_faces_and_cells_are_counted_as_checkMesh_counts_them(tangled):
    checked = check_mesh(tangled)
    assert checked["wronglyOrientedFaces"] > 0
    assert checked["nonPositiveCells"] > 0
    figures = quality(tangled.run("morphMesh", status=1))
    same_figures(figures["before"], checked, digits=3)
    same_figures(figures["after"], checked, digits=3)


def test_what_was_wrong_before_is_not_laid_to_the_motion(tangled):
    output = tangled.run("morphMesh", status=1)
    assert (
        "the motion makes 0 wrongly oriented faces and 0 cells without"
        in output
    )

    # Now every cell turns inside out: what was wrong does not count
    was = quality(output)["before"]
    tangled.write("0/pointDisplacement", *field("0 1 0 0 0 0 0", "0 0 -3"))
    output = tangled.run("morphMesh", status=1)
    figures = quality(output)["after"]
    made = re.search(r"the motion makes (\d+) .* and (\d+) cells", output)
    assert (
        0
        < figures["wronglyOrientedFaces"] - int(made.group(1))
        <= was["wronglyOrientedFaces"]
    )
    assert (
        0
        <= figures["nonPositiveCells"] - int(made.group(2))
        <= was["nonPositiveCells"]
    )


def test_wrong_faces_between_two_ranks_count_once(tangled):
    serial = tangled.run("morphMesh", status=1)
    tangled.decompose((2, 1, 1))
    parallel = tangled.run("morphMesh", ranks=2, status=1)
    serial_figures, parallel_figures = quality(serial), quality(parallel)
    for name in NAMES:
        assert parallel_figures["after"][name] == pytest.approx(
            serial_figures["after"][name], rel=1e-5
        )
    where = r"it has .* the worst at \(.*\)"
    assert (
        re.search(where, parallel).group() == re.search(where, serial).group()
    )


def test_wrong_faces_of_a_mesh_in_micrometres_are_found(tmp_path):
    # Pyramids here have some 1e-20 m^3, below the tolerance of checkMesh
    case = make_box(tmp_path, top="0 0 0", x=(0, 2e-6), z=(0, 1e-6))
    points = case.points("constant/polyMesh/points")
    points[:, 1] *= 1e-6
    rows = "\n".join("({!r} {!r} {!r})".format(*map(float, p)) for p in points)
    case.write(
        "constant/polyMesh/points",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )
    assert (
        quality(case.run("morphMesh", "-dryRun"))["after"][
            "wronglyOrientedFaces"
        ]
        == 0
    )
    move_one_point(case, (1e-6, 0.5e-6, 0.5e-6), (1.1e-6, 0.5e-6, 1.9e-6))
    assert (
        quality(case.run("morphMesh", status=1))["after"][
            "wronglyOrientedFaces"
        ]
        > 0
    )


# --- what it refuses


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("options", [(), ("-overwrite",), ("-dryRun",)])
def test_a_motion_that_folds_the_mesh_is_refused(tmp_path, ranks, options):
    # The top goes through the bottom: every cell turns inside out
    case = make_box(tmp_path, top="0 0 -1.5")
    if ranks > 1:
        case.decompose((2, 1, 1))
    tree = case.tree if "-dryRun" in options else case.tree_without_reports
    before = tree()
    output = case.run("morphMesh", *options, ranks=ranks, status=1)
    assert tree() == before
    assert "The moved mesh would be invalid" in output
    assert "64 cells without positive volume, the worst at (" in output
    assert "Nothing was written" in output
    assert quality(output)["before"]["nonPositiveCells"] == 0


def no_dictionary(case):
    for path in case.path.rglob("dynamicMeshDict"):
        path.unlink()


def no_solver(case):
    case.write("constant/dynamicMeshDict", "dictionary", "dynamicFvMesh none;")


def unknown_solver(case):
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        LAPLACIAN.replace("motionSolver displ", "motionSolver dispi"),
    )


def empty_list(case):
    case.write("constant/dynamicMeshDict", "dictionary", "solvers {}")


def points0_of_another_mesh(case):
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        "motionSolver velocityLaplacian; diffusivity uniform;"
        "motionSolverLibs (fvMotionSolvers);",
    )
    case.write("0/pointMotionU", *field("0 1 -1 0 0 0 0", "0 0 0.1"))
    # Put where both the whole and the decomposed case look for it
    for mesh in case.path.rglob("polyMesh"):
        case.write(
            mesh.relative_to(case.path) / "points0",
            "vectorField",
            "1((0 0 0))",
        )


def nothing(case):
    pass


WRONG = {
    "time is no number": (
        nothing,
        ("-time", "soon"),
        ["-time is 'soon'", "not a number"],
    ),
    "time without the fields of the solver": (
        nothing,
        ("-time", "7"),
        ["Time 7 has no folder", "pointDisplacement"],
    ),
    "no such region": (
        nothing,
        ("-region", "moon"),
        ["no mesh in", "moon", "-region"],
    ),
    "no dynamicMeshDict": (
        no_dictionary,
        (),
        ["no dictionary", "dynamicMeshDict", "motionSolver"],
    ),
    "no motionSolver": (
        no_solver,
        (),
        ["neither an entry motionSolver", "dynamicMeshDict"],
    ),
    "unknown motionSolver": (
        unknown_solver,
        (),
        ["dispiacementLaplacian", "displacementLaplacian"],
    ),
    "empty list of solvers": (empty_list, (), ["no motion solver is given"]),
    "points0 of another mesh": (
        points0_of_another_mesh,
        ("-overwrite",),
        ["1 points in", "left from another mesh", "Remove it"],
    ),
    "unknown option": (nothing, ("-overwritten",), ["overwritten"]),
}


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("wrong", WRONG)
def test_wrong_input_is_an_error_that_writes_nothing(tmp_path, wrong, ranks):
    spoil, options, words = WRONG[wrong]
    case = make_box(tmp_path)
    spoil(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
        spoil(case)
    before = case.tree()
    output = case.run("morphMesh", *options, ranks=ranks, status=1)
    assert case.tree() == before

    # Of an unknown option OpenFOAM itself speaks, and aborts before mpirun has
    # passed its words on in every case
    if ranks == 1 or wrong != "unknown option":
        for word in words:
            assert word in output


# --- in parallel


@pytest.mark.parametrize("options", [(), ("-overwrite",)])
def test_parallel_run_equals_serial_run(tmp_path, options):
    serial = make_box(tmp_path / "serial", top="0.4 0.2 0.5")
    parallel = make_box(tmp_path / "parallel", top="0.4 0.2 0.5")
    serial.run("morphMesh", *options)
    parallel.decompose((1, 1, 2))
    parallel.run("morphMesh", *options, ranks=2)

    file = ("constant" if options else "0") + "/polyMesh/points"
    np.testing.assert_allclose(
        parallel.decomposed_points(file), serial.points(file), atol=1e-10
    )
    for row in ["before", "after"]:
        ours, theirs = quality_file(parallel)[row], quality_file(serial)[row]
        assert ours == pytest.approx(theirs, rel=1e-6, abs=1e-6)
    assert not list(parallel.path.glob("processor*/postProcessing"))
    if options:
        np.testing.assert_array_equal(
            parallel.decomposed_points("constant/polyMesh/points0"),
            serial.points("constant/polyMesh/points0"),
        )
