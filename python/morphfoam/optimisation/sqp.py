# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Trust-region sequential quadratic programming where every value costs a run,
may carry noise, and may not come at all.

    min f(x)   with  c(x) >= 0 (or = 0),  low <= x <= high

Each step minimises a quadratic model of the Lagrangian, its Hessian built by
damped BFGS updates (Powell, M. J. D. (1978). Lect. Notes Math. 630, 144-157),
under linearised constraints in a box about x; it is judged by the exact penalty
function f + penalty*(sum of what the constraints miss) (Nocedal, J., Wright,
S. J. (2006). Numerical optimization. Springer, chapter 18). What is known of
noise enters both sides of the comparison of gain and prediction, so that noise
cannot shrink the region without end (Sun, S., Nocedal, J. (2023). Math.
Program. 202, 445-472, doi 10.1007/s10107-023-01941-9).

Constraints that are cheap and exact (a volume) are not taken as linear: the step
is corrected until it keeps to them, before anything is run.
"""

from dataclasses import dataclass, field

import numpy as np

from . import differences, quadratic

# Gain against prediction: a step is taken, and the region left or enlarged
TAKEN, POOR, GOOD = 0.02, 0.25, 0.75
LARGEST_RADIUS = 0.5
# Corrections of a step for the exact constraints, and what they may leave
CORRECTIONS, MET = 8, 1e-9


@dataclass
class Failure:
    """No values at a point.

    fraction  of the step to it that might be possible; None: not known
    blamed    the variables that bring it about; empty: not known
    """

    reason: str
    fraction: float | None = None
    blamed: tuple = ()


@dataclass
class Value:
    """What a run says of a point: objective and constraints; gradients of
    those that have an exact one (None: by differences)."""

    f: float
    c: np.ndarray = field(default_factory=lambda: np.zeros(0))
    f_gradient: np.ndarray | None = None
    c_gradients: list | None = None

    def vector(self):
        return np.concatenate([[self.f], self.c])


class Problem:
    """What is minimised. Points are in the units of low and high.

    equal        which costly constraints are equalities
    exact_equal  which exact ones are
    """

    low: np.ndarray
    high: np.ndarray
    equal = np.zeros(0, bool)
    exact_equal = np.zeros(0, bool)

    def evaluate(self, points, gradient):
        """A Value or Failure for each of the points, which are computed at
        once; gradient says whether they serve differences alone."""
        raise NotImplementedError

    def exact(self, point):
        """Values and gradients (one row each) of the exact constraints, or a
        Failure."""
        return np.zeros(0), np.zeros((0, len(point)))


@dataclass
class Options:
    """Lengths in parts of the bounds, values in parts of f at the start.

    radius       of the trust region at first
    step         of differences
    scheme       forward, central, or auto: central once forward ones lead on
                 no more
    noise        of f
    tolerance    ends where less can be gained
    min_radius   ends where the region is smaller
    """

    radius: float = 0.125
    max_iterations: int = 20
    step: float = 0.01
    scheme: str = "auto"
    noise: float = 0.0
    tolerance: float = 1e-4
    min_radius: float = 1e-3

    @property
    def met(self):
        """What may be missed by constraints that are met: costly ones are
        only as linear as the last step is short."""
        return max(1e-6, 0.1 * self.tolerance)


@dataclass
class Point:
    """x in parts of the bounds, with what is known there."""

    x: np.ndarray
    value: Value
    exact: tuple
    gradient: np.ndarray | None = None  # rows: f, costly constraints
    unknown: tuple = ()

    @property
    def c(self):
        """All constraints: costly, exact."""
        return np.concatenate([self.value.c, self.exact[0]])

    @property
    def jacobian(self):
        return np.vstack([self.gradient[1:], self.exact[1]])


@dataclass
class Iteration:
    """One trial step, or the start (number 0)."""

    number: int
    point: np.ndarray
    f: float | None
    missed: float | None
    radius: float
    predicted: float | None = None
    gained: float | None = None
    taken: bool = False
    note: str = ""


@dataclass
class Result:
    """point   in the problem's units
    value     there; c: all constraints
    feasible  whether they are met
    why       the descent ended
    path      the points that were taken, in parts of the bounds: pairs of
              iteration and Point
    """

    point: np.ndarray
    value: Value
    c: np.ndarray
    missed: float
    feasible: bool
    multipliers: np.ndarray
    why: str
    iterations: list
    path: list


class StartFailed(Exception):
    """There is no value at the start."""

    def __init__(self, failure):
        super().__init__(failure.reason)
        self.failure = failure


def minimise(problem, start, options=None, observe=lambda iteration: None):
    """Descend from start; observe is told each Iteration as it is done."""
    return Descent(problem, options or Options(), observe).run(start)


class Descent:
    """One descent, in parts of the bounds."""

    def __init__(self, problem, options, observe):
        self.problem, self.options, self.observe = problem, options, observe
        self.span = problem.high - problem.low
        self.equal = np.concatenate(
            [problem.equal, problem.exact_equal]
        ).astype(bool)
        self.costly = len(problem.equal)
        self.radius = options.radius
        # Of each variable, in parts of the radius: less where it was to blame
        self.reach = np.ones(len(self.span))
        self.central = options.scheme == "central"
        self.penalty, self.iterations, self.path = 0.0, [], []
        self.hessian, self.updated = None, False
        self.multipliers = np.zeros(len(self.equal))

    # What is asked of the problem

    def place(self, x):
        point = self.problem.low + x * self.span
        return np.clip(point, self.problem.low, self.problem.high)

    def exact(self, x):
        """Exact constraints at x, gradients by parts of the bounds."""
        found = self.problem.exact(self.place(x))
        if isinstance(found, Failure):
            return found
        return np.asarray(found[0], float), np.asarray(found[1]) * self.span

    def evaluate(self, x):
        """A Point without differences, or a Failure."""
        exact = self.exact(x)
        if isinstance(exact, Failure):
            return exact
        (value,) = self.problem.evaluate([self.place(x)], False)
        if isinstance(value, Failure):
            return value
        return Point(x, value, exact)

    def differentiate(self, point, before=None):
        """Gradients of f and the costly constraints."""
        value = point.value
        given = [value.f_gradient, *(value.c_gradients or [])]
        given += [None] * (1 + self.costly - len(given))
        if all(g is not None for g in given):
            point.gradient = np.array(given, float) * self.span
            return

        def values(points):
            found = self.problem.evaluate(
                [self.place(p) for p in points], True
            )
            return [
                None if isinstance(v, Failure) else v.vector() for v in found
            ]

        n = len(point.x)
        point.gradient, point.unknown = differences.gradient(
            values,
            point.x,
            value.vector(),
            np.full(n, self.options.step),
            np.zeros(n),
            np.ones(n),
            self.central,
            None if before is None else before.gradient,
        )
        for row, exact in enumerate(given):
            if exact is not None:
                point.gradient[row] = exact * self.span

    # The descent

    def missed(self, c):
        """The sum of what constraints miss."""
        return float(
            np.abs(c[self.equal]).sum() + np.maximum(0, -c[~self.equal]).sum()
        )

    def merit(self, point):
        return point.value.f + self.penalty * self.missed(point.c)

    def run(self, start):
        x = (np.asarray(start, float) - self.problem.low) / self.span
        point = self.evaluate(np.clip(x, 0, 1))
        if isinstance(point, Failure):
            raise StartFailed(point)
        self.unit = abs(point.value.f) or 1.0
        self.note(point, 0, taken=True)
        self.differentiate(point)
        self.path.append((0, point))
        slope = np.abs(point.gradient[0]).max() or self.unit
        self.hessian = np.eye(len(x)) * slope / (2 * self.radius)

        why = f"{self.options.max_iterations} iterations are done"
        for number in range(1, self.options.max_iterations + 1):
            if self.radius < self.options.min_radius:
                if not self.refine(point):
                    why = "no shorter step is of use (minRadius)"
                    break
            trial = self.step(point, number)
            if self.is_last(point, trial):
                if self.refine(point):
                    trial = self.step(point, number)
                if self.is_last(point, trial):
                    why = (
                        "no step is predicted to gain more than the tolerance"
                    )
                    break
            point = self.attempt(point, trial, number)
        return self.result(point, why)

    def is_last(self, point, trial):
        """Nothing to be gained, nor constraints to be met."""
        if trial.gain > self.options.tolerance * self.unit:
            return False
        missed = self.missed(point.c)
        linear = self.missed(point.c + point.jacobian @ trial.step)
        return (
            missed <= self.options.met
            or linear > 0.9 * missed
            or self.radius < self.options.min_radius
        )

    def refine(self, point):
        """From forward to central differences, once; whether that is new."""
        if self.central or self.options.scheme != "auto":
            return False
        if all(
            g is not None
            for g in (point.value.f_gradient, *(point.value.c_gradients or []))
        ):
            return False
        self.central = True
        self.differentiate(point, point)
        self.radius = max(self.radius, 2 * self.options.step)
        return True

    def attempt(self, point, trial, number):
        """Evaluate a trial step: the point that is gone on from."""
        new = self.evaluate(point.x + trial.step)
        if isinstance(new, Failure):
            self.shorten(trial, new)
            self.note(None, number, trial, note=f"failed: {new.reason}")
            return point
        ratio = self.ratio(point, new, trial)
        if ratio < TAKEN and self.missed(new.c) > self.missed(point.c):
            second = self.second_order(point, new, trial)
            if second is not None:
                new = second
                ratio = self.ratio(point, new, trial)
        length = np.abs(new.x - point.x).max()
        radius = self.radius
        if ratio < POOR:
            self.radius = 0.5 * length if ratio < TAKEN else 0.7 * length
        elif ratio > GOOD and length > 0.9 * self.radius:
            self.radius = min(2 * self.radius, LARGEST_RADIUS)
        taken = ratio >= TAKEN
        self.note(new, number, trial, point, taken, radius)
        if not taken:
            return point
        self.differentiate(new, point)
        if len(new.unknown):
            self.iterations[
                -1
            ].note += f"no differences for {len(new.unknown)} parameters"
        self.path.append((number, new))
        self.update(point, new)
        self.reach = np.minimum(1, 2 * self.reach)
        return new

    def shorten(self, trial, failure):
        """Less of the variables that are to blame, or of all."""
        size = np.abs(trial.step)
        fraction = 0.5 if failure.fraction is None else failure.fraction
        fraction = min(max(fraction, 0.1), 0.9)
        blamed = np.asarray(failure.blamed, int)
        blamed = blamed[size[blamed] > self.options.min_radius]
        if 0 < len(blamed) < len(size):
            self.reach[blamed] = (
                min(fraction, 0.7) * size[blamed] / self.radius
            )
        else:
            self.radius = size.max() * fraction

    def ratio(self, point, new, trial):
        """Gain against prediction; noise, and the rounding of f, in both."""
        noise = 2 * max(
            self.options.noise * self.unit, 1e-15 * abs(point.value.f)
        )
        gained = self.merit(point) - self.merit(new)
        return (gained + noise) / (trial.gain + noise)

    def second_order(self, point, new, trial):
        """The step corrected for the curvature of costly constraints, where
        these spoiled it; its Point, or None."""
        if not self.costly:
            return None
        c = new.c - point.jacobian @ trial.step
        found = self.program(point, c, point.jacobian)
        if np.abs(found.step - trial.step).max() < 1e-3 * self.radius:
            return None
        second = self.evaluate(point.x + found.step)
        if isinstance(second, Failure):
            return None
        return second if self.merit(second) < self.merit(new) else None

    # The subproblem

    def program(self, point, c, jacobian, turned=0):
        radius = self.radius * self.reach
        low = np.maximum(-radius, -point.x)
        high = np.minimum(radius, 1 - point.x)
        return quadratic.solve(
            self.hessian,
            point.gradient[0] + turned,
            jacobian,
            c,
            self.equal,
            low,
            high,
        )

    def step(self, point, number):
        """The next trial step: none that an exact constraint is known to
        forbid, or whose correction for these takes what it gains."""
        while True:
            trial, linear = self.candidate(point)
            if (
                self.radius < self.options.min_radius
                or linear <= self.options.tolerance * self.unit
            ):
                trial.gain = min(trial.gain, linear)
                return trial
            if trial.failure:
                self.shorten(trial, trial.failure)
                self.note(
                    None,
                    number,
                    trial,
                    note=f"not run: {trial.failure.reason}",
                )
            elif trial.gain > 0.1 * linear:
                return trial
            else:
                self.radius = 0.5 * np.abs(trial.step).max()

    def candidate(self, point):
        """A trial step for the radius, and what it would gain were all
        constraints linear."""
        found = self.program(point, point.c, point.jacobian)
        failure, before = None, self.missed(point.c)
        met = not found.relaxed.any()
        self.price(point, found, met)
        linear = self.model_gain(point, found) + self.penalty * (
            before - self.missed(point.c + point.jacobian @ found.step)
        )
        if not met or not len(point.exact[0]):
            return Trial(found.step, linear, None), linear
        found, failure = self.corrected(point, found)
        met = not found.relaxed.any()
        self.price(point, found, met)
        step = found.step
        expected = point.c + point.jacobian @ step
        there = expected.copy()
        there[self.costly :] = self.exact_after(point, step)
        gain = self.model_gain(point, found)
        gain += self.penalty * (before - self.missed(there))
        if met:
            # The model is the Lagrangian's: f, less what constraints bend
            gain += found.multipliers @ (expected - there)
        return Trial(step, gain, failure), linear

    def model_gain(self, point, found):
        step = found.step
        return -(point.gradient[0] @ step + step @ self.hessian @ step / 2)

    def price(self, point, found, met):
        """Multipliers, and the penalty: above all of them, and so high that
        it pays to come nearer to the constraints."""
        if met:
            self.multipliers = found.multipliers
            largest = np.abs(found.multipliers).max(initial=0)
            self.penalty = max(self.penalty, 1.5 * largest)
        missed = self.missed(point.c) - self.missed(
            point.c + point.jacobian @ found.step
        )
        gain = self.model_gain(point, found)
        if missed > 1e-12 and gain < 0:
            self.penalty = max(self.penalty, -gain / (0.7 * missed))

    def exact_after(self, point, step):
        if not len(point.exact[0]):
            return np.zeros(0)
        found = self.exact(point.x + step)
        if isinstance(found, Failure):
            return point.exact[0] + point.exact[1] @ step
        return found[0]

    def corrected(self, point, found):
        """The solution of the subproblem with the exact constraints as they
        are, by linearising them where the last solution was. The Hessian has
        their curvature already: the objective is turned by as much, so that
        the conditions of the optimum hold with the slopes at the point."""
        tail = slice(self.costly, None)
        equal = self.equal[tail]
        for _ in range(CORRECTIONS):
            exact = self.exact(point.x + found.step)
            if isinstance(exact, Failure):
                return found, exact
            value, slope = exact
            missed = np.where(equal, np.abs(value), -value)
            if missed.max(initial=0) <= MET:
                return found, None
            c, jacobian = point.c, point.jacobian
            turned = (slope - jacobian[tail]).T @ found.multipliers[tail]
            c[tail] = value - slope @ found.step
            jacobian[tail] = slope
            former = found.step
            found = self.program(point, c, jacobian, turned)
            if np.abs(found.step - former).max() < 1e-12:
                return found, None
        return found, None

    # The model

    def update(self, old, new):
        """Damped BFGS with the change of the Lagrangian's gradient."""
        s = new.x - old.x
        m = self.multipliers
        y = (new.gradient[0] - new.jacobian.T @ m) - (
            old.gradient[0] - old.jacobian.T @ m
        )
        known = np.ones(len(s), bool)
        known[np.asarray([*old.unknown, *new.unknown], int)] = False
        s, y = s * known, y * known
        if s @ s == 0:
            return
        # Of differences of noisy values nothing can be learned
        noise = 2 * self.options.noise * self.unit / self.options.step
        if np.linalg.norm(y) <= noise:
            return
        if not self.updated and s @ y > 0:
            scale = (y @ y) / (s @ y)
            self.hessian = np.eye(len(s)) * np.clip(
                scale, self.hessian[0, 0] / 10, self.hessian[0, 0] * 10
            )
            self.updated = True
        along = self.hessian @ s
        bent = s @ along
        if s @ y < 0.2 * bent:
            theta = 0.8 * bent / (bent - s @ y)
            y = theta * y + (1 - theta) * along
        self.hessian = definite(
            self.hessian
            - np.outer(along, along) / bent
            + np.outer(y, y) / (s @ y)
        )

    # What is said of it

    def note(
        self,
        point,
        number,
        trial=None,
        old=None,
        taken=False,
        radius=None,
        note="",
    ):
        """Tell a trial; without a point it has no values."""
        at = point.x if point else None
        self.iterations.append(
            Iteration(
                number,
                None if at is None else self.place(at),
                point.value.f if point else None,
                self.missed(point.c) if point else None,
                self.radius if radius is None else radius,
                trial.gain if trial else None,
                self.merit(old) - self.merit(point) if old else None,
                taken,
                note,
            )
        )
        self.observe(self.iterations[-1])

    def result(self, point, why):
        missed = self.missed(point.c)
        return Result(
            self.place(point.x),
            point.value,
            point.c,
            missed,
            missed <= self.options.met,
            self.multipliers,
            why,
            self.iterations,
            self.path,
        )


def definite(H):
    """The nearest matrix whose eigenvalues are positive beyond rounding."""
    values, vectors = np.linalg.eigh((H + H.T) / 2)
    floor = 1e-9 * max(values.max(), 1e-300)
    return vectors * np.maximum(values, floor) @ vectors.T


@dataclass
class Trial:
    """A step, the gain of the penalty function that is predicted for it, and
    why an exact constraint has no value there."""

    step: np.ndarray
    gain: float
    failure: Failure | None
