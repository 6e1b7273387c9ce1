# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/slidingCylinder as a regression, run in a temporary copy.

Source of truth: the bound that geometry sets, and what was measured before
with the same settings (tutorials/slidingCylinder/README.md).
"""

import csv

import pytest

from tutorialCase import run, tutorial


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    case = tutorial("slidingCylinder", tmp_path_factory.mktemp("cylinder"))
    run(
        case,
        "./Allrun",
        "-noPictures",
        "-motions",
        "rbf",
        "rbfSubSteps",
        "laplacianUniform",
        "-walls",
        "sliding",
    )
    with (case / "results/largest.csv").open() as file:
        return {
            row["motion"]: {
                name: float(value)
                for name, value in row.items()
                if name not in ("motion", "walls")
            }
            for row in csv.DictReader(file)
        }


def test_rbf_moves_the_body_twice_as_far_as_a_uniform_laplacian(results):
    # 5.5 is where the cylinder meets the end of the duct
    assert 4.2 < results["rbf"]["largest valid"] < 5.5
    assert (
        results["rbf"]["largest valid"]
        > 2 * results["laplacianUniform"]["largest valid"]
    )
    assert results["laplacianUniform"]["largest valid"] == pytest.approx(
        2.04, abs=0.03
    )


def test_sub_steps_take_the_body_almost_to_the_end(results):
    assert results["rbfSubSteps"]["largest valid"] == pytest.approx(5.4)


@pytest.mark.parametrize("motion", ["rbf", "laplacianUniform"])
def test_what_is_attainable_is_what_a_search_finds(results, motion):
    # Both fields are proportional to the displacement; the search is to 0.02
    row = results[motion]
    assert row["attainable"] == pytest.approx(row["largest valid"], abs=0.02)


@pytest.mark.parametrize("motion", ["rbf", "rbfSubSteps"])
def test_points_of_the_walls_stay_on_them(results, motion):
    assert results[motion]["off the walls"] <= 1e-12
