# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""How far a mesh may move: onInvalidMesh error | limit | ignore, and reports.

Sources of truth: boxes of one layer of cells, of which every point is on a
moving or fixed patch, so that the motion is known; the fraction of it at which
the first tetrahedron is flat, by a formula or by a search over determinants
here, which knows nothing of polynomials; checkMesh.
"""

import re

import numpy as np
import pytest

from boxCase import fixed
from rbfCase import groups, points_at, rbf_case, reference
from slidingCases import annulus

FAILED = "\nFailed: the moved mesh would be invalid\n"
LIMIT = "onInvalidMesh limit;\n"
BOTTOM = "type fixed; patches (zMin);"


def top(displacement):
    return groups(
        top="type moving; patches (zMax); displacement { %s }" % displacement,
        bottom=BOTTOM,
    )


def lowered(height):
    return top(f"type uniform; value (0 0 {-height});")


def screwed(case, angle, depth):
    """A table that turns and lowers the top of a case; what it says."""
    x = reference(case)
    a = np.radians(angle)
    turn = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    s = np.zeros_like(x)
    up = x[:, 2] > 1 - 1e-9
    s[up, :2] = (x[up, :2] - 0.5) @ turn.T - (x[up, :2] - 0.5)
    s[up, 2] = -depth
    (case.path / "constant/screw.txt").write_text(
        "".join(
            " ".join(repr(float(v)) for v in (*p, *d)) + "\n"
            for p, d in zip(x[up], s[up])
        )
    )
    return s


SCREW = top('type file; file "constant/screw.txt";')


def motion(case, time="1", folder="invalidMotion"):
    """What the limiter says in the log or the record of morphMesh."""
    text = (
        case.path / "postProcessing" / folder / time / "motion"
    ).read_text()
    return {
        key: value
        for key, value in re.findall(r"^(\w+)\s+(.*);$", text, re.MULTILINE)
    }


LIMITED = (
    r"limited to the fraction (\S+) of it. It is valid up to (\S+), "
    r"where the first cell breaks at \((.*?)\) \((\w+)\)"
)


def limited(output):
    """Fraction moved, fraction attainable, where, criterion."""
    moved, valid, where, criterion = re.search(LIMITED, output).groups()
    return (
        float(moved),
        float(valid),
        np.array(where.split(), float),
        criterion,
    )


def first_flat(x, s, cells, steps=4000):
    """The fraction at which the first tetrahedron of hexes is flat.

    Each face's triangles of an edge and its average, and the cell's average.
    cells: labels of hexes, in the order of OpenFOAM's hex.
    """
    sides = [
        (0, 3, 2, 1),
        (4, 5, 6, 7),
        (0, 1, 5, 4),
        (3, 7, 6, 2),
        (0, 4, 7, 3),
        (1, 2, 6, 5),
    ]

    def smallest(t):
        corners = (x + t * s)[cells]
        centre = corners.mean(axis=1)
        volumes = []
        for side in sides:
            face = corners[:, side]
            middle = face.mean(axis=1)
            for i in range(4):
                a, b = face[:, i], face[:, (i + 1) % 4]
                volumes.append(
                    np.einsum(
                        "ij,ij->i",
                        np.cross(a - middle, b - middle),
                        middle - centre,
                    )
                )
        return np.min(volumes)

    assert smallest(0) > 0
    for i in range(1, steps + 1):
        low, high = (i - 1) / steps, i / steps
        if smallest(high) <= 0:
            for _ in range(60):
                middle = 0.5 * (low + high)
                low, high = (
                    (middle, high) if smallest(middle) > 0 else (low, middle)
                )
            return low
    return None


def one_layer(n):
    """The hexes of a box of n x n x 1 cells, as blockMesh numbers points."""

    def label(i, j, k):
        return i + (n + 1) * (j + (n + 1) * k)

    return np.array(
        [
            [
                label(i, j, 0),
                label(i + 1, j, 0),
                label(i + 1, j + 1, 0),
                label(i, j + 1, 0),
                label(i, j, 1),
                label(i + 1, j, 1),
                label(i + 1, j + 1, 1),
                label(i, j + 1, 1),
            ]
            for j in range(n)
            for i in range(n)
        ]
    )


# --- limit


def test_a_layer_is_lowered_to_a_tenth_of_its_height(tmp_path):
    # Height 1 - 1.5 t: flat at t = 2/3
    case = rbf_case(tmp_path, coeffs=LIMIT + lowered(1.5), cells=(3, 3, 1))
    output = case.run("moveDynamicMesh")
    moved, valid, _, criterion = limited(output)
    assert valid == pytest.approx(2 / 3, rel=1e-5)
    assert moved == pytest.approx(0.6, rel=1e-5)
    assert criterion == "tetrahedra"
    x = reference(case)
    expected = x + np.outer(x[:, 2], [0, 0, -1.5 * 0.9 * 2 / 3])
    np.testing.assert_allclose(points_at(case, "1"), expected, atol=1e-12)
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


@pytest.mark.parametrize("angle", [20, 120])
def test_a_screwed_layer_goes_as_far_as_its_first_tetrahedron(tmp_path, angle):
    case = rbf_case(tmp_path, coeffs=LIMIT + SCREW, cells=(3, 3, 1))
    x, s = reference(case), screwed(case, angle, 1.4)
    _, _, _, criterion = limited(case.run("morphMesh", "-time", 1))

    expected = first_flat(x, s, one_layer(3))
    assert criterion == "tetrahedra"
    record = motion(case, folder="morphMesh")
    assert float(record["attainable"]) == pytest.approx(expected, abs=1e-12)
    assert float(record["moved"]) == pytest.approx(0.9 * expected, abs=1e-12)
    np.testing.assert_allclose(
        points_at(case, "1"), x + 0.9 * expected * s, atol=1e-11
    )


def test_a_valid_motion_is_made_as_if_nothing_had_been_said(tmp_path):
    plain = rbf_case(tmp_path / "plain", coeffs=lowered(0.5))
    limit = rbf_case(tmp_path / "limit", coeffs=LIMIT + lowered(0.5))
    plain.run("moveDynamicMesh")
    output = limit.run("moveDynamicMesh")
    assert "limited" not in output
    assert np.array_equal(points_at(plain, "1"), points_at(limit, "1"))
    assert not (limit.path / "postProcessing").exists()
    assert not (limit.path / "constant/polyMesh/sets").exists()


def test_limited_motions_are_the_same_on_any_number_of_ranks(tmp_path):
    results = {}
    for ranks, split in {
        1: None,
        2: (2, 1, 1),
        3: (1, 3, 1),
        4: (2, 1, 2),
    }.items():
        case = rbf_case(
            tmp_path / str(ranks), coeffs=LIMIT + SCREW, cells=(4, 3, 4)
        )
        screwed(case, 60, 1.1)
        if split:
            case.decompose(split)
        case.run("morphMesh", "-time", 1, ranks=ranks)
        record = motion(case, folder="morphMesh")
        results[ranks] = points_at(case, "1"), record
    points, record = results[1]
    assert 0 < float(record["attainable"]) < 1
    for ranks in (2, 3, 4):
        assert results[ranks][1] == record
        assert np.array_equal(results[ranks][0], points)


# --- what was wrong before


def test_what_is_wrong_before_the_motion_does_not_stop_it(tmp_path):
    case = rbf_case(tmp_path, coeffs=LIMIT + lowered(1.5), cells=(3, 3, 1))
    x = reference(case)
    # One bottom point above its top: its cells are inverted there
    x[np.lexsort((x[:, 0], x[:, 1], x[:, 2]))[5]] += (0, 0, 1.4)
    rows = "\n".join("({!r} {!r} {!r})".format(*map(float, p)) for p in x)
    case.write(
        "constant/polyMesh/points", "vectorField", f"{len(x)}\n(\n{rows}\n)"
    )
    _, valid, _, _ = limited(case.run("moveDynamicMesh"))
    assert 0.05 < valid <= 2 / 3 + 1e-6


# --- reports


def cell_set(path):
    text = path.read_text()
    assert re.search(r"class\s+cellSet", text)
    return [
        int(c)
        for c in re.search(r"\n\d+\s*\(([\d\s]*)\)", text).group(1).split()
    ]


@pytest.mark.parametrize("policy", ["error", "limit"])
def test_the_cells_that_stop_a_motion_are_reported(tmp_path, policy):
    # Lowered by a table: the first column of cells goes through the bottom
    x_low = 'type file; file "constant/lower.txt";'
    case = rbf_case(
        tmp_path,
        coeffs=f"onInvalidMesh {policy};" + top(x_low),
        cells=(3, 1, 1),
    )
    x = reference(case)
    depth = {0: 1.5, 1: 1.5, 2: 0.2, 3: 0}
    (case.path / "constant/lower.txt").write_text(
        "".join(
            f"{p[0]!r} {p[1]!r} {p[2]!r} 0 0 {-depth[round(3*p[0])]}\n"
            for p in x.tolist()
            if p[2] > 0.5
        )
    )
    mesh = {f: h for f, h in case.tree().items() if f.startswith("constant")}
    output = case.run("moveDynamicMesh", status=policy == "error")

    assert ("onInvalidMesh limit" in output) and "valid up to" in output
    assert cell_set(
        case.path / "constant/polyMesh/sets/invalidMotionCells"
    ) == [0, 1]
    now = case.tree()
    assert {f: now[f] for f in mesh} == mesh
    assert {f for f in now if f.startswith("constant")} - set(mesh) == {
        "constant/polyMesh/sets",
        "constant/polyMesh/sets/invalidMotionCells",
    }
    assert (case.path / "1").exists() == (policy == "limit")

    vtk = (
        case.path / "postProcessing/invalidMotion/1/invalidCells.vtk"
    ).read_text()
    assert re.search(r"POLYGONS 12 ", vtk)
    assert "POINTS 12 " in vtk
    values = re.search(r"attainable 1 12 float\n([^A-Za-z]*)", vtk).group(1)
    values = np.array(values.split(), float)
    assert values.min() == pytest.approx(2 / 3, rel=1e-5)
    assert "displacement 3 12 float" in vtk

    # OpenFOAM reads the set
    case.write(
        "system/topoSetDict",
        "dictionary",
        """
        actions ({ name seen; type cellSet; action new; source cellToCell;
                   set invalidMotionCells; });""",
    )
    assert "now size 2" in case.run("topoSet")


def test_morphMesh_reports_into_its_own_folder_but_not_in_a_dry_run(tmp_path):
    case = rbf_case(tmp_path, coeffs=lowered(1.5), cells=(3, 3, 1))
    before = case.tree()
    output = case.run("morphMesh", "-time", 1, "-dryRun", status=1)
    assert case.tree() == before
    assert FAILED in output

    output = case.run("morphMesh", "-time", 1, status=1)
    assert case.tree_without_reports() == before
    assert FAILED in output
    assert {
        p.name for p in (tmp_path / "postProcessing/morphMesh/1").iterdir()
    } == {"motion", "invalidCells.vtk"}
    record = motion(case, folder="morphMesh")
    assert float(record["attainable"]) == pytest.approx(2 / 3, rel=1e-5)
    assert float(record["moved"]) == 0


def test_how_far_a_motion_of_another_solver_may_go_is_recorded(tmp_path):
    # Laplace's equation: the heights of all cells are 1 - 1.6 t of their own
    case = rbf_case(
        tmp_path,
        control={"end": 1},
        conditions={
            "zMax": fixed(0, 0, -1.6),
            "zMin": fixed(0, 0, 0),
            **{
                side: "zeroGradient"
                for side in ("xMin", "xMax", "yMin", "yMax")
            },
        },
    )
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        """
        motionSolverLibs (fvMotionSolvers); motionSolver displacementLaplacian;
        displacementLaplacianCoeffs { diffusivity uniform; }""",
    )
    output = case.run("morphMesh", status=1)
    assert FAILED in output and "The moved mesh would be invalid" in output
    record = motion(case, "0", "morphMesh")
    assert float(record["attainable"]) == pytest.approx(1 / 1.6, rel=1e-5)
    assert (
        len(cell_set(case.path / "constant/polyMesh/sets/invalidMotionCells"))
        == 64
    )


def test_a_valid_motion_is_recorded_as_attainable(tmp_path):
    case = rbf_case(tmp_path, coeffs=lowered(0.5), cells=(3, 3, 1))
    case.run("morphMesh", "-time", 1)
    assert motion(case, folder="morphMesh") == {
        "attainable": "1",
        "moved": "1",
        "stoppedBy": "none",
        "subSteps": "1",
    }
    # A file that OpenFOAM reads
    for entry, value in (("attainable", "1"), ("stoppedBy", "none")):
        output = case.run(
            "foamDictionary",
            "-entry",
            entry,
            "-value",
            "postProcessing/morphMesh/1/motion",
        )
        assert output.split()[-1] == value


# --- histograms


def test_the_histogram_counts_every_face_once(tmp_path):
    # Shear by 1: faces that were at right angles are at 45 degrees
    shear = top("type uniform; value (1 0 0);")
    serial = rbf_case(tmp_path / "1", coeffs=shear, cells=(4, 3, 1))
    serial.run("morphMesh", "-time", 1)
    rows = re.findall(
        r"^(\w+)\s+(\S+)\s+(\S+)\s+(\d+)\s+(\d+)$",
        (serial.path / "postProcessing/morphMesh/1/histogram.dat").read_text(),
        re.MULTILINE,
    )
    count = {
        (name, float(low)): (int(before), int(after))
        for name, low, _, before, after in rows
    }
    internal, boundary = 3 * 3 + 4 * 2, 2 * 3 + 2 * 4 + 2 * 4 * 3

    def total(name, i):
        return sum(n[i] for (key, _), n in count.items() if key == name)

    for i in (0, 1):
        assert total("nonOrthogonality", i) == internal
        assert total("volumeRatio", i) == internal
        assert total("skewness", i) == internal + boundary
    # Sheared in x by the height 1: normals of x faces turn by 45 degrees
    assert count["nonOrthogonality", 0] == (internal, 4 * 2)
    assert sum(count["nonOrthogonality", low][1] for low in (40, 45)) == 3 * 3
    assert count["volumeRatio", 0.9] == (internal, internal)

    parallel = rbf_case(tmp_path / "2", coeffs=shear, cells=(4, 3, 1))
    parallel.decompose((2, 1, 1))
    parallel.run("morphMesh", "-time", 1, ranks=2)
    name = "postProcessing/morphMesh/1/histogram.dat"
    assert (parallel.path / name).read_text() == (
        serial.path / name
    ).read_text()


# --- curved surfaces


def aside(path, distance, extra):
    """An annulus of radii 0.5 and 1 whose hub moves to the side."""
    return annulus(
        path,
        "supportRadius 2; greedy { tolerance 1e-3; }"
        + extra
        + groups(
            hub="type moving; patches (hub); displacement { type"
            f" uniform; value ({distance} 0 0); }}",
            casing="type sliding; patches (casing); surface { type"
            " searchableCylinder; point1 (0 0 0);"
            " point2 (0 0 1); radius 1; }",
            ends="type sliding; patches (zMin zMax);",
        ),
    )


@pytest.mark.parametrize(
    "distance, extra",
    [
        (0.7, "onInvalidMesh limit;"),
        (0.7, "onInvalidMesh limit; subSteps 4;"),
        (0.4, "subSteps 4;"),
    ],
)
def test_points_stay_on_a_curved_surface_on_a_part_of_their_way(
    tmp_path, distance, extra
):
    case = aside(tmp_path, distance, extra)
    output = case.run("morphMesh", "-time", 1)
    assert ("limited to" in output) == (distance > 0.5)
    x, y = reference(case), points_at(case, "1")
    casing = np.hypot(x[:, 0], x[:, 1]) > 1 - 1e-9
    hub = np.hypot(x[:, 0], x[:, 1]) < 0.5 + 1e-9
    along = np.linalg.norm((y - x)[casing], axis=1).max()
    assert along > 0.05
    assert np.abs(np.hypot(y[casing, 0], y[casing, 1]) - 1).max() < 1e-13
    made = float(motion(case, folder="morphMesh")["moved"]) * distance
    np.testing.assert_allclose(y[hub], x[hub] + [made, 0, 0], atol=1e-12)


# --- polyhedra


AFFINE = "polynomial linear; selection all; supportRadius 2;" + lowered(1.5)


def polyhedral(case):
    case.run("polyDualMesh", "30", "-overwrite", "-noFunctionObjects")


def with_hanging_nodes(case):
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions
        ({ name half; type cellSet; action new; source boxToCell;
           box (-1 -1 -1) (0.5 0.6 0.4); });""",
    )
    case.run("topoSet")
    case.run("refineHexMesh", "half", "-overwrite")


