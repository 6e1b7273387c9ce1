# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Metamodels, fronts and clusters where the answer is known in closed form."""

import csv

import numpy as np
import pytest
from scipy.stats import qmc

from study_case import make_study, read

from morphfoam.study import (
    designs,
    feasibility,
    fit,
    metamodel,
    optimise,
    outcomes,
    pareto,
    report,
)
from morphfoam.study.errors import StudyError


def branin(x):
    """On [0, 1]^2; Forrester et al. 2008, Engineering Design via Surrogate
    Modelling, appendix."""
    a, b = 15 * x[:, 0] - 5, 15 * x[:, 1]
    return (
        (b - 5.1 / (4 * np.pi**2) * a**2 + 5 / np.pi * a - 6) ** 2
        + 10 * (1 - 1 / (8 * np.pi)) * np.cos(a)
        + 10
    )


@pytest.fixture(scope="module")
def unit_study(tmp_path_factory):
    return read(make_study(tmp_path_factory.mktemp("unit")))


def points(n, seed=1):
    return qmc.LatinHypercube(2, seed=seed, optimization="random-cd").random(n)


def test_leave_one_out_tells_how_good_a_model_is_elsewhere(unit_study):
    x = points(40)
    model = metamodel.fit(unit_study, "f", x, branin(x))
    others = np.random.default_rng(5).random((1000, 2))
    truth = branin(others)
    q2 = 1 - np.sum((model(others) - truth) ** 2) / np.sum(
        (truth - truth.mean()) ** 2
    )
    assert q2 > 0.98
    assert model.q2 == pytest.approx(q2, abs=0.02)


def test_q2_of_noise_is_none(unit_study):
    x = points(40)
    noise = np.random.default_rng(2).normal(size=40)
    assert metamodel.fit(unit_study, "f", x, noise).q2 < 0.3


def test_noise_is_told_from_the_response(unit_study):
    x = points(60)
    noise = np.random.default_rng(3).normal(scale=0.05, size=60)
    model = metamodel.fit(unit_study, "f", x, np.sin(3 * x[:, 0]) + noise)
    # The standard deviation of 60 values is known to 1/sqrt(120) = 9 %
    assert model.noise == pytest.approx(0.05, rel=0.3)
    # and y has no influence
    assert model.lengths[1] > 5 * model.lengths[0]


def test_leave_one_out_is_the_closed_form_of_it(unit_study):
    """Dubrule 1983, Math. Geol. 15, 687-699: y_i - [C^-1 y]_i/[C^-1]_ii for
    known mean; here for the mean of those that are left."""
    x = points(15)
    y = branin(x)
    model = metamodel.fit(unit_study, "f", x, y)
    covariance = model.process.kernel_(x)
    for i in (0, 7):
        others = np.arange(15) != i
        mean = y[others].mean()
        weights = np.linalg.solve(
            covariance[np.ix_(others, others)], covariance[others, i]
        )
        # The scale of the response left out changes nothing; the noise does
        assert model.predicted[i] == pytest.approx(
            mean + weights @ (y[others] - mean), rel=1e-6
        )


def test_too_few_designs_are_an_error(unit_study):
    with pytest.raises(StudyError, match="at least 4"):
        metamodel.fit(unit_study, "f", points(3), [1, 2, 3])


def nsga2(
    objectives,
    lows,
    highs,
    signs,
    violation=lambda x: 0 * x[:, 0],
    generations=100,
):
    return pareto.nsga2(
        lambda x: (objectives(x), violation(x)),
        np.array(lows),
        np.array(highs),
        signs,
        100,
        generations,
        1,
    )


def test_front_of_zdt1_is_the_known_one():
    """Zitzler, Deb, Thiele 2000, Evol. Comput. 8, 173-195: f2 = 1 - sqrt(f1),
    x2 = ... = 0."""

    def zdt1(x):
        g = 1 + 9 * x[:, 1:].mean(axis=1)
        return np.stack([x[:, 0], g * (1 - np.sqrt(x[:, 0] / g))], axis=1)

    x, f = nsga2(zdt1, [0] * 4, [1] * 4, [-1, -1])
    assert len(x) > 80
    assert np.abs(f[:, 1] - (1 - np.sqrt(f[:, 0]))).max() < 0.02
    assert np.diff(np.sort(f[:, 0])).max() < 0.05
    assert f[:, 0].min() < 0.01 and f[:, 0].max() > 0.99


