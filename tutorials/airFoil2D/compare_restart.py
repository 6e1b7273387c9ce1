# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Iterations and forces on the pitched meshes: restarted against started anew.

Run after Allrun's flow solutions; writes results/restart.csv and .md and
prints the table.
"""

from pathlib import Path

from morphfoam.output.tables import iterations, read_columns, write_table

here = Path(__file__).resolve().parent


def row(angle, start):
    case = here / f"runs/{start}{angle}"
    steps, converged = iterations(case / "log.simpleFoam")
    (output,) = (case / "postProcessing/forces").glob("*/coefficient.dat")
    forces = read_columns(output)
    return {
        "pitch [deg]": angle,
        "start": {"pitched": "restart", "uniform": "uniform"}[start],
        "iterations": steps,
        "converged": "yes" if converged else "no",
        "Cl": forces["Cl"][-1],
        "Cd": forces["Cd"][-1],
        "Cm": forces["CmPitch"][-1],
    }


write_table(
    [row(a, start) for a in (1, 10) for start in ("pitched", "uniform")],
    here / "results/restart",
)
