# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The pictures of a study, with matplotlib and without a display."""

import math

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  the backend comes first

import numpy as np  # noqa: E402

from . import designs, outcomes  # noqa: E402

COLOURS = pyplot.get_cmap("tab10").colors
GREY = "0.6"


def grid(rows, columns, width=3.4, height=3.0):
    figure, axes = pyplot.subplots(
        rows,
        columns,
        figsize=(width * columns, height * rows),
        squeeze=False,
        layout="constrained",
    )
    return figure, axes


def save(figure, path):
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def leave_one_out(models, path):
    """Predicted without the design against computed."""
    figure, axes = grid(1, len(models), 4.2, 4)
    for axis, model in zip(axes[0], models.values()):
        ends = [
            min(model.y.min(), model.predicted.min()),
            max(model.y.max(), model.predicted.max()),
        ]
        axis.plot(ends, ends, color=GREY, lw=1, zorder=1)
        axis.errorbar(
            model.y,
            model.predicted,
            2 * model.deviation,
            fmt="o",
            ms=4,
            lw=1,
            color=COLOURS[0],
        )
        axis.set(
            xlabel=f"{model.name}, computed",
            ylabel=f"{model.name}, predicted without the design",
            title=f"Q² = {model.q2:.4f}",
        )
    save(figure, path)


def front(study, strategy, points, objectives, label, rows, path):
    """The front in the plane of the first two objectives (one: over its first
    parameter), the designs, and predicted against computed."""
    names = list(study.optimise.objectives)
    x, y = (
        (names[0], names[1]) if len(names) > 1 else (study.names[0], names[0])
    )
    figure, axes = grid(1, 1, 7, 5)
    axis = axes[0, 0]
    done = [
        {**d.parameters, **outcome.responses}
        for d in designs.read(study)
        if outcomes.is_done(
            outcome := outcomes.read(study, strategy, d.number)
        )
    ]
    axis.plot(
        [d[x] for d in done],
        [d[y] for d in done],
        "o",
        ms=4,
        color=GREY,
        label="designs, computed",
    )
    front_x = objectives[:, 0] if len(names) > 1 else points[:, 0]
    front_y = objectives[:, min(1, len(names) - 1)]
    for k in np.unique(label):
        axis.plot(
            front_x[label == k],
            front_y[label == k],
            ".",
            ms=5,
            color=COLOURS[k % 10],
            label=f"front, cluster {k + 1}",
        )
    for row in rows:
        colour = COLOURS[(row["cluster"] - 1) % 10]
        predicted = [row.get(f"{n}.predicted", row.get(n)) for n in (x, y)]
        axis.plot(*predicted, "s", ms=9, color=colour, mec="k")
        if row["status"] == outcomes.DONE:
            computed = [row.get(f"{n}.computed", row.get(n)) for n in (x, y)]
            axis.plot(*zip(predicted, computed), color="k", lw=1)
            axis.plot(*computed, "D", ms=9, mfc="none", mec=colour, mew=2)
    axis.plot([], [], "ks", label="representative, predicted")
    axis.plot([], [], "D", mfc="none", mec="k", label="the same, computed")
    axis.set(xlabel=x, ylabel=y)
    axis.legend(fontsize=8)
    save(figure, path)


def shapes(study, points, label, rows, path):
    """The front in the space of the parameters, two at a time."""
    pairs = [(i, j) for i in range(len(study.names)) for j in range(i)] or [
        (0, 0)
    ]
    columns = min(3, len(pairs))
    figure, axes = grid(math.ceil(len(pairs) / columns), columns)
    for axis in axes.flat[len(pairs) :]:
        axis.axis("off")
    for axis, (i, j) in zip(axes.flat, pairs):
        for k in np.unique(label):
            axis.plot(
                points[label == k, j],
                points[label == k, i],
                ".",
                color=COLOURS[k % 10],
            )
        for row in rows:
            axis.plot(
                row[study.names[j]],
                row[study.names[i]],
                "s",
                ms=9,
                color=COLOURS[(row["cluster"] - 1) % 10],
                mec="k",
            )
        box(axis, study, j, i)
    save(figure, path)


def box(axis, study, i, j):
    """Labels and bounds of two parameters."""
    for which, p in (("x", study.parameters[i]), ("y", study.parameters[j])):
        margin = 0.04 * (p.high - p.low)
        axis.set(
            **{
                f"{which}label": p.name,
                f"{which}lim": (p.low - margin, p.high + margin),
            }
        )


def sampled(study, strategy, path):
    """Where the designs are, and which failed."""
    table = designs.read(study)
    kinds = []
    for d in table:
        outcome = outcomes.read(study, strategy, d.number)
        kinds.append(
            "not run"
            if not outcome
            else outcome.status
            if not outcomes.is_done(outcome)
            else "done"
            if d.origin == designs.SAMPLED
            else d.origin
        )
    points, kinds = designs.points(study, table), np.array(kinds)
    pairs = [(i, j) for i in range(len(study.names)) for j in range(i)] or [
        (0, 0)
    ]
    columns = min(3, len(pairs))
    figure, axes = grid(math.ceil(len(pairs) / columns), columns)
    for axis in axes.flat[len(pairs) :]:
        axis.axis("off")
    style = {
        "done": ("o", COLOURS[0]),
        "failed": ("x", COLOURS[3]),
        "verification": ("D", COLOURS[2]),
        "not run": (".", GREY),
    }
    for axis, (i, j) in zip(axes.flat, pairs):
        for kind, (mark, colour) in style.items():
            chosen = kinds == kind
            if chosen.any():
                axis.plot(
                    points[chosen, j],
                    points[chosen, i],
                    mark,
                    ms=5,
                    color=colour,
                    label=kind,
                )
        axis.plot(
            study.parameters[j].baseline,
            study.parameters[i].baseline,
            "*",
            ms=10,
            color="k",
            label="baseline",
        )
        box(axis, study, j, i)
    axes[0, 0].legend(fontsize=7)
    save(figure, path)


def trends(study, rows, path):
    """Each response over each parameter, of the designs that are done."""
    figure, axes = grid(len(study.responses), len(study.names), 2.8, 2.2)
    for line, name in zip(axes, study.responses):
        for axis, parameter in zip(line, study.names):
            axis.plot(
                [r[parameter] for r in rows],
                [r[name] for r in rows],
                "o",
                ms=4,
                color=COLOURS[0],
            )
            axis.set(xlabel=parameter, ylabel=name)
    save(figure, path)


def strategies(tables, path):
    """Iterations and time of the same designs by each strategy."""
    figure, axes = grid(1, 2, 6, 3)
    width = 0.8 / len(tables)
    for k, (name, rows) in enumerate(tables.items()):
        at = np.arange(len(rows)) + (k - (len(tables) - 1) / 2) * width
        for axis, key in zip(axes[0], ("iterations", "time")):
            axis.bar(at, [r[key] or 0 for r in rows], width, label=name)
            axis.set(
                xlabel="design", ylabel=key + (" [s]" if key == "time" else "")
            )
            axis.set_xticks(
                np.arange(len(rows)),
                [r["design"].lstrip("0") for r in rows],
                fontsize=6,
            )
    axes[0, 0].legend(fontsize=8)
    save(figure, path)
