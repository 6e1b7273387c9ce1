# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Points that slide on curved surfaces and onto others.

Sources of truth: the closed forms of cylinder and sphere; for a patch without a
named surface its own faces, which are flat and of equal angles around the axis.
"""

import re

import numpy as np
import pytest

from rbfCase import (
    CUBE,
    groups,
    move,
    points_at,
    rbf_case,
    reference,
    selections,
)
from slidingCases import annulus, duct_obj, stl_of

# The hub turns about an axis that is not quite that of the casing
TURN = (
    "displacement { type solidBody; solidBodyMotionFunction rotatingMotion;"
    " rotatingMotionCoeffs { origin (0 0 0.5); axis (0.1 0 1); omega 0.6; } }"
)

CYLINDER = (
    "{ type searchableCylinder; point1 (0 0 0); point2 (0 0 1);" " radius 1; }"
)

TOLERANCE = 1e-3

CELLS = (6, 5, 8)


def casing_case(path, surface="", extra="", hub=TURN, **rest):
    return annulus(
        path,
        f"greedy {{ tolerance {TOLERANCE}; }}"
        f" supportRadius 2; {extra}"
        + groups(
            hub=f"type moving; patches (hub); {hub}",
            casing=f"type sliding; patches (casing); {surface}",
            ends="type sliding; patches (zMin zMax);",
        ),
        cells=CELLS,
        **rest,
    )


def on_casing(points):
    return np.abs(np.hypot(points[:, 0], points[:, 1]) - 1) < 1e-9


def off_cylinder(points):
    return np.abs(np.hypot(points[:, 0], points[:, 1]) - 1).max()


def off_faces(points, radius=1, sectors=4 * CELLS[0]):
    """How far points are from the flat sides of a duct."""
    sector = 2 * np.pi / sectors
    angle = np.arctan2(points[:, 1], points[:, 0])
    middle = (np.floor(angle / sector) + 0.5) * sector
    return np.abs(
        np.hypot(points[:, 0], points[:, 1]) * np.cos(angle - middle)
        - radius * np.cos(sector / 2)
    ).max()


def between_ends(points):
    """The points of the casing without its rims."""
    return on_casing(points) & (0.01 < points[:, 2]) & (points[:, 2] < 0.99)


def off_ends(before, after):
    ends = on_casing(before) & (
        (before[:, 2] < 1e-9) | (before[:, 2] > 1 - 1e-9)
    )
    return np.abs((after - before)[ends, 2]).max()


@pytest.mark.parametrize(
    "surface, off",
    [
        (f"surface {CYLINDER}", off_cylinder),
        ("", off_faces),
        ("surface curved;", off_faces),
    ],
)
def test_points_end_on_the_curved_surface_and_on_the_rim(
    tmp_path, surface, off
):
    case = casing_case(tmp_path, surface)
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    moved = np.linalg.norm((after - before)[casing], axis=1).max()
    assert moved > 0.2
    assert off(after[casing]) < 1e-13
    assert off_ends(before, after) < 1e-13


@pytest.mark.parametrize(
    "surface, off", [(f"surface {CYLINDER}", off_cylinder), ("", off_faces)]
)
def test_the_field_itself_is_on_the_surface_to_the_tolerance(
    tmp_path, surface, off
):
    case = casing_case(tmp_path, surface, extra="exactSliding no;")
    before = reference(case)
    output = case.run("moveDynamicMesh")
    ((_, _, error, tolerance),) = selections(output)
    assert error <= tolerance
    after = points_at(case, "1")
    distance = off(after[on_casing(before)])
    # Not by the last projection, which is off
    assert 1e-3 * tolerance < distance < 1.1 * tolerance


# --- onto other surfaces

STILL = "displacement { type uniform; value (0.02 0 0); }"


def test_points_slide_onto_a_sphere(tmp_path):
    centre = np.array([0.1, 0, 0.5])
    case = casing_case(
        tmp_path,
        "target { type searchableSphere; centre (0.1 0 0.5);" " radius 1.2; }",
        hub=STILL,
    )
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    radius = np.linalg.norm(after[casing] - centre, axis=1)
    assert np.linalg.norm((after - before)[casing], axis=1).max() > 0.1
    np.testing.assert_allclose(radius, 1.2, rtol=0, atol=1e-13)
    assert off_ends(before, after) < 1e-13


def test_points_slide_onto_triangles_of_a_file(tmp_path):
    case = casing_case(tmp_path, 'target "new.obj";', hub=STILL)
    (case.path / "constant/triSurface").mkdir()
    (case.path / "constant/triSurface/new.obj").write_text(duct_obj(1.1, 40))
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    assert off_faces(after[casing], 1.1, 40) < 1e-12
    assert off_ends(before, after) < 1e-12


def test_points_slide_onto_triangles_of_an_stl_file(tmp_path):
    # Whose numbers are in single precision
    case = casing_case(tmp_path, 'target "new.stl";', hub=STILL)
    (case.path / "constant/triSurface").mkdir()
    (case.path / "constant/triSurface/new.stl").write_text(
        stl_of(duct_obj(1.1, 40))
    )
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    assert np.linalg.norm((after - before)[casing], axis=1).max() > 0.09
    assert off_faces(after[casing], 1.1, 40) < 1e-6
    assert off_ends(before, after) < 1e-12


def test_on_a_named_surface_points_keep_the_distance_they_have(tmp_path):
    # The dual mesh has its points in the middle of the faces of the old one
    case = casing_case(tmp_path, f"surface {CYLINDER}", hub=TURN)
    case.run("polyDualMesh", "60", "-overwrite")
    before = reference(case)
    casing = np.hypot(before[:, 0], before[:, 1]) > 0.985
    distance = 1 - np.hypot(*before[casing, :2].T)
    assert distance.max() > 1e-3
    after = move(case)
    assert np.linalg.norm((after - before)[casing], axis=1).max() > 0.2
    np.testing.assert_allclose(
        1 - np.hypot(*after[casing, :2].T), distance, rtol=0, atol=1e-12
    )


# --- motions


def test_a_long_way_around(tmp_path):
    # One end turns by 57 degrees, the other is fixed, the walls slide
    case = annulus(
        tmp_path,
        "greedy { tolerance 1e-3; } supportRadius 2;"
        + groups(
            top="type moving; patches (zMax); displacement { type"
            " solidBody; solidBodyMotionFunction rotatingMotion;"
            " rotatingMotionCoeffs { origin (0 0 0); axis (0 0 1);"
            " omega 1; } }",
            bottom="type fixed; patches (zMin);",
            walls="type sliding; patches (casing hub);",
        ),
        cells=(8, 6, 10),
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert "Warning" not in output
    after = points_at(case, "1")
    # (The ends go where they are told to)
    casing = between_ends(before)
    assert np.linalg.norm((after - before)[casing], axis=1).max() > 0.8
    assert off_faces(after[casing], 1, 32) < 1e-12
    assert "Mesh OK" in output


def turning(omega, extra=""):
    return f"greedy {{ tolerance 1e-3; }} supportRadius 2; {extra}" + groups(
        walls="type moving; patches (zMin zMax hub); displacement { type"
        " solidBody; solidBodyMotionFunction rotatingMotion;"
        " rotatingMotionCoeffs { origin (0 0 0); axis (0 0 1);"
        f" omega {omega}; }} }}",
        casing="type sliding; patches (casing);",
    )


def around(before, after):
    """The angles by which the points of the casing go around its axis."""
    casing = between_ends(before)
    start, end = np.unwrap(
        np.stack(
            [np.arctan2(x[casing, 1], x[casing, 0]) for x in (before, after)]
        ),
        axis=0,
    )
    return end - start


@pytest.mark.parametrize("n", [4, 8])
def test_sub_steps_go_on_around_the_surface(tmp_path, n):
    # Ends and hub turn by 86 degrees: the casing follows, as far as it is
    # dragged
    case = annulus(
        tmp_path, turning(1.5, f"subSteps {n};"), cells=(CELLS[0], 4, 5)
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert f"moved in {n} sub-steps" in output and "Mesh OK" in output
    after = points_at(case, "1")
    casing = between_ends(before)
    assert off_faces(after[casing]) < 1e-12
    # Further than 60 degrees, which is as far as one direction reaches
    angle = around(before, after)
    assert angle.min() > 1.3 and angle.max() < 1.65
    # Cells turn with it: points that slide are on the surface in every step
    largest = re.search(r"non-orthogonality Max: (\S+)", output)[1]
    assert float(largest) < 25


def test_sub_steps_around_the_surface_are_the_same_on_three_ranks(tmp_path):
    results = []
    for ranks in (1, 3):
        case = annulus(
            tmp_path / str(ranks),
            turning(1.5, "subSteps 4;"),
            cells=(CELLS[0], 4, 5),
        )
        before = reference(case)
        if ranks > 1:
            case.decompose_cells(
                np.random.default_rng(ranks).integers(
                    0, ranks, 4 * CELLS[0] * 4 * 5
                )
            )
        output = case.run("moveDynamicMesh", ranks=ranks)
        assert "moved in 4 sub-steps" in output
        results.append(points_at(case, "1"))
    assert np.array_equal(*results)
    assert around(before, results[0]).min() > 1.3


def test_there_and_back_does_not_drift(tmp_path):
    steps = 40
    swing = " ".join(
        f"({t} ({0.3*np.sin(t*np.pi/4)!r} 0 {0.2*(t % 2)!r}))"
        for t in range(steps + 1)
    )
    case = casing_case(
        tmp_path,
        hub="displacement { type uniform; value table" f" ({swing}); }}",
        control={"end": steps, "writeInterval": 8, "format": "ascii"},
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    # Every eight steps at rest, where nothing is left
    for t in range(8, steps + 1, 8):
        np.testing.assert_allclose(
            case.points(f"{t}/polyMesh/points"), before, rtol=0, atol=1e-13
        )


def test_in_two_dimensions_points_stay_on_the_curve(tmp_path):
    case = annulus(
        tmp_path,
        "greedy { tolerance 1e-3; } supportRadius 2;"
        + groups(
            hub="type moving; patches (hub); displacement"
            " { type uniform; value (0.2 0.1 0); }",
            casing="type sliding; patches (casing);",
        ),
        cells=(CELLS[0], 5, 1),
        ends="empty",
    )
    before = reference(case)
    after = move(case)
    casing = on_casing(before)
    assert np.linalg.norm((after - before)[casing], axis=1).max() > 0.02
    assert off_faces(after[casing]) < 1e-13
    np.testing.assert_array_equal(after[:, 2], before[:, 2])


@pytest.mark.parametrize("surface", ["", 'target "new.obj";'])
def test_every_decomposition_slides_alike(tmp_path, surface):
    def case(path):
        case = casing_case(path, surface, hub=TURN if not surface else STILL)
        (case.path / "constant/triSurface").mkdir()
        (case.path / "constant/triSurface/new.obj").write_text(
            duct_obj(1.1, 40)
        )
        return case

    serial = case(tmp_path / "serial")
    expected = selections(serial.run("moveDynamicMesh"))
    points = points_at(serial, "1")
    n_cells = 4 * int(np.prod(CELLS))
    for n in (2, 4):
        parallel = case(tmp_path / str(n))
        parallel.decompose_cells(
            np.random.default_rng(n).integers(0, n, n_cells)
        )
        output = parallel.run("moveDynamicMesh", ranks=n)
        assert selections(output)[0][:2] == expected[0][:2]
        np.testing.assert_allclose(
            points_at(parallel, "1"), points, rtol=0, atol=1e-15
        )


# --- where else points slide

TURNED_ZONE = """
actions
(
    { name ring; type faceSet; action new; source cylinderAnnulusToFace;
      p1 (0 0 -1); p2 (0 0 2); outerRadius 0.76; innerRadius 0.72; }
    { name ring; type faceZoneSet; action new; source setToFaceZone;
      faceSet ring; }
);
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_points_of_a_face_zone_stay_on_the_curved_surface_it_is(
    tmp_path, ranks
):
    # A cylinder halfway between hub and casing, which the mesh has as 24 planes
    case = annulus(
        tmp_path,
        "greedy { tolerance 1e-3; } supportRadius 2;"
        + groups(
            hub=f"type moving; patches (hub); {TURN}",
            ring="type sliding; faceZones (ring);",
            ends="type sliding; patches (zMin zMax);",
            casing="type fixed; patches (casing);",
        ),
        cells=(CELLS[0], 4, 6),
    )
    case.write("system/topoSetDict", "dictionary", TURNED_ZONE)
    case.run("topoSet")
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    after = points_at(case, "1")
    ring = np.abs(np.hypot(before[:, 0], before[:, 1]) - 0.75) < 1e-9
    assert ring.sum() == 24 * 7
    assert np.linalg.norm((after - before)[ring], axis=1).max() > 0.1
    assert off_faces(after[ring], 0.75) < 1e-12


