# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Iterations and forces on the pitched meshes: restarted against started anew.

Run after Allrun's flow solutions; writes results/restart.csv and .md and
prints the table.
"""

import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "scripts"))
from foamOutput import iterations, readColumns, writeTable  # noqa: E402


def row(angle, start):
    case = here / f"runs/{start}{angle}"
    steps, converged = iterations(case / "log.simpleFoam")
    output, = (case / "postProcessing/forces").glob("*/coefficient.dat")
    forces = readColumns(output)
    return {
        "pitch [deg]": angle,
        "start": {"pitched": "restart", "uniform": "uniform"}[start],
        "iterations": steps,
        "converged": "yes" if converged else "no",
        "Cl": forces["Cl"][-1],
        "Cd": forces["Cd"][-1],
        "Cm": forces["CmPitch"][-1],
    }


writeTable(
    [row(a, start) for a in (1, 10) for start in ("pitched", "uniform")],
    here / "results/restart",
)