def test_front_under_constraints_is_the_known_one():
    """CONSTR of Deb et al. 2002: f1 = x, f2 = (1 + y)/x with y + 9x >= 6,
    -y + 9x >= 1: f2 = (7 - 9x)/x for x < 2/3, and y = 0 beyond."""
    x, f = nsga2(
        lambda x: np.stack([x[:, 0], (1 + x[:, 1]) / x[:, 0]], axis=1),
        [0.1, 0],
        [1, 5],
        [-1, -1],
        lambda x: np.maximum(0, 6 - x[:, 1] - 9 * x[:, 0])
        + np.maximum(0, 1 + x[:, 1] - 9 * x[:, 0]),
    )
    known = np.maximum(7 - 9 * f[:, 0], 1) / f[:, 0]
    assert (f[:, 1] - known >= -1e-9).all()
    assert np.median(f[:, 1] - known) < 0.02
    # The leftmost feasible x: y = 6 - 9x <= 9x - 1
    assert f[:, 0].min() == pytest.approx(7 / 18, abs=0.01)


def test_maximising_is_minimising_the_opposite():
    def both(x):
        return np.stack([x[:, 0] ** 2, (x[:, 0] - 1) ** 2], axis=1)

    x, f = nsga2(both, [-2], [2], [-1, -1], generations=15)
    _, g = nsga2(lambda x: -both(x), [-2], [2], [1, 1], generations=15)
    np.testing.assert_array_equal(f, -g[::-1])
    # Schaffer's front is 0 <= x <= 1
    assert x.min() > -0.02 and x.max() < 1.02


def test_clusters_are_counted_and_represented():
    random = np.random.default_rng(4)
    centres = np.array([[0.2, 2], [0.8, 3], [0.5, 7]])
    x = np.concatenate(
        [c + random.normal(size=(60, 2)) * [0.03, 0.3] for c in centres]
    )
    label, chosen, bic = pareto.clusters(
        x, np.array([0, 0]), np.array([1, 10]), 6, 1
    )
    assert len(bic) == 6 and np.argmin(bic) == 2
    for k in range(3):
        assert len(set(label[60 * k : 60 * k + 60])) == 1
    found = x[chosen][np.argsort(x[chosen][:, 1])]
    assert np.abs((found - centres) / [0.03, 0.3]).max() < 1


def write(study, strategy, design, seconds, responses, reason=""):
    """An outcome as a run would leave it."""
    outcomes.write(
        study,
        outcomes.Outcome(
            strategy=strategy,
            number=design.number,
            status="failed" if reason else "done",
            reason=reason,
            parameters=design.parameters,
            responses={} if reason else responses,
            iterations=10 * seconds,
            wall={"solve": seconds},
            cpu={"solve": seconds},
            started_from="baseline",
            made=outcomes.recipe(study, strategy),
            response_texts=outcomes.response_texts(study),
        ),
    )


@pytest.fixture(scope="module")
def optimised(tmp_path_factory):
    """A study with its outcomes, as if run, fitted and optimised."""
    study = read(
        make_study(
            tmp_path_factory.mktemp("optimised"),
            ("sampling:", "constraints: [x + y >= 0.4]\nsampling:"),
            ("g: minimise}", "g: minimise}\n  constraints: [f <= 1.2]"),
        )
    )
    rows = points(24, seed=3)
    designs.add(study, rows[study.feasible(rows)], designs.SAMPLED)
    for strategy, slower in (("morph", 1), ("remesh", 3)):
        for d in designs.read(study):
            x, y = d.parameters.values()
            why = "solve: <diverged>" if d.number == 3 else ""
            values = {"f": x * x + y, "g": 1 - x * y}
            write(study, strategy, d, slower, values, why)
    fit.fit(study)
    optimise.optimise(study, no_runs=True)
    return study


def column(path, name):
    with path.open() as file:
        return np.array([float(row[name]) for row in csv.DictReader(file)])


