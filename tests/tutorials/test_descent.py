# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tutorials/bulb's descent as a regression, reduced: three parameters, one step.

Sources of truth: the drag at rest measured before with the same settings
(tutorials/bulb/reference/descent.csv); the exact volume of the mesh, of which
80 % has to stay; the drag itself, which has to fall.
"""

import csv

import pytest

from tutorialCase import run, tutorial


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_a_step_lowers_the_drag_of_the_bulb(tmp_path):
    case = tutorial("bulb", tmp_path)
    study = case / "descend.yaml"
    text = study.read_text()
    study.write_text(
        text.replace(
            "maxIterations: 12",
            "maxIterations: 1\n  parameters: [mu7, mu10, mu18]",
        )
    )
    command = (
        f". {case.parents[1]}/etc/bashrc; morphStudy descend descend.yaml"
    )
    run(case, "bash", "-c", command)
    before, after = rows(case / "descend.study/descend.morph/history.csv")
    reference = rows(case / "reference/descent.csv")[1]
    assert float(before["D"]) == pytest.approx(
        float(reference["D0"]), rel=1e-3
    )
    assert after["taken"] == "yes"
    assert float(after["J"]) < 0.97 < float(before["J"])
    assert float(after["V"]) <= 0.8 * float(before["V"]) * (1 - 1e-9)
    # Three differences, the start and the step, of 19 parameters
    assert int(after["runs"]) == 5
