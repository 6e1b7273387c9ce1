# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphRemesh: what stays where cells are replaced by tetrahedra.

Source of truth: OpenFOAM's checkMesh, the volume of a box, the files before and
after, and linear fields, which linear mapping leaves exact.
"""

import pathlib
import re
import sys

import numpy as np
import pytest

from boxCase import box
from foamCase import ROOT, read_labels, read_vectors

PATCHES = {
    "xMin": "patch",
    "xMax": "patch",
    "yMin": "wall",
    "yMax": "wall",
    "zMin": "wall",
    "zMax": "patch",
}

LIMITS = "limits { nonOrthogonality 65; skewness 4; }"


def has_madlib():
    made = list((ROOT / "build").glob("*/engines"))
    return any("lMAdLib" in path.read_text() for path in made)


needs_madlib = pytest.mark.skipif(
    not has_madlib(), reason="libmorphRemesh is built without MAdLib"
)


def remesh_dict(case, entries):
    case.write("system/remeshDict", "dictionary", f"remesh {{ {entries} }}")


def write_points(case, points):
    rows = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in points.tolist())
    case.write(
        "constant/polyMesh/points",
        "vectorField",
        f"{len(points)}\n(\n{rows}\n)",
    )


def sheared(path):
    """A box, 2 x 1 x 1, that is sheared by 70 degrees in the middle."""
    case = box(path, PATCHES, cells=(12, 8, 8), high=(2, 1, 1))
    x = case.points("constant/polyMesh/points")
    y, z = (x[:, 1] - 0.5) / 0.25, (x[:, 2] - 0.5) / 0.5
    wave = np.where(abs(y) < 1, np.sin(np.pi * y), 0)
    length = np.sin(np.pi * x[:, 0] / 2)
    x[:, 0] += 0.35 * length * wave * np.cos(np.pi * z / 2)
    write_points(case, x)
    return case


def figures(output):
    """Cells, non-orthogonality, skewness of the rows before and after."""
    rows = re.findall(r"^(before|after) +(.*)$", output, re.MULTILINE)
    return {
        name: dict(
            zip(
                ("cells", "volume", "nonOrthogonality", "skewness"),
                map(float, row.split()),
            )
        )
        for name, row in rows
    }


def patch_faces(case, mesh, name):
    """The points of the faces of a patch, or of a zone of faces."""
    points = read_vectors(case.path / mesh / "points")
    faces = mesh_faces(case, mesh)
    text = (case.path / mesh / "boundary").read_text()
    found = re.search(
        rf"{name}\s*{{[^}}]*nFaces\s+(\d+);\s*startFace\s+(\d+);", text
    )
    n, start = map(int, found.groups())
    return [points[f] for f in faces[start : start + n]]


def zone_labels(case, mesh, kind, name):
    """The labels of a zone."""
    text = (case.path / mesh / kind).read_text()
    body = re.search(rf"\b{name}\s*{{[^}}]*?List<label>[^(]*\(([^)]*)\)", text)
    return [int(i) for i in body.group(1).split()]


def area_vector(faces):
    """The sum of the area vectors of faces."""
    return sum(
        0.5 * np.cross(np.roll(f, -1, axis=0) - f[0], f - f[0]).sum(axis=0)
        for f in faces
    )


def area(faces):
    """The area of triangles and of plane faces."""
    return sum(np.linalg.norm(area_vector([f])) for f in faces)


def mesh_faces(case, mesh):
    text = (case.path / mesh / "faces").read_text()
    return [
        [int(i) for i in face.split()]
        for face in re.findall(r"^\d+\(([\d ]+)\)$", text, re.MULTILINE)
    ]


def mesh_cells(case, mesh):
    """The points of each cell, as a set of positions."""
    points = read_vectors(case.path / mesh / "points")
    faces = mesh_faces(case, mesh)
    cells = {}
    for name in ("owner", "neighbour"):
        for face, cell in enumerate(read_labels(case.path / mesh / name)):
            cells.setdefault(cell, set()).update(
                tuple(points[i]) for i in faces[face]
            )
    return {frozenset(x) for x in cells.values()}


@pytest.fixture(scope="module")
def cavity(tmp_path_factory):
    """The sheared box, with zones and a set, before and after."""
    case = sheared(tmp_path_factory.mktemp("cavity"))
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions
        (
            { name box; type cellZoneSet; action remove; }
            { name low; type cellSet; action new; source boxToCell;
              box (-1 -1 -1) (3 2 0.25); }
            { name low; type cellZoneSet; action new; source setToCellZone;
              set low; }
            { name middle; type faceSet; action new; source boxToFace;
              box (0.1 0.1 0.24) (1.9 0.9 0.26); }
            { name middle; type faceZoneSet; action new;
              source setsToFaceZone; faceSet middle; cellSet low; }
            { name probe; type pointSet; action new; source nearestToPoint;
              points ((1.01 0.51 0.51)); }
            { name probe; type pointZoneSet; action new;
              source setToPointZone; set probe; }
        );""",
    )
    case.run("topoSet")
    remesh_dict(case, f"{LIMITS} layers 1;")
    return case, case.run("morphRemesh")


