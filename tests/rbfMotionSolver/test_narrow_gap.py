# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Control points that are close to each other and move differently fling points
far away: the log says which, and what to do.

Source of truth: no point has to go further than the farthest control point.
"""

import re

import numpy as np
import pytest

from rbfCase import CUBE, groups, move, rbf_case, reference

GAP, STEP = 0.01, 0.05

FLAT = {**CUBE, "yMin": "empty", "yMax": "empty"}


def gap_case(path, extra="", flat=True):
    """Two sheets of points in the middle of a box, a gap apart, of which the
    lower one slides along the other; flat: two lines in a plane."""
    low = [
        (0.1 * i, 0.1 * j, 0.5)
        for i in range(11)
        for j in range(1 if flat else 11)
    ]
    high = [(x, y, z + GAP) for x, y, z in low]
    sheets = [
        " ".join(f"({x!r} {y!r} {z!r})" for x, y, z in sheet)
        for sheet in (low, high)
    ]
    mesh = (
        {"patches": FLAT, "cells": (10, 1, 10)}
        if flat
        else {"cells": (10, 10, 10)}
    )
    return rbf_case(
        path,
        **mesh,
        coeffs=extra
        + groups(
            lower=f"type moving; points ({sheets[0]}); displacement"
            f" {{ type uniform; value ({STEP} 0 0); }}",
            upper=f"type fixed; points ({sheets[1]});",
        ),
    )


def vectors(text):
    """The vectors in a text."""
    return [
        np.array(v.split(), float) for v in re.findall(r"\(([^)]*)\)", text)
    ]


@pytest.mark.parametrize(
    "ranks, steps", [(1, ""), (2, ""), (1, "subSteps 2;"), (2, "subSteps 3;")]
)
def test_the_warning_names_two_points_and_a_remedy_that_works(
    tmp_path, ranks, steps
):
    case = gap_case(tmp_path / "before", "onInvalidMesh ignore;" + steps)
    if ranks > 1:
        case.decompose((1, 1, ranks))
    output = case.run("moveDynamicMesh", ranks=ranks)
    reached, told = map(
        float,
        re.search(
            r"Points move by up to (\S+) m, at .*? where no control point moves by"
            r" more than (\S+) m",
            output,
            re.DOTALL,
        ).groups(),
    )
    assert told == pytest.approx(STEP) and reached > 2 * STEP
    sentence = re.search(
        r"The control points at (.*?), (\S+) m apart, move by" r" (.*?)\n",
        output,
        re.DOTALL,
    )
    assert float(sentence[2]) == pytest.approx(GAP)
    one, other = vectors(sentence[1])
    assert np.linalg.norm(one - other) == pytest.approx(GAP)
    moves = sorted(np.linalg.norm(v) for v in vectors(sentence[3]))
    assert moves[1] - moves[0] == pytest.approx(STEP, rel=0.02)

    within = float(
        re.search(
            r"'kernel wendlandC0', with which they go no"
            r" further than (\S+) m",
            output,
        )[1]
    )
    case = gap_case(tmp_path / "advised", "kernel wendlandC0;")
    if ranks > 1:
        case.decompose((1, 1, ranks))
    after = move(case, ranks=ranks)
    assert np.abs(after - reference(case)).max() <= 1.01 * within < 2 * STEP


def test_no_kernel_is_offered_that_would_not_help(tmp_path):
    # Dense solves: 0.60 with wendlandC2, 0.33 with wendlandC0
    output = gap_case(tmp_path, "onInvalidMesh ignore;", flat=False).run(
        "moveDynamicMesh"
    )
    assert "Points move by up to 0.59" in output
    assert "wendlandC0" not in output and "Move them less" in output


def test_a_rotation_by_ninety_degrees_is_no_gap(tmp_path):
    # A body of a third of the box: any two of its points differ by at most
    # sqrt(2) times their distance
    body = " ".join(
        f"({0.5+0.2*np.cos(a)!r} 0 {0.5+0.1*np.sin(a)!r})"
        for a in np.linspace(0, 2 * np.pi, 25)[:-1]
    )
    case = rbf_case(
        tmp_path,
        patches=FLAT,
        cells=(10, 1, 10),
        coeffs="supportRadius 20; onInvalidMesh ignore;"
        + groups(
            body=f"type moving; points ({body}); displacement {{ type solidBody;"
            " solidBodyMotionFunction axisRotationMotion;"
            " axisRotationMotionCoeffs"
            " { origin (0.5 0 0.5); radialVelocity (0 90 0); } }",
            far="type fixed; patches (xMin xMax zMin zMax);",
        ),
    )
    assert "Points move by up to" not in case.run("moveDynamicMesh")


def test_a_motion_without_a_gap_is_not_warned_of(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type uniform;"
            " value (0.05 0 0); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    assert "Points move by up to" not in case.run("moveDynamicMesh")
