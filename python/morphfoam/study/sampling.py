# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Designs in a box under constraints: factorial, Latin hypercube, Sobol.

Each method is given the points there are and returns the points to add; those
there are stay. Points are rows in the parameters' units.

Latin hypercube: every parameter's range is cut into as many strata as there are
designs, of equal share of the feasible set (equal width, without constraints),
and each stratum of each parameter holds one design; of all such designs one of
small phi_p = (sum d_ij^-p)^(1/p), p = 15, is sought by exchanging coordinates
(Morris and Mitchell 1995, J. Statist. Plann. Inference 43, 381-402,
doi 10.1016/0378-3758(94)00035-T), which for large p is maximin. Strata of the
feasible set: the conditioned Latin hypercube (Minasny and McBratney 2006,
Computers & Geosciences 32, 1378-1388, doi 10.1016/j.cageo.2005.12.009).
"""

import csv
import itertools
import math

import numpy as np
from scipy.stats import qmc

from .errors import StudyError

P = 15
# Random points on which a feasible set is judged
PROBES = 2**16
EXCHANGES = 20000


def sample(study, existing):
    """The points to add to the existing ones, as the study file asks."""
    existing = np.asarray(existing, dtype=float).reshape(-1, len(study.names))
    if study.sampling.method in ("latinHypercube", "sobol"):
        check_enough(study)
    return METHODS[study.sampling.method](study, existing)


def check_enough(study):
    """Where all parameters have certain values only, there may be fewer designs
    than are asked for."""
    if len(study.discrete) < len(study.names):
        return
    counts = [len(p.values) for p in study.parameters]
    if math.prod(counts) > PROBES:
        return
    grid = itertools.product(*(p.values for p in study.parameters))
    there_are = int(study.feasible(np.array(list(grid))).sum())
    if study.sampling.designs > there_are:
        raise StudyError(
            f"sampling/designs is {study.sampling.designs}, but the values of"
            f" the parameters make {there_are} designs that keep to all"
            f" constraints. Use {there_are}, or the method factorial"
        )


def feasible_probes(study):
    """Feasible points, uniformly spread, and their share of the box."""
    random = np.random.default_rng(0)
    unit = random.random((PROBES, len(study.names)))
    points = study.spread(study.lows + unit * (study.highs - study.lows))
    points = points[study.feasible(points)]
    if not len(points):
        raise StudyError(
            f"constraints: none of {PROBES} random points between the bounds"
            " keeps to all of them, so there is nothing to sample. The"
            " constraints: "
            + "; ".join(c.text for c in study.constraints)
            + ". Widen bounds, or correct the constraint"
        )
    return points, len(points) / PROBES


def is_new(point, points, study):
    """Whether a point is none of those there are."""
    return (
        not len(points)
        or np.abs((points - point) / (study.highs - study.lows))
        .max(axis=1)
        .min()
        > 1e-9
    )


def missing(study, existing):
    return max(0, study.sampling.designs - len(existing))


def factorial(study, existing):
    """The grid, without what breaks a constraint."""
    axes = [
        np.unique(
            p.nearest(
                [(p.low + p.high) / 2]
                if study.sampling.levels[p.name] == 1
                else np.linspace(p.low, p.high, study.sampling.levels[p.name])
            )
        )
        for p in study.parameters
    ]
    grid = np.array(list(itertools.product(*axes)))
    grid = grid[study.feasible(grid)]
    if not len(grid):
        raise StudyError(
            "sampling/levels: no point of the grid keeps to all constraints."
            " Use more levels, or another method"
        )
    return np.array([p for p in grid if is_new(p, existing, study)]).reshape(
        -1, len(study.names)
    )


def sobol(study, existing):
    """The scrambled sequence, in its order, without what is infeasible."""
    feasible_probes(study)
    sequence = qmc.Sobol(len(study.names), seed=study.sampling.seed)
    added, block = [], 64
    while len(added) < missing(study, existing):
        points = study.spread(
            study.lows + sequence.random(block) * (study.highs - study.lows)
        )
        for p in points[study.feasible(points)]:
            there = np.vstack([existing, *added]) if added else existing
            if is_new(p, there, study):
                added.append(p)
    return np.array(added[: missing(study, existing)]).reshape(
        -1, len(study.names)
    )


class HyperCube:
    """Points to add, by their strata; exchanged until feasible and far apart.

    In units of the box. Column j of 'strata' holds the stratum of each new
    point, each free stratum at most once.
    """

    def __init__(self, study, existing, count, random, probes):
        self.study, self.random = study, random
        self.span = study.highs - study.lows
        self.fixed = (existing - study.lows) / self.span
        self.total = len(existing) + count
        probes = (probes - study.lows) / self.span
        d = probes.shape[1]
        if study.constraints:
            shares = np.linspace(0, 1, self.total + 1)
            self.edges = np.quantile(probes, shares, axis=0)
        else:
            self.edges = np.repeat(
                np.linspace(0, 1, self.total + 1)[:, None], d, axis=1
            )
        self.strata = np.stack(
            [self._free_strata(j, count) for j in range(d)], axis=1
        )
        self.within = random.random((count, d))
        self.points = self.place(np.arange(count))
        self.feasible = self._feasible(self.points)

    def _free_strata(self, j, count):
        """Strata of parameter j that hold no existing design, in random
        order; where there are more than needed, evenly spread ones."""
        taken = np.clip(
            np.searchsorted(self.edges[:, j], self.fixed[:, j], side="right")
            - 1,
            0,
            self.total - 1,
        )
        free = np.setdiff1d(np.arange(self.total), taken)
        chosen = free[
            ((np.arange(count) + 0.5) * len(free) / count).astype(int)
        ]
        return self.random.permutation(chosen)

    def place(self, rows):
        columns = np.arange(self.strata.shape[1])
        low = self.edges[self.strata[rows], columns]
        high = self.edges[self.strata[rows] + 1, columns]
        return low + self.within[rows] * (high - low)

    def _feasible(self, points):
        return self.study.feasible(
            self.study.spread(self.study.lows + points * self.span)
        )

    def _distances(self, rows):
        """phi_p's terms of these points with all others: d^-p."""
        others = np.vstack([self.points, self.fixed])
        d = np.linalg.norm(rows[:, None, :] - others[None], axis=2)
        return np.where(d > 0, np.maximum(d, 1e-12), np.inf) ** -P

    def _energy(self, rows):
        """The part of phi_p^p in which these points have a share."""
        d = self._distances(self.points[rows])
        return d.sum() - d[:, rows].sum() / 2

    def exchange(self):
        """Let two points exchange the stratum of one parameter, or one move
        within it; keep what makes more of them feasible, or else phi_p
        smaller."""
        count, d = self.points.shape
        bad = np.flatnonzero(~self.feasible)
        a = self.random.choice(bad if len(bad) else count)
        b = self.random.integers(count)
        j = self.random.integers(d)
        rows = [a] if a == b else [a, b]
        old = [x[rows].copy() for x in self._state()]
        before = self._energy(rows)

        if a != b:
            self.strata[rows, j] = self.strata[rows[::-1], j]
        self.within[rows, j] = self.random.random(len(rows))
        self.points[rows] = self.place(rows)
        self.feasible[rows] = self._feasible(self.points[rows])

        gain = int(self.feasible[rows].sum()) - int(old[3].sum())
        if gain < 0 or gain == 0 and self._energy(rows) >= before:
            for x, values in zip(self._state(), old):
                x[rows] = values

    def _state(self):
        return self.strata, self.within, self.points, self.feasible

    def replace_infeasible(self, probes):
        """Points for which no stratum was left that would do: the feasible
        ones farthest from all others."""
        probes = (probes[:4096] - self.study.lows) / self.span
        for i in np.flatnonzero(~self.feasible):
            others = np.vstack([self.points[self.feasible], self.fixed])
            d = np.linalg.norm(probes[:, None] - others[None], axis=2)
            self.points[i] = (
                probes[d.min(axis=1).argmax()] if len(others) else probes[0]
            )
            self.feasible[i] = True