OLD, NEW = "constant/polyMesh", "1/polyMesh"


@needs_madlib
def test_bad_cells_become_good_ones(cavity):
    case, output = cavity
    table = figures(output)
    assert table["before"]["nonOrthogonality"] > 65
    assert table["after"]["nonOrthogonality"] <= 65
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


@needs_madlib
def test_the_volume_stays(cavity):
    change = re.search(r"Volume (\S+), relative change (\S+)", cavity[1])
    assert float(change.group(1)) == pytest.approx(2, rel=1e-12)
    assert abs(float(change.group(2))) < 1e-12


@needs_madlib
def test_cells_that_are_not_replaced_keep_their_points_to_the_bit(cavity):
    case, output = cavity
    before, after = mesh_cells(case, OLD), mesh_cells(case, NEW)
    replaced = int(re.search(r"remesh: (\d+) cells, cut", output).group(1))
    known = frozenset().union(*before)
    # Faces that are cut about a point have one more
    stayed = before & {cell & known for cell in after if len(cell) > 4}
    assert 0 < replaced < len(before)
    assert len(stayed) == len(before) - replaced


@needs_madlib
def test_zones_keep_their_space(cavity):
    case, _ = cavity
    table = case.run("checkMesh", "-latestTime")
    low = re.search(r"^ +low +\d+ +\d+ +(\S+) ", table, re.MULTILINE)
    assert float(low.group(1)) == pytest.approx(0.5, rel=1e-12)

    # The sum of areas in the orientation of the zone, and its border
    sums, points = [], []
    for mesh in (OLD, NEW):
        x = read_vectors(case.path / mesh / "points")
        faces = mesh_faces(case, mesh)
        text = (case.path / mesh / "faceZones").read_text()
        flips = re.search(r"List<bool>[^({]*[({]([^)}]*)[)}]", text).group(1)
        labels = zone_labels(case, mesh, "faceZones", "middle")
        flips = (
            flips.split() if len(flips.split()) > 1 else [flips] * len(labels)
        )
        vectors = [area_vector([x[faces[f]]]) for f in labels]
        sums.append(
            sum(
                -v if flip.strip() in ("1", "true") else v
                for v, flip in zip(vectors, flips)
            )
        )
        points.append({tuple(x[i]) for f in labels for i in faces[f]})
    assert len(labels) > 0
    np.testing.assert_allclose(sums[1], sums[0], atol=1e-12)
    assert points[0] <= points[1]

    probes = [
        read_vectors(case.path / mesh / "points")[
            zone_labels(case, mesh, "pointZones", "probe")
        ]
        for mesh in (OLD, NEW)
    ]
    np.testing.assert_array_equal(probes[0], probes[1])


@needs_madlib
def test_a_set_has_what_its_zone_has(cavity):
    case, _ = cavity
    text = (case.path / NEW / "sets/low").read_text()
    body = re.search(r"\n(\d+)\s*\(([^)]*)\)", text).group(2)
    assert sorted(map(int, body.split())) == sorted(
        zone_labels(case, NEW, "cellZones", "low")
    )


def wavy(path):
    """A box with a wall that is no plane, and others that are."""
    case = box(path, PATCHES, cells=(4, 4, 4))
    x = case.points(f"{OLD}/points")
    x[:, 2] += 0.1 * (1 - x[:, 2]) * np.sin(3 * x[:, 0] + 2 * x[:, 1])
    write_points(case, x)
    return case


