# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A displacement of type cellDisplacement that OpenFOAM's function object
externalCoupled fills, each time the mesh moves.

Source of truth: what the other side of the coupling, here a thread, answers.
"""

import threading
import time

import numpy as np
import pytest

from rbfCase import CUBE, groups, points_at, rbf_case, reference, side, ulps

COUPLING = """
functions { coupling { type externalCoupled; libs (fieldFunctionObjects);
commsDir "<case>/comms"; initByExternal no; waitInterval 1; timeOut 60;
calcFrequency 1000000; regions { region0 { zMax
{ readFields (cellDisplacement); writeFields (); } } } } }
"""


def case_of(path, function="coupling"):
    case = rbf_case(
        path,
        {name: "calculated" for name in CUBE},
        coeffs="supportRadius 2;\n"
        + groups(
            top="type moving; patches (zMax); displacement "
            f"{{ type cellDisplacement; functions ({function}); }}",
            bottom="type fixed; patches (zMin);",
        ),
        control={"end": 2},
    )
    conditions = "\n".join(
        f"{name} {{ type {kind}; value uniform (0 0 0); }}"
        for name, kind in [
            (name, "fixedValue" if name == "zMax" else "calculated")
            for name in CUBE
        ]
    )
    case.write(
        "0/cellDisplacement",
        "volVectorField",
        "dimensions [0 1 0 0 0 0 0]; internalField uniform (0 0 0);\n"
        f"boundaryField {{ {conditions} }}",
    )
    control = case.path / "system/controlDict"
    control.write_text(control.read_text() + COUPLING)
    return case


class Partner(threading.Thread):
    """Answers 0.02, 0.04, ... in the direction of z, for each face of zMax."""

    def __init__(self, case):
        super().__init__(daemon=True)
        self.comms = case.path / "comms"
        self.answers = 0

    def run(self):
        lock = self.comms / "OpenFOAM.lock"
        # The lock may come and go between two looks; the geometry stays
        while not (self.comms / "zMax/patchFaces").exists():
            time.sleep(0.01)
        while True:
            try:
                ended = "done" in lock.read_text()
            except FileNotFoundError:
                ended = False
                self.answers += 1
                (self.comms / "zMax/cellDisplacement.in").write_text(
                    f"0 0 {0.02 * self.answers!r}\n" * 16
                )
                lock.write_text("status=partner\n")
            if ended:
                return
            time.sleep(0.01)


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_mesh_moves_as_the_partner_says_in_each_step(tmp_path, ranks):
    case = case_of(tmp_path)
    before = reference(case)
    if ranks > 1:
        case.decompose((2, 1, 1))
    partner = Partner(case)
    partner.start()
    case.run("moveDynamicMesh", ranks=ranks)
    top = side(before, "zMax")
    for step in (1, 2):
        np.testing.assert_allclose(
            points_at(case, step)[top] - before[top],
            np.tile([0, 0, 0.02 * step], (top.sum(), 1)),
            rtol=0,
            atol=ulps(before),
        )
    assert partner.answers == 2


def test_a_function_object_that_is_not_there_is_an_error(tmp_path):
    case = case_of(tmp_path, function="couplings")
    output = case.run("moveDynamicMesh", status=1)
    assert "no function object is called 'couplings'" in output
