# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A study's descent as the optimiser sees it: points are designs, values their
outcomes, constraints the comparisons of the study file."""

import dataclasses

import numpy as np

from morphfoam.optimisation import sqp

from . import designs, failures, outcomes, results, sweep
from .errors import StudyError
from .geometry import Geometry
from .slopes import Slopes

# What keeps designs clear of constraints of parameters, which must not be
# broken by rounding
CLEAR = 1e-9


def folder(study, strategy):
    return study.folder / f"descend.{strategy}{study.descend.suffix}"


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
                self.study,
                self.strategy,
                [d.number for d in chosen],
                note=False,
            )
            if not all(read()):
                sweep.complete(
                    self.study,
                    self.strategy,
                    chosen,
                    self.cores,
                    self.profile,
                    note=False,
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
