# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Entries, tables and meshes at the limits of what can be calculated with.

Source of truth: the contract: a message that names the entry or the line, exit
status 1; or the motion that the other algorithm, or an unsplit mesh, makes.
"""

import numpy as np
import pytest

from boxCase import fixed, point_field
from ffdCase import ffd_box, ffd_case, parameter
from fuzzCases import rbf
from rbfCase import (
    CUBE,
    groups,
    move,
    points_at,
    rbf_case,
    reference,
    selections,
)

TOP = (
    "type moving; patches (zMax);"
    " displacement { type uniform; value (0 0 0.1); }"
)
BOTTOM = "type fixed; patches (zMin);"
MOVED = groups(top=TOP, bottom=BOTTOM)

REFUSED = {
    "sub-steps": ("subSteps 1000000;" + MOVED, ["'subSteps'", "1000"]),
    "tolerance": ("greedy { tolerance 1e9; }" + MOVED, ["'tolerance'"]),
    "a surface without value": (
        groups(top=TOP, side="type sliding; patches (xMin); surface;"),
        ["'surface'", "no value"],
    ),
    "a kernel in braces": (
        "kernel { a 1; }" + MOVED,
        ["'kernel'", "dictionary"],
    ),
    "a list without end": (
        groups(top=TOP, there="type fixed; points 2000000000((0 0 0));"),
        ["'points'", "2000000000"],
    ),
    "a negative list": (
        groups(top=TOP, there="type fixed; points -1((0 0 0));"),
        ["'points'", "-1"],
    ),
    "a repeated point": (
        groups(top=TOP, there="type fixed; points 2000000000{(0 0 0)};"),
        ["'points'", "2000000000"],
    ),
    "a point out of range": (
        groups(top=TOP, there="type fixed; points ((1e300 0 0));"),
        ["'points'"],
    ),
    "a table out of order": (
        groups(
            top=TOP.replace("(0 0 0.1)", "table ((1 (0 0 0)) (0 (0 0 1)))"),
            bottom=BOTTOM,
        ),
        ["'value'"],
    ),
}


@pytest.mark.parametrize("coeffs, phrases", REFUSED.values(), ids=REFUSED)
@pytest.mark.parametrize("ranks", [1, 2])
def test_an_entry_out_of_limits_is_named(tmp_path, coeffs, phrases, ranks):
    case = rbf_case(
        tmp_path, coeffs="supportRadius 2;" + coeffs, cells=(4, 4, 4)
    )
    if ranks == 2:
        if "list" not in coeffs and "subSteps" not in coeffs:
            pytest.skip("read in the same way")
        case.decompose((2, 1, 1))
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    for phrase in [*phrases, "dynamicMeshDict"]:
        assert phrase in output


@pytest.mark.parametrize("number", ["1e400", "1e300", "nan", "inf"])
def test_a_number_of_a_table_is_named_by_its_line(tmp_path, number):
    case = rbf(tmp_path)
    table = case.path / "constant/moved"
    lines = table.read_text().splitlines()
    lines[4] = " ".join([*lines[4].split()[:5], number])
    table.write_text("\n".join(lines) + "\n")
    output = case.run("morphMesh", status=1)
    assert "constant/moved, line 5" in output


def test_schur_warns_of_a_radius_that_is_too_large(tmp_path):
    outputs = {}
    for algorithm in ("schur", "incremental"):
        case = rbf_case(
            tmp_path / algorithm,
            cells=(4, 4, 4),
            coeffs="supportRadius 1e5;"
            f" greedy {{ algorithm {algorithm}; }} onInvalidMesh ignore;"
            + groups(
                top=TOP.replace(
                    "uniform; value (0 0 0.1)",
                    "polyline; vertices ((0 0 1) (1 1 1));"
                    " values ((0 0 0) (0 0 0.1))",
                ),
                bottom=BOTTOM,
            ),
        )
        outputs[algorithm] = case.run("moveDynamicMesh")
        assert selections(outputs[algorithm])
    for output in outputs.values():
        assert "Reduce the support radius" in output


def test_a_wedge_patch_without_faces_is_no_wedge(tmp_path):
    box = ffd_box("b", parameter("mu", [((1, 1, 1), (0, 0, 1))]))
    case = ffd_case(tmp_path, box, cells=(4, 4, 4))
    expected = move(case)
    boundary = case.path / "constant/polyMesh/boundary"
    text = boundary.read_text()
    end = text.rindex(")")
    boundary.write_text(
        text[:end].replace("\n6\n", "\n7\n", 1)
        + "gone { type wedge; nFaces 0; startFace 240; }\n"
        + text[end:]
    )
    np.testing.assert_array_equal(move(case), expected)


def test_images_too_many_within_a_thin_mesh_are_done_without(tmp_path):
    # 0.05 between periodic sides, 100 long: thousands of images in reach
    patches = dict(
        CUBE,
        zMin="cyclic; neighbourPatch zMax;",
        zMax="cyclic; neighbourPatch zMin;",
    )
    case = rbf_case(
        tmp_path,
        patches=patches,
        cells=(8, 8, 1),
        high=(100, 100, 0.05),
        conditions={
            "zMin": "cyclic",
            "zMax": "cyclic",
            "xMin": fixed(5, 0, 0),
            "xMax": fixed(0, 0, 0),
            "yMin": "slip",
            "yMax": "slip",
        },
    )
    output = case.run("moveDynamicMesh")
    assert "no images: more than 200" in output
    moved = points_at(case, 1) - reference(case)
    assert np.abs(moved[:, 0].max() - 5) < 1e-12


def write_baffle(case):
    """Split the mesh along a flap: its sides have points of their own."""
    case.write(
        "system/topoSetDict",
        "dictionary",
        """actions (
        { name s; type faceSet; action new; source boxToFace;
          sourceInfo { box (-1 -1 0.49) (0.51 2 0.51); } }
        { name z; type faceZoneSet; action new; source setToFaceZone;
          sourceInfo { faceSet s; } } );""",
    )
    case.write(
        "system/createBafflesDict",
        "dictionary",
        """
        internalFacesOnly true;
        baffles { b { type faceZone; zoneName z; patches {
            master { name upper; type wall; }
            slave { name lower; type wall; } } } }""",
    )
    case.run("topoSet")
    case.run("createBaffles", "-overwrite")
    case.run("mergeOrSplitBaffles", "-overwrite", "-split")


@pytest.mark.parametrize("difference, status", [(1e-7, 0), (1e-3, 1)])
def test_sides_of_a_baffle_may_differ_within_the_tolerance(
    tmp_path, difference, status
):
    # 1e-7 is an eighth of the default tolerance of 1e-5 of 0.08
    case = rbf_case(tmp_path, cells=(8, 8, 8), coeffs="supportRadius 2;")
    write_baffle(case)
    conditions = {side: fixed(0, 0, 0) for side in CUBE}
    conditions.update(
        upper=fixed(0, 0, 0.08 + difference), lower=fixed(0, 0, 0.08)
    )
    case.write("0/pointDisplacement", *point_field(conditions))
    output = case.run("moveDynamicMesh", status=status)
    if status == 0:
        d = points_at(case, 1) - reference(case)
        assert abs(d[:, 2].max() - 0.08) < 2e-7
    else:
        assert "Contradicting control points" in output
