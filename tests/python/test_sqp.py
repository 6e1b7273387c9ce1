# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The optimiser on problems with known solutions: Hock, W., Schittkowski, K.
(1981). Test examples for nonlinear programming codes. Springer. Their numbers
and optima are the book's. Constraints are taken once as costly (linearised,
by differences) and once as exact (kept to within the step)."""

import numpy as np
import pytest
from scipy import optimize

from morphfoam.optimisation import differences, quadratic, sqp


def dot(a, x):
    return float(np.dot(a, x))


# number: f, constraints, which are equalities, bounds, start, optimum
PROBLEMS = {
    24: (
        lambda x: ((x[0] - 3) ** 2 - 9) * x[1] ** 3 / (27 * 3**0.5),
        [
            lambda x: x[0] / 3**0.5 - x[1],
            lambda x: x[0] + 3**0.5 * x[1],
            lambda x: 6 - x[0] - 3**0.5 * x[1],
        ],
        [False] * 3,
        [(0, 10)] * 2,
        [1, 0.5],
        -1,
    ),
    35: (
        lambda x: 9
        - dot([8, 6, 4], x)
        + dot([2, 2, 1], np.square(x))
        + 2 * x[0] * (x[1] + x[2]),
        [lambda x: 3 - x[0] - x[1] - 2 * x[2]],
        [False],
        [(0, 10)] * 3,
        [0.5] * 3,
        1 / 9,
    ),
    43: (
        lambda x: dot([1, 1, 2, 1], np.square(x)) - dot([5, 5, 21, -7], x),
        [
            lambda x: 8 - dot(x, x) - dot([1, -1, 1, -1], x),
            lambda x: 10 - dot([1, 2, 1, 2], np.square(x)) + x[0] + x[3],
            lambda x: 5
            - dot([2, 1, 1, 0], np.square(x))
            - dot([2, -1, 0, -1], x),
        ],
        [False] * 3,
        [(-10, 10)] * 4,
        [0] * 4,
        -44,
    ),
    65: (
        lambda x: (x[0] - x[1]) ** 2
        + (x[0] + x[1] - 10) ** 2 / 9
        + (x[2] - 5) ** 2,
        [lambda x: 48 - dot(x, x)],
        [False],
        [(-4.5, 4.5), (-4.5, 4.5), (-5, 5)],
        [-4.5, 4.5, 0],
        0.9535288567,
    ),
    71: (
        lambda x: x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2],
        [lambda x: np.prod(x) - 25, lambda x: dot(x, x) - 40],
        [False, True],
        [(1, 5)] * 4,
        [1, 5, 5, 1],
        17.0140173,
    ),
    76: (
        lambda x: dot([1, 0.5, 1, 0.5], np.square(x))
        - x[0] * x[2]
        + x[2] * x[3]
        - dot([1, 3, -1, 1], x),
        [
            lambda x: 5 - dot([1, 2, 1, 1], x),
            lambda x: 4 - dot([3, 1, 2, -1], x),
            lambda x: x[1] + 4 * x[2] - 1.5,
        ],
        [False] * 3,
        [(0, 10)] * 4,
        [0.5] * 4,
        -4.681818181,
    ),
    100: (
        lambda x: (x[0] - 10) ** 2
        + 5 * (x[1] - 12) ** 2
        + x[2] ** 4
        + 3 * (x[3] - 11) ** 2
        + 10 * x[4] ** 6
        + 7 * x[5] ** 2
        + x[6] ** 4
        - 4 * x[5] * x[6]
        - 10 * x[5]
        - 8 * x[6],
        [
            lambda x: 127
            - 2 * x[0] ** 2
            - 3 * x[1] ** 4
            - x[2]
            - 4 * x[3] ** 2
            - 5 * x[4],
            lambda x: 282 - 7 * x[0] - 3 * x[1] - 10 * x[2] ** 2 - x[3] + x[4],
            lambda x: 196 - 23 * x[0] - x[1] ** 2 - 6 * x[5] ** 2 + 8 * x[6],
            lambda x: -4 * x[0] ** 2
            - x[1] ** 2
            + 3 * x[0] * x[1]
            - 2 * x[2] ** 2
            - 5 * x[5]
            + 11 * x[6],
        ],
        [False] * 4,
        [(-10, 10)] * 7,
        [1, 2, 0, 4, 0, 1, 1],
        680.6300573,
    ),
}
KINDS = ("costly", "exact")


def slope(function, x, h=1e-6):
    return np.array(
        [
            (function(x + h * e) - function(x - h * e)) / (2 * h)
            for e in np.eye(len(x))
        ]
    )


class Known(sqp.Problem):
    """A problem of the book, with noise (of f at the start) and failures."""

    def __init__(self, number, kind="costly", noise=0, failing=0, seed=0):
        (
            self.f,
            self.constraints,
            equal,
            bounds,
            self.start,
            self.best,
        ) = PROBLEMS[number]
        self.low, self.high = np.array(bounds, float).T
        self.costly = kind == "costly"
        both = np.array(equal, bool), np.zeros(0, bool)
        self.equal, self.exact_equal = both if self.costly else both[::-1]
        self.noise, self.failing, self.calls = noise, failing, 0
        self.unit = abs(self.f(np.array(self.start, float))) or 1
        self.random = np.random.default_rng(seed)

    def evaluate(self, points, gradient):
        return [self.value(x) for x in points]

    def value(self, x):
        self.calls += 1
        if self.calls > 1 and self.random.random() < self.failing:
            return sqp.Failure("bad luck")
        noise = self.noise * self.unit * self.random.uniform(-1, 1)
        return sqp.Value(
            self.f(x) + noise,
            np.array([c(x) for c in self.constraints if self.costly]),
        )

    def exact(self, x):
        if self.costly:
            return super().exact(x)
        return (
            np.array([c(x) for c in self.constraints]),
            np.array([slope(c, x) for c in self.constraints]),
        )

    def missed(self, x):
        values = np.array([c(x) for c in self.constraints])
        equal = np.concatenate([self.equal, self.exact_equal])
        return np.where(equal, np.abs(values), np.maximum(-values, 0)).max()


SHARP = sqp.Options(
    step=1e-5,
    scheme="central",
    tolerance=1e-11,
    min_radius=1e-9,
    max_iterations=200,
)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("number", PROBLEMS)
def test_the_books_optimum_is_found(number, kind):
    problem = Known(number, kind)
    found = sqp.minimise(problem, problem.start, SHARP)
    assert found.value.f == pytest.approx(problem.best, abs=1e-6, rel=1e-6)
    assert problem.missed(found.point) < 1e-6 and found.feasible


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("number", PROBLEMS)
def test_noise_costs_no_more_than_its_size_and_that_of_the_steps(number, kind):
    """Noise of 1e-5 and differences over 1 % of the bounds: f within 2e-4,
    exact constraints met all the same."""
    for seed in range(3):
        problem = Known(number, kind, noise=1e-5, seed=seed)
        options = sqp.Options(
            noise=1e-5,
            scheme="auto",
            tolerance=2e-5,
            min_radius=1e-4,
            max_iterations=60,
        )
        found = sqp.minimise(problem, problem.start, options)
        unit = max(problem.unit, abs(problem.best))
        assert problem.f(found.point) == pytest.approx(
            problem.best, abs=2e-4 * unit
        )
        if kind == "exact":
            assert problem.missed(found.point) < 1e-6


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("number", PROBLEMS)
def test_a_fifth_of_failures_changes_nothing(number, kind):
    for seed in range(3):
        problem = Known(number, kind, failing=0.2, seed=seed)
        found = sqp.minimise(problem, problem.start, SHARP)
        assert found.value.f == pytest.approx(problem.best, abs=1e-6, rel=1e-6)


@pytest.mark.parametrize("number", PROBLEMS)
def test_it_takes_fewer_gradients_than_slsqp_or_about_as_many(number):
    """The peer is scipy's SLSQP (Kraft 1988) from the same start with the
    same bounds; both end at the same value."""
    problem = Known(number)
    own = sqp.minimise(problem, problem.start, SHARP)
    gradients = sum(i.taken for i in own.iterations)
    other = optimize.minimize(
        problem.f,
        problem.start,
        method="SLSQP",
        bounds=list(zip(problem.low, problem.high)),
        constraints=[
            {"type": "eq" if e else "ineq", "fun": c}
            for c, e in zip(problem.constraints, problem.equal)
        ],
        options={"ftol": 1e-11},
    )
    assert own.value.f <= other.fun + 1e-5 * max(1, abs(other.fun))
    assert gradients <= 1.5 * other.njev + 3


@pytest.mark.parametrize("number", PROBLEMS)
def test_nlopt_finds_the_same(number):
    """The peer is NLopt's SLSQP; where Debian's python3-nlopt is installed."""
    nlopt = pytest.importorskip("nlopt")
    problem = Known(number)
    own = sqp.minimise(problem, problem.start, SHARP)
    peer = nlopt.opt(nlopt.LD_SLSQP, len(problem.low))
    peer.set_lower_bounds(problem.low)
    peer.set_upper_bounds(problem.high)

    def with_gradient(function, sign):
        def call(x, gradient):
            if gradient.size:
                gradient[:] = sign * slope(function, x)
            return sign * float(function(x))

        return call

    peer.set_min_objective(with_gradient(problem.f, 1))
    for constraint, equal in zip(problem.constraints, problem.equal):
        call = with_gradient(constraint, -1)
        if equal:
            peer.add_equality_constraint(call, 1e-9)
        else:
            peer.add_inequality_constraint(call, 1e-9)
    peer.set_ftol_rel(1e-12)
    peer.set_maxeval(1000)
    point = peer.optimize(np.array(problem.start, float))
    assert own.value.f <= problem.f(point) + 1e-6 * max(1, abs(problem.best))


class Square(sqp.Problem):
    """x^2 + y^2 in [-1, 1]^2, failing where x < wall."""

    low, high = np.full(2, -1.0), np.ones(2)
    wall, tried, blamed = -2.0, 0, ()

    def evaluate(self, points, gradient):
        self.tried += len(points)
        return [
            sqp.Failure("it folds", 0.3, self.blamed)
            if x[0] < self.wall
            else sqp.Value(float(x @ x))
            for x in points
        ]


@pytest.mark.parametrize("blamed", [(), (0,)])
def test_a_wall_of_failures_is_gone_up_to(blamed):
    """Along it, where it is known which variable leads into it."""
    problem = Square()
    problem.wall, problem.blamed = 0.25, blamed
    found = sqp.minimise(
        problem, [0.9, 0.9], sqp.Options(max_iterations=60, min_radius=1e-5)
    )
    assert 0.25 <= found.point[0] < 0.28
    if blamed:
        assert abs(found.point[1]) < 0.02
    failed = [i for i in found.iterations if "it folds" in i.note]
    assert failed and all(i.point is None for i in failed)


def test_a_start_that_fails_is_said():
    problem = Square()
    problem.wall = 2
    with pytest.raises(sqp.StartFailed, match="it folds") as caught:
        sqp.minimise(problem, [0, 0])
    assert caught.value.failure.fraction == 0.3


def test_what_cannot_be_met_is_missed_by_the_least():
    """x + y >= 3 in [-1, 1]^2: (1, 1) misses it by 1."""

    class Far(Square):
        equal = np.array([False])

        def evaluate(self, points, gradient):
            return [
                sqp.Value(float(x @ x), np.array([x.sum() - 3]))
                for x in points
            ]

    found = sqp.minimise(Far(), [0, 0])
    assert not found.feasible
    assert found.missed == pytest.approx(1, abs=1e-6)
    assert found.point == pytest.approx([1, 1])


def test_exact_gradients_take_no_differences():
    class Exact(Square):
        def evaluate(self, points, gradient):
            assert not gradient
            return [sqp.Value(float(x @ x), f_gradient=2 * x) for x in points]

    found = sqp.minimise(Exact(), [0.9, 0.4])
    assert found.point == pytest.approx([0, 0], abs=0.02)


def test_the_same_descent_twice_takes_the_same_steps():
    """What a descent that was killed rests on."""
    runs = [
        sqp.minimise(Known(100), PROBLEMS[100][4], SHARP) for _ in range(2)
    ]
    first, second = (
        [(i.point.tolist(), i.radius) for i in r.iterations] for r in runs
    )
    assert first == second


@pytest.mark.parametrize("seed", range(20))
def test_quadratic_programs_agree_with_another_method(seed):
    """scipy's trust-region interior point method, on random programs."""
    random = np.random.default_rng(seed)
    n, m = 6, 4
    M = random.normal(size=(n, n))
    H, g = M @ M.T + 0.1 * np.eye(n), random.normal(size=n)
    A, c = random.normal(size=(m, n)), random.uniform(-0.3, 1, m)
    equal = np.array([True, False, False, False])
    low, high = np.full(n, -1.0), np.ones(n)
    own = quadratic.solve(H, g, A, c, equal, low, high)
    peer = optimize.minimize(
        lambda d: g @ d + d @ H @ d / 2,
        np.zeros(n),
        jac=lambda d: g + H @ d,
        hess=lambda d: H,
        method="trust-constr",
        bounds=list(zip(low, high)),
        constraints=optimize.LinearConstraint(
            A, -c, np.where(equal, -c, np.inf)
        ),
        options={"gtol": 1e-10, "xtol": 1e-12, "barrier_tol": 1e-10},
    )
    met = A @ own.step + c
    assert (np.where(equal, -np.abs(met), met) > -1e-9).all()
    assert g @ own.step + own.step @ H @ own.step / 2 <= peer.fun + 1e-8
    # Karush, Kuhn, Tucker: of what the bounds leave free
    free = (own.step > low + 1e-9) & (own.step < high - 1e-9)
    rest = g + H @ own.step - A.T @ own.multipliers
    assert np.abs(rest[free]).max(initial=0) < 1e-8
    assert (own.multipliers[~equal] >= 0).all()


