# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb importance on closed-form arithmetic: f = x^2 + y (study_case.py)."""

import csv

import pytest

from study_case import make_study, read
from test_study_descend import OPTIMISE

from morphfoam.study import descend, designs, importance, sample, sweep
from morphfoam.study.errors import StudyError

DESCEND = (
    "descend:\n  objective: {f: minimise}\n  tolerance: 1e-6\n"
    "  gradient: {scheme: central}\n"
)


def table(study, name):
    with (study.folder / "importance.morph" / name).open() as file:
        return list(csv.DictReader(file))


@pytest.fixture
def descended(tmp_path, at_once):
    study = read(make_study(tmp_path, (OPTIMISE, DESCEND)))
    assert descend.descend(study, "morph") == 0
    return study


def test_shares_are_those_of_the_change(descended):
    """From (1/2, 1/2) to (0, 0): x gives 1/4 of 3/4, y 1/2 of it. The
    trapezoidal rule is exact for x^2."""
    assert importance.importance(descended) == 0
    rows = table(descended, "parameters.csv")
    assert [r["parameter"] for r in rows] == ["y", "x"]
    shares = [float(r["share"]) for r in rows]
    assert shares == pytest.approx([2 / 3, 1 / 3], abs=0.01)
    assert "sobol" not in rows[0]
    assert (descended.folder / "importance.morph/importance.png").exists()


def test_few_parameters_reach_what_is_theirs(descended):
    """y alone: from 3/4 to 1/4."""
    before = len(designs.read(descended))
    importance.importance(descended, counts=[1, 2])
    rows = {r["parameters"]: r for r in table(descended, "elimination.csv")}
    assert float(rows["1"]["objective"]) == pytest.approx(0.25, abs=1e-3)
    assert rows["1"]["which"] == "y"
    assert float(rows["1"]["part"]) == pytest.approx(2 / 3, abs=0.01)
    # The first of its designs are those of the whole descent
    assert len(designs.read(descended)) < before + int(rows["1"]["runs"])


def test_indices_of_the_metamodel_where_there_are_designs(tmp_path, at_once):
    """Variances of x^2 and y on [0, 0.85]: 4/45 b^4 and b^2/12."""
    text = [(OPTIMISE, DESCEND), ("designs: 4", "designs: 24")]
    text += [
        (f"{n}: {{bounds: [0, 1]", f"{n}: {{bounds: [0, 0.85]") for n in "xy"
    ]
    study = read(make_study(tmp_path, *text))
    sample.sample(study)
    sweep.run(study, "morph")
    descend.descend(study, "morph")
    importance.importance(study)
    x, y = 4 / 45 * 0.85**4, 0.85**2 / 12
    rows = {r["parameter"]: r for r in table(study, "parameters.csv")}
    for name, part in (("x", x / (x + y)), ("y", y / (x + y))):
        assert float(rows[name]["sobolTotal"]) == pytest.approx(part, abs=0.03)


def test_it_says_what_has_to_be_there(tmp_path):
    with pytest.raises(StudyError, match="needs a descent"):
        importance.importance(read(make_study(tmp_path)))
    study = read(make_study(tmp_path, (OPTIMISE, DESCEND)))
    with pytest.raises(StudyError, match="morphStudy descend study.yaml"):
        importance.importance(study, "morph")
    with pytest.raises(StudyError, match="-counts 3"):
        importance.importance(study, "morph", [3])
