# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The frequency of the plate against its closed form, the work on both sides of
the interface, residuals, and what the restart changed (results/plate.md).

In a basin with slip walls that is open above, the mode cos(kx), k = pi/L, of a
plate whose ends slide and do not turn carries the mass rho tanh(kH)/k of an
inviscid, incompressible fluid: omega^2 = B k^4/(m + rho tanh(kH)/k).
"""

import math
import re
from pathlib import Path

import numpy as np

from morphfoam.output.tables import write_table

here = Path(__file__).resolve().parent
RELEASED = 0.5


def constants():
    text = (here / "plate.py").read_text()
    return {
        name: float(re.search(rf"^{name} = ([\d.]+)", text, re.MULTILINE)[1])
        for name in ("DENSITY", "MASS", "STIFFNESS", "DELTA_T")
    }


def history(name):
    """Time, amplitude, work of the flow in the step, residual."""
    return np.loadtxt(
        here / "runs" / name / "plate/history.csv", delimiter=",", ndmin=2
    )


def frequency(amplitudes, dt):
    """Of a damped oscillation, from y(n+1) - c y(n) + d y(n-1) = 0."""
    y = amplitudes
    c, d = np.linalg.lstsq(
        np.column_stack([y[1:-1], -y[:-2]]), y[2:], rcond=None
    )[0]
    return math.acos(c / (2 * math.sqrt(d))) / (2 * math.pi * dt)


def numbers(path, pattern, n, width):
    text = path.read_text()
    start = re.search(pattern, text).end()
    body = text[start:].split("\n)", 1)[0].replace("(", " ").replace(")", " ")
    return np.array(body.split()[: n * width], float).reshape(n, width)


def flow_work(name, times, n):
    """Of the flow on the plate in each step: pressures of the first cells and
    what the faces of the mesh have swept."""
    pressures, heights = [], []
    for time in times:
        folder = here / "runs" / name / f"{time:g}"
        pressures.append(
            numbers(folder / "p", r"nonuniform List<scalar>\s*\d+\s*\(", n, 1)
        )
        heights.append(
            numbers(folder / "polyMesh/points", r"\n\d+\s*\(", n + 1, 3)[:, 2]
        )
    p = constants()["DENSITY"] * np.array(pressures)[:, :, 0]
    z = np.array(heights)
    swept = 0.5 * (np.diff(z, axis=0)[:, 1:] + np.diff(z, axis=0)[:, :-1])
    return -(0.5 * (p[1:] + p[:-1]) * swept).sum(axis=1) * 0.1 / n


def main():
    given = constants()
    k = math.pi
    mass = given["MASS"] + given["DENSITY"] * math.tanh(k) / k
    exact = math.sqrt(given["STIFFNESS"] * k**4 / mass) / (2 * math.pi)
    whole = history("whole")
    free = whole[whole[:, 0] > RELEASED]

    plate = np.cumsum(whole[1:, 2])
    flow = np.cumsum(flow_work("whole", whole[:, 0], 64))
    rows = [{"figure": "frequency, closed form [Hz]", "value": exact}]
    # A run that ends sooner has not swung freely
    if len(free) > 4:
        measured = frequency(free[:, 1], given["DELTA_T"])
        rows += [
            {"figure": "frequency, measured [Hz]", "value": measured},
            {"figure": "difference", "value": measured / exact - 1},
        ]
    rows += [
        {
            "figure": "frequency in vacuo [Hz]",
            "value": math.sqrt(given["STIFFNESS"] * k**4 / given["MASS"])
            / (2 * math.pi),
        },
        {
            "figure": "largest amplitude [m]",
            "value": np.abs(whole[:, 1]).max(),
        },
        {
            "figure": "work at the interface, largest difference of the "
            "largest",
            "value": np.abs(plate - flow).max() / np.abs(flow).max(),
        },
        {
            "figure": "residual, median of the steps",
            "value": np.median(whole[:, 3]),
        },
    ]
    if len(whole) > 3:
        rows.append(
            {
                "figure": "residual, largest after the third step",
                "value": whole[3:, 3].max(),
            }
        )
    if (here / "runs/restarted/plate/history.csv").exists():
        again = history("restarted")
        _, i, j = np.intersect1d(whole[:, 0], again[:, 0], return_indices=True)
        rows.append(
            {
                "figure": "restarted on two ranks, largest difference of the "
                "amplitude",
                "value": np.abs(whole[i, 1] - again[j, 1]).max()
                / np.abs(whole[:, 1]).max(),
            }
        )
    write_table(rows, here / "results/plate")


if __name__ == "__main__":
    main()
