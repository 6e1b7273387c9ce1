"""rbfMotionSolver in time: restarts.

Source of truth: the uninterrupted run. Where one selection serves the whole
motion, as it does where the displacement is one pattern that is scaled, a
restart is the same to round-off. Otherwise the restarted run selects again,
for its own first step, and both runs are within the tolerance of what is
prescribed.
"""

import numpy as np
import pytest

from boxCase import words, write_control
from rbfCase import groups, rbf_case, reference, selections, side

SPAN = np.sqrt(3)


def read_binary(path):
    """The points of a binary file."""
    data = path.read_bytes()
    start = data.index(b"(", data.index(b"}"))
    count = int(data[:start].split()[-1])
    return np.frombuffer(data, float, 3*count, start + 1).reshape(-1, 3)


# One pattern, scaled up and down
PATTERN = ('type file; file "constant/top.txt";'
           " scale table ((0 0) (0.75 1) (1.25 0.2) (2 0.7));")

# Here each step prescribes another pattern
TURN = ("type solidBody; solidBodyMotionFunction rotatingMotion;"
        " rotatingMotionCoeffs { origin (0.3 0.4 1); axis (0 1 3);"
        " omega 0.2; }")


def runs(path, displacement, settings, end=2):
    """Points and selections at the end, uninterrupted and restarted at 1."""
    results = []
    for name, stops in (("whole", [end]), ("parts", [1, end])):
        case = rbf_case(path/name, coeffs=settings + groups(
            top=f"type moving; patches (zMax); displacement"
            f" {{ {displacement} }}",
            bottom="type fixed; patches (zMin);",
            walls='type sliding; patches ("[xy].*");'), cells=(6, 5, 4))
        x = reference(case)
        x = x[side(x, "zMax")]
        values = np.stack([0.02*x[:, 1], 0.03*x[:, 0]**2,
                           0.05 + 0.03*np.sin(5*x[:, 0])], 1)
        (case.path/"constant/top.txt").write_text("".join(
            f"{words(a)} {words(d)}\n" for a, d in zip(x, values)))
        for stop in stops:
            write_control(case, end=stop, deltaT=0.25, format="binary",
                          startFrom="latestTime")
            output = case.run("moveDynamicMesh")
        results.append((read_binary(case.path/f"{end}/polyMesh/points"),
                        selections(output)))
    (whole, selected), (parts, selected_again) = results
    assert np.abs(whole - reference(case)).max() > 0.02
    return whole, parts, selected, selected_again


SOME = "supportRadius 1; greedy { tolerance 1e-2; }"


def test_a_scaled_pattern_restarts_to_round_off(tmp_path):
    whole, parts, selected, again = runs(tmp_path, PATTERN, SOME)
    assert [s[:2] for s in selected] == [s[:2] for s in again]
    assert selected[0][0] < selected[0][1]
    np.testing.assert_allclose(parts, whole, rtol=0, atol=1e-13*SPAN)


def test_the_support_radius_of_the_largest_displacement_survives_a_restart(
        tmp_path):
    # It grows with the displacement until 0.75 and is kept from there on
    whole, parts, selected, again = runs(
        tmp_path, PATTERN, "supportRadiusFactor 4; greedy { tolerance 1e-2; }")
    assert len(selected) == 3
    assert selected[-1][:2] == again[-1][:2]
    np.testing.assert_allclose(parts, whole, rtol=0, atol=1e-13*SPAN)


@pytest.mark.parametrize("tolerance", [3e-2, 1e-2])
def test_another_pattern_restarts_to_the_tolerance(tmp_path, tolerance):
    # The runs may select other points: both are within the tolerance, times
    # the largest displacement, at control points, and about so elsewhere
    whole, parts, selected, _ = runs(
        tmp_path, TURN, f"supportRadius 1; greedy {{ tolerance {tolerance}; }}")
    n, candidates, _, allowed = selected[-1]
    assert n < candidates
    assert np.abs(parts - whole).max() <= 3*allowed


def test_every_point_restarts_to_round_off(tmp_path):
    whole, parts, _, _ = runs(tmp_path, TURN,
                              "supportRadius 1; selection all;")
    np.testing.assert_allclose(parts, whole, rtol=0, atol=1e-13*SPAN)
