# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Entries of boxes that cannot be calculated with, and large lattices.

Source of truth: the contract (a message that names the entry, exit status 1);
of the large lattice the formula of Sederberg and Parry.
"""

import time

import numpy as np
import pytest

from ffdCase import displaced, ffd_box, ffd_case, move, parameter, reference

MU = parameter("mu", [((1, 1, 1), (0, 0, 1))])


def changed(old, new):
    box = ffd_box(
        "b",
        MU,
        extra="rotation { type axisAngle; axis (0 0 1);"
        " angle 5; } continuity none;",
    )
    assert old in box
    return box.replace(old, new)


ENTRIES = {
    "order beyond binomials": (
        changed("order (2 2 2)", "order (400 3 2)"),
        ["'order'", "(400 3 2)"],
    ),
    "order beyond memory": (
        changed("order (2 2 2)", "order (100000 3 2)"),
        ["'order'", "100000"],
    ),
    "order of large numbers": (
        changed("order (2 2 2)", "order (2000000000 2000000000 2)"),
        ["'order'", "2000000000"],
    ),
    "rotation without value": (
        changed(
            "rotation { type axisAngle; axis (0 0 1); angle 5; }", "rotation;"
        ),
        ["'rotation'", "no value"],
    ),
    "parameters without value": (
        changed("parameters {", "parameters; unknown {"),
        ["'parameters'", "no value"],
    ),
    "max a dictionary": (
        changed("value 0.1;", "value 0.1; max { a 1; }"),
        ["'max'", "dictionary"],
    ),
    "order a dictionary": (
        changed("order (2 2 2);", "order { a 1; }"),
        ["'order'", "dictionary"],
    ),
    "origin out of range": (
        changed("origin (-0.1", "origin (1e300"),
        ["'origin'"],
    ),
    "span out of range": (changed("span (1.2", "span (1e300"), ["'span'"]),
    "span below range": (changed("span (1.2", "span (1e-150"), ["'span'"]),
    "moves out of range": (
        changed("(0.0 0.0 1.0)", "(0 0 1e80)"),
        ["'moves'"],
    ),
    "a list that is too long": (
        changed("moves ( ", "moves 2000000000( "),
        ["'moves'", "2000000000"],
    ),
    "a long name": (
        changed("b\n", "b" * 300 + "\n"),
        ["name", "300 characters"],
    ),
}


@pytest.mark.parametrize("box, phrases", ENTRIES.values(), ids=ENTRIES)
def test_an_entry_that_is_wrong_is_named(tmp_path, box, phrases):
    case = ffd_case(tmp_path, box, cells=(2, 2, 2))
    output = case.run("morphMesh", "-lattice", status=1)
    for phrase in phrases:
        assert phrase in output
    assert "FOAM FATAL IO ERROR" in output


def test_a_large_lattice_takes_seconds_and_moves_as_the_formula_says(tmp_path):
    moves = [
        ((20, 20, 20), (0, 0, 1)),
        ((21, 20, 19), (0.5, 0, 0)),
        ((19, 21, 20), (0, 0.3, 0)),
    ]
    order = (40, 40, 40)
    box = ffd_box(
        "b",
        parameter("mu", moves, value="0.02"),
        order=order,
        extra="continuity none;",
    )
    case = ffd_case(tmp_path, box, cells=(6, 6, 6))
    start = time.process_time()
    points = move(case)
    assert time.process_time() - start < 30
    x = reference(case)
    d = 0.02 * displaced(x, moves, order, (-0.1,) * 3, (1.2,) * 3)
    np.testing.assert_allclose(points, x + d, rtol=0, atol=1e-12)
    assert np.abs(d).max() > 1e-5


def test_a_fold_of_a_large_lattice_is_found(tmp_path):
    box = ffd_box(
        "b",
        parameter("mu", [((20, 20, 20), (0, 0, 1))], value="300"),
        order=(40, 40, 40),
        extra="continuity none;",
    )
    case = ffd_case(tmp_path, box, cells=(2, 2, 2))
    output = case.run("morphMesh", status=1)
    assert "'b' folds" in output and "(mu)" in output