@pytest.mark.parametrize("make", [polyhedral, with_hanging_nodes])
def test_cells_of_any_shape_break_where_their_volume_ends(tmp_path, make):
    # With a linear polynomial the whole box is squeezed evenly: 1 - 1.5 t
    case = rbf_case(tmp_path, coeffs=LIMIT + AFFINE)
    make(case)
    for time in case.path.glob("[0-9]*"):
        assert not (time / "polyMesh").exists()
    case.run("morphMesh", "-time", 1)
    record = motion(case, folder="morphMesh")
    assert float(record["attainable"]) == pytest.approx(2 / 3, rel=1e-5)


# --- where OpenFOAM's criterion decides


def arrowhead(path, far, extra=LIMIT):
    """One prism whose fourth corner goes from (0.3 0.3) towards (far far). It
    is within the average of its corners: tetrahedra there are inverted."""
    case = rbf_case(
        path,
        coeffs=extra
        + "selection all;"
        + groups(
            corner=f"type moving; points ((0.3 0.3 0) (0.3 0.3 1)); displacement"
            f" {{ type uniform; value ({far - 0.3} {far - 0.3} 0); }}",
            rest="type fixed; patches (xMin yMin);",
        ),
        cells=(1, 1, 1),
    )
    x = reference(case)
    x[(x[:, 0] > 0.5) & (x[:, 1] > 0.5), :2] = 0.3
    rows = "\n".join("({!r} {!r} {!r})".format(*map(float, p)) for p in x)
    case.write(
        "constant/polyMesh/points", "vectorField", f"{len(x)}\n(\n{rows}\n)"
    )
    return case


def test_faces_decide_where_tetrahedra_were_inverted_before(tmp_path):
    case = arrowhead(tmp_path / "far", -0.3)
    assert "Mesh OK" in case.run("checkMesh")
    _, _, _, criterion = limited(case.run("morphMesh", "-time", 1))
    assert criterion == "facesAndCells"
    valid = float(motion(case, folder="morphMesh")["attainable"])

    # As a search by motions that are refused or not finds
    for share, status in ((1 - 1e-5, 0), (1 + 1e-5, 1)):
        near = arrowhead(tmp_path / str(status), 0.3 - 0.6 * valid * share, "")
        near.run("morphMesh", "-time", 1, status=status)
