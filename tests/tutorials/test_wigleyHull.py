# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/wigleyHull as a regression, run in a temporary copy.

Sources of truth: the analytic hull, which stretched along its axes is the
hull of other dimensions; figures measured before with the same settings
(tutorials/wigleyHull/README.md).
"""

import csv

import pytest

from tutorialCase import run, tutorial


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    case = tutorial("wigleyHull", tmp_path_factory.mktemp("hull"))
    run(case, "./Allrun", "-noPictures")
    with (case / "results/figures.csv").open() as file:
        return {
            row.pop("images"): {
                name: float(value) for name, value in row.items()
            }
            for row in csv.DictReader(file)
        }


@pytest.mark.parametrize("images", ["auto", "no"])
def test_the_hull_is_the_one_of_the_new_dimensions(results, images):
    row = results[images]
    assert row["off Wigley after"] == pytest.approx(
        1.3 * row["off Wigley before"], rel=1e-9
    )
    assert row["wrong faces after"] == 0
    assert row["non-orthogonality after"] < 43.5


@pytest.mark.parametrize("images", ["auto", "no"])
@pytest.mark.parametrize("plane", ["middle", "water"])
def test_symmetry_planes_are_kept(results, images, plane):
    # 2.4 m long
    assert results[images][f"off {plane}"] <= 2.4e-12


def test_images_need_about_half_the_control_points(results):
    assert results["auto"]["selected"] < 0.65 * results["no"]["selected"]
    assert (
        results["auto"]["control points"]
        < 0.6 * results["no"]["control points"]
    )
