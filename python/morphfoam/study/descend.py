# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb descend: from the baseline to the nearest optimum, every value by a
run. A descent that was killed replays itself: designs that are finished are not
run again, so that it takes the same steps and goes on."""

import csv
import os

from scipy.stats import qmc

from morphfoam.optimisation import sqp

from . import plots, results, sweep
from .errors import StudyError
from .shape_problem import ShapeProblem, folder

# How often a random start that fails is drawn towards the baseline
DRAWN = 6


class History:
    """What happened, as a table that is written with every iteration."""

    def __init__(self, study, strategy):
        self.study, self.rows = study, []
        self.path = folder(study, strategy) / "history.csv"

    def add(self, problem, start, iteration):
        """The row of an iteration; says it."""
        used = problem.used.values()
        row = {
            "start": start,
            "iteration": iteration.number,
            "design": "",
            problem.wanted.objective: "",
            **{name: "" for name in problem.study.responses},
            "missed": iteration.missed,
            "radius": iteration.radius,
            "predicted": iteration.predicted,
            "gained": iteration.gained,
            "taken": "yes" if iteration.taken else "no",
            "runs": len(used),
            "failed": sum(not o.done for o in used),
            "cpuTime": round(sum(sum(o.cpu.values()) for o in used), 3),
            "note": iteration.note,
        }
        if iteration.point is not None:
            (design,) = problem.designs_at([iteration.point], None)
            outcome = problem.used[design.number]
            row.update(outcome.responses)
            row.update(outcome.parameters)
            row["design"] = design.id
        elif iteration.note.startswith("failed") and problem.last:
            row.update(problem.last.parameters)
            row["design"] = problem.last.id
        if iteration.taken:
            problem.here = problem.parameters(iteration.point)
        self.rows.append(row)
        self.write()
        print(self.said(problem, row), flush=True)

    def said(self, problem, row):
        name = problem.wanted.objective
        text = f"iteration {row['iteration']}: "
        if row[name] != "":
            text += f"{name} {row[name]:.6g}, design {row['design']}"
            if row["missed"] > 1e-6:
                text += f", constraints missed by {row['missed']:.2g}"
            if row["taken"] == "no":
                text += ", not taken"
        text += f", radius {row['radius']:.3g}, {row['runs']} runs"
        return text + (f"; {row['note']}" if row["note"] else "")

    def write(self):
        columns = list(dict.fromkeys(k for row in self.rows for k in row))
        write_table(self.path, columns, self.rows)


def write_table(path, columns, rows):
    """At once, so that it is whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_suffix(".new")
    with new.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(new, path)


def descend(study, strategy=None, cores=None, profile=None):
    """Returns the exit status: 1 where no start reached a shape that keeps to
    the constraints."""
    if study.descend is None:
        raise StudyError(
            "the study file has no descend: nothing says what is better. Add"
            " for example 'descend: {objective: {drag: minimise}}'"
        )
    strategy, cores = sweep.prepared(study, strategy, cores, profile)
    if study.descend.geometry and study.strategy(strategy).start == "template":
        raise StudyError(
            f"descend/geometry runs in a copy of the baseline, and strategy"
            f" {strategy} starts from the template. Take a strategy that"
            " starts from the baseline"
        )
    broken = study.broken(study.baseline)
    if broken:
        raise StudyError(
            f"constraints: the baseline, where the descent starts, breaks"
            f" {broken[0]}. Correct one of them"
        )
    history, found = History(study, strategy), []
    for number, start in enumerate(starts(study), 1):
        if study.descend.starts > 1:
            print(f"start {number} of {study.descend.starts}", flush=True)
        best = from_start(
            study, strategy, cores, profile, number, start, history
        )
        if best:
            found.append(best)
            write_gradients(study, strategy, found)
            write_optima(study, strategy, found)
    results.write(study, strategy)
    if not found:
        return 1
    plots.descent(study, history.rows, history.path.with_name("history.png"))
    found.sort(key=better)
    conclude(study, history, found)
    print(history.path)
    return 0 if found[0]["result"].feasible else 1


def better(row):
    """What sorts results, the best first."""
    result = row["result"]
    return (
        not result.feasible,
        result.value.f if result.feasible else result.missed,
    )