def test_programs_that_contradict_themselves_are_relaxed_by_the_least():
    """d >= 2 with d <= 1: by 1."""
    found = quadratic.solve(
        np.eye(1),
        np.zeros(1),
        [[1.0]],
        [-2.0],
        [False],
        -np.ones(1),
        np.ones(1),
    )
    assert found.step == pytest.approx([1]) and found.relaxed == pytest.approx(
        [1]
    )


@pytest.mark.parametrize("central", (False, True))
def test_differences_turn_where_there_is_no_value(central):
    """Of x^3 + 2 y at (1, 1), above which nothing has values."""

    def values(points):
        return [
            None if p.max() > 1 else np.array([p[0] ** 3 + 2 * p[1]])
            for p in points
        ]

    found, unknown = differences.gradient(
        values,
        np.ones(2),
        np.array([3.0]),
        np.full(2, 1e-4),
        np.zeros(2),
        np.full(2, 2.0),
        central,
    )
    assert found[0] == pytest.approx([3, 2], rel=2e-4) and not len(unknown)


def test_differences_that_all_fail_keep_what_was_known():
    found, unknown = differences.gradient(
        lambda points: [None if p[1] != 0.5 else p[:1] for p in points],
        np.full(2, 0.5),
        np.array([0.5]),
        np.full(2, 0.01),
        np.zeros(2),
        np.ones(2),
        False,
        np.array([[7.0, 7.0]]),
    )
    assert found[0] == pytest.approx([1, 7]) and unknown.tolist() == [1]
