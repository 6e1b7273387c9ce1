"""How far a mesh may move: onInvalidMesh error | limit | ignore, and reports.

Sources of truth: boxes of one layer of cells, of which every point is on a
moving or fixed patch, so that the motion is known; the fraction of it at which
the first tetrahedron is flat, by a formula or by a search over determinants
here, which knows nothing of polynomials; checkMesh.
"""

import re

import numpy as np
import pytest

from rbfCase import groups, points_at, rbf_case, reference, ulps

LIMIT = "onInvalidMesh limit;\n"
BOTTOM = "type fixed; patches (zMin);"


def top(displacement):
    return groups(
        top="type moving; patches (zMax); displacement { %s }" % displacement,
        bottom=BOTTOM)


def lowered(height):
    return top(f"type uniform; value (0 0 {-height});")


def turned(angle):
    return top("type solidBody; solidBodyMotionFunction axisRotationMotion;"
               "axisRotationMotionCoeffs { origin (0.5 0.5 0);"
               f" radialVelocity (0 0 {angle}); }}")


def motion(case, time="1", folder="invalidMotion"):
    """What the limiter says in the log or the record of morphMesh."""
    text = (case.path/"postProcessing"/folder/time/"motion").read_text()
    return {key: value for key, value in
            re.findall(r"^(\w+)\s+(.*);$", text, re.MULTILINE)}


LIMITED = (r"limited to the fraction (\S+) of it. It is valid up to (\S+), "
           r"where the first cell breaks at \((.*?)\) \((\w+)\)")


def limited(output):
    """Fraction moved, fraction attainable, where, criterion."""
    moved, valid, where, criterion = re.search(LIMITED, output).groups()
    return (float(moved), float(valid), np.array(where.split(), float),
            criterion)


def first_flat(x, s, cells, steps=4000):
    """The fraction at which the first tetrahedron of hexes is flat.

    Each face's triangles of an edge and its average, and the cell's average.
    cells: labels of hexes, in the order of OpenFOAM's hex.
    """
    sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (3, 7, 6, 2),
             (0, 4, 7, 3), (1, 2, 6, 5)]

    def smallest(t):
        corners = (x + t*s)[cells]
        centre = corners.mean(axis=1)
        volumes = []
        for side in sides:
            face = corners[:, side]
            middle = face.mean(axis=1)
            for i in range(4):
                a, b = face[:, i], face[:, (i + 1) % 4]
                volumes.append(np.einsum(
                    "ij,ij->i", np.cross(a - middle, b - middle),
                    middle - centre))
        return np.min(volumes)

    assert smallest(0) > 0
    for i in range(1, steps + 1):
        low, high = (i - 1)/steps, i/steps
        if smallest(high) <= 0:
            for _ in range(60):
                middle = 0.5*(low + high)
                low, high = ((middle, high) if smallest(middle) > 0
                             else (low, middle))
            return low
    return None


def one_layer(n):
    """The hexes of a box of n x n x 1 cells, as blockMesh numbers points."""
    def label(i, j, k):
        return i + (n + 1)*(j + (n + 1)*k)
    return np.array([
        [label(i, j, 0), label(i + 1, j, 0), label(i + 1, j + 1, 0),
         label(i, j + 1, 0), label(i, j, 1), label(i + 1, j, 1),
         label(i + 1, j + 1, 1), label(i, j + 1, 1)]
        for j in range(n) for i in range(n)])


# --- limit


def test_a_layer_is_lowered_to_a_tenth_of_its_height(tmp_path):
    # Height 1 - 1.5 t: flat at t = 2/3
    case = rbf_case(tmp_path, coeffs=LIMIT + lowered(1.5), cells=(3, 3, 1))
    output = case.run("moveDynamicMesh")
    moved, valid, _, criterion = limited(output)
    assert valid == pytest.approx(2/3, rel=1e-5)
    assert moved == pytest.approx(0.6, rel=1e-5)
    assert criterion == "tetrahedra"
    x = reference(case)
    expected = x + np.outer(x[:, 2], [0, 0, -1.5*0.9*2/3])
    np.testing.assert_allclose(points_at(case, "1"), expected, atol=1e-12)
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


