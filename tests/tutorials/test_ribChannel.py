# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/ribChannel as a regression, reduced: no sweep, and flows that are
only begun.

Sources of truth: Dittus-Boelter and Blasius for the smooth channel; the
geometry of the rib; what was measured before with the same settings.
"""

import csv
import re

import pytest

from morphfoam.output.tables import read_columns

from tutorialCase import run, tutorial


TALL = (0.3, 0.63, 0.567)  # highest, widest top, overhanging


def in_case(case, command, status=0):
    return run(
        case, "bash", "-c", f". ../../etc/bashrc; {command}", status=status
    )


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return tutorial("ribChannel", tmp_path_factory.mktemp("rib"))


@pytest.fixture(scope="module")
def smooth(case):
    run(case, "./Allrun.smooth")
    with (case / "results/smooth.csv").open() as file:
        return {
            row["case"]: {n: float(v) for n, v in row.items() if n != "case"}
            for row in csv.DictReader(file)
        }


def test_smooth_channel_has_the_friction_of_blasius(smooth):
    assert smooth["smooth"]["Cf/Cf0"] == pytest.approx(1, abs=0.15)


def test_smooth_channel_heated_all_around_has_nusselts_number_of_dittus_boelter(
    smooth,
):
    assert smooth["smoothBothHeated"]["Nu/Nu0"] == pytest.approx(1, abs=0.15)


def test_one_heated_wall_transfers_less(smooth):
    # measured 0.828; turbulent air between plates of which one is heated has
    # about five sixths of the number for two
    assert 0.75 < smooth["smooth"]["Nu/Nu0"] < 0.9


@pytest.fixture(scope="module")
def baseline(case):
    in_case(
        case,
        "./geometry.py && blockMesh && topoSet && cp -r 0.orig 0 &&"
        " splitMeshRegions -cellZones -overwrite",
    )
    return case


@pytest.fixture(scope="module")
def morphed(baseline):
    """What the log says, and the table of quality"""
    (baseline / "constant/parameters").write_text(
        "h {};\ne {};\nE {};\n".format(*TALL)
    )
    log = in_case(
        baseline,
        "./geometry.py && morphMesh -overwrite &&"
        " splitMeshRegions -cellZones -overwrite",
    )
    (path,) = (baseline / "postProcessing/morphMesh").glob("*/quality.dat")
    return log, read_columns(path)


def test_half_of_the_control_points_carry_an_extreme_shape(morphed):
    selected, of = map(
        int,
        re.search(
            r"selected (\d+) of (\d+) control points", morphed[0]
        ).groups(),
    )
    # measured 270 of 596: moving and fixed ones, and some 250 that slide
    assert of == 596
    assert 220 < selected < 320


def test_an_extreme_shape_is_a_valid_mesh(morphed):
    quality = morphed[1]
    assert quality["wronglyOrientedFaces"][-1] == 0
    assert quality["nonPositiveCells"][-1] == 0
    # measured 75.4 and 3.06
    assert quality["maxNonOrthogonality"][-1] < 78
    assert quality["maxSkewness"][-1] < 3.4


def points(text):
    return [
        tuple(map(float, p.split()))
        for p in re.findall(r"^\(([^()]+)\)$", text, re.MULTILINE)
    ]


def test_corners_are_where_the_parameters_say_and_flanks_straight(
    baseline, morphed
):
    h, e, E = TALL
    in_case(
        baseline,
        "foamDictionary system/controlDict -entry writeFormat"
        " -set ascii && foamFormatConvert -constant"
        " -region solid",
    )
    solid = points((baseline / "constant/solid/polyMesh/points").read_text())
    right = [p for p in solid if p[0] > 0.3 and p[2] == 0]
    highest = max(p[1] for p in right)
    assert highest == pytest.approx(h, abs=1e-9)
    top = max(p[0] for p in right if p[1] > h - 1e-9)
    assert top == pytest.approx(e, abs=1e-9)
    assert min(abs(p[0] - E) + abs(p[1]) for p in right) < 1e-9
    # The outermost of each height, above the floor
    for y in {round(p[1], 6) for p in right if 1e-6 < p[1] < h - 1e-6}:
        x = max(p[0] for p in right if abs(p[1] - y) < 2e-6)
        assert x <= E + (e - E) * y / h + 1e-6


def test_flow_over_the_morphed_rib_begins_as_it_should(baseline, morphed):
    # Where fvc::reconstruct is wrong (bin/correctedSolver) it has diverged
    # after six iterations
    run(
        baseline,
        "../../bin/correctedSolver",
        "heatTransfer/chtMultiRegionFoam/chtMultiRegionSimpleFoam",
    )
    log = in_case(
        baseline,
        "foamDictionary system/controlDict -entry endTime -set 100"
        " && chtMultiRegionSimpleFoam",
    )
    h, e, E = TALL
    mean = float(re.findall(r"uncorrected Ubar = (\S+),", log)[-1])
    assert mean == pytest.approx(1.8 / (1.8 - h * (e + E)), rel=1e-2)
    # It swings at first, between 5 and -1
    gradient = float(re.findall(r"pressure gradient = (\S+)", log)[-1])
    assert abs(gradient) < 10


def test_study_file_is_right(case):
    assert "No mistake found" in in_case(case, "morphStudy check study.yaml")
