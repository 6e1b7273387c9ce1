# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphStudy infill: runs where the metamodels expect most.

Sources of truth: expectations by drawing (Monte Carlo) and by hand; optima in
closed form; the study's README.
"""

import csv

import numpy as np
import pytest

from study_case import command, make_study, read
from test_study_optimum import branin, points, write

from morphfoam.study import designs, infill, sweep
from morphfoam.study.errors import StudyError


def study_of(folder, objectives, budget, *changes):
    return read(
        make_study(
            folder,
            ("optimise:", f"infill: {{budget: {budget}}}\noptimise:"),
            ("objectives: {f: minimise, g: minimise}", objectives),
            *changes,
        )
    )


def test_expected_improvement_is_the_mean_of_draws():
    random = np.random.default_rng(1)
    for limit, mean, deviation in ((1, 1.2, 0.3), (0, -2, 0.5), (0, 1, 0.2)):
        draws = random.normal(mean, deviation, 400000)
        gains = np.maximum(limit - draws, 0)
        assert infill.improvement(limit, mean, deviation) == pytest.approx(
            gains.mean(), abs=4 * gains.std() / 400000**0.5 + 1e-7
        )


def test_hypervolume_of_a_staircase():
    """By hand: steps of 1 x 1, 2 x 1 and 1 x 1 up to (4, 4)."""
    corners = np.array([[1, 3], [2, 2], [3, 1], [3, 3], [5, 0]])
    assert infill.hypervolume(corners, np.array([4, 4])) == 6
    assert infill.hypervolume(np.empty((0, 2)), np.array([4, 4])) == 0


@pytest.mark.parametrize("known", [[[1, 3], [2, 2], [3, 1]], []])
def test_expected_hypervolume_is_the_mean_of_draws(known):
    known = np.array(known, dtype=float).reshape(-1, 2)
    reference = np.array([4.0, 4.0])
    means = np.array([[1.5, 1.5], [3.5, 3.5], [0.5, 3.8]])
    deviations = np.array([[0.5, 0.2], [1.0, 0.7], [0.3, 0.4]])
    expected = infill.hypervolume_improvement(
        known, reference, means, deviations
    )
    random = np.random.default_rng(2)
    before = infill.hypervolume(known, reference)
    for mean, deviation, value in zip(means, deviations, expected):
        gains = np.array(
            [
                infill.hypervolume(np.vstack([known, draw]), reference)
                - before
                for draw in random.normal(mean, deviation, (20000, 2))
            ]
        )
        assert value == pytest.approx(
            gains.mean(), abs=4 * gains.std() / 20000**0.5
        )


def as_if_run(monkeypatch, respond):
    """Runs that cost nothing: respond(x, y) -> responses, or a reason."""
    ran = []

    def run(study, strategy, cores, profile=None, only=()):
        for d in designs.read(study):
            if d.number in only:
                ran.append(d.number)
                found = respond(*d.parameters.values())
                failed = isinstance(found, str)
                write(
                    study,
                    strategy,
                    d,
                    1,
                    {} if failed else found,
                    found if failed else "",
                )
        return 0

    monkeypatch.setattr(sweep, "run", run)
    return ran


def sampled(study, n, seed=1):
    designs.add(study, points(n, seed), designs.SAMPLED)
    sweep.run(study, "morph", 1, only=[d.number for d in designs.read(study)])


def best(study, respond, name):
    return min(
        respond(*d.parameters.values())[name]
        for d in designs.read(study)
        if not isinstance(respond(*d.parameters.values()), str)
    )


def test_the_least_of_branin_is_found_in_few_runs(tmp_path, monkeypatch):
    """Its three minima are 0.397887 (Forrester et al. 2008). The sample alone
    is far from it."""

    def respond(x, y):
        value = branin(np.array([[x, y]]))[0]
        return {"f": float(value), "g": 0.0}

    study = study_of(tmp_path, "objectives: {f: minimise}", 15)
    as_if_run(monkeypatch, respond)
    sampled(study, 12)
    before = best(study, respond, "f")
    assert infill.infill(study) == 0
    assert before > 1
    # The range is 308
    assert best(study, respond, "f") < 0.397887 + 0.1


def test_two_objectives_get_a_better_front(tmp_path, monkeypatch):
    """Least x^2 + y and (x - 1)^2 + y: y = 0, any x. From the corner (1.1, 1.1)
    the front sqrt(f) + sqrt(g) = 1 dominates 1.21 - 1/6."""

    def respond(x, y):
        return {"f": x**2 + y, "g": (x - 1) ** 2 + y}

    study = study_of(tmp_path, "objectives: {f: minimise, g: minimise}", 8)
    as_if_run(monkeypatch, respond)
    sampled(study, 10)
    corner = np.array([1.1, 1.1])

    def dominated():
        return infill.hypervolume(
            np.array(
                [
                    list(respond(*d.parameters.values()).values())
                    for d in designs.read(study)
                ]
            ),
            corner,
        )

    before = dominated()
    infill.infill(study)
    assert before < 0.9 * (1.21 - 1 / 6)
    # Nine points on the front, evenly, lack 1/54 + margins
    assert dominated() > 0.95 * (1.21 - 1 / 6)


def test_runs_go_where_designs_succeed(tmp_path, monkeypatch):
    """f = x^2 + y is largest at (1, 1), where x + y > 1.4 fails."""

    def respond(x, y):
        if x + y > 1.4:
            return "solve: diverged"
        return {"f": x * x + y, "g": 0.0}

    study = study_of(tmp_path, "objectives: {f: maximise}", 12)
    as_if_run(monkeypatch, respond)
    sampled(study, 16, seed=2)
    infill.infill(study)
    added = [d for d in designs.read(study) if d.origin == designs.INFILL]
    failed = sum(sum(d.parameters.values()) > 1.4 for d in added)
    assert failed <= len(added) / 2
    # Largest where x = 1, y = 0.4
    values = [
        respond(*d.parameters.values())["f"]
        for d in added
        if sum(d.parameters.values()) <= 1.4
    ]
    assert max(values) > 1.3


def test_the_budget_counts_what_was_run_before(tmp_path, monkeypatch, capsys):
    def respond(x, y):
        return {"f": np.sin(9 * x) * np.cos(7 * y), "g": 0.0}

    study = study_of(tmp_path, "objectives: {f: minimise}", 2)
    ran = as_if_run(monkeypatch, respond)
    sampled(study, 8)
    study.infill.tolerance = 0
    infill.infill(study)
    assert len(ran) == 10 and "The budget is spent" in capsys.readouterr().out
    # Ended, raised, said again
    study.infill.budget = 3
    infill.infill(study)
    assert sum(d.origin == designs.INFILL for d in designs.read(study)) == 3
    with (tmp_path / "study.study/infill.morph/history.csv").open() as file:
        assert [int(r["runs"]) for r in csv.DictReader(file)] == [0, 1, 2, 3]


def test_it_ends_where_no_run_promises_anything(tmp_path, monkeypatch, capsys):
    study = study_of(tmp_path, "objectives: {f: minimise}", 20)
    as_if_run(monkeypatch, lambda x, y: {"f": x + y, "g": 0.0})
    sampled(study, 12)
    infill.infill(study)
    assert "No run promises" in capsys.readouterr().out
    added = [d for d in designs.read(study) if d.origin == designs.INFILL]
    assert len(added) < 5


def test_the_command_runs_designs(tmp_path):
    path = make_study(
        tmp_path,
        ("optimise:", "infill: {budget: 1, tolerance: 0}\noptimise:"),
        (
            "bounds: [0, 1], baseline: 0.5}\n  y",
            "bounds: [0, 0.8], baseline:" " 0.5}\n  y",
        ),
        ("y: {bounds: [0, 1]", "y: {bounds: [0, 0.8]"),
        ("designs: 4", "designs: 6"),
    )
    command("sample", path)
    command("run", path)
    said = command("infill", path)
    assert "1 of 1 runs" in said and "The budget is spent" in said
    assert "morph: 1 done" in said


@pytest.mark.parametrize(
    "changes, said",
    [
        ([("budget: 2", "budget: 0")], "infill/budget"),
        ([("budget: 2", "criterion: best, budget: 2")], "infill/criterion"),
        (
            [
                (
                    "responses:",
                    "responses:\n  k: {expression: x}",
                ),
                ("g: minimise}", "g: minimise, k: minimise}"),
            ],
            "of one or of two",
        ),
    ],
)
def test_wrong_sections_say_why(tmp_path, changes, said):
    with pytest.raises(StudyError, match=said):
        study_of(
            tmp_path, "objectives: {f: minimise, g: minimise}", 2, *changes
        )


def test_without_the_section_it_says_what_to_add(tmp_path):
    with pytest.raises(StudyError, match="has no infill. Add"):
        infill.infill(read(make_study(tmp_path)))


def test_without_objectives_it_says_what_to_add(tmp_path):
    path = make_study(tmp_path)
    text = path.read_text().split("optimise:")[0] + "infill: {budget: 2}\n"
    path.write_text(text)
    with pytest.raises(StudyError, match="infill needs optimise"):
        read(path)