def test_models_leave_failed_designs_out(optimised):
    path = optimised.folder / "fit.morph/leaveOneOut.csv"
    with path.open() as file:
        assert "0003" not in {row["design"] for row in csv.DictReader(file)}
    assert (
        column(optimised.folder / "fit.morph/models.csv", "Q2") > 0.99
    ).all()


def test_the_front_keeps_to_the_constraints_of_both_kinds(optimised):
    path = optimised.folder / "optimise.morph/front.csv"
    x, y, f, g = (column(path, name) for name in "xyfg")
    assert (x + y >= 0.4 * (1 - 1e-9)).all() and (f <= 1.2 + 1e-9).all()
    # x y is largest at given f = x^2 + y where x^2 = f/3, y = 2 f/3
    assert f.max() > 1.19 and len(f) > 20
    missed = np.abs(g - (1 - 2 * (f / 3) ** 1.5))[f > 0.3]
    assert missed.max() < 0.03 and np.median(missed) < 0.003


def test_representatives_become_designs_once(optimised):
    before = [
        d.number
        for d in designs.read(optimised)
        if d.origin == designs.VERIFICATION
    ]
    assert before
    optimise.optimise(optimised, no_runs=True)
    assert before == [
        d.number
        for d in designs.read(optimised)
        if d.origin == designs.VERIFICATION
    ]


def test_predicted_and_computed_are_set_against_each_other(optimised):
    verified = [
        d for d in designs.read(optimised) if d.origin == designs.VERIFICATION
    ]
    found = fit.models(optimised, "morph")
    value = float(found["f"](designs.points(optimised, verified[:1]))[0])
    outcome = outcomes.read(optimised, "morph", 1)
    outcome.number = verified[0].number
    outcome.responses = {"f": value / 1.1, "g": 0.5}
    outcomes.write(optimised, outcome)
    row, *rest = optimise.compare(
        optimised,
        "morph",
        found,
        verified,
        range(len(verified)),
        feasibility.fit(optimised, "morph"),
    )
    assert row["f.error%"] == pytest.approx(10)
    assert all(r["status"] == "not run" and r["f.error%"] == "" for r in rest)
    outcomes.path(optimised, "morph", verified[0].number).unlink()


def test_the_report_has_what_there_is(optimised):
    report.report(optimised)
    page = (optimised.folder / "report.html").read_text()
    for words in (
        "Strategies compared",
        "Metamodels",
        "Optima",
        "solve: &lt;diverged&gt;",
        "x + y &gt;= 0.4",
    ):
        assert words in page
    assert page.count("<img ") >= 6 and 'src="data:image/png' in page
    assert "http" not in page
    table = report.compare(
        optimised,
        {
            name: [{"iterations": k, "time": 2 * k, "f": 1 + k / 100, "g": 1}]
            for name, k in (("morph", 1), ("remesh", 3))
        },
    )
    assert table[1]["iterations"] == 3
    assert table[1]["f: largest %"] == pytest.approx(100 * 0.02 / 1.01)


def test_optimising_without_objectives_says_what_to_add(tmp_path):
    path = make_study(tmp_path)
    path.write_text(path.read_text().split("optimise:")[0])
    with pytest.raises(StudyError, match="has no optimise"):
        optimise.optimise(read(path))


def computed(folder, objectives, *changes):
    """A study of one strategy on a grid, as if run: f = x^2 + y, g = 1 - x y."""
    study = read(
        make_study(
            folder, ("objectives: {f: minimise, g: minimise}", objectives)
        )
    )
    axis = np.linspace(0, 1, 5)
    rows = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    designs.add(study, rows, designs.SAMPLED)
    for d in designs.read(study):
        x, y = d.parameters.values()
        write(study, "morph", d, 1, {"f": x * x + y, "g": 1 - x * y})
    return study


@pytest.mark.parametrize(
    "objectives, best",
    [
        # f = x^2 + y is largest at (1, 1)
        ("objectives: {f: maximise}", (1, 1)),
        # g = 1 - x y least with x + y <= 1: at x = y = 1/2
        ("objectives: {g: minimise}\n  constraints: [x + y <= 1]", (0.5, 0.5)),
        # f least with g <= 0.75, x y >= 1/4: x^3 = 1/8
        ("objectives: {f: minimise}\n  constraints: [g <= 0.75]", (0.5, 0.5)),
    ],
)
def test_one_objective_has_one_optimum(tmp_path, objectives, best):
    study = computed(tmp_path, objectives)
    optimise.optimise(study, no_runs=True)
    found = column(study.folder / "optimise.morph/front.csv", "x")
    assert len(found) == 1
    path = study.folder / "optimise.morph/representatives.csv"
    assert [column(path, n)[0] for n in "xy"] == pytest.approx(best, abs=0.03)


