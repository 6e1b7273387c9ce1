# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Mean drag, amplitude of the lift and its frequency over the last periods of
each run, in a table (results/forces.csv and .md)."""

import math
from pathlib import Path

from morphfoam.output.tables import read_columns, write_table

here = Path(__file__).resolve().parent

period = 6


def last_periods(path):
    columns = read_columns(path)
    end = columns["Time"][-1]
    periods = 5 if end > 10 * period else 2
    first = next(
        i
        for i, t in enumerate(columns["Time"])
        if t > end - periods * period - 1e-6
    )
    return {name: values[first:] for name, values in columns.items()}


def frequency(time, signal):
    """From upward crossings of its mean, interpolated linearly."""
    mean = sum(signal) / len(signal)
    crossings = [
        t0 + (t1 - t0) * (mean - a) / (b - a)
        for t0, t1, a, b in zip(time, time[1:], signal, signal[1:])
        if a < mean <= b
    ]
    return (len(crossings) - 1) / (crossings[-1] - crossings[0])


def harmonic(time, signal):
    """Amplitude of the signal at the period of the motion, and its phase ahead
    of the displacement sin(2 pi t/period) [deg]"""
    omega = 2 * math.pi / period
    n = len(time)
    s = 2 / n * sum(x * math.sin(omega * t) for t, x in zip(time, signal))
    c = 2 / n * sum(x * math.cos(omega * t) for t, x in zip(time, signal))
    return math.hypot(s, c), math.degrees(math.atan2(c, s))


def row(name):
    (path,) = (here / "runs" / name / "postProcessing/forces").glob(
        "*/coefficient.dat"
    )
    columns = last_periods(path)
    time, drag, lift = columns["Time"], columns["Cd"], columns["Cl"]
    amplitude, phase = harmonic(time, lift)
    return {
        "run": name,
        "mean Cd": sum(drag) / len(drag),
        "Cd amplitude": (max(drag) - min(drag)) / 2,
        "Cl amplitude": (max(lift) - min(lift)) / 2,
        "lift frequency": frequency(time, lift),
        "Cl at the period": amplitude if name != "fixed" else "",
        "phase [deg]": phase if name != "fixed" else "",
    }


write_table(
    [
        row(name)
        for name in ("oscillating", "rigid", "fixed")
        if (here / "runs" / name).exists()
    ],
    here / "results/forces",
)