@needs_madlib
def test_a_curved_wall_keeps_its_faces_and_planes_their_area(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "region all; sizeFactor 0.7;")
    output = case.run("morphRemesh")
    assert figures(output)["after"]["cells"] != 64
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")
    curved = [patch_faces(case, mesh, "zMin") for mesh in (OLD, NEW)]
    corners = [{tuple(p) for f in faces for p in f} for faces in curved]
    # Each quadrilateral is cut along a diagonal or about its centre
    assert corners[0] <= corners[1]
    assert len(corners[1]) <= len(corners[0]) + 16
    np.testing.assert_allclose(
        area_vector(curved[1]), area_vector(curved[0]), atol=1e-13
    )
    for name in ("xMin", "xMax", "yMin", "yMax", "zMax"):
        planes = [patch_faces(case, mesh, name) for mesh in (OLD, NEW)]
        assert {len(f) for f in planes[1]} == {3}
        np.testing.assert_allclose(
            area(planes[1]), area(planes[0]), rtol=1e-12
        )
    change = re.search(r"relative change (\S+)", output)
    assert abs(float(change.group(1))) < 1e-12


@needs_madlib
def test_layers_at_patches_stay(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "region all; keepLayers 2; keepPatches (zMin);")
    old = mesh_cells(case, OLD)
    case.run("morphRemesh", "-overwrite")
    known = frozenset().union(*old)
    new = {cell & known for cell in mesh_cells(case, OLD) if len(cell) > 4}
    # The cells of two layers of 4 x 4, by the height of their lowest point
    layers = {cell for cell in old if min(p[2] for p in cell) < 0.4}
    assert len(layers) == 32
    assert layers <= new
    assert not (old - layers) & new


@needs_madlib
def test_cells_at_periodic_faces_stay(tmp_path):
    patches = dict(
        PATCHES,
        xMin="cyclic; neighbourPatch xMax;",
        xMax="cyclic; neighbourPatch xMin;",
    )
    case = box(tmp_path, patches, cells=(6, 4, 4))
    remesh_dict(case, "region all;")
    old = mesh_cells(case, OLD)
    case.run("morphRemesh")
    known = frozenset().union(*old)
    new = {cell & known for cell in mesh_cells(case, NEW) if len(cell) > 4}
    ends = {cell for cell in old if {p[0] for p in cell} & {0, 1}}
    assert len(ends) == 32
    assert ends <= new
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


@needs_madlib
def test_polyhedra_are_replaced(tmp_path):
    case = wavy(tmp_path)
    case.run("polyDualMesh", "75", "-overwrite")
    remesh_dict(case, "region all;")
    output = case.run("morphRemesh")
    change = re.search(r"relative change (\S+)", output)
    assert abs(float(change.group(1))) < 1e-12
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


@needs_madlib
def test_fields_of_zero_gradient_and_fixed_value_are_written(tmp_path):
    """A constant stays one, and conditions stay with their patches."""
    case = wavy(tmp_path)
    case.write(
        "0/T",
        "volScalarField",
        "dimensions [0 0 0 1 0 0 0]; internalField uniform 3; boundaryField {"
        " xMin { type fixedValue; value uniform 5; }"
        ' "(xMax|y.*|z.*)" { type zeroGradient; } }',
    )
    case.write(
        "0/pointDisplacement",
        "pointVectorField",
        "dimensions [0 1 0 0 0 0 0]; internalField uniform (0 0 0);"
        " boundaryField {"
        ' zMin { type fixedValue; value uniform (0 0 0); } "[xy].*|zMax"'
        " { type slip; } }",
    )
    remesh_dict(case, "region all;")
    assert "pointDisplacement" in case.run("morphRemesh")
    text = (case.path / "1/T").read_text()
    values = re.search(r"nonuniform List<scalar>\s*\d+\s*\(([^)]*)\)", text)[
        1
    ].split()
    np.testing.assert_allclose(np.array(values, float), 3, rtol=1e-14)
    assert re.search(
        r"xMin\s*{\s*type\s+fixedValue;\s*value\s+uniform 5;", text
    )
    text = (case.path / "1/pointDisplacement").read_text()
    assert re.search(r"internalField\s+uniform \(0 0 0\);", text)
    assert len(re.findall(r"type\s+slip;", text)) == 5


