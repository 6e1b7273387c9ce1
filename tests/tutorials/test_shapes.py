# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The tutorials of axes, bulk parameters and constraints: wingTwist, carBody
and nozzleThickness.

Sources of truth: the scaling and rotation that the boxes ask for; closed
forms of the nozzle's wall; what each README says.
"""

import re

import numpy as np
import pytest

from tutorialCase import run, tutorial


def table(path):
    return {
        row.split()[0]: row.split()[1:]
        for row in path.read_text().splitlines()[1:]
    }


def test_wing_twist(tmp_path):
    case = tutorial("wingTwist", tmp_path)
    log = run(case, "./Allrun", "-noPictures")
    # Round-off of positions up to 3 m
    assert float(re.search(r"kept to (\S+) m", log)[1]) < 1e-14
    assert float(
        re.search(r"Twist of the tip: (\S+) deg", log)[1]
    ) == pytest.approx(-6, abs=1e-6)
    values = table(case / "results/wing.constraints.dat")
    # A section at z is smaller by 15 % of z/3, its thickness to chord is not
    for i, z in enumerate((0.5, 1.5, 2.5)):
        assert float(values[f"spar.{i}"][0]) == pytest.approx(
            1 - 0.15 * z / 3, abs=2e-6
        )
    slopes = table(case / "results/wing.constraintDerivatives.dat")
    for i in range(3):
        assert np.abs(np.array(slopes[f"ratio.{i}"], float)).max() < 1e-5


def test_car_body(tmp_path):
    case = tutorial("carBody", tmp_path)
    log = run(case, "./Allrun", "-noPictures")
    assert "96 parameters" in log
    values = table(case / "results/body.constraints.dat")
    assert 0.9 < float(values["front"][0]) < 1.2
    assert float(values["front"][0]) != pytest.approx(1, abs=1e-3)


def test_nozzle_thickness(tmp_path):
    case = tutorial("nozzleThickness", tmp_path)
    log = run(case, "./Allrun", "-noPictures")
    steps = re.findall(r"open (\S+) m: (\S+) at (\S+) of", log)
    assert float(steps[0][2]) < 0.79
    # Linear in the value: the second step is there
    assert len(steps) <= 3
    assert float(steps[-1][2]) == pytest.approx(0.8, abs=1e-9)

    # The wall at x = 1 by Bernstein polynomials: radius 0.35 and 0.45
    def opens(r):
        s, t = (r - 0.1) / 0.5, (1 + 0.2) / 2.4
        return 3 * s * (1 - s) ** 2 * 6 * t**2 * (1 - t) ** 2

    mu = float(steps[-1][0])
    wall = 0.1 + mu * (opens(0.45) - opens(0.35))
    assert wall / 0.1 == pytest.approx(0.8, abs=2e-3)