@pytest.mark.parametrize("shift", [(0.3, 0, 0), (-0.2, 0, 0.1)])
def test_a_flank_between_displaced_corners_stays_straight(tmp_path, shift):
    # The upper corner of the flank is displaced, the lower one is not: points
    # end on the line between them, wherever along it
    straight = (
        "displacement {{ type polyline; vertices ({}); values ({}); }}".format
    )
    dx, _, dz = shift
    case = rbf_case(
        tmp_path,
        coeffs="greedy { tolerance 1e-3; } supportRadius 2;"
        + groups(
            top="type moving; patches (zMax); "
            + straight("(0 0 1) (1 0 1)", f"({dx} 0 {dz}) (0 0 {dz})"),
            bottom="type fixed; patches (zMin);",
            flank="type sliding; patches (xMin); "
            + straight("(0 0 0) (0 0 1)", f"(0 0 0) ({dx} 0 {dz})"),
            sides="type sliding; patches (yMin yMax);",
        ),
        cells=(5, 3, 8),
    )
    before = reference(case)
    after = move(case)
    flank = np.abs(before[:, 0]) < 1e-9
    along = np.array([dx, 0, 1 + dz])
    across = np.array([along[2], 0, -along[0]]) / np.linalg.norm(along)
    np.testing.assert_allclose(after[flank] @ across, 0, rtol=0, atol=1e-13)
    inner = flank & (0.01 < before[:, 2]) & (before[:, 2] < 0.99)
    # They slide on it: nothing puts them where the polyline says
    told = before + np.outer(before[:, 2], shift)
    assert np.abs((after - told)[inner] @ along).max() > 1e-3
    for axis, plane in ((1, 0), (1, 1)):
        side = np.abs(before[:, axis] - plane) < 1e-9
        np.testing.assert_allclose(after[side, axis], plane, atol=1e-13)


