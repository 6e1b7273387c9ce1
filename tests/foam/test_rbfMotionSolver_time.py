"""rbfMotionSolver in time: restarts.

Source of truth: the uninterrupted run. Where one selection serves the whole
motion, as it does where the displacement is one pattern that is scaled, a
restart is the same to round-off. Otherwise the restarted run selects again,
for its own first step, and both runs are within the tolerance of what is
prescribed.
"""

import numpy as np
import pytest

from rbfCase import groups, rbf_case, selections

SPAN = np.sqrt(3)


def read_binary(path):
    """The points of a binary file."""
    data = path.read_bytes()
    start = data.index(b"(", data.index(b"\n}") + 2)
    count = int(data[data.index(b"}") + 1:start].split()[-1])
    return np.frombuffer(data, float, 3*count, start + 1).reshape(-1, 3)


PATTERN = ("type file; file \"constant/top.txt\"; scale table ((0 0)"
           " (1 1) (2 0.2) (4 1));")

SHEAR = "type uniform; value table ((0 (0 0 0)) (1 (0 0 0.1)) (2 (0.1 0 0)));"

TURN = ("type solidBody; solidBodyMotionFunction rotatingMotion;"
        " rotatingMotionCoeffs { origin (0.3 0.4 1); axis (0 0 1);"
        " omega 0.2; }")


def runs(path, displacement, settings):
    """Points and selections at time 2, uninterrupted and restarted at 1."""
    results = []
    for name, stops in (("whole", [2]), ("parts", [1, 2])):
        for stop in stops:
            case = rbf_case(
                path/name, coeffs=settings + groups(
                    top=f"type moving; patches (zMax); displacement"
                    f" {{ {displacement} }}",
                    bottom="type fixed; patches (zMin);",
                    walls='type sliding; patches ("[xy].*");'),
                control={"format": "binary", "end": stop, "deltaT": 0.25,
                         "startFrom": "latestTime"}, cells=(6, 5, 4))
            x = case.points("constant/polyMesh/points") \
                if False else read_reference(case)
            top = x[:, 2] == 1
            values = np.stack([0.02*x[top, 1], 0.03*x[top, 0]**2,
                               0.05 + 0.03*np.sin(5*x[top, 0])], 1)
            (case.path/"constant/top.txt").write_text("".join(
                " ".join(map(repr, map(float, (*a, *d)))) + "\n"
                for a, d in zip(x[top], values)))
            output = case.run("moveDynamicMesh")
        results.append((read_binary(case.path/"2/polyMesh/points"),
                        selections(output)))
    return results
