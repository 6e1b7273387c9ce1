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


def test_the_thesis_parameters_of_the_rudder_do_what_it_says(tmp_path):
    """Table 5.3: less drag (2.993 to 2.915), more efficiency (2.559 to 3.746),
    J 0.829. Here on a coarse mesh after a few iterations; with its stations
    counted from the leading edge on, the drag rises."""
    case = tutorial("rudder", tmp_path)
    for name, old, new in (
        ("flow/system/controlDict", "endTime             400", "endTime 160"),
        ("descend.yaml", "endTime 520", "endTime 240"),
    ):
        text = (case / name).read_text()
        assert old in text
        (case / name).write_text(text.replace(old, new))
    command = (
        f". {case.parents[1]}/etc/bashrc; morphStudy sample descend.yaml"
        " && morphStudy run descend.yaml"
    )
    run(case, "bash", "-c", command)
    rest, thesis = rows(case / "descend.study/results.morph.csv")
    assert float(thesis["D"]) < 0.95 * float(rest["D"])
    assert float(thesis["E"]) > 1.2 * float(rest["E"])
    assert float(thesis["J"]) < 0.9
    # The volume of the thesis: 0.0207 of 0.0298
    assert float(thesis["V"]) / float(rest["V"]) == pytest.approx(
        0.0207 / 0.0298, abs=0.005
    )