@needs_madlib
def test_the_result_is_the_same_each_time(tmp_path):
    points = []
    for name in ("a", "b"):
        case = wavy(tmp_path / name)
        remesh_dict(case, "region all;")
        case.run("morphRemesh")
        points.append((case.path / NEW / "points").read_bytes())
    assert points[0] == points[1]


@needs_madlib
def test_a_dry_run_writes_nothing(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "region all;")
    before = case.tree()
    assert "nothing is written" in case.run("morphRemesh", "-dryRun")
    assert case.tree() == before


@needs_madlib
def test_where_nothing_is_bad_nothing_is_written(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "")
    before = case.tree()
    assert "There is nothing to replace" in case.run("morphRemesh")
    assert case.tree() == before


def test_an_external_engine(tmp_path):
    """The surface of the box stays as it was cut, and its volume."""
    case = wavy(tmp_path)
    script = pathlib.Path(__file__).with_name("adapt.py")
    remesh_dict(
        case,
        "region all; engine external; sizeFactor 0.5;"
        "limits { nonOrthogonality 90; skewness 20; }"
        f'command "{sys.executable} {script}";',
    )
    output = case.run("morphRemesh")
    assert figures(output)["after"]["cells"] > 12 * 64
    change = re.search(r"relative change (\S+)", output)
    assert abs(float(change.group(1))) < 1e-12
    assert "Mesh OK" in case.run("checkMesh", "-latestTime")


@pytest.mark.parametrize(
    "entries, message",
    [
        ("engine mmg;", "Entry 'engine' is 'mmg'"),
        ("keepPatches (zMin hull);", "which is no patch or group"),
        ("layers 0;", "Entry 'layers' is 0"),
        ("size metric;", "Entry 'size' is 'metric'"),
        ("layrs 3;", "layrs"),
        ("region all; engine external;", "command"),
        (
            'region all; engine external; command "false";',
            "which ends with status 1",
        ),
        (
            'region all; engine external; command "true";',
            "of the external engine cannot be read",
        ),
    ],
)
def test_a_wrong_entry_is_named(tmp_path, entries, message):
    case = wavy(tmp_path)
    remesh_dict(case, entries)
    mesh = case.path / OLD
    before = {p.name: p.read_bytes() for p in mesh.iterdir() if p.is_file()}
    output = case.run("morphRemesh", status=1)
    assert message in output
    assert not (case.path / NEW).exists()
    after = {p.name: p.read_bytes() for p in mesh.iterdir() if p.is_file()}
    assert before == after


@needs_madlib
def test_limits_that_cannot_be_kept_stop_with_figures(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "limits { nonOrthogonality 3; } passes 2; layers 1;")
    before = case.tree()
    output = case.run("morphRemesh", status=1)
    assert output.count("cut into") <= 2
    found = re.search(
        r"the best has non-orthogonality (\S+) \(limit 3\)", output
    )
    assert float(found.group(1)) > 3
    assert case.tree() == before


def test_zones_that_overlap_are_refused(tmp_path):
    case = wavy(tmp_path)
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions
        (
            { name half; type cellSet; action new; source boxToCell;
              box (-1 -1 -1) (0.5 2 2); }
            { name half; type cellZoneSet; action new; source setToCellZone;
              set half; }
        );""",
    )
    case.run("topoSet")
    remesh_dict(case, "region all;")
    output = case.run("morphRemesh", status=1)
    assert "Cell 0 is in zones box and half" in output


def test_a_distributed_mesh_is_refused(tmp_path):
    case = wavy(tmp_path)
    remesh_dict(case, "region all;")
    case.decompose((2, 1, 1))
    output = case.run("morphRemesh", ranks=2, status=1)
    assert "distributed over ranks cannot be re-meshed" in output


def test_a_mesh_of_two_dimensions_is_refused(tmp_path):
    patches = dict(PATCHES, zMin="empty", zMax="empty")
    case = box(tmp_path, patches, cells=(4, 4, 1))
    remesh_dict(case, "region all;")
    output = case.run("morphRemesh", status=1)
    assert "A mesh of 2 dimensions" in output


def test_there_has_to_be_a_dictionary(tmp_path):
    case = wavy(tmp_path)
    assert "There is no dictionary" in case.run("morphRemesh", status=1)
