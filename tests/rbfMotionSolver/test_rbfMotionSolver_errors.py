# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What rbfMotionSolver refuses, and what it says then.

Source of truth: the contract, by which every wrong entry is an error that
names the dictionary, the entry, the value, what is allowed and what to do, in
parallel as in serial, and by which nothing is written.
"""

import re

import pytest

from boxCase import fixed
from rbfCase import CUBE, DROP_IN, groups, rbf_case

UP = "displacement { type uniform; value (0 0 0.1); }"
TOP = f"type moving; patches (zMax); {UP}"
BOTTOM = "type fixed; patches (zMin);"
HELD = {name: fixed(0, 0, 0) for name in CUBE}


def top(displacement, select="patches (zMax);"):
    return groups(
        top=f"type moving; {select} displacement" f" {{ {displacement} }}",
        bottom=BOTTOM,
    )


def with_top(entries):
    return entries + groups(top=TOP, bottom=BOTTOM)


POSITIVE = "has to be a positive number"

# name: (coefficients, phrases of the message)
COEFFICIENTS = {
    # --- what is not known, at every level
    "kernel": (
        with_top("kernel wendlandC8;"),
        ["'kernel'", "wendlandC8", "Valid kernels", "wendlandC2"],
    ),
    "polynomial": (
        with_top("polynomial cubic;"),
        ["polynomial", "cubic", "linear"],
    ),
    "key of the coefficients": (
        with_top("suportRadius 1;"),
        ["'suportRadius'", "Valid entries", "supportRadius"],
    ),
    "key of greedy": (
        with_top("greedy { tolerence 1e-3; }"),
        ["'tolerence'", "Valid entries", "tolerance"],
    ),
    "key of a group": (
        groups(top=TOP + "patch zMin;"),
        ["top", "'patch'", "Valid entries", "patches"],
    ),
    "key of a displacement": (
        top("type uniform; value (0 0 0.1); scale 2;"),
        ["displacement", "'scale'", "Valid entries", "value"],
    ),
    "key of a solid body": (
        top(
            "type solidBody; solidBodyMotionFunction linearMotion;"
            " linearMotionCoeffs { velocity (0 0 0.1); } speed 1;"
        ),
        ["'speed'", "Valid entries", "linearMotionCoeffs"],
    ),
    "type of a group": (
        groups(top=TOP.replace("moving", "movable")),
        ["top", "movable", "moving", "fixed", "sliding"],
    ),
    "type of a displacement": (
        top("type unifrom; value (0 0 0.1);"),
        ["'unifrom'", "Valid types", "uniform", "solidBody", "polyline"],
    ),
    "patch": (
        groups(top=TOP.replace("zMax", "lid"), bottom=BOTTOM),
        ["'patches'", "'lid'", "xMin", "zMax"],
    ),
    "face zone": (
        top("type uniform; value (0 0 0.1);", "faceZones (middle);"),
        ["'faceZones'", "'middle'", "There are"],
    ),
    "point zone": (
        top("type uniform; value (0 0 0.1);", "pointZones (middle);"),
        ["'pointZones'", "'middle'", "There are"],
    ),
    "algorithm": (
        with_top("greedy { algorithm best; }"),
        ["'algorithm'", "best", "incremental"],
    ),
    "selection": (with_top("selection some;"), ["'selection'", "some", "all"]),
    "surface": (
        groups(top=TOP, flank="type sliding; patches (xMin); surface flat;"),
        ["surface", "flat", "planar", "curved"],
    ),
    "onInvalidMesh": (
        with_top("onInvalidMesh shrug;"),
        ["onInvalidMesh", "shrug", "error", "ignore", "limit"],
    ),
    "solid body motion": (
        top("type solidBody; solidBodyMotionFunction jumping;"),
        ["jumping", "rotatingMotion"],
    ),
    # --- numbers out of range
    **{
        f"{key} {value}": (with_top(f"{key} {value};"), [f"'{key}'", POSITIVE])
        for key in ("supportRadius", "supportRadiusFactor", "featureAngle")
        for value in ("-1", "0", "nan")
    },
    **{
        f"tolerance {value}": (
            with_top(f"greedy {{ tolerance {value}; }}"),
            ["'tolerance'", POSITIVE],
        )
        for value in ("-1", "0", "nan")
    },
    **{
        f"{key} {value}": (
            with_top(f"greedy {{ {key} {value}; }}"),
            [f"'{key}'", POSITIVE],
        )
        for key in ("maxPoints", "pointsPerSweep")
        for value in (-1, 0)
    },
    "supportRadius inf": (
        with_top("supportRadius inf;"),
        ["'supportRadius'", POSITIVE],
    ),
    "featureAngle too large": (
        with_top("featureAngle 120;"),
        ["'featureAngle'", "120", "90"],
    ),
    # OpenFOAM's own reader takes no such word for a number
    **{
        f"displacement {value}": (
            top(f"type uniform; value (0 0 {value});"),
            ["top.displacement.value", "expected scalar", value],
        )
        for value in ("nan", "inf")
    },
    "displacement 1e200": (
        top("type uniform; value (0 0 1e200);"),
        ["prescribed displacement", "not finite", "e+199"],
    ),
    "scale 1e200": (
        top(
            "type values; values ((0 0 0.1)); scale 1e200;",
            "points ((0.4 0.4 0.4));",
        ),
        ["prescribed displacement", "not finite", "e+199"],
    ),
    # --- entries that contradict each other
    "two support radii": (
        with_top("supportRadius 1; supportRadiusFactor 4;"),
        ["'supportRadius'", "'supportRadiusFactor'", "Give one of them"],
    ),
    "greedy selection of all": (
        with_top("selection all; greedy { tolerance 1e-3; }"),
        ["'selection'", "'greedy'"],
    ),
    "thinPlate without polynomial": (
        with_top("kernel thinPlate; polynomial none;"),
        ["'polynomial'", "thinPlate", "Use 'polynomial linear'"],
    ),
    "too few values": (
        top("type values; values ((0 0 0.1));", "points ((1 1 1) (0 0 1));"),
        ["'values'", "1 displacement", "2 points", "one displacement for"],
    ),
    "values for a patch": (
        top("type values; values ((0 0 0.1));"),
        ["'values'", "lists 'points'", "'file'"],
    ),
    "polyline lengths": (
        top("type polyline; vertices ((0 0 1) (1 0 1)); values ((0 0 0.1));"),
        ["'vertices'", "2 positions", "'values'", "1 displacement"],
    ),
    "polyline of one vertex": (
        top("type polyline; vertices ((0 0 1)); values ((0 0 0.1));"),
        ["'vertices'", "at least two"],
    ),
    "coincident points on the mesh": (
        top(
            "type values; values ((0 0 0.1) (0 0 0.2));",
            "points ((1 1 1) (1 1 1));",
        ),
        ["Contradicting control points", "Give coincident points one"],
    ),
    "coincident points off the mesh": (
        top(
            "type values; values ((0 0 0.1) (0 0 0.2));",
            "points ((0.4 0.4 0.4) (0.4 0.4 0.4));",
        ),
        ["Contradicting control points", "Give coincident points one"],
    ),
    "sliding points": (
        groups(top=TOP, on="type sliding; points ((0 0 0));"),
        ["sliding", "'points'", "Select 'patches' or 'faceZones'"],
    ),
    "fixed points that move": (
        groups(top=TOP, bottom=BOTTOM + UP),
        ["fixed", "cannot have a 'displacement'", "Remove the entry"],
    ),
    "surface of what does not slide": (
        groups(top=TOP + "surface planar;"),
        ["'surface'", "sliding", "moving"],
    ),
    "planar surface with a bend": (
        groups(
            top=TOP,
            walls="type sliding; patches (xMin yMin);" " surface planar;",
        ),
        ["'walls'", "surface planar", "deviate", "surface curved"],
    ),
    "moving points without displacement": (
        groups(top="type moving; points ((1 1 1));"),
        ["pointDisplacement", "selects no patches", "'displacement'"],
    ),
    "moving patch without condition": (
        groups(top="type moving; patches (zMax);"),
        ["'zMax'", "pointDisplacement", "fixes no value", "fixedValue"],
    ),
    # --- what is missing or of the wrong kind
    "nothing selected": (
        groups(top=f"type moving; {UP}"),
        ["'top'", "Give it 'patches'"],
    ),
    "empty list of patches": (
        groups(top=f"type moving; patches (); {UP}"),
        ["'top'", "Give it 'patches'"],
    ),
    "no type of group": (groups(top=f"patches (zMax); {UP}"), ["type", "top"]),
    "no groups": (groups(), ["Nothing moves", "type moving"]),
    "groups as a list": (
        "controlPoints (zMax);",
        ["'controlPoints'", "dictionary of groups"],
    ),
    "group that is none": (
        "controlPoints { top zMax; }",
        ["'top'", "is not a group", "type"],
    ),
    "greedy that is none": (
        with_top("greedy 1e-3;"),
        ["'greedy'", "has to be a dictionary"],
    ),
    "displacement that is none": (
        groups(top="type moving; patches (zMax); displacement (0 0 0.1);"),
        ["'displacement'", "has to be a dictionary"],
    ),
    "value that is none": (top("type uniform;"), ["value", "displacement"]),
    "file that is not there": (
        top('type file; file "constant/nowhere.txt";'),
        ["'file'", "cannot read", "nowhere.txt"],
    ),
    "malformed file": (
        top('type file; file "constant/short.txt";'),
        ["short.txt", "line 2", "x y z dx dy dz"],
    ),
    "file with a word too many": (
        top('type file; file "constant/long.txt";'),
        ["long.txt", "line 1", "x y z dx dy dz"],
    ),
    "empty file": (
        top('type file; file "constant/empty.txt";'),
        ["empty.txt", "has no lines"],
    ),
    "file for other points": (
        top('type file; file "constant/other.txt";'),
        ["'file'", "for example (", "other.txt", "'tolerance'"],
    ),
    "file tolerance -1": (
        top('type file; file "constant/other.txt"; tolerance -1;'),
        ["'tolerance'", POSITIVE],
    ),
    # --- motions
    "nothing that moves": (
        groups(bottom=BOTTOM, slip="type sliding; patches (xMin);"),
        ["Nothing moves", "type moving"],
    ),
    "motion that folds": (
        "greedy { tolerance 1e-5; }" + top("type uniform; value (0 0 -1.5);"),
        [
            "makes the mesh invalid",
            "wrongly oriented faces",
            "Make the motion smaller",
            "onInvalidMesh ignore",
            "onInvalidMesh limit",
            "valid up to the fraction 0.624",
        ],
    ),
}


def files(case):
    for name, text in {
        "short": "0 0 1  0 0 0.1\n0 0 1  0 0.1\n",
        "long": "0 0 1  0 0 0.1 up\n",
        "empty": "# nothing\n\n",
        "other": "0 0 1  0 0 0.1\n",
    }.items():
        (case.path / f"constant/{name}.txt").write_text(text)


def refused(case, phrases, ranks):
    """Whether the case stops as it should; what it says."""
    files(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    before = case.tree_without_reports()
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    assert case.tree_without_reports() == before
    # Without what each run says at its start
    said = re.sub("trapFpe: .*", "", output)
    for trap in (
        "Floating point exception",
        "sigFpe",
        "sigHandler",
        "Segmentation",
        "printStack",
    ):
        assert trap not in said
    assert "FOAM FATAL IO ERROR" in said
    for phrase in phrases:
        assert phrase in said, said[-3000:]
    return said


@pytest.mark.parametrize("wrong", COEFFICIENTS)
def test_a_wrong_entry_is_an_error_that_names_it_and_a_remedy(tmp_path, wrong):
    coeffs, phrases = COEFFICIENTS[wrong]
    refused(rbf_case(tmp_path, coeffs=coeffs), phrases, 1)


@pytest.mark.parametrize(
    "wrong",
    [
        "kernel",
        "patch",
        "key of a group",
        "coincident points on the mesh",
        "coincident points off the mesh",
        "supportRadius nan",
        "displacement nan",
        "file that is not there",
        "file for other points",
        "nothing that moves",
        "motion that folds",
        "planar surface with a bend",
        "polyline lengths",
    ],
)
def test_all_ranks_stop_with_the_message_of_a_wrong_entry(tmp_path, wrong):
    coeffs, phrases = COEFFICIENTS[wrong]
    refused(rbf_case(tmp_path, coeffs=coeffs), phrases, 2)


@pytest.mark.parametrize("ranks", [1, 2])
def test_an_error_on_one_rank_alone_stops_all_with_its_message(
    tmp_path, ranks
):
    # Only the rank at xMax has points that the file lacks
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            wall="type moving; patches (xMax); displacement { type file;"
            ' file "constant/other.txt"; }',
            bottom=BOTTOM,
        ),
    )
    refused(case, ["for example (1 ", "other.txt", "'tolerance'"], ranks)


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_field_that_can_move_nothing_is_an_error(tmp_path, ranks):
    refused(
        rbf_case(tmp_path, {name: "slip" for name in CUBE}),
        ["Nothing moves the mesh", "pointDisplacement", "controlPoints"],
        ranks,
    )


@pytest.mark.parametrize("ranks", [1, 2])
def test_no_field_and_no_dictionary_is_an_error(tmp_path, ranks):
    refused(
        rbf_case(tmp_path),
        ["Nothing moves the mesh", "pointDisplacement", "controlPoints"],
        ranks,
    )


@pytest.mark.parametrize(
    "value, phrases",
    [
        ("nan", ["boundaryField.zMax.value", "expected scalar"]),
        (
            "1e200",
            [
                "prescribed displacement",
                "not finite",
                "e+199",
                "Correct pointDisplacement",
            ],
        ),
    ],
)
def test_a_condition_that_gives_no_number_is_an_error(
    tmp_path, value, phrases
):
    refused(
        rbf_case(
            tmp_path,
            {**HELD, "zMax": "fixedValue;" f" value uniform (0 0 {value});"},
        ),
        phrases,
        1,
    )


@pytest.mark.parametrize("entry", ["cellZone", "cellSet"])
def test_a_zone_that_is_not_there_is_an_error(tmp_path, entry):
    case = rbf_case(tmp_path, coeffs=with_top("") + f"{entry} nowhere;")
    assert "nowhere" in case.run("moveDynamicMesh", status=1)


def test_zones_that_differ_are_an_error(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=with_top("") + "cellZone outer;",
        extra="cellZone none;",
    )
    refused(
        case,
        [
            "'cellZone' is here and beside the coefficients",
            "Remove one of them",
        ],
        1,
    )


def test_no_zone_is_the_whole_mesh(tmp_path):
    # 'none' is OpenFOAM's own word for it
    case = rbf_case(tmp_path, coeffs=with_top("") + "cellZone none;")
    case.run("moveDynamicMesh")


def test_the_second_dictionary_of_a_name_is_not_overlooked(tmp_path):
    # OpenFOAM merges it: what it brings is checked
    case = rbf_case(
        tmp_path, coeffs=with_top("") + "controlPoints" " { top { speed 1; } }"
    )
    refused(case, ["'speed'", "Valid entries"], 1)


def test_a_pattern_as_a_key_is_an_unknown_entry(tmp_path):
    case = rbf_case(tmp_path, coeffs=with_top('"support.*" 1;'))
    refused(case, ["support.*", "Valid entries"], 1)


def test_a_motion_that_folds_is_made_where_that_is_asked_for(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs="onInvalidMesh ignore;"
        + top("type uniform; value (0 0 -1.5);"),
    )
    case.run("moveDynamicMesh")
    assert case.points("1/polyMesh/points")[:, 2].min() < -0.4


def test_the_error_of_a_later_step_leaves_the_steps_before(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=top(
            "type uniform; value table ((0 (0 0 0)) (1 (0 0 0.1))"
            " (2 (0 0 -1.5)));"
        ),
        control={"end": 2},
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "makes the mesh invalid" in output
    assert (tmp_path / "1/polyMesh/points").exists()
    assert not (tmp_path / "2").exists()


def refused_dictionary(case, command, dictionary, phrases):
    """Whether a dynamicMeshDict is refused with all phrases and no change."""
    case.write("constant/dynamicMeshDict", "dictionary", dictionary)
    before = case.tree_without_reports()
    output = case.run(command, status=1)
    for phrase in phrases:
        assert phrase in output, output[-3000:]
    assert case.tree_without_reports() == before


@pytest.mark.parametrize("command", ["moveDynamicMesh", "morphMesh"])
def test_an_unknown_solver_is_OpenFOAMs_own_error(tmp_path, command):
    refused_dictionary(
        rbf_case(tmp_path),
        command,
        DROP_IN.replace("rbfMotionSolver", "rbfMeshMotionSolver"),
        [
            "Unknown solver type rbfMeshMotionSolver",
            "Valid solver types",
            "\nffdMotionSolver\n",
            "\nrbfMotionSolver\n",
        ],
    )


def test_an_unknown_library_is_OpenFOAMs_own_error(tmp_path):
    # (morphMesh brings our solvers with it)
    refused_dictionary(
        rbf_case(tmp_path),
        "moveDynamicMesh",
        DROP_IN.replace("morphMotionSolvers", "morphMeshMotionSolvers"),
        [
            "libmorphMeshMotionSolvers.so",
            "No such file",
            "Unknown solver type rbfMotionSolver",
        ],
    )
