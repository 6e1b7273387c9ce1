# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/bladeTip as a regression, run in a temporary copy.

Sources of truth: the cylinders of casing and tip, the rotation by a twelfth of
a turn; figures measured before with the same settings
(tutorials/bladeTip/README.md).
"""

import csv

import pytest

from tutorialCase import run, tutorial


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    case = tutorial("bladeTip", tmp_path_factory.mktemp("blade"))
    run(case, "./Allrun", "-noPictures")
    with (case / "results/figures.csv").open() as file:
        return {
            row.pop("images"): {
                name: float(value) for name, value in row.items()
            }
            for row in csv.DictReader(file)
        }


@pytest.mark.parametrize("images", ["auto", "no"])
@pytest.mark.parametrize(
    "what", ["off casing", "tip gap", "off blade", "pairs"]
)
def test_constraints_are_kept(results, images, what):
    assert results[images][what] <= 1e-12


def test_images_let_the_periodic_sides_go_with_the_blade(results):
    auto, no = results["auto"], results["no"]
    assert auto["wrong faces"] == no["wrong faces"] == 0
    assert (
        auto["max non-orthogonality"] < 55 < 67 < no["max non-orthogonality"]
    )
    assert auto["motion of the sides"] > 1.8 * no["motion of the sides"]
    assert auto["control points"] < no["control points"]
    assert auto["selected"] < 210
