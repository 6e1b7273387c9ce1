#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Writes the set of 100,000 candidates: generate.py FILE [COUNT]

A unit box. In it a sphere that turns and moves, a ring that is bent and
twisted, and a wing that flaps in a smooth wave are prescribed; five walls are
fixed; on the floor points slide. The same points every time: they come from an
additive recurrence, not from random numbers.
"""

import sys

import numpy as np

SUPPORT_RADIUS = 0.6


def pairs(count):
    """Evenly spread points of the unit square (R2 sequence)."""
    g = 1.32471795724474602596
    i = np.arange(1, count + 1)
    return (0.5 + i / g) % 1, (0.5 + i / g**2) % 1


def turned(x, axis, angle):
    """x turned about an axis through the origin (Rodrigues)."""
    k = np.asarray(axis, float) / np.linalg.norm(axis)
    angle = np.broadcast_to(np.asarray(angle, float), len(x))[:, None]
    return (
        x * np.cos(angle)
        + np.cross(k, x) * np.sin(angle)
        + np.outer(x @ k, k) * (1 - np.cos(angle))
    )


def sphere(count):
    u, v = pairs(count)
    phi, z = 2 * np.pi * u, 2 * v - 1
    s = np.sqrt(1 - z * z)
    local = 0.12 * np.column_stack((s * np.cos(phi), s * np.sin(phi), z))
    moved = turned(local, (1, 2, 3), 0.35) + (0.03, 0.02, -0.02)
    return local + (0.25, 0.3, 0.5), moved - local


def ring(count):
    u, v = pairs(count)
    phi, psi = 2 * np.pi * u, 2 * np.pi * v
    radius = 0.15 + 0.04 * np.cos(psi)
    local = np.column_stack(
        (radius * np.cos(phi), radius * np.sin(phi), 0.04 * np.sin(psi))
    )
    bent = local + np.outer(0.03 * np.cos(2 * phi), (0, 0, 1))
    moved = turned(bent, (0, 0, 1), 0.2 * np.cos(phi))
    return local + (0.7, 0.7, 0.35), moved - local


def wing(count):
    u, v = pairs(count)
    theta, span = 2 * np.pi * u, v
    chord = 0.25 * (1 - 0.4 * span)
    local = np.column_stack(
        (
            chord * (0.5 * np.cos(theta) + 0.2 * span),
            0.5 * span,
            0.06 * chord * np.sin(theta) * (1.2 - np.cos(theta)),
        )
    )
    moved = turned(local, (0, 1, 0), 0.3 * span**2)
    moved[:, 2] += 0.06 * span**2 * np.cos(3 * span)
    return local + (0.6, 0.08, 0.72), moved - local


def walls(count):
    """The faces of the unit box but for the floor z = 0."""
    x = []
    for face in range(5):
        u, v = pairs(count // 5 + (face < count % 5))
        side = np.full_like(u, face % 2)
        columns = ((side, u, v), (u, side, v), (u, v, side + 1))[face // 2]
        x.append(np.column_stack(columns))
    return np.concatenate(x)


def write(file, count=100000):
    inside = int(0.22 * count)
    bodies = [shape(inside) for shape in (sphere, ring, wing)]
    n_floor = int(0.1 * count)
    u, v = pairs(n_floor)
    floor = np.column_stack((u, v, np.zeros(n_floor)))
    wall = walls(count - 3 * inside - n_floor)

    x = np.concatenate([b[0] for b in bodies] + [wall, floor])
    s = np.concatenate(
        [b[1] for b in bodies] + [np.zeros((len(wall) + n_floor, 3))]
    )
    k = np.full(count, 3)
    k[-n_floor:] = 1
    normal = np.zeros((count, 3))
    normal[-n_floor:, 2] = 1

    with open(file, "w") as out:
        out.write(
            f"# name=box{count//1000}k dim=3 r0={SUPPORT_RADIUS} "
            f"smax={np.linalg.norm(s, axis=1).max():.17g} n={count}\n"
        )
        np.savetxt(
            out,
            np.column_stack((x, k, normal, np.zeros((count, 3)), s)),
            fmt=["%.17g"] * 3 + ["%d"] + ["%.17g"] * 9,
        )


if __name__ == "__main__":
    write(sys.argv[1], *map(int, sys.argv[2:3]))
