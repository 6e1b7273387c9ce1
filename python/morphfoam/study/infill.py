# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb infill: designs where the metamodels expect most of a run.

One objective: expected improvement over the best design (Jones, Schonlau and
Welch 1998, J. Global Optim. 13, 455-492, equation 15). Two: expected improvement
of the hypervolume that the designs dominate, the models independent of each
other (Emmerich, Giannakoglou and Naujoks 2006, IEEE Trans. Evol. Comput. 10,
421-439). With u the upper edge of the dominated region, r the reference point,
both objectives minimised, it is

    integral over x < r1 of P(Y1 <= x) E[max(u(x) - Y2, 0)] dx,

and u is a staircase: a sum over its steps, in closed form. Both are weighed by
the probability that a design succeeds, and nothing is run where that is less
than optimise/feasibility: failures alone, however many, do not make a promise
small. After each run the models are fitted again.
"""

import numpy as np
from scipy.stats import norm

from . import (
    designs,
    feasibility,
    fit,
    optimise,
    outcomes,
    pareto,
    sampling,
    sweep,
)
from .errors import StudyError

# The reference point is worse than all designs by this part of their range
MARGIN = 0.1


def improvement(limit, mean, deviation):
    """Expectation of max(limit - Y, 0) of normal Y; also the integral of
    P(Y <= x) up to the limit."""
    # Far below, where both terms vanish, instead of infinitely far
    z = np.maximum((limit - mean) / deviation, -40)
    return deviation * (z * norm.cdf(z) + norm.pdf(z))


def staircase(points, reference):
    """The points (rows, minimised) that no other dominates and that are better
    than the reference, by their first objective."""
    inside = points[(points < reference).all(axis=1)]
    kept = []
    for point in inside[np.lexsort(inside.T[::-1])]:
        if not kept or point[1] < kept[-1][1]:
            kept.append(point)
    return np.array(kept).reshape(-1, 2)


def hypervolume(points, reference):
    """Dominated by points (minimised), up to the reference."""
    front = staircase(points, reference)
    right = np.append(front[1:, 0], reference[0])
    return float(np.sum((right - front[:, 0]) * (reference[1] - front[:, 1])))


def hypervolume_improvement(points, reference, means, deviations):
    """Expected, at rows of means and deviations of two objectives."""
    front = staircase(points, reference)
    edges = np.concatenate([[-np.inf], front[:, 0], [reference[0]]])
    heights = np.concatenate([[reference[1]], front[:, 1]])
    m, s = means[:, :, None], deviations[:, :, None]
    up_to = improvement(edges[None], m[:, 0], s[:, 0])
    below = improvement(heights[None], m[:, 1], s[:, 1])
    return np.sum(np.diff(up_to, axis=1) * below, axis=1)


class State:
    """What is known before a run: models, best designs, what to gain."""

    def __init__(self, study, strategy):
        self.study = study
        self.models = fit.models(study, strategy)
        self.likely = feasibility.fit(study, strategy)
        self.names = list(study.optimise.objectives)
        self.signs = -np.array(list(study.optimise.objectives.values()))
        values = self.kept_to(strategy)
        everything = self.signs * np.stack(
            [self.models[n].y for n in self.names], axis=1
        )
        low, high = everything.min(axis=0), everything.max(axis=0)
        self.reference = high + MARGIN * (high - low)
        self.values = values
        if len(self.names) == 1:
            # Where no design keeps to the constraints: any is a gain
            self.best = values.min() if len(values) else self.reference[0]
            self.scale = float(high[0] - low[0])
        else:
            self.best = hypervolume(values, self.reference)
            self.scale = float(np.prod(self.reference - low))

    def kept_to(self, strategy):
        """Objectives, as minimised, of designs that keep to all
        constraints."""
        found = []
        baseline = outcomes.baseline_values(self.study)
        for design, outcome in fit.finished(self.study, strategy):
            values = {
                **self.study.values(design.parameters),
                **outcome.responses,
            }
            if not sum(
                float(c.violation(values, baseline))
                for c in optimise.limits(self.study)
            ):
                found.append([outcome.responses[n] for n in self.names])
        return self.signs * np.array(found).reshape(-1, len(self.names))

    def gain(self, rows):
        """Expected, times the probability to succeed."""
        mean, deviation = (
            np.stack(part, axis=1)
            for part in zip(
                *(self.models[n].with_deviation(rows) for n in self.names)
            )
        )
        mean = self.signs * mean
        deviation = np.maximum(deviation, 1e-12 * self.scale + 1e-300)
        expected = (
            improvement(self.best, mean[:, 0], deviation[:, 0])
            if len(self.names) == 1
            else hypervolume_improvement(
                self.values, self.reference, mean, deviation
            )
        )
        return expected * self.likely(rows)

    def next(self):
        """The point that promises most, and what, as a part of the scale."""
        study = self.study

        def evaluate(rows):
            _, missed = optimise.predict(study, self.models, rows)
            unlikely = study.optimise.feasibility - self.likely(rows)
            return self.gain(rows)[:, None], missed + np.maximum(unlikely, 0)

        wanted = study.optimise
        try:
            points, gains = pareto.nsga2(
                evaluate,
                study.lows,
                study.highs,
                [1],
                wanted.population,
                wanted.generations,
                wanted.seed,
                study.nearest,
            )
        except pareto.Infeasible as error:
            return error.point, np.inf
        best = int(gains[:, 0].argmax())
        return points[best], float(gains[best, 0]) / self.scale


def infill(study, strategy=None, cores=None, profile=None):
    """Returns the exit status."""
    if study.infill is None:
        raise StudyError(
            "the study file has no infill. Add for example 'infill: {budget:"
            " 20}', beside optimise"
        )
    strategy = strategy or next(iter(study.strategies))
    spent = [d for d in designs.read(study) if d.origin == designs.INFILL]
    # One that was ended before its run was
    status = run(study, strategy, spent, cores, profile)
    folder = study.folder / f"infill.{strategy}"
    while not status:
        state = State(study, strategy)
        point, gain = state.next()
        said = (
            f"best {state.names[0]} {float((state.signs * state.best)[0]):.6g}"
            if len(state.names) == 1
            else f"hypervolume {state.best / state.scale:.6g}"
        )
        print(
            f"{len(spent)} of {study.infill.budget} runs; {said}; a run"
            f" promises {100 * gain:.3g} %",
            flush=True,
        )
        folder.mkdir(parents=True, exist_ok=True)
        record(folder / "history.csv", spent, said, gain)
        if len(spent) >= study.infill.budget:
            print("The budget is spent")
            break
        if gain < study.infill.tolerance:
            print(
                f"No run promises {100 * study.infill.tolerance:g} %"
                " (infill/tolerance)"
            )
            break
        with sweep.only_one(study):
            table = designs.read(study)
            if not sampling.is_new(point, designs.points(study, table), study):
                print("The most promising design has been run")
                break
            spent += designs.add(study, [point], designs.INFILL)
        status = run(study, strategy, spent[-1:], cores, profile)
    return status


def run(study, strategy, chosen, cores, profile):
    if not chosen:
        return 0
    return sweep.run(
        study,
        strategy,
        cores,
        profile=profile,
        only=[d.number for d in chosen],
    )


def record(path, spent, said, gain):
    """A line for each state of the designs, once."""
    lines = path.read_text().splitlines() if path.exists() else []
    what, value = said.rsplit(" ", 1)
    lines = lines[: len(spent) + 1] or [f"runs,{what},promised %"]
    if len(lines) == len(spent) + 1:
        lines.append(f"{len(spent)},{value},{100 * gain:.6g}")
    path.write_text("\n".join(lines) + "\n")