@pytest.mark.parametrize("height", [0.9, 1.2])
def test_in_a_wedge_points_slide_along_the_straight_generatrix(
    tmp_path, height
):
    # A cone whose inner end moves along the axis: its radius is linear in x
    angle = np.radians(2.5)
    corners = [
        (x, r * np.cos(angle), z * r * np.sin(angle))
        for z in (-1, 1)
        for x, r in ((0, 0.3), (1, 0.3), (1, height), (0, 0.6))
    ]
    case = rbf_case(
        tmp_path,
        coeffs="greedy { tolerance 1e-3; } supportRadius 2;"
        + groups(
            hub="type moving; patches (yMin); displacement { type uniform;"
            " value (0.15 0 0); }",
            ends="type fixed; patches (xMin xMax);",
            cone="type sliding; patches (yMax);",
        ),
        patches={**CUBE, "zMin": "wedge", "zMax": "wedge"},
        cells=(8, 6, 1),
        corners=corners,
    )
    before = reference(case)
    after = move(case)
    radius = np.hypot(after[:, 1], after[:, 2])
    cone = (
        np.abs(
            np.hypot(before[:, 1], before[:, 2])
            - (0.6 + (height - 0.6) * before[:, 0])
        )
        < 1e-9
    )
    assert cone.sum() == 18
    assert np.abs((after - before)[cone, 0]).max() > 0.01
    np.testing.assert_allclose(
        radius[cone], 0.6 + (height - 0.6) * after[cone, 0], rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(
        np.abs(np.arctan2(after[:, 2], after[:, 1])), angle, rtol=0, atol=1e-14
    )


# --- errors


@pytest.mark.parametrize(
    "surface, phrases",
    [
        (
            'target "nowhere.obj";',
            ["nowhere.obj", "there is no surface", "other.obj"],
        ),
        (
            'surface "other.obj";',
            ["'casing'", "0.1", "half a face", "'target'"],
        ),
        (
            "target { type searchableSphere; centre (90 0 0); radius 1; }",
            ["'casing'", "90", "half the size", "units"],
        ),
        (
            "target { type searchableSphere; centre (0 0 0); radius 1; }"
            f" surface {CYLINDER}",
            ["'surface'", "'target'", "one of them"],
        ),
        (
            f"surface {CYLINDER} {STILL}",
            ["'surface'", "'displacement'", "target"],
        ),
        (
            "surface { type searchableCylinder; point1 (0 0 0); point2 (0 0 0);"
            " radius 1; }",
            ["point1", "point2", "axis"],
        ),
        (
            "surface { type searchableCylinder; point1 (0 0 0); point2 (0 0 1);"
            " radius -1; }",
            ["radius", "-1"],
        ),
        (
            "surface { type searchableTorus; }",
            ["searchableTorus", "searchableSphere"],
        ),
    ],
)
def test_a_wrong_surface_is_an_error(tmp_path, surface, phrases):
    case = casing_case(tmp_path, surface)
    (case.path / "constant/triSurface").mkdir()
    (case.path / "constant/triSurface/other.obj").write_text(
        duct_obj(0.75, 40)
    )
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    for phrase in phrases:
        assert phrase in output
    assert case.tree() == before


def test_all_ranks_stop_with_the_message_of_a_surface_too_far(tmp_path):
    case = casing_case(
        tmp_path,
        "target { type searchableSphere;" " centre (90 0 0); radius 1; }",
    )
    case.decompose((2, 1, 1))
    assert "half the size" in case.run("moveDynamicMesh", ranks=2, status=1)