def latin_hypercube(study, existing):
    """One design in each stratum of each parameter, far from each other."""
    count = missing(study, existing)
    if count == 0:
        return np.empty((0, len(study.names)))
    probes, _ = feasible_probes(study)
    random = np.random.default_rng([study.sampling.seed, len(existing)])
    cube = HyperCube(study, existing, count, random, probes)
    for _ in range(min(EXCHANGES, 100 * cube.points.size)):
        cube.exchange()
    cube.replace_infeasible(probes)
    points = study.lows + cube.points * cube.span
    return without_twins(study, existing, points, probes)


def without_twins(study, existing, points, probes):
    """Points with the values that parameters may have; of those that are one
    another's equal then all but one become the probes farthest from all."""
    if not study.discrete:
        return points
    span = study.highs - study.lows
    kept, twins = [], 0
    for point in study.spread(points):
        if is_new(point, np.vstack([existing, *kept]), study):
            kept.append(point)
        else:
            twins += 1
    probes = np.unique(probes, axis=0)
    for _ in range(twins):
        others = np.vstack([existing, *kept]) / span
        d = np.linalg.norm(probes[:, None] / span - others[None], axis=2)
        kept.append(probes[d.min(axis=1).argmax()])
    return np.array(kept)


def table(study, existing):
    """The rows of a table with a column for each parameter, as others have
    chosen them."""
    path = study.root / study.sampling.file
    try:
        with path.open() as file:
            rows = list(csv.DictReader(file))
        points = np.array(
            [[float(row[name]) for name in study.names] for row in rows]
        ).reshape(-1, len(study.names))
    except OSError as error:
        raise StudyError(
            f"sampling/file: {path} cannot be read: {error.strerror}"
        ) from None
    except (KeyError, TypeError, ValueError) as error:
        raise StudyError(
            f"sampling/file: {path} must be a table (.csv) with a column of"
            f" numbers for each of {' '.join(study.names)}; wrong is {error}"
        ) from None
    off = np.abs(study.nearest(points) - points) > 1e-9 * (
        study.highs - study.lows
    )
    if off.any():
        row, column = np.argwhere(off)[0]
        raise StudyError(
            f"sampling/file: row {row + 1} of {path} has {study.names[column]}"
            f" {points[row, column]:g}, which is none of its values. Correct"
            " it, or the parameter"
        )
    bad = np.flatnonzero(~study.feasible(points))
    if len(bad):
        row = dict(zip(study.names, points[bad[0]]))
        raise StudyError(
            f"sampling/file: row {bad[0] + 1} of {path} breaks"
            f" {study.broken(row)[0]}. Correct it, or the constraint"
        )
    return np.array([p for p in points if is_new(p, existing, study)]).reshape(
        -1, len(study.names)
    )


METHODS = {
    "table": table,
    "factorial": factorial,
    "sobol": sobol,
    "latinHypercube": latin_hypercube,
}


def smallest_distance(study, points):
    """Of any two designs, in units of the bounds."""
    unit = (points - study.lows) / (study.highs - study.lows)
    d = np.linalg.norm(unit[:, None] - unit[None], axis=2)
    np.fill_diagonal(d, np.inf)
    return d.min()
