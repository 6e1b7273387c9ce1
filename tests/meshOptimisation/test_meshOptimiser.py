# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphMesh -optimise: meshes of any cells get better, or stay.

Sources of truth: a mesh whose boundary is at rest has its reference as the only
shape without distortion; the figures of quality.dat, which are those of
checkMesh; the same mesh on one rank.
"""

import shutil

import numpy as np
import pytest

from boxCase import box
from foamCase import FoamCase, read_labels

SIDES = ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")


def patches(**types):
    return {side: types.get(side, "patch") for side in SIDES}


def write_points(case, points, name="points"):
    rows = "\n".join("(%.17g %.17g %.17g)" % tuple(x) for x in points)
    case.write(
        f"constant/polyMesh/{name}",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


def shaken(points, by, seed=0, axes=(0, 1, 2), inside=None):
    """The points, those inside shifted at random."""
    shift = np.random.default_rng(seed).uniform(-by, by, points.shape)
    if inside is None:
        low, high = points.min(0) + 1e-9, points.max(0) - 1e-9
        inside = ((points > low) & (points < high))[:, list(axes)].all(1)
    moved = points.copy()
    for axis in axes:
        moved[inside, axis] += shift[inside, axis]
    return moved


def tangled(path, by=0.3, n=5, **more):
    """A cube of n^3 cells of which the inner points are anywhere."""
    case = box(path, patches(), cells=(n, n, n), control={"digits": 17})
    reference = case.points("constant/polyMesh/points")
    write_points(case, reference, "points0")
    write_points(case, shaken(reference, by, **more))
    return case, reference


def settings(case, text):
    case.write("system/optimiseDict", "dictionary", text)


def optimise(case, ranks=1, status=0):
    options = ("-optimise", "-noMotion", "-time", "1")
    return case.run("morphMesh", *options, ranks=ranks, status=status)


def quality(case):
    """The columns of quality.dat before and after."""
    table = (case.path / "postProcessing/morphMesh/1/quality.dat").read_text()
    names = table.splitlines()[0].split()[2:]
    return [
        dict(zip(names, map(float, row.split()[1:])))
        for row in table.splitlines()[1:]
    ]


def test_box_of_random_points_is_untangled(tmp_path):
    case, reference = tangled(tmp_path)
    optimise(case)
    before, after = quality(case)
    assert before["wronglyOrientedFaces"] > 50
    assert after["wronglyOrientedFaces"] == after["nonPositiveCells"] == 0
    assert after["maxNonOrthogonality"] < 5
    points = case.points("1/polyMesh/points")
    assert np.abs(points - reference).max() < 0.02


def test_without_a_reference_cells_get_right_angles(tmp_path):
    """The lengths of the shaken cells are their targets, so that the result is
    not the box, but valid and better."""
    case, _ = tangled(tmp_path, by=0.12)
    (case.path / "constant/polyMesh/points0").unlink()
    log = optimise(case)
    assert "the target are orthogonal cells" in log
    before, after = quality(case)
    assert after["wronglyOrientedFaces"] == 0
    assert after["maxNonOrthogonality"] < 0.6 * before["maxNonOrthogonality"]


def test_mesh_at_rest_stays_to_the_last_bit(tmp_path):
    case, reference = tangled(tmp_path, by=0)
    optimise(case)
    assert np.array_equal(case.points("1/polyMesh/points"), reference)


@pytest.mark.parametrize("n", [(2, 1, 1), (1, 3, 1), (2, 2, 1)])
def test_ranks_agree_to_the_last_bit(tmp_path, n):
    serial, _ = tangled(tmp_path / "serial")
    settings(serial, "iterations 60;")
    optimise(serial)
    case, _ = tangled(tmp_path / "parallel")
    settings(case, "iterations 60;")
    case.decompose(n)
    for rank in case.path.glob("processor[0-9]*"):
        mesh = rank / "constant/polyMesh"
        local = read_labels(mesh / "pointProcAddressing")
        for name in ("points", "points0"):
            whole = case.points(f"constant/polyMesh/{name}")
            write_points(FoamCase(rank), whole[local], name)
    optimise(case, ranks=int(np.prod(n)))
    assert np.array_equal(
        case.decomposed_points("1/polyMesh/points"),
        serial.points("1/polyMesh/points"),
    )


def test_planar_mesh_keeps_its_planes(tmp_path):
    case = box(
        tmp_path,
        patches(zMin="empty", zMax="empty"),
        cells=(8, 8, 1),
        control={"digits": 17},
    )
    reference = case.points("constant/polyMesh/points")
    write_points(case, reference, "points0")
    flat = reference.copy()
    shift = shaken(reference, 0.2, axes=(0, 1)) - reference

    # Both sides alike
    lower = {tuple(x[:2]): d for x, d in zip(reference, shift) if x[2] == 0}
    for x, y in zip(reference, flat):
        y[:2] += lower[tuple(x[:2])][:2]
    write_points(case, flat)
    optimise(case)
    before, after = quality(case)
    assert before["wronglyOrientedFaces"] > 0
    assert after["wronglyOrientedFaces"] == 0
    points = case.points("1/polyMesh/points")
    assert np.array_equal(points[:, 2], reference[:, 2])
    assert np.abs(points - reference).max() < 0.02


def test_points_slide_in_symmetry_planes(tmp_path):
    case = box(
        tmp_path,
        patches(zMin="symmetryPlane"),
        cells=(5, 5, 5),
        control={"digits": 17},
    )
    reference = case.points("constant/polyMesh/points")
    write_points(case, reference, "points0")
    in_plane = reference[:, 2] == 0
    inner = in_plane & (np.abs(reference[:, :2] - 0.5) < 0.49).all(1)
    write_points(case, shaken(reference, 0.15, axes=(0, 1), inside=inner))
    optimise(case)
    points = case.points("1/polyMesh/points")
    assert np.array_equal(points[in_plane, 2], np.zeros(36))
    assert np.abs(points - reference).max() < 0.01


def test_polyhedra(tmp_path):
    """The dual of a box of tetrahedra-like cells: polyhedra of many faces."""
    case = box(tmp_path, patches(), cells=(5, 5, 5), control={"digits": 17})
    case.run("polyDualMesh", "30", "-overwrite")
    for folder in case.path.glob("[0-9]*"):
        if (folder / "polyMesh").is_dir():
            shutil.rmtree(case.path / "constant/polyMesh")
            shutil.move(folder / "polyMesh", case.path / "constant")
    reference = case.points("constant/polyMesh/points")
    write_points(case, reference, "points0")
    write_points(case, shaken(reference, 0.12))
    optimise(case)
    before, after = quality(case)
    assert before["wronglyOrientedFaces"] > 0
    assert after["wronglyOrientedFaces"] == 0
    assert np.abs(case.points("1/polyMesh/points") - reference).max() < 0.02


def test_layers_move_only_what_is_near(tmp_path):
    case, reference = tangled(tmp_path, by=0)
    moved = reference.copy()
    middle = np.abs(reference - 0.4).max(1) < 0.01
    assert middle.sum() == 1
    moved[middle] += 0.3
    write_points(case, moved)
    settings(case, "layers 1;")
    optimise(case)
    points = case.points("1/polyMesh/points")
    far = np.abs(reference - 0.4).max(1) > 0.59
    assert np.array_equal(points[far], reference[far])
    assert np.abs(points - reference).max() < 0.02


def test_needed_leaves_a_mesh_within_limits_alone(tmp_path):
    case, _ = tangled(tmp_path, by=0.03)
    before = case.points("constant/polyMesh/points")
    settings(case, "when needed;")
    optimise(case)
    assert np.array_equal(case.points("1/polyMesh/points"), before)
    settings(case, "when needed; limits { nonOrthogonality 5; }")
    optimise(case)
    assert quality(case)[1]["maxNonOrthogonality"] < 5


@pytest.mark.parametrize(
    "entries, says",
    [
        ("when sometimes;", "needed"),
        ("power 0;", "from 1 to 16"),
        ("power 20;", "from 1 to 16"),
        ("sizeWeight -1;", "from 0 to 1000"),
        ("iterations 0;", "whole number from 1"),
        ("layers none;", "Use all, or a whole number"),
        ("layers 0;", "Use all, or a whole number"),
        ("target nicer;", "orthogonal"),
        ("limits { nonOrthogonality 500; }", "from 1 to 180"),
        ("limits { angle 50; }", "angle"),
        ("speed 3;", "speed"),
    ],
)
def test_wrong_entries(tmp_path, entries, says):
    case, _ = tangled(tmp_path, n=2)
    settings(case, entries)
    tree = case.tree()
    log = optimise(case, status=1)
    assert "FATAL IO ERROR" in log and "optimiseDict" in log
    assert says in log
    assert case.tree() == tree


def test_no_reference_to_be_a_target(tmp_path):
    case, _ = tangled(tmp_path, n=2)
    (case.path / "constant/polyMesh/points0").unlink()
    settings(case, "target reference;")
    assert "Use 'target orthogonal'" in optimise(case, status=1)


def test_points0_of_another_mesh(tmp_path):
    case, reference = tangled(tmp_path, n=2)
    write_points(case, reference[:-1], "points0")
    assert "points0 is of another mesh" in optimise(case, status=1)


def test_no_motion_needs_something_to_do(tmp_path):
    case, _ = tangled(tmp_path, n=2)
    log = case.run("morphMesh", "-noMotion", status=1)
    assert "Add -optimise" in log
