# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Derivatives by differences: all points of one gradient in one batch, so that
they can be computed at once. Where a point has no value, the point on the other
side takes its place, then a nearer one; what is still missing stays what it was
at the point before."""

import numpy as np

# Fractions of the step that are tried one after the other
TRIED = (1.0, -1.0, 0.5, -0.5, 0.25, -0.25)


def gradient(evaluate, x, base, step, low, high, central, before=None):
    """Derivatives at x of what has the values base there.

    evaluate  of a list of points: a list of arrays, None where there is none
    step      of each variable
    before    the gradient that stands in where differences fail; default 0

    Returns the gradient, one row per value, and the variables of which no
    point had values.
    """
    x, base = np.asarray(x, float), np.asarray(base, float)
    n = len(x)
    result = np.full((len(base), n), np.nan)
    sides = {1: {}, -1: {}}

    for fraction in TRIED:
        wanted = [
            j for j in range(n) if not sides[1].get(j) and not sides[-1].get(j)
        ]
        take(evaluate, x, step, low, high, wanted, fraction, sides)
        if central and fraction == 1.0:
            take(evaluate, x, step, low, high, range(n), -1.0, sides)
    for j in range(n):
        ends = [sides[s][j] for s in (1, -1) if sides[s].get(j)]
        if len(ends) == 2:
            (h, up), (k, down) = ends
            # Exact for parabolas, also where the steps differ
            result[:, j] = ((up - base) / h * -k + (down - base) / k * h) / (
                h - k
            )
        elif ends:
            h, value = ends[0]
            result[:, j] = (value - base) / h
    unknown = np.flatnonzero(np.isnan(result).any(axis=0))
    result[:, unknown] = 0 if before is None else before[:, unknown]
    return result, unknown


def take(evaluate, x, step, low, high, variables, fraction, sides):
    """Values at x + fraction*step of each variable, turned inwards where that
    would leave the bounds: sides[sign][variable] = (step, values)."""
    places = []
    for j in variables:
        h = fraction * step[j]
        if not low[j] <= x[j] + h <= high[j]:
            h = -h
        if not low[j] <= x[j] + h <= high[j] or sides[np.sign(h)].get(j):
            continue
        places.append((j, h))
    points = []
    for j, h in places:
        point = x.copy()
        point[j] += h
        points.append(point)
    for (j, h), value in zip(places, evaluate(points) if points else []):
        if value is not None:
            sides[np.sign(h)][j] = (h, np.asarray(value, float))
