# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A motion of a small part of a mesh, of which that part alone is checked.

Source of truth: the check of all cells, which morphMesh makes of any mesh.
"""

import re

import numpy as np
import pytest

from rbfCase import groups, rbf_case

CELLS = (10, 10, 10)


def coefficients(by, policy):
    return (
        f"supportRadius 0.35; subSteps 1; onInvalidMesh {policy};\n"
        + groups(
            one="type moving; points ((0.5 0.5 0.5)); displacement"
            f" {{ type uniform; value ({by} 0.03 0); }}",
            walls='type fixed; patches (".*");',
        )
    )


def said(output):
    found = re.search(
        r"(\d+) wrongly oriented faces? and (\d+) cells?"
        r" without positive volume,\s+the worst at \(([^)]*)\)",
        output.replace("\n    ", " "),
    )
    assert found, output
    return found.groups()


@pytest.mark.parametrize("ranks", [1, 2])
def test_what_is_invalid_in_a_small_part_is_what_a_check_of_all_finds(
    tmp_path, ranks
):
    found = []
    for policy in ("error", "ignore"):
        case = rbf_case(
            tmp_path / policy,
            coeffs=coefficients(0.33, policy),
            cells=CELLS,
        )
        if ranks > 1:
            case.decompose((ranks, 1, 1))
        output = case.run("morphMesh", "-time", "1", ranks=ranks, status=1)
        found.append(said(output))
    assert found[0] == found[1]
    assert int(found[0][0]) > 0


def test_a_valid_motion_of_a_small_part_is_made(tmp_path):
    case = rbf_case(tmp_path, coeffs=coefficients(0.04, "error"), cells=CELLS)
    before = case.points("constant/polyMesh/points")
    case.run("moveDynamicMesh")
    d = np.abs(case.points("1/polyMesh/points") - before).max(axis=1)
    assert d.max() == pytest.approx(0.04, rel=1e-9)
    assert 0 < (d > 0).sum() < 0.4 * len(d)
