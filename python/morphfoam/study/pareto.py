# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The best trade-offs: NSGA-II, and the clusters of its front.

NSGA-II: Deb et al. 2002, IEEE Trans. Evol. Comput. 6, 182-197, doi
10.1109/4235.996017, as DEAP has it; with their constrained domination: any
feasible point is better than any other, and of two infeasible ones that which
violates the constraints less. Clusters: Gaussian mixtures (Bishop 2006, chapter
9), their number by the Bayesian information criterion.
"""

import random
import warnings

import numpy as np

# Share of the bounds below which two optima count as the same shape
SAME = 0.01
# Distribution indices and probabilities of Deb et al.
ETA_CROSSOVER, ETA_MUTATION, CROSSOVER = 20, 20, 0.9
INFEASIBLE = 1e30


class Infeasible(Exception):
    """No point keeps to the constraints; the one that misses them least."""

    def __init__(self, point):
        super().__init__("no point keeps to the constraints")
        self.point = np.array(point)


def nsga2(
    evaluate,
    lows,
    highs,
    signs,
    population,
    generations,
    seed,
    nearest=np.asarray,
):
    """The front: points (rows) and objectives. Raises Infeasible.

    evaluate   rows of points -> rows of objectives, violation of each row
    signs      +1 for an objective to maximise, -1 to minimise
    nearest    rows of points -> the nearest ones that may be taken
    """
    from deap import base, tools

    class Fitness(base.Fitness):
        weights = tuple(float(s) for s in signs)

    class Individual(list):
        def __init__(self, values):
            super().__init__(values)
            self.fitness = Fitness()

    def rate(individuals):
        allowed = nearest(np.array(individuals))
        for item, row in zip(individuals, allowed):
            item[:] = map(float, row)
        objectives, violation = evaluate(allowed)
        for item, values, missed in zip(individuals, objectives, violation):
            if missed > 0:
                values = -np.array(signs) * INFEASIBLE * (1 + missed)
            item.fitness.values = tuple(map(float, values))

    def children(parents):
        made = [Individual(p) for p in parents]
        for a, b in zip(made[::2], made[1::2]):
            if random.random() < CROSSOVER:
                tools.cxSimulatedBinaryBounded(
                    a, b, ETA_CROSSOVER, list(lows), list(highs)
                )
        for item in made:
            tools.mutPolynomialBounded(
                item, ETA_MUTATION, list(lows), list(highs), 1 / len(lows)
            )
        return made

    random.seed(seed)
    start = np.random.default_rng(seed).uniform(
        lows, highs, (population, len(lows))
    )
    people = [Individual(map(float, row)) for row in start]
    rate(people)
    people = tools.selNSGA2(people, population)
    for _ in range(generations):
        made = children(tools.selTournamentDCD(people, population))
        rate(made)
        people = tools.selNSGA2(people + made, population)

    front = tools.sortNondominated(people, population, first_front_only=True)[
        0
    ]
    feasible = [p for p in front if abs(p.fitness.values[0]) < INFEASIBLE]
    if not feasible:
        raise Infeasible(max(people, key=lambda p: p.fitness))
    rows = {tuple(p): p.fitness.values for p in feasible}
    order = sorted(rows, key=lambda row: rows[row])
    return (
        np.array(order).reshape(-1, len(lows)),
        np.array([rows[row] for row in order]).reshape(-1, len(signs)),
    )


def clusters(points, lows, highs, most, seed):
    """Cluster of each point of the front, the index of each cluster's
    representative (its point nearest to the centre), and the BIC of 1, 2, ...
    clusters."""
    from sklearn.mixture import GaussianMixture

    x = (points - lows) / (highs - lows)
    if len(x) == 1:
        return np.zeros(1, int), [0], []
    mixtures = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for count in range(1, min(most, len(x) // (2 * x.shape[1]) or 1) + 1):
            mixtures.append(
                GaussianMixture(
                    count, reg_covar=SAME**2, n_init=5, random_state=seed
                ).fit(x)
            )
    bic = [m.bic(x) for m in mixtures]
    best = mixtures[int(np.argmin(bic))]
    label = best.predict(x)
    representatives = []
    for k in np.unique(label):
        off = x - best.means_[k]
        far = np.einsum("ij,jk,ik->i", off, best.precisions_[k], off)
        far[label != k] = np.inf
        representatives.append(int(far.argmin()))
    return label, representatives, bic
