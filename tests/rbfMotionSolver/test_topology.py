# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A change of topology: what was known of the mesh is dropped and found anew.

Source of truth: a solver that is made for the changed mesh.
"""

import re

from foamCase import build_program
from rbfCase import groups, rbf_case


def test_after_a_change_of_topology_the_motion_is_that_of_a_new_solver(
    tmp_path,
):
    build_program("changeTopology")
    case = rbf_case(
        tmp_path,
        coeffs="supportRadius 1.5;"
        + groups(
            top="type moving; patches (zMax); displacement { type solidBody;"
            " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
            " { origin (0.5 0.5 1); axis (0 1 1); omega 0.1; } }",
            bottom="type fixed; patches (zMin);",
            walls="type sliding; patches (yMin yMax);",
        ),
        cells=(6, 5, 4),
    )
    output = case.run("changeTopology")
    before, after = map(
        int, re.search(r"cells (\d+) then (\d+)", output).groups()
    )
    assert 0 < after < before
    assert float(re.search(r"largest motion (\S+)", output)[1]) > 0.05
    assert float(re.search(r"largest difference (\S+)", output)[1]) == 0
