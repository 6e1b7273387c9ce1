# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Displacements of type ffd: boxes deform the surface, radial basis functions
the volume.

Source of truth: the formula of Sederberg and Parry (1986) at the points of the
group, which end where they were told to.
"""

import numpy as np
import pytest

from ffdCase import displaced, ffd_box, parameter
from rbfCase import CUBE, groups, move, rbf_case, reference, side

# The top of the cube from above and below; the sides are cut at p = 0
MOVES = [((1, 1, 2), (0.1, 0.05, 0.4)), ((1, 1, 3), (0, 0, 0.2))]
ORDER = (2, 2, 3)
PLACE = dict(origin=(-0.1, -0.1, 0.5), span=(1.2, 1.2, 0.9))

TABLE = "table ((0 0) (1 0.5) (2 1))"


def box_of(value, extra=""):
    return (
        "displacement { type ffd; boxes {"
        + ffd_box(
            "lid",
            parameter("a", MOVES, value),
            order=ORDER,
            **PLACE,
            extra=extra,
        )
        + "} }"
    )


def lid(value, **mesh):
    return dict(
        coeffs="supportRadius 2;\n"
        + groups(
            lid=f"type moving; patches (zMax); {box_of(value)}",
            bottom="type fixed; patches (zMin);",
        ),
        **mesh,
    )


@pytest.mark.parametrize("ranks", [1, 3])
def test_the_surface_moves_by_the_formula_and_the_volume_follows(
    tmp_path, ranks
):
    case = rbf_case(tmp_path, **lid(TABLE), control={"end": 2})
    before = reference(case)
    if ranks > 1:
        case.decompose((3, 1, 1))
    after = move(case, "2", ranks=ranks)
    on = side(before, "zMax")
    d = displaced(before, MOVES, ORDER, **PLACE)
    assert np.abs(d[on]).max() > 0.04
    np.testing.assert_allclose(after[on], (before + d)[on], rtol=0, atol=1e-14)
    # The points below are not in the box; they follow the surface
    below = np.isclose(before, (0.5, 0.5, 0.25)).all(axis=1)
    assert below.sum() == 1 and (after - before)[below, 2] > 0.005


@pytest.mark.parametrize("how", ["", "combine chain;", "combine sum;"])
def test_boxes_are_combined_as_asked_for(tmp_path, how):
    # The second box moves where the first one has gone, or from the start
    first = [((1, 1, 1), (0.5, 0, 0.2))]
    second = [((1, 1, 1), (0, 0.6, 0.2))]
    place = dict(origin=(-0.1, -0.1, 0.5), span=(1.2, 1.2, 1.1))
    order = (2, 2, 2)
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 2;\n"
        + groups(
            lid="type moving; patches (zMax); displacement { type ffd; boxes {"
            + ffd_box("one", parameter("a", first, "0.5"), order, **place)
            + ffd_box("two", parameter("b", second, "0.5"), order, **place)
            + f"}} {how} }}",
            bottom="type fixed; patches (zMin);",
        ),
    )
    before = reference(case)
    on = side(before, "zMax")
    middle = before + 0.5 * displaced(before, first, order, **place)
    chain, add = (
        middle + 0.5 * displaced(start, second, order, **place)
        for start in (middle, before)
    )
    assert np.abs(chain - add)[on].max() > 0.001
    np.testing.assert_allclose(
        move(case)[on],
        (add if "sum" in how else chain)[on],
        rtol=0,
        atol=1e-14,
    )


def test_a_group_that_a_face_cuts_freezes_layers_there(tmp_path):
    # The side is cut at p = 0: three layers have to be at rest
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 2;\n"
        + groups(
            wall="type moving; patches (xMax zMax);"
            + box_of("1", "continuity C2;")
        ),
    )
    output = case.run("moveDynamicMesh", status=1)
    assert (
        "(1 1 2)" in output and "frozen layer" in output and "p = 0" in output
    )


def test_a_box_without_a_point_of_the_group_is_an_error(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 2;\n"
        + groups(bottom=f"type moving; patches (zMin); {box_of('1')}"),
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "'lid' contains no point" in output


def test_listed_points_move_too(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 2;\n"
        + groups(
            inside="type moving; points ((0.5 0.5 0.75) (0.5 0.5 0.25)"
            f" (0.5 0.5 0.25)); {box_of('1')}"
        ),
        patches=CUBE,
    )
    before = reference(case)
    after = move(case)
    d = displaced(before, MOVES, ORDER, **PLACE)
    for x in ((0.5, 0.5, 0.75), (0.5, 0.5, 0.25)):
        on = np.isclose(before, x).all(axis=1)
        np.testing.assert_allclose(
            after[on], (before + d)[on], rtol=0, atol=1e-5
        )
