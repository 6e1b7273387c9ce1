# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Where designs succeed: the classifier, and optima that keep to it.

Sources of truth: regions and optima in closed form; the study's README.
"""

import csv

import numpy as np
import pytest

from study_case import make_study, read
from test_study_optimum import column, computed, write

from morphfoam.study import designs, feasibility, fit, optimise, outcomes
from morphfoam.study.errors import StudyError


def likely_fails(study, where):
    """Designs on a grid that fail where a function of x and y says so."""
    axis = np.linspace(0, 1, 7)
    rows = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    designs.add(study, rows, designs.SAMPLED)
    for d in designs.read(study):
        x, y = d.parameters.values()
        why = "solve: diverged" if where(x, y) else ""
        write(study, "morph", d, 1, {"f": x * x + y, "g": 1 - x * y}, why)


def test_no_optimum_is_where_designs_fail(tmp_path):
    """f = x^2 + y is largest at (1, 1), where x + y > 1.45 makes every design
    fail: within x + y <= 1.45 it is largest at x = 1."""
    study = read(
        make_study(
            tmp_path,
            (
                "objectives: {f: minimise, g: minimise}",
                "objectives: {f: maximise}",
            ),
        )
    )
    likely_fails(study, lambda x, y: x + y > 1.45)
    optimise.optimise(study, no_runs=True)
    path = study.folder / "optimise.morph/representatives.csv"
    x, y = (column(path, name)[0] for name in "xy")
    assert x + y < 1.6 and x == pytest.approx(1, abs=0.05)
    assert column(path, "feasibility")[0] >= 0.5 - 1e-6

    # and without it, where they fail
    study.optimise.feasibility = 0
    optimise.optimise(study, no_runs=True)
    assert [column(path, n)[0] for n in "xy"] == pytest.approx(
        (1, 1), abs=0.03
    )


def test_feasibility_is_told_of_designs_that_were_not_seen(tmp_path):
    study = read(make_study(tmp_path))
    likely_fails(study, lambda x, y: x > 0.6)
    model = feasibility.fit(study, "morph")
    others = np.random.default_rng(5).random((500, 2))
    right = (model(others) > 0.5) == (others[:, 0] <= 0.6)
    # The boundary is known to half a step of the grid, 1/12
    assert right.mean() > 0.9
    assert model.right / len(model.done) > 0.9
    fit.fit(study, "morph")
    table = study.folder / "fit.morph/feasibility.csv"
    assert column(table, "succeeded").sum() == 28 == model.done.sum()
    # Grid points beside the boundary may be told wrong: 7 on each side
    assert abs((column(table, "probability") >= 0.5).sum() - 28) <= 7


@pytest.mark.parametrize("fails, probability", [(False, 1), (True, 0)])
def test_designs_that_are_all_alike_say_so(tmp_path, fails, probability):
    study = read(make_study(tmp_path))
    likely_fails(study, lambda x, y: fails)
    model = feasibility.fit(study, "morph")
    assert (model(np.array([[0.2, 0.3], [0.9, 0.9]])) == probability).all()


def test_the_baseline_enters_the_fit(tmp_path):
    study = computed(tmp_path, "objectives: {f: minimise}")
    before = len(fit.fit(study, "morph")["f"].y)
    outcomes.write(
        study,
        outcomes.Outcome(
            strategy=outcomes.BASELINE,
            number=None,
            status="done",
            parameters=study.baseline,
            responses={"f": 7.0, "g": 0.5},
        ),
    )
    model = fit.fit(study, "morph")["f"]
    assert len(model.y) == before + 1 and model.y[-1] == 7
    path = study.folder / "fit.morph/leaveOneOut.csv"
    with path.open() as file:
        assert "baseline" in {row["design"] for row in csv.DictReader(file)}


@pytest.mark.parametrize("value", ["1", "-0.1", "often"])
def test_a_probability_that_is_none_is_an_error(tmp_path, value):
    path = make_study(
        tmp_path, ("population: 40", f"population: 40\n  feasibility: {value}")
    )
    with pytest.raises(StudyError, match="optimise/feasibility"):
        read(path)