def test_a_valid_motion_is_made_as_if_nothing_had_been_said(tmp_path):
    plain = rbf_case(tmp_path/"plain", coeffs=lowered(0.5))
    limit = rbf_case(tmp_path/"limit", coeffs=LIMIT + lowered(0.5))
    plain.run("moveDynamicMesh")
    output = limit.run("moveDynamicMesh")
    assert "limited" not in output
    assert np.array_equal(points_at(plain, "1"), points_at(limit, "1"))
    assert not (limit.path/"postProcessing").exists()
    assert not (limit.path/"constant/polyMesh/sets").exists()


# --- what was wrong before


def test_what_is_wrong_before_the_motion_does_not_stop_it(tmp_path):
    case = rbf_case(tmp_path, coeffs=LIMIT + lowered(1.5), cells=(3, 3, 1))
    x = reference(case)
    # One bottom point above its top: its cells are inverted there
    x[np.lexsort((x[:, 0], x[:, 1], x[:, 2]))[5]] += (0, 0, 1.4)
    rows = "\n".join("({!r} {!r} {!r})".format(*map(float, p)) for p in x)
    case.write("constant/polyMesh/points", "vectorField",
               f"{len(x)}\n(\n{rows}\n)")
    _, valid, _, _ = limited(case.run("moveDynamicMesh"))
    assert 0.05 < valid <= 2/3 + 1e-6


# --- reports


def cell_set(path):
    text = path.read_text()
    assert re.search(r"class\s+cellSet", text)
    return [int(c) for c in
            re.search(r"\n\d+\s*\(([\d\s]*)\)", text).group(1).split()]


@pytest.mark.parametrize("policy", ["error", "limit"])
def test_the_cells_that_stop_a_motion_are_reported(tmp_path, policy):
    # Lowered by a table: the first column of cells goes through the bottom
    x_low = "type file; file \"constant/lower.txt\";"
    case = rbf_case(tmp_path, coeffs=f"onInvalidMesh {policy};" + top(x_low),
                    cells=(3, 1, 1))
    x = reference(case)
    depth = {0: 1.5, 1: 1.5, 2: 0.2, 3: 0}
    (case.path/"constant/lower.txt").write_text("".join(
        f"{p[0]!r} {p[1]!r} {p[2]!r} 0 0 {-depth[round(3*p[0])]}\n"
        for p in x.tolist() if p[2] > 0.5))
    mesh = {f: h for f, h in case.tree().items() if f.startswith("constant")}
    output = case.run("moveDynamicMesh", status=policy == "error")

    assert ("onInvalidMesh limit" in output) and "valid up to" in output
    assert cell_set(
        case.path/"constant/polyMesh/sets/invalidMotionCells") == [0, 1]
    now = case.tree()
    assert {f: now[f] for f in mesh} == mesh
    assert {f for f in now if f.startswith("constant")} - set(mesh) == {
        "constant/polyMesh/sets",
        "constant/polyMesh/sets/invalidMotionCells"}
    assert (case.path/"1").exists() == (policy == "limit")

    vtk = (case.path/"postProcessing/invalidMotion/1/invalidCells.vtk"
           ).read_text()
    assert re.search(r"POLYGONS 12 ", vtk)
    assert "POINTS 12 " in vtk
    values = re.search(r"attainable 1 12 float\n([^A-Za-z]*)", vtk).group(1)
    values = np.array(values.split(), float)
    assert values.min() == pytest.approx(2/3, rel=1e-5)
    assert "displacement 3 12 float" in vtk

    # OpenFOAM reads the set
    case.write("system/topoSetDict", "dictionary", """
        actions ({ name seen; type cellSet; action new; source cellToCell;
                   set invalidMotionCells; });""")
    assert "now size 2" in case.run("topoSet")
