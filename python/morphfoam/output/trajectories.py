# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The motion of a body as two solvers found it, compared.

    compare(ours, reference, "rigidBody", ["sway [m]", "pitch [deg]"], output)

A motion is the times and, for each of the names, the values at them.
"""

from morphfoam.output.tables import write_table


def at(time, times, values):
    """Between the times linear."""
    after = next(i for i, t in enumerate(times) if t >= time - 1e-9)
    if after == 0:
        return values[0]
    part = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + part * (values[after] - values[after - 1])


def compare(ours, reference, name, motions, output):
    """A table (csv and md) of the largest values and the largest difference,
    at the times of the reference that both have."""
    end = min(ours[0][-1], reference[0][-1])
    times = [t for t in reference[0] if t <= end]
    rows = []
    for i, motion in enumerate(motions, 1):
        a = [at(t, ours[0], ours[i]) for t in times]
        b = [at(t, reference[0], reference[i]) for t in times]
        largest = max(map(abs, b))
        rows.append(
            {
                "motion": motion,
                "largest, rbf": max(map(abs, a)),
                f"largest, {name}": largest,
                "largest difference, of that": max(
                    abs(x - y) for x, y in zip(a, b)
                )
                / largest,
            }
        )
    write_table(rows, output)
