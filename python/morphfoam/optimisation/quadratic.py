# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Convex quadratic programs

    min g.d + d.H.d/2   with  A d + c >= 0 (= 0 where equal),  low <= d <= high

turned into least distance programs, which non-negative least squares solve in
finitely many steps (Lawson, C. L., Hanson, R. J. (1974). Solving least squares
problems. Prentice-Hall, chapter 23). Constraints that contradict each other
are relaxed by the least sum, which a linear program finds.
"""

from dataclasses import dataclass

import numpy as np
from scipy import linalg, optimize

# Of a residual of 1 at most: contradictory
CONTRADICTORY = 1e-10
# By which relaxed constraints are made sure to have room
ROOM = 1e-9


@dataclass
class Solution:
    """step         d
    multipliers  of the rows of A; not negative for inequalities
    relaxed      by how much each row had to be relaxed, in its own units;
                 signed for equalities
    """

    step: np.ndarray
    multipliers: np.ndarray
    relaxed: np.ndarray


def solve(H, g, A, c, equal, low, high):
    """The solution; constraints relaxed where they contradict each other."""
    A = np.asarray(A, dtype=float).reshape(-1, len(g))
    c, equal = np.asarray(c, dtype=float), np.asarray(equal, dtype=bool)
    none = np.zeros(len(c))
    found = program(H, g, A, c, equal, low, high)
    if found is None:
        relaxed = relaxation(A, c, equal, low, high)
        slack = np.where(equal, relaxed, np.maximum(relaxed, 0))
        room = ROOM * np.maximum(1, np.abs(c)) * (relaxed != 0)
        found = program(
            H, g, A, c + slack + np.where(equal, 0, room), equal, low, high
        )
        if found is None:
            # Equalities that meet in the box's corner alone
            step = nearest(A, c, equal, low, high)[0]
            return Solution(step, none, slack)
        return Solution(*found, slack)
    return Solution(*found, none)


def program(H, g, A, c, equal, low, high):
    """Step and multipliers, or None where the constraints contradict each
    other. Variables that equalities fix are eliminated."""
    n = len(g)
    if equal.any():
        E, e = A[equal], c[equal]
        start = np.linalg.lstsq(E, -e, rcond=None)[0]
        scale = np.abs(E).max(axis=1) + np.abs(e) + 1e-300
        if (np.abs(E @ start + e) > 1e-9 * scale).any():
            return None
        Z = linalg.null_space(E)
    else:
        start, Z = np.zeros(n), np.eye(n)

    rows = np.vstack([A[~equal], np.eye(n), -np.eye(n)])
    limits = np.concatenate([-c[~equal], low, -high])
    limits = limits - rows @ start
    if Z.shape[1] == 0:
        if (limits > 1e-9 * (1 + np.abs(limits))).any():
            return None
        w, pushed = np.zeros(0), np.zeros(len(rows))
    else:
        found = least_distance(
            Z.T @ H @ Z, Z.T @ (g + H @ start), rows @ Z, limits
        )
        if found is None:
            return None
        w, pushed = found
    step = np.clip(start + Z @ w, low, high)
    multipliers = np.zeros(len(c))
    multipliers[~equal] = pushed[: (~equal).sum()]
    if equal.any():
        # What of the gradient the inequalities do not carry
        rest = g + H @ step - rows.T @ pushed
        multipliers[equal] = np.linalg.lstsq(A[equal].T, rest, rcond=None)[0]
    return step, multipliers


def least_distance(H, g, G, h):
    """min g.w + w.H.w/2 with G w >= h: w and multipliers, or None."""
    R = linalg.cholesky(H)
    shift = linalg.solve_triangular(R, g, trans="T")
    rows = linalg.solve_triangular(R, G.T, trans="T").T
    limits = h + rows @ shift
    size = np.linalg.norm(rows, axis=1)
    empty = size < 1e-12 * max(size.max(initial=0), 1e-300)
    if (limits[empty] > 1e-9).any():
        return None
    size = np.where(empty, 1, size)
    rows, limits = rows / size[:, None], limits / size
    rows[empty], limits[empty] = 0, -1
    # Least distance: the unit is that of the farthest limit
    unit = np.abs(limits).max(initial=0) or 1.0
    E = np.vstack([rows.T, limits / unit])
    f = np.zeros(len(E))
    f[-1] = 1
    pushed, _ = optimize.nnls(E, f, maxiter=50 * E.shape[1])
    residual = E @ pushed - f
    if -residual[-1] < CONTRADICTORY:
        return None
    y = -residual[:-1] / residual[-1] * unit
    w = linalg.solve_triangular(R, y - shift)
    return w, pushed / -residual[-1] * unit / size


def nearest(A, c, equal, low, high):
    """The step at which the sum of what the constraints miss is least, and
    what each of them misses there."""
    n, m = len(low), len(c)
    both = equal.astype(float)
    slack = np.hstack([np.eye(m), -np.diag(both)])
    found = optimize.linprog(
        np.concatenate([np.zeros(n), np.ones(m), both + (~equal) * 1e-6]),
        A_ub=-np.hstack([A, slack])[~equal],
        b_ub=c[~equal],
        A_eq=np.hstack([A, slack])[equal] if equal.any() else None,
        b_eq=-c[equal] if equal.any() else None,
        bounds=[*zip(low, high), *[(0, None)] * (2 * m)],
        method="highs",
    )
    return found.x[:n], found.x[n : n + m] - both * found.x[n + m :]


def relaxation(A, c, equal, low, high):
    """By how much each constraint has to be relaxed, their sum least."""
    step = nearest(A, c, equal, low, high)[0]
    missed = A @ step + c
    return np.where(equal, -missed, np.maximum(0, -missed))