def starts(study):
    """The baseline, and random points between the bounds."""
    bounded = {
        p.name: min(max(p.baseline, p.low), p.high) for p in study.parameters
    }
    yield bounded
    sequence = qmc.Sobol(len(study.names), seed=study.descend.seed)
    left = study.descend.starts - 1
    while left > 0:
        for unit in sequence.random(64):
            point = study.lows + unit * (study.highs - study.lows)
            values = dict(zip(study.names, map(float, point)))
            for name in set(study.names) - set(study.descend.parameters):
                values[name] = bounded[name]
            if not study.broken(values) and left > 0:
                left -= 1
                yield values


def from_start(study, strategy, cores, profile, number, start, history):
    """The result of one descent, or None where it could not start."""
    wanted = study.descend
    options = sqp.Options(
        radius=wanted.radius,
        max_iterations=wanted.max_iterations,
        step=wanted.step,
        scheme=wanted.scheme,
        noise=wanted.noise,
        tolerance=wanted.tolerance,
        min_radius=wanted.min_radius,
    )
    for _ in range(DRAWN):
        problem = ShapeProblem(study, strategy, cores, profile, start)
        try:
            result = sqp.minimise(
                problem,
                problem.point(start),
                options,
                lambda i: history.add(problem, number, i),
            )
            break
        except sqp.StartFailed as error:
            if number == 1:
                raise StudyError(
                    f"the descent cannot start: the baseline's shape fails"
                    f" with strategy {strategy}: {error}. It must run before"
                    " it can be made better"
                ) from None
            fraction = min(0.9 * (error.failure.fraction or 0.6), 0.9)
            print(
                f"start {number} fails ({error}); it is drawn towards the"
                f" baseline, to {100*fraction:.0f} %",
                flush=True,
            )
            start = {
                n: study.baseline[n] + fraction * (v - study.baseline[n])
                for n, v in start.items()
            }
    else:
        return None
    (design,) = problem.designs_at([result.point], None)
    outcome = problem.used[design.number]
    return {
        "start": number,
        "design": design,
        "outcome": outcome,
        "missed": problem.missed(outcome),
        "runs": len(problem.used),
        "failed": sum(not o.done for o in problem.used.values()),
        "result": result,
    }


def write_optima(study, strategy, found):
    rows = [
        {
            "start": row["start"],
            "design": row["design"].id,
            **row["outcome"].parameters,
            **row["outcome"].responses,
            "missed": row["result"].missed,
            "runs": row["runs"],
            "failed": row["failed"],
            "why": row["result"].why,
        }
        for row in sorted(found, key=better)
    ]
    write_table(folder(study, strategy) / "optima.csv", list(rows[0]), rows)


def write_gradients(study, strategy, found):
    """Of the objective, and of the Lagrangian with the last multipliers, at
    every point that was taken; by the whole distance of the bounds."""
    rows, sign = [], -study.descend.sense
    for best in found:
        result = best["result"]
        for number, point in result.path:
            objective = point.gradient[0]
            lagrangian = objective - point.jacobian.T @ result.multipliers
            for name, values in (
                ("objective", objective),
                ("lagrangian", lagrangian),
            ):
                rows.append(
                    {
                        "start": best["start"],
                        "iteration": number,
                        "of": name,
                        **dict(
                            zip(
                                study.descend.parameters,
                                (sign * values).tolist(),
                            )
                        ),
                    }
                )
    path = folder(study, strategy) / "gradients.csv"
    write_table(path, list(rows[0]), rows)


def conclude(study, history, found):
    """Say how it went."""
    name = study.descend.objective
    best = found[0]
    first = next(r[name] for r in history.rows if r["iteration"] == 0)
    value = best["outcome"].responses[name]
    change = f" ({100*(value - first)/abs(first):+.1f} %)" if first else ""
    cpu = max(
        (r["cpuTime"] for r in history.rows if r["start"] == best["start"])
    )
    print(
        f"{name} {first:.6g} -> {value:.6g}{change}: design"
        f" {best['design'].id}, {best['runs']} runs"
        + (f" of which {best['failed']} failed" if best["failed"] else "")
        + f", {cpu:.0f} s of processor time; {best['result'].why}"
    )
    for text, by in best["missed"].items():
        print(
            f"Not met: {text}, missed by {by:.4g}. The descent came no nearer"
            " to all constraints; ask for no more than that, or widen the"
            " bounds"
        )
