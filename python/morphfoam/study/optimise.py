# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb optimise: the front on the metamodels, its clusters, and what runs
say of their representatives."""

import csv

import numpy as np

from . import (
    designs,
    feasibility,
    fit,
    outcomes,
    pareto,
    plots,
    sampling,
    sweep,
)
from .errors import StudyError


def optimise(study, strategy=None, no_runs=False, cores=None, profile=None):
    if study.optimise is None:
        raise StudyError(
            "the study file has no optimise: nothing says what is"
            " better. Add for example"
            " 'optimise: {objectives: {Nu: maximise}}'"
        )
    strategy = strategy or next(iter(study.strategies))
    found = fit.models(study, strategy)
    likely = feasibility.fit(study, strategy)
    points, objectives = front(study, found, likely)
    label, chosen, bic = pareto.clusters(
        points,
        study.lows,
        study.highs,
        study.optimise.max_clusters,
        study.optimise.seed,
    )
    path = study.folder / f"optimise.{strategy}"
    path.mkdir(exist_ok=True)
    names = list(study.optimise.objectives)
    write_table(
        path / "front.csv",
        [*study.names, *names, "cluster"],
        [
            [*map(float, p), *map(float, o), int(k) + 1]
            for p, o, k in zip(points, objectives, label)
        ],
    )
    if len(names) == 1:
        print(f"optimum: {names[0]} {objectives[0, 0]:.5g} predicted")
    else:
        print(
            f"front of {len(points)} points in {len(chosen)} clusters; BIC of 1"
            f" to {len(bic)} clusters: {' '.join(f'{b:.0f}' for b in bic)}"
        )

    verified = representatives(study, points[chosen])
    status = 0
    if not no_runs:
        status = sweep.run(
            study,
            strategy,
            cores,
            profile=profile,
            only=[d.number for d in verified],
        )
    rows = compare(study, strategy, found, verified, label[chosen], likely)
    write_table(
        path / "representatives.csv",
        list(rows[0]),
        [list(row.values()) for row in rows],
    )
    report(rows, names)
    plots.front(
        study, strategy, points, objectives, label, rows, path / "front.png"
    )
    plots.shapes(study, points, label, rows, path / "shapes.png")
    print(path / "front.png")
    return status


def limits(study):
    """The constraints of designs and of optima."""
    return [*study.constraints, *study.optimise.constraints]


def predict(study, found, rows):
    """{response: prediction} at rows of points, and by how much each misses the
    constraints."""
    predictions = {name: model(rows) for name, model in found.items()}
    values = {**study.values(dict(zip(study.names, rows.T))), **predictions}
    baseline = outcomes.baseline_values(study)
    missed = sum(
        (c.violation(values, baseline) for c in limits(study)),
        np.zeros(len(rows)),
    )
    return predictions, missed


def front(study, found, likely):
    """NSGA-II on the metamodels, where designs are likely to succeed: points
    and objectives."""
    wanted = study.optimise

    def evaluate(rows):
        predictions, missed = predict(study, found, rows)
        missed = missed + np.maximum(wanted.feasibility - likely(rows), 0)
        return (
            np.stack([predictions[n] for n in wanted.objectives], axis=1),
            missed,
        )

    signs = list(wanted.objectives.values())
    try:
        points, objectives = pareto.nsga2(
            evaluate,
            study.lows,
            study.highs,
            signs,
            wanted.population,
            wanted.generations,
            wanted.seed,
            study.nearest,
        )
    except pareto.Infeasible as error:
        raise StudyError(
            best_attainable(study, found, likely, error.point)
        ) from None
    if len(signs) == 1:
        best = [int(np.argmax(objectives[:, 0] * signs[0]))]
        points, objectives = points[best], objectives[best]
    return points, objectives


def best_attainable(study, found, likely, point):
    """What is said where no design keeps to all constraints."""
    values = study.values(dict(zip(study.names, point)))
    values.update({n: float(m(point[None])[0]) for n, m in found.items()})
    missed = {
        c.text: float(c.violation(values, outcomes.baseline_values(study)))
        for c in limits(study)
    }
    probability = float(likely(point[None])[0])
    missed[f"feasibility >= {study.optimise.feasibility:g}"] = max(
        study.optimise.feasibility - probability, 0
    )
    return (
        "optimise/constraints: no design keeps to all of them on the"
        " metamodels. Nearest to it is "
        + ", ".join(f"{n} = {v:.3g}" for n, v in zip(study.names, point))
        + ", where "
        + " and ".join(
            f"{text} is missed by {by:.3g}"
            for text, by in missed.items()
            if by
        )
        + " ("
        + ", ".join(f"{name} {values[name]:.4g}" for name in found)
        + f", probability to succeed {probability:.3g}). Ask for no more than"
        " that, or widen the bounds"
    )


def representatives(study, points):
    """Their designs: those there are, and new ones."""
    table = designs.read(study)
    with sweep.only_one(study):
        new = [
            p
            for p in points
            if sampling.is_new(p, designs.points(study, table), study)
        ]
        table += designs.add(study, new, designs.VERIFICATION)
    found = designs.points(study, table)
    span = study.highs - study.lows
    return [
        table[int(np.abs((found - p) / span).max(axis=1).argmin())]
        for p in points
    ]


def compare(study, strategy, found, verified, label, likely):
    """Predicted against computed, one row per representative."""
    rows = []
    for design, k in zip(verified, label):
        outcome = outcomes.read(study, strategy, design.number)
        row = {"cluster": int(k) + 1, "design": design.id, **design.parameters}
        point = np.array([[design.parameters[n] for n in study.names]])
        for name, model in found.items():
            mean, deviation = model.without(design.number, point)
            row[f"{name}.predicted"] = mean
            row[f"{name}.deviation"] = deviation
            computed = row[f"{name}.computed"] = (
                outcome.responses[name] if outcomes.is_done(outcome) else ""
            )
            row[f"{name}.error%"] = (
                100 * (mean - computed) / abs(computed)
                if computed not in ("", 0)
                else ""
            )
        row["feasibility"] = float(likely(point)[0])
        row["status"] = outcome.status if outcome else "not run"
        rows.append(row)
    return rows


def write_table(path, header, rows):
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(header)
        writer.writerows(rows)


def report(rows, names):
    for row in rows:
        said = [
            f"{n} {row[n + '.predicted']:.5g} predicted"
            + (
                f", {row[n + '.computed']:.5g} computed ({row[n + '.error%']:+.2f} %)"
                if row[f"{n}.error%"] != ""
                else ""
            )
            for n in names
        ]
        print(
            f"cluster {row['cluster']}, design {row['design']}"
            f" ({row['status']}): " + "; ".join(said)
        )
    for name in names:
        errors = [
            abs(r[f"{name}.error%"]) for r in rows if r[f"{name}.error%"] != ""
        ]
        if errors:
            print(
                f"{name}: predicted against computed, mean"
                f" {np.mean(errors):.2f} %, largest {max(errors):.2f} %"
            )
