# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Which parameters matter: of a function that costs nothing to evaluate, of
gradients at some points, of a path."""

import numpy as np
from scipy.stats import qmc


def total_indices(function, low, high, samples=2**12, seed=1):
    """First-order and total Sobol indices, by the estimators of Saltelli et
    al. (2010) and Jansen (1999) (Saltelli, A., et al. (2010). Comput. Phys.
    Commun. 181, 259-270, doi 10.1016/j.cpc.2009.09.018)."""
    n = len(low)
    units = qmc.Sobol(2 * n, seed=seed).random(samples)
    points = np.asarray(low) + np.hstack([units[:, :n], units[:, n:]]).reshape(
        samples, 2, n
    ) * (np.asarray(high) - low)
    a, b = points[:, 0], points[:, 1]
    at_a, at_b = function(a), function(b)
    variance = np.var(np.concatenate([at_a, at_b]))
    first, total = np.zeros(n), np.zeros(n)
    if variance == 0:
        return first, total
    for j in range(n):
        mixed = a.copy()
        mixed[:, j] = b[:, j]
        at_mixed = function(mixed)
        first[j] = np.mean(at_b * (at_mixed - at_a)) / variance
        total[j] = np.mean((at_a - at_mixed) ** 2) / (2 * variance)
    return first, total


def active_subspace(gradients):
    """Eigenvalues of the mean of g g^T, the largest first, with their
    directions as columns (Constantine, P. G. (2015). Active subspaces. SIAM);
    and each variable's activity, the sum of eigenvalue times squared component
    (Constantine, P. G., Diaz, P. (2017). Reliab. Eng. Syst. Saf. 162, 1-13, doi
    10.1016/j.ress.2017.01.013), which with all directions is the mean squared
    derivative."""
    g = np.asarray(gradients, float)
    values, vectors = np.linalg.eigh(g.T @ g / len(g))
    return values[::-1], vectors[:, ::-1], (g**2).mean(axis=0)


def contributions(path, gradients):
    """What each variable contributed to the change of a function along a path:
    the integral of its derivative over its way, by the trapezoidal rule. The
    sum is the change."""
    x, g = np.asarray(path, float), np.asarray(gradients, float)
    return ((g[1:] + g[:-1]) / 2 * np.diff(x, axis=0)).sum(axis=0)
