# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb fit: a metamodel of each response, and how far to trust it."""

import csv

from . import designs, feasibility, metamodel, outcomes, plots
from .errors import StudyError


def finished(study, strategy):
    """Designs that are done, the baseline and verifications of optima too,
    with their outcomes. Not those of differences: side by side, they would say
    of a model that it predicts what is in fact next to a design."""
    pairs = [
        (d, outcomes.read(study, strategy, d.number))
        for d in designs.read(study)
        if d.origin != designs.GRADIENT
    ]
    if study.baseline_steps is not None:
        baseline = designs.Design(0, outcomes.BASELINE, study.baseline)
        pairs.append((baseline, outcomes.read(study, outcomes.BASELINE)))
    return [(d, o) for d, o in pairs if outcomes.is_done(o)]


def models(study, strategy):
    """{response: model} of what the study file wants fitted."""
    if strategy not in study.strategies:
        raise StudyError(
            f"there is no strategy {strategy}; the strategies are"
            f" {' '.join(study.strategies)}"
        )
    pairs = finished(study, strategy)
    points = designs.points(study, [d for d, _ in pairs])
    for design, outcome in pairs:
        lacking = [n for n in study.fitted if n not in outcome.responses]
        if lacking:
            raise StudyError(
                f"design {design.id} has no response {lacking[0]}: it was added"
                " to the study file later. 'morphStudy run' reads it"
            )
    return {
        name: metamodel.fit(
            study,
            name,
            points,
            [o.responses[name] for _, o in pairs],
            [d.number for d, _ in pairs],
        )
        for name in study.fitted
    }


def folder(study, strategy):
    path = study.folder / f"fit.{strategy}"
    path.mkdir(exist_ok=True)
    return path


def fit(study, strategy=None):
    strategy = strategy or next(iter(study.strategies))
    found = models(study, strategy)
    path = folder(study, strategy)
    numbers = [d.id for d, _ in finished(study, strategy)]
    rows = [summary(model) for model in found.values()]
    with (path / "models.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    with (path / "leaveOneOut.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(
            [
                "response",
                "design",
                "computed",
                "predicted",
                "standardDeviation",
            ]
        )
        for name, model in found.items():
            writer.writerows(
                zip(
                    [name] * len(numbers),
                    numbers,
                    model.y,
                    model.predicted,
                    model.deviation,
                )
            )
    likely = feasibility.fit(study, strategy)
    with (path / "feasibility.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["design", "succeeded", "probability"])
        writer.writerows(
            zip(
                [f"{n:04d}" for n in likely.numbers],
                likely.done.astype(int),
                likely.predicted,
            )
        )
    plots.leave_one_out(found, path / "leaveOneOut.png")
    print(
        f"{strategy}: {len(numbers)} designs; lengths in units of the bounds"
    )
    for row in rows:
        print(
            "  ".join(
                f"{k} {v:.4g}" if isinstance(v, float) else f"{v}:"
                for k, v in row.items()
            )
        )
    print(likely)
    print(path / "leaveOneOut.png")
    return found


def summary(model):
    """What a reader wants to know of a model."""
    errors = abs(model.errors)
    return {
        "response": model.name,
        "Q2": float(model.q2),
        "rmsError": float((errors**2).mean() ** 0.5),
        "maxError": float(errors.max()),
        "range": float(model.y.max() - model.y.min()),
        "noise": float(model.noise),
        **{
            f"length.{n}": float(length)
            for n, length in zip(model.study.names, model.lengths)
        },
    }
