# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Mirror and periodic images of control points.

Sources of truth: a box that is mirrored or repeated explicitly, as one larger
mesh (mirror planes: the same field up to the tolerance of the selection), and
what each constraint means: points of a plane stay on it, of a pair of periodic
sides one is the other moved by the period.
"""

import re

import numpy as np
import pytest

from boxCase import words, write_control
from rbfCase import CUBE, groups, move, rbf_case, reference, selections, side

LOOSE = "supportRadius 1.2; greedy { tolerance 1e-2; }\n"

IMAGES = (
    r"rbfMotionSolver: (\d+) images within reach, of (\d+) symmetry "
    r"planes and (\d+) pairs of periodic sides"
)


def uniform(*value):
    return f"displacement {{ type uniform; value ({words(value)}); }}"


def solid(axis, omega, origin=(0, 0, 0)):
    return (
        "displacement { type solidBody; solidBodyMotionFunction"
        f" rotatingMotion; rotatingMotionCoeffs {{ origin ({words(origin)});"
        f" axis ({words(axis)}); omega {omega}; }} }}"
    )


def body(*at, d=(0.04, -0.03, 0.1)):
    """A point inside the mesh that moves."""
    return f"type moving; points (({words(at)}));" + uniform(*d)


def images_in(output):
    return [tuple(map(int, found)) for found in re.findall(IMAGES, output)]


# --- symmetry planes

HALF = {**CUBE, "xMax": "symmetryPlane", "yMin": "symmetry"}
ENDS = "type fixed; patches (zMin zMax);"


def test_symmetry_planes_are_kept_without_control_points_on_them(tmp_path):
    coeffs = LOOSE + groups(body=body(0.7, 0.3, 0.5), ends=ENDS)
    case = rbf_case(tmp_path, coeffs=coeffs, patches=HALF, cells=(6, 6, 6))
    before = reference(case)
    output = case.run("moveDynamicMesh")
    after = case.points("1/polyMesh/points")
    assert images_in(output) == [(3, 2, 0)]
    for name, axis, at in (("xMax", 0, 1), ("yMin", 1, 0)):
        on = side(before, name)
        np.testing.assert_allclose(after[on, axis], at, rtol=0, atol=1e-15)
        assert np.abs(after[on] - before[on]).max() > 0.02
    ((_, candidates, _, _),) = selections(output)
    ends = (side(before, "zMin") | side(before, "zMax")).sum()
    # The body, and of the ends all points: those on the planes slide in them
    assert candidates == ends + 1

    (tmp_path / "whole").mkdir()
    mirrored = [(x, y, 0.5) for x in (0.7, 1.3) for y in (0.3, -0.3)]
    values = [
        (0.04 * np.sign(1 - x), -0.03 * np.sign(y), 0.1)
        for x, y, _ in mirrored
    ]
    whole = rbf_case(
        tmp_path / "whole",
        low=(0, -1, 0),
        high=(2, 1, 1),
        cells=(12, 12, 6),
        coeffs="supportRadius 1.2; images no; greedy { tolerance 1e-9; }"
        + groups(
            body="type moving; points ("
            + "".join(f"({words(x)})" for x in mirrored)
            + "); displacement { type values; values ("
            + "".join(f"({words(d)})" for d in values)
            + "); }",
            ends=ENDS,
        ),
    )
    case = rbf_case(
        tmp_path / "half",
        coeffs=coeffs.replace("1e-2", "1e-9"),
        patches=HALF,
        cells=(6, 6, 6),
    )
    x = reference(whole)
    moved = move(whole)
    half = {tuple(p): q for p, q in zip(before.round(9), move(case) - before)}
    mine = (x[:, 0] < 1 + 1e-9) & (x[:, 1] > -1e-9)
    expected = (moved - x)[mine]
    found = np.array([half[tuple(p)] for p in x[mine].round(9) + 0.0])
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-9)


def test_a_displacement_across_a_symmetry_plane_keeps_plane_and_images(
    tmp_path,
):
    coeffs = LOOSE + groups(
        top="type moving; patches (zMax);" + uniform(0.1, 0, 0.1),
        bottom="type fixed; patches (zMin);",
    )
    for images in ("auto", "yes"):
        case = rbf_case(
            tmp_path / images,
            patches=HALF,
            coeffs=f"images {images};" + coeffs,
        )
        before = reference(case)
        output = case.run("moveDynamicMesh")
        assert images_in(output) == [(3, 2, 0)]
        assert output.count("leave patch 'xMax' of type symmetryPlane") == 1
        after = case.points("1/polyMesh/points")
        np.testing.assert_array_equal(after[side(before, "xMax"), 0], 1)
        np.testing.assert_array_equal(after[side(before, "yMin"), 1], 0)


@pytest.mark.parametrize("images", ["auto", "yes"])
def test_a_point_off_the_mesh_that_leaves_the_plane_has_no_image(
    tmp_path, images
):
    """In the plane and no mesh point: nothing keeps it there but the mesh."""
    coeffs = (
        f"images {images};"
        + LOOSE
        + groups(free=body(1, 0.3, 0.4, d=(0.1, 0, 0.1)), ends=ENDS)
    )
    case = rbf_case(tmp_path, patches=HALF, coeffs=coeffs)
    before = reference(case)
    why = "leaves the plane of symmetry or axis of rotation there by 0.1"
    if images == "yes":
        tree = case.tree()
        assert why in case.run("moveDynamicMesh", status=1)
        assert case.tree() == tree
        return
    assert why in case.run("moveDynamicMesh")
    after = case.points("1/polyMesh/points")
    np.testing.assert_array_equal(after[side(before, "xMax"), 0], 1)


def test_what_moves_beside_a_symmetry_patch_in_its_plane_takes_its_images(
    tmp_path,
):
    patches = {**CUBE, "zMin": "patch"}
    case = rbf_case(
        tmp_path,
        patches=patches,
        coeffs=LOOSE
        + groups(
            top="type fixed; patches (zMax);",
            bump=body(0.5, 0.5, 0, d=(0, 0, 0.1)),
        ),
    )
    # Half of the floor is a symmetry plane, the other one may move
    case.write(
        "system/topoSetDict",
        "dictionary",
        """
        actions ( { name half; type faceSet; action new; source patchToFace;
                    patch zMin; }
                  { name half; type faceSet; action subset; source boxToFace;
                    box (-1 -1 -1) (0.5 2 2); } );""",
    )
    case.run("topoSet")
    case.write(
        "system/createPatchDict",
        "dictionary",
        """
        pointSync false; patches ( { name upstream;
            patchInfo { type symmetryPlane; }
            constructFrom set; set half; } );""",
    )
    case.run("createPatch", "-overwrite")
    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        (case.path / "constant/dynamicMeshDict")
        .read_text()
        .split("\n\n", 1)[1]
        .replace(
            "bump {",
            "plate { type moving; patches (zMin);"
            + uniform(0, 0, 0)
            + "} bump {",
        ),
    )
    output = case.run("moveDynamicMesh")
    assert (
        "no images: patch 'upstream' is in one plane with points that" " move"
    ) in output
    assert images_in(output) == []


# --- periodic sides


def cyclic(a, b, kind="cyclic", extra=""):
    return {
        a: f"{kind}; neighbourPatch {b}; {extra}",
        b: f"{kind}; neighbourPatch {a}; {extra}",
    }


def paired(
    before,
    after,
    name_a,
    name_b,
    axes=(1, 2),
    turn=np.eye(3),
    period=(0, 0, 0),
    on=side,
):
    """How far the points of a side are from those of the other, carried over."""
    worst = 0
    a, b = (np.flatnonzero(on(before, name)) for name in (name_a, name_b))
    carried = before[a] @ turn.T + period
    for i, x in zip(a, carried):
        j = b[np.argmin(np.linalg.norm(before[b] - x, axis=1))]
        assert np.linalg.norm(before[j] - x) < 1e-9
        worst = max(
            worst, np.linalg.norm(after[i] @ turn.T + period - after[j])
        )
    return worst


@pytest.mark.parametrize("ranks", [1, 3])
def test_translational_pairs_match_and_the_field_is_periodic(tmp_path, ranks):
    patches = {**CUBE, **cyclic("xMin", "xMax"), **cyclic("yMin", "yMax")}
    coeffs = LOOSE + groups(body=body(0.9, 0.1, 0.5), ends=ENDS)
    case = rbf_case(tmp_path, coeffs=coeffs, patches=patches, cells=(6, 6, 6))
    before = reference(case)
    if ranks > 1:
        case.decompose((3, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks)
    after = (
        case.decomposed_points("1/polyMesh/points")
        if ranks > 1
        else case.points("1/polyMesh/points")
    )
    # Reach 1.2: two cells on, but not those two over the corners
    assert images_in(output) == [(20, 0, 2)]
    for a, b, period in (
        ("xMin", "xMax", (1, 0, 0)),
        ("yMin", "yMax", (0, 1, 0)),
    ):
        assert paired(before, after, a, b, period=period) < 1e-14
    # What the body does to the cell beside it comes in from the other side
    d = np.linalg.norm(after - before, axis=1)
    near = np.linalg.norm(before - (0, 1, 0.5), axis=1).argmin()
    far = np.linalg.norm(before - (0.5, 0.5, 0.5), axis=1).argmin()
    assert d[near] > 2 * d[far]


SECTOR = np.radians(40)


def sector(high=1.0, angle=SECTOR):
    """Corners of an annular sector around z."""
    return [
        (r * np.cos(t), r * np.sin(t), z)
        for z in (0, high)
        for r, t in ((0.5, 0), (1.0, 0), (1.0, angle), (0.5, angle))
    ]


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def on_ray(points, name):
    angle = 0 if name == "yMin" else SECTOR
    return np.abs(np.arctan2(points[:, 1], points[:, 0]) - angle) < 1e-9


ROTATIONAL = (
    "transform rotational; rotationAxis (0 0 1);" " rotationCentre (0 0 0);"
)

BLADE = groups(
    blade=body(0.7, 0.1, 0.5, d=(0.02, 0.03, 0.05)),
    hub="type moving; patches (xMin);" + solid((0, 0, 1), 0.05),
    casing="type fixed; patches (xMax);",
)


@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI"])
def test_rotational_pairs_match(tmp_path, kind):
    patches = {**CUBE, **cyclic("yMin", "yMax", kind, ROTATIONAL)}
    case = rbf_case(
        tmp_path,
        coeffs=LOOSE + BLADE,
        patches=patches,
        corners=sector(),
        cells=(5, 5, 5),
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    after = case.points("1/polyMesh/points")
    ((n, _, pairs),) = images_in(output)
    assert pairs == 1 and 4 <= n <= 8
    assert np.abs(after - before)[on_ray(before, "yMin")].max() > 0.02
    assert (
        paired(before, after, "yMin", "yMax", turn=turned(SECTOR), on=on_ray)
        < 1e-14
    )


@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI"])
def test_rotational_pairs_move_the_same_on_any_number_of_ranks(tmp_path, kind):
    patches = {**CUBE, **cyclic("yMin", "yMax", kind, ROTATIONAL)}
    points = []
    for ranks in (1, 2, 3, 4):
        (tmp_path / str(ranks)).mkdir()
        case = rbf_case(
            tmp_path / str(ranks),
            coeffs=LOOSE + BLADE,
            patches=patches,
            corners=sector(),
            cells=(5, 5, 5),
        )
        if ranks > 1:
            # Interleaved: sides that are coupled are on several ranks
            cells = np.arange(125)
            case.decompose_cells((cells // 25 + cells % 5) % ranks)
        points.append(move(case, ranks=ranks))
    for other in points[1:]:
        np.testing.assert_array_equal(other, points[0])


def test_sub_steps_keep_pairs_and_planes(tmp_path):
    patches = {
        **CUBE,
        **cyclic("yMin", "yMax", "cyclic", ROTATIONAL),
        "zMin": "symmetryPlane",
    }
    case = rbf_case(
        tmp_path,
        coeffs="subSteps 3;" + LOOSE + BLADE,
        patches=patches,
        corners=sector(),
        cells=(5, 5, 5),
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert "moved in 3 sub-steps" in output
    after = case.points("1/polyMesh/points")
    assert (
        paired(before, after, "yMin", "yMax", turn=turned(SECTOR), on=on_ray)
        < 1e-13
    )
    on = side(before, "zMin")
    np.testing.assert_allclose(after[on, 2], 0, rtol=0, atol=1e-15)
    assert np.abs(after - before)[on].max() > 0.02


@pytest.mark.parametrize("kind", ["cyclic", "cyclicAMI"])
def test_a_restart_with_images_continues_to_the_last_bit(tmp_path, kind):
    patches = {
        **CUBE,
        **cyclic("yMin", "yMax", kind, ROTATIONAL),
        "zMin": "symmetryPlane",
    }
    points = []
    for stops in ([2], [1, 2]):
        case = rbf_case(
            tmp_path / str(len(stops)),
            coeffs=LOOSE
            + groups(
                hub="type moving; patches (xMin);" + solid((0, 0, 1), 0.1),
                casing="type fixed; patches (xMax);",
            ),
            patches=patches,
            corners=sector(),
            cells=(5, 5, 5),
        )
        for end in stops:
            write_control(
                case,
                end=end,
                deltaT=0.5,
                startFrom="latestTime",
                writeInterval=2,
            )
            assert images_in(case.run("moveDynamicMesh"))
        points.append(case.points("2/polyMesh/points"))
    assert np.abs(points[0] - reference(case)).max() > 0.05
    np.testing.assert_array_equal(points[1], points[0])


def test_a_translational_ami_pair_stays_on_itself(tmp_path):
    patches = {
        **CUBE,
        **cyclic(
            "xMin",
            "xMax",
            "cyclicAMI",
            "transform translational;" " separationVector (1 0 0);",
        ),
    }
    patches["xMax"] = patches["xMax"].replace("(1 0 0)", "(-1 0 0)")
    case = rbf_case(
        tmp_path,
        coeffs=LOOSE + groups(body=body(0.9, 0.5, 0.5), ends=ENDS),
        patches=patches,
        cells=(6, 6, 6),
    )
    before = reference(case)
    after = move(case)
    assert paired(before, after, "xMin", "xMax", period=(1, 0, 0)) < 1e-14
    assert np.abs(after - before)[side(before, "xMin")].max() > 0.03


def test_periodic_sides_that_are_told_to_move_differently_are_an_error(
    tmp_path,
):
    patches = {**CUBE, **cyclic("yMin", "yMax", "cyclic", ROTATIONAL)}
    case = rbf_case(
        tmp_path,
        patches=patches,
        corners=sector(),
        coeffs=LOOSE
        + groups(
            hub="type moving; patches (xMin);" + uniform(0, 0.1, 0),
            casing="type fixed; patches (xMax);",
        ),
    )
    before = case.tree()
    output = case.run("moveDynamicMesh", status=1)
    assert "Periodic sides are told to move differently" in output
    assert case.tree() == before

    case.decompose((1, 2, 1))
    assert "Periodic sides are told to move differently" in case.run(
        "moveDynamicMesh", ranks=2, status=1
    )


# --- wedge


def test_a_wedge_is_the_same_on_any_number_of_ranks(tmp_path):
    angle = np.radians(2.5)
    corners = [
        (x, r * np.cos(angle), z * r * np.sin(angle))
        for z in (-1, 1)
        for x, r in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    patches = {
        **CUBE,
        "zMin": "wedge",
        "zMax": "wedge",
        "yMin": "empty",
        "xMin": "symmetryPlane",
    }
    points = []
    for ranks in (1, 2, 3):
        (tmp_path / str(ranks)).mkdir()
        case = rbf_case(
            tmp_path / str(ranks),
            patches=patches,
            corners=corners,
            axis=True,
            cells=(6, 6, 1),
            coeffs=LOOSE
            + groups(
                body=body(0.4, 0.5, 0, d=(0.05, 0.1, 0)),
                wall="type fixed; patches (yMax);",
                end="type sliding; patches (xMax);",
            ),
        )
        before = reference(case)
        if ranks > 1:
            cells = np.arange(36)
            case.decompose_cells((cells // 6 + cells % 6) % ranks)
        output = case.run("moveDynamicMesh", ranks=ranks)
        assert images_in(output) == [(1, 1, 0)]
        points.append(
            case.points("1/polyMesh/points")
            if ranks == 1
            else case.decomposed_points("1/polyMesh/points")
        )
    after = points[0]
    for other in points[1:]:
        np.testing.assert_array_equal(other, after)
    np.testing.assert_allclose(after[before[:, 0] == 0, 0], 0, atol=1e-15)
    axis = np.hypot(before[:, 1], before[:, 2]) < 1e-10
    np.testing.assert_allclose(after[axis, 1:], 0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        np.arctan2(after[:, 2], after[:, 1])[~axis],
        np.sign(before[~axis, 2]) * angle,
        rtol=0,
        atol=1e-14,
    )


# --- the entry


@pytest.mark.parametrize(
    "extra, why",
    [
        ("polynomial linear;", "they need 'polynomial none'"),
        ("kernel inverseMultiQuadric;", "endlessly many"),
        ("supportRadius 300;", "more than 200 of them"),
    ],
)
def test_where_images_cannot_be_the_log_says_why_and_yes_is_an_error(
    tmp_path, extra, why
):
    patches = {**CUBE, **cyclic("xMin", "xMax")}
    radius = "" if "Radius" in extra else "supportRadius 1.2;"
    coeffs = extra + radius + groups(body=body(0.9, 0.5, 0.5), ends=ENDS)
    case = rbf_case(tmp_path, coeffs=coeffs, patches=patches)
    output = case.run("moveDynamicMesh")
    assert "no images: " in output and why in output
    before, after = reference(case), case.points("1/polyMesh/points")
    assert paired(before, after, "xMin", "xMax", period=(1, 0, 0)) < 1e-14

    case.write(
        "constant/dynamicMeshDict",
        "dictionary",
        (case.path / "constant/dynamicMeshDict")
        .read_text()
        .split("\n\n", 1)[1]
        .replace(extra, extra + "images yes;"),
    )
    assert why in case.run("moveDynamicMesh", status=1)


def test_without_images_rotational_pairs_match_by_the_mean(tmp_path):
    patches = {**CUBE, **cyclic("yMin", "yMax", "cyclic", ROTATIONAL)}
    case = rbf_case(
        tmp_path,
        coeffs="images no;" + LOOSE + BLADE,
        patches=patches,
        corners=sector(),
        cells=(5, 5, 5),
    )
    before = reference(case)
    output = case.run("moveDynamicMesh")
    assert images_in(output) == []
    after = case.points("1/polyMesh/points")
    assert (
        paired(before, after, "yMin", "yMax", turn=turned(SECTOR), on=on_ray)
        < 1e-14
    )