def test_objectives_that_agree_have_one_optimum(tmp_path):
    """Both are least at the origin's corner x = 0, y = 0."""
    study = computed(tmp_path, "objectives: {f: minimise, g: maximise}")
    optimise.optimise(study, no_runs=True)
    path = study.folder / "optimise.morph/representatives.csv"
    assert [column(path, n).min() for n in "xy"] == pytest.approx(
        [0, 0], abs=0.03
    )


def test_what_is_attainable_is_said_where_no_design_will_do(tmp_path):
    """x y is at most 1, so that g = 1 - x y is at least 0."""
    study = computed(
        tmp_path, "objectives: {f: minimise}\n  constraints: [g <= -0.5]"
    )
    with pytest.raises(StudyError) as caught:
        optimise.optimise(study, no_runs=True)
    said = str(caught.value)
    assert "g <= -0.5" in said and "missed by 0.5" in said
    assert "x = 1, y = 1" in said


def test_runs_of_optima_enter_the_fit(tmp_path):
    study = computed(tmp_path, "objectives: {f: minimise}")
    before = len(fit.fit(study, "morph")["f"].y)
    (added,) = designs.add(study, [(0.33, 0.77)], designs.VERIFICATION)
    write(study, "morph", added, 1, {"f": 9.0, "g": 0.5})
    model = fit.fit(study, "morph")["f"]
    assert len(model.y) == before + 1 and model.y[-1] == 9
    path = study.folder / "fit.morph/leaveOneOut.csv"
    with path.open() as file:
        assert added.id in {row["design"] for row in csv.DictReader(file)}


def test_a_design_of_the_fit_is_compared_with_a_model_without_it(tmp_path):
    """Or the comparison would say nothing of how well the model predicts."""
    study = computed(tmp_path, "objectives: {f: minimise}")
    (added,) = designs.add(study, [(0.33, 0.77)], designs.VERIFICATION)
    write(study, "morph", added, 1, {"f": 9.0, "g": 0.5})
    found = fit.models(study, "morph")
    likely = feasibility.fit(study, "morph")
    (row,) = optimise.compare(study, "morph", found, [added], [0], likely)
    assert row["f.predicted"] == pytest.approx(found["f"].predicted[-1])
    assert abs(row["f.predicted"] - 9) > 5


def test_the_report_says_which_designs_are_samples(tmp_path):
    study = computed(tmp_path, "objectives: {f: minimise}")
    (added,) = designs.add(study, [(0.33, 0.77)], designs.VERIFICATION)
    write(study, "morph", added, 1, {"f": 0.88, "g": 0.75})
    fit.fit(study, "morph")
    report.report(study)
    page = (study.folder / "report.html").read_text()
    assert "25 sampled and 1 verification" in page
    assert "fitted to 26 designs" in page


def test_a_front_has_no_values_but_those_allowed():
    """Of (x - 1.3)^2 + n over the whole n: the least is at n = 0, and with
    -n against it every n is on the front."""
    allowed = np.arange(5.0)

    def nearest(rows):
        whole = np.abs(rows[:, 1, None] - allowed).argmin(axis=1)
        return np.stack([rows[:, 0], allowed[whole]], axis=1)

    def evaluate(rows):
        f = (rows[:, 0] - 1.3) ** 2 + rows[:, 1]
        return np.stack([f, -rows[:, 1]], axis=1), np.zeros(len(rows))

    found, values = pareto.nsga2(
        evaluate,
        np.array([0.0, 0.0]),
        np.array([3.0, 4.0]),
        [-1, -1],
        100,
        100,
        1,
        nearest,
    )
    assert np.unique(found[:, 1]).tolist() == allowed.tolist()
    np.testing.assert_allclose(found[:, 0], 1.3, atol=0.05)
