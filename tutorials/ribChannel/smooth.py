# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The smooth channel beside correlations: smooth.py CASE... -> results/smooth

Nu (38) by Dittus and Boelter, which holds for a channel that is heated all
around; C_f (39) by Blasius.
"""

import re
import sys
from pathlib import Path

from morphfoam.output.tables import write_table


REYNOLDS, PRANDTL = 20000, 0.71
CONDUCTIVITY = 1000 * 1e-4 / PRANDTL
NUSSELT = 0.023 * REYNOLDS**0.8 * PRANDTL**0.4
FRICTION = 0.316 * REYNOLDS**-0.25


def last(case, region, name):
    (path,) = Path(case).glob(
        f"postProcessing/{region}/{name}/*/surfaceFieldValue.dat"
    )
    return float(path.read_text().split()[-1])


def row(case):
    bulk = 0.5 * (
        last(case, "fluid", "bulkTemperature")
        + last(case, "fluid", "outletTemperature")
    )
    wall = last(case, "solid", "wallTemperature")
    log = (Path(case) / "log.conservativeChtSimpleFoam").read_text()
    gradient = float(re.findall(r"pressure gradient = (\S+)", log)[-1])
    nusselt, friction = (
        100 * 2 / (CONDUCTIVITY * (wall - bulk)),
        gradient * 2 / 0.5,
    )
    return {
        "case": Path(case).name,
        "Nu": nusselt,
        "Nu/Nu0": nusselt / NUSSELT,
        "Cf": friction,
        "Cf/Cf0": friction / FRICTION,
    }


if __name__ == "__main__":
    write_table([row(case) for case in sys.argv[1:]], "results/smooth")
