# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The pictures of a study, with matplotlib and without a display."""

import math

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  the backend comes first

import numpy as np  # noqa: E402

from . import designs, outcomes  # noqa: E402

# Parameters of which each pair can be shown
MANY = 6
COLOURS = pyplot.get_cmap("tab10").colors
GREY = "0.6"
# What became of a design, or what it was made for
KINDS = {
    "gradient": (".", "0.8"),
    "done": ("o", COLOURS[0]),
    "failed": ("x", COLOURS[3]),
    "verification": ("D", COLOURS[2]),
    "descent": ("D", COLOURS[1]),
    "not run": (".", GREY),
}


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
    if len(study.names) > MANY:
        return parallel(study, points, kinds, path)
    pairs = [(i, j) for i in range(len(study.names)) for j in range(i)] or [
        (0, 0)
    ]
    columns = min(3, len(pairs))
    figure, axes = grid(math.ceil(len(pairs) / columns), columns)
    for axis in axes.flat[len(pairs) :]:
        axis.axis("off")
    for axis, (i, j) in zip(axes.flat, pairs):
        for kind, (mark, colour) in KINDS.items():
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


def parallel(study, points, kinds, path):
    """Many parameters: each an axis from its lowest to its highest value,
    each design a line."""
    figure, axes = grid(1, 1, 9, 3.5)
    axis = axes[0, 0]
    unit = (points - study.lows) / (study.highs - study.lows)
    for kind, (_, colour) in KINDS.items():
        for k, line in enumerate(unit[kinds == kind]):
            axis.plot(
                line,
                color=colour,
                lw=0.6,
                alpha=0.6,
                label=None if k else kind,
            )
    axis.set_xticks(range(len(study.names)), study.names, rotation=90)
    axis.set(ylim=(-0.02, 1.02), ylabel="in parts of the bounds")
    axis.legend(fontsize=7)
    save(figure, path)


def trends(study, rows, path):
    """Each response over each parameter, of the designs that are done; of many
    parameters those that it follows most closely."""
    shown = min(MANY, len(study.names))
    figure, axes = grid(len(study.responses), shown, 2.8, 2.2)
    for line, name in zip(axes, study.responses):
        chosen = closest(study, rows, name)[:shown]
        for axis, parameter in zip(line, chosen):
            axis.plot(
                [r[parameter] for r in rows],
                [r[name] for r in rows],
                "o",
                ms=4,
                color=COLOURS[0],
            )
            axis.set(xlabel=parameter, ylabel=name)
    save(figure, path)


def closest(study, rows, name):
    """The parameters; where there are many, by their correlation with a
    response."""
    if len(study.names) <= MANY:
        return study.names
    y = np.array([r[name] for r in rows])

    def correlation(parameter):
        x = np.array([r[parameter] for r in rows])
        if not x.std() or not y.std():
            return 0
        return -abs(np.corrcoef(x, y)[0, 1])

    return sorted(study.names, key=correlation)


def descent(study, rows, path):
    """Objective and constraints over the runs that they took, and where the
    parameters went. Rows: of the history, of which those with a start are
    drawn."""
    name = study.descend.objective
    figure, axes = grid(1, 3, 4.6, 3.6)
    objective, missed, moved = axes[0]
    span = study.highs - study.lows
    for start in dict.fromkeys(r["start"] for r in rows):
        own = [r for r in rows if r["start"] == start and r[name] != ""]
        taken = [r for r in own if r["taken"] == "yes"]
        colour = COLOURS[(int(start) - 1) % 10]
        for axis, key in ((objective, name), (missed, "missed")):
            axis.plot(
                [r["runs"] for r in taken],
                [r[key] for r in taken],
                "o-",
                ms=4,
                color=colour,
                label=f"start {start}",
            )
            axis.plot(
                [r["runs"] for r in own if r["taken"] == "no"],
                [r[key] for r in own if r["taken"] == "no"],
                "x",
                ms=4,
                color=colour,
            )
        ends = [
            (np.array([r[n] for n in study.names]) - study.lows) / span
            for r in (taken[0], taken[-1])
        ]
        moved.plot(ends[1], "o", ms=5, color=colour)
        if str(start) == "1":
            moved.plot(ends[0], color=GREY, lw=1)
    objective.set(xlabel="runs", ylabel=name, title="x: not taken")
    missed.set(xlabel="runs", ylabel="constraints missed by (parts)")
    missed.set_yscale("symlog", linthresh=1e-4)
    missed.set_ylim(bottom=0)
    moved.set_xticks(
        range(len(study.names)), study.names, rotation=90, fontsize=7
    )
    moved.set(
        ylim=(-0.03, 1.03),
        ylabel="in parts of the bounds",
        title="the end; grey: the start",
    )
    if len({r["start"] for r in rows}) > 1:
        objective.legend(fontsize=7)
    save(figure, path)


def importance(rows, elimination, objective, path):
    """Each parameter's share of a descent's gain, and what few of them
    reach."""
    figure, axes = grid(1, 2 if elimination else 1, 5.5, 3.4)
    axis = axes[0, 0]
    names = [row["parameter"] for row in rows]
    axis.bar(names, [100 * row["share"] for row in rows], color=COLOURS[0])
    axis.tick_params(axis="x", rotation=90)
    axis.set(ylabel="share of the gain [%]")
    if elimination:
        axis = axes[0, 1]
        axis.plot(
            [int(r["parameters"]) for r in elimination],
            [float(r["objective"]) for r in elimination],
            "o-",
            ms=5,
        )
        for r in elimination:
            axis.annotate(
                f"{r['runs']} runs",
                (int(r["parameters"]), float(r["objective"])),
                xytext=(4, 4),
                textcoords="offset points",
                fontsize=8,
            )
        axis.set(xlabel="parameters", ylabel=f"{objective} reached")
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


def convergence(residuals, histories, path):
    """Residuals of a run, and each response, over the iterations."""
    count = 1 + len(histories)
    columns = min(3, count)
    figure, axes = grid(math.ceil(count / columns), columns, 4, 2.8)
    for axis in axes.flat[count:]:
        axis.axis("off")
    first = axes.flat[0]
    for name, values in residuals.items():
        first.plot(*zip(*values), lw=1, label=name)
    first.set(xlabel="iteration", ylabel="initial residual")
    if residuals:
        first.set_yscale("log")
        first.legend(fontsize=6, ncols=2)
    for axis, (name, values) in zip(axes.flat[1:], histories.items()):
        axis.plot(*zip(*values), lw=1, color=COLOURS[0])
        late = [value for _, value in values[len(values) // 10 :]]
        margin = 0.05 * (max(late) - min(late)) or 1e-12 + abs(late[0]) * 1e-3
        axis.set(
            xlabel="n-th value written",
            ylabel=name,
            ylim=(min(late) - margin, max(late) + margin),
        )
    save(figure, path)
