# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb descend: from the baseline to the nearest optimum, every value by a
run. A descent that was killed replays itself: designs that are finished are not
run again, so that it takes the same steps and goes on."""

import csv
import dataclasses
import os

import numpy as np
from scipy.stats import qmc

from morphfoam.optimisation import sqp

from . import designs, failures, outcomes, plots, results, sweep
from .errors import StudyError
from .geometry import Geometry
from .slopes import Slopes

# What keeps designs clear of constraints of parameters, which must not be
# broken by rounding
CLEAR = 1e-9
# How often a random start that fails is drawn towards the baseline
DRAWN = 6


@dataclasses.dataclass
class Side:
    """One comparison left <= right, or left == right, as a number that must
    not be negative, or be zero: (right - left)/scale."""

    text: str
    left: object
    right: object
    equal: bool
    parametric: bool
    scale: float = 1.0

    @property
    def names(self):
        return self.left.names | self.right.names

    def values(self, values, baseline):
        return [float(s(values, baseline)) for s in (self.left, self.right)]

    def margin(self, values, baseline):
        left, right = self.values(values, baseline)
        return (right - left) / self.scale - CLEAR * self.parametric

    def slope(self, slopes):
        """By each parameter, or None."""
        left = slopes.of_expression(self.left)
        right = slopes.of_expression(self.right)
        if left is None or right is None:
            return None
        return (right - left) / self.scale


class ShapeProblem(sqp.Problem):
    """A study's descent as the optimiser sees it."""

    def __init__(self, study, strategy, cores, profile, start):
        self.study, self.strategy = study, strategy
        self.cores, self.profile = cores, profile
        self.wanted, self.start = study.descend, dict(start)
        self.moving = [
            study.names.index(name) for name in self.wanted.parameters
        ]
        self.low = study.lows[self.moving]
        self.high = study.highs[self.moving]
        self.used, self.last = {}, None
        # The last point that was taken, from which steps are measured
        self.here = dict(study.baseline)
        with sweep.only_one(study):
            sweep.complete(study, strategy, [], cores, profile)
        self.baseline = outcomes.baseline_values(study)
        if study.needs_baseline(strategy):
            found = outcomes.read(study, outcomes.BASELINE)
            if not outcomes.is_done(found):
                raise StudyError(
                    "the baseline "
                    + (f"failed: {found.reason}" if found else "has not run")
                    + f". See {outcomes.case(study, outcomes.BASELINE)};"
                    " corrected, the same command goes on"
                )
        self.geometry = Geometry(study, folder(study, strategy))
        self._sort_constraints()

    def _sort_constraints(self):
        """Exact: what parameters and geometry alone decide."""
        free = {*self.study.baseline_values, *self.geometry.names}
        self.exact_sides, self.costly_sides = [], []
        for conditions, parametric in (
            (self.study.constraints, True),
            (self.wanted.constraints, False),
        ):
            for condition in conditions:
                for left, right, equal in condition.sides():
                    side = Side(condition.text, left, right, equal, parametric)
                    (
                        self.exact_sides
                        if side.names <= free
                        else self.costly_sides
                    ).append(side)
        self.equal = np.array([s.equal for s in self.costly_sides], bool)
        self.exact_equal = np.array([s.equal for s in self.exact_sides], bool)
        # Their sizes, of the baseline where it has responses
        values = {**self.study.values(self.start), **self.baseline}
        for side in (*self.exact_sides, *self.costly_sides):
            if side.names <= values.keys():
                sizes = np.abs(side.values(values, self.baseline))
                side.scale = max(*sizes, 1e-12) if sizes.max() else 1.0

    # Points and designs

    def parameters(self, point):
        values = dict(self.start)
        for index, value in zip(self.moving, point):
            values[self.study.names[index]] = float(value)
        return values

    def point(self, parameters):
        return np.array([parameters[n] for n in self.wanted.parameters])

    def designs_at(self, points, origin):
        """The designs there are at these points, and new ones."""
        rows = [
            [self.parameters(p)[n] for n in self.study.names] for p in points
        ]
        span = self.study.highs - self.study.lows
        with sweep.only_one(self.study):
            table = designs.read(self.study)
            there = designs.points(self.study, table)
            found = []
            new = []
            for row in rows:
                near = (
                    np.abs((there - row) / span).max(axis=1)
                    if len(there)
                    else np.ones(0)
                )
                if len(near) and near.min() <= 1e-9:
                    found.append(table[int(near.argmin())])
                else:
                    found.append(len(new))
                    new.append(row)
            added = designs.add(self.study, new, origin) if new else []
        return [added[d] if isinstance(d, int) else d for d in found]

    def outcomes_of(self, chosen):
        """Of these designs, run where they are not finished."""

        def read():
            return [
                outcomes.read(self.study, self.strategy, d.number)
                for d in chosen
            ]

        with sweep.only_one(self.study):
            sweep.keep_up(
                self.study, self.strategy, [d.number for d in chosen]
            )
            if not all(read()):
                sweep.complete(
                    self.study,
                    self.strategy,
                    chosen,
                    self.cores,
                    self.profile,
                )
        found = read()
        for design, outcome in zip(chosen, found):
            if outcome is None:
                log = self.study.folder / "snakemake.log"
                raise StudyError(
                    f"design {design.id} was not run:"
                    f" {results.last_error(log)}. See {log}; corrected, the"
                    " same command goes on"
                )
            self.used[design.number] = outcome
        return found

    # What the optimiser asks

    def evaluate(self, points, gradient):
        if not gradient:
            broken = self.study.broken(self.parameters(points[0]))
            if broken:
                self.last = None
                return [sqp.Failure(f"it breaks {broken[0]}", 0.9)]
        chosen = self.designs_at(
            points, designs.GRADIENT if gradient else designs.DESCENT
        )
        if not gradient:
            self.last = chosen[0]
        return [
            self.value(outcome, points[0] if not gradient else None)
            for outcome in self.outcomes_of(chosen)
        ]

    def value(self, outcome, point=None):
        """Of an outcome; its own gradients only where a point is given."""
        lacking = self.lacking(outcome)
        if not outcome.done or lacking:
            return self.failure(
                outcome.reason or f"there is no response {lacking}",
                outcome.parameters,
                outcome.motion.get("attainable"),
            )
        values = self.values(outcome)
        sign = -self.wanted.sense
        value = sqp.Value(
            sign * outcome.responses[self.wanted.objective],
            np.array(
                [s.margin(values, self.baseline) for s in self.costly_sides]
            ),
        )
        if point is not None:
            slopes = Slopes(
                self.study, values, outcome.gradients, self.baseline
            )
            own = slopes.of(self.wanted.objective)
            value.f_gradient = None if own is None else sign * own[self.moving]
            value.c_gradients = [
                None if g is None else g[self.moving]
                for g in (s.slope(slopes) for s in self.costly_sides)
            ]
        return value

    def lacking(self, outcome):
        """A response that is asked for and was not read."""
        asked = {self.wanted.objective}.union(
            *(s.names & set(self.study.responses) for s in self.costly_sides)
        )
        return next(iter(sorted(asked - set(outcome.responses))), None)

    def values(self, outcome):
        return {
            **self.study.values(outcome.parameters),
            **outcome.responses,
        }

    def failure(self, reason, parameters, attainable):
        """Whose parameters are to blame, and how much of them is possible."""
        names = set(failures.blamed(reason))
        for item in self.study.derived:
            if item.name in names:
                names |= item.expression.names
        return sqp.Failure(
            reason,
            self.fraction(parameters, attainable),
            tuple(
                i
                for i, name in enumerate(self.wanted.parameters)
                if name in names
            ),
        )

    def fraction(self, parameters, attainable):
        """How much of the step from the last point is possible where this much
        is of the whole motion from the baseline: what is possible grows
        along the step as it does along the motion."""
        if attainable is None or not 0 < attainable < 1:
            return None
        span = self.study.highs - self.study.lows
        there, here, rest = (
            np.array([p[n] for n in self.study.names]) / span
            for p in (parameters, self.here, self.study.baseline)
        )
        length = np.linalg.norm(there - rest)
        used = np.linalg.norm(here - rest) / length if length else 0
        done, wanted = min(used / attainable, 1), 1 / attainable
        return (1 - done) / (wanted - done)

    def exact(self, point):
        parameters = self.parameters(point)
        values = dict(self.study.values(parameters))
        tables = {}
        if any(s.names - values.keys() for s in self.exact_sides):
            found = self.geometry.values(parameters)
            if isinstance(found, sqp.Failure):
                return self.failure(found.reason, parameters, found.fraction)
            values.update(found[0])
            tables = found[1]
        slopes = Slopes(self.study, values, tables, self.baseline)
        n = len(self.moving)
        return (
            np.array(
                [s.margin(values, self.baseline) for s in self.exact_sides]
            ),
            np.array(
                [s.slope(slopes)[self.moving] for s in self.exact_sides]
            ).reshape(-1, n),
        )

    def missed(self, outcome):
        """{text: by how much} of the constraints that a design misses."""
        values = self.values(outcome)
        found = {}
        for side in (*self.costly_sides, *self.exact_sides):
            if not side.names <= values.keys():
                continue
            left, right = side.values(values, self.baseline)
            by = abs(left - right) if side.equal else left - right
            if by > 1e-6 * side.scale:
                found[side.text] = by
        return found


def folder(study, strategy):
    return study.folder / f"descend.{strategy}{study.descend.suffix}"


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
    if (
        study.descend.geometry
        and study.strategies[strategy].start == "template"
    ):
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
