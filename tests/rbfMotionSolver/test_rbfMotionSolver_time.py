# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""rbfMotionSolver in time: restarts.

Source of truth: the uninterrupted run, of which a run that is stopped and
continued is the same to the last bit, in binary files, on any number of ranks
and where they change in between.
"""

import re
import shutil

import numpy as np
import pytest

from boxCase import words, write_control
from conditions import CONDITIONS, SLIPPING
from rbfCase import groups, rbf_case, reference, selections, side


def read_binary(path, kind=float, components=3):
    """The list in a binary file."""
    data = path.read_bytes()
    start = data.index(b"(", data.index(b"}"))
    count = int(data[:start].split()[-1])
    return np.frombuffer(data, kind, components * count, start + 1).reshape(
        -1, components
    )


def points_at(case, time):
    """Those of a binary file, of all ranks in the order of the whole mesh."""
    ranks = sorted(case.path.glob("processor[0-9]*"))
    if not ranks:
        return read_binary(case.path / f"{time}/polyMesh/points")
    parts = [
        (
            read_binary(
                rank / "constant/polyMesh/pointProcAddressing", np.int32, 1
            ).ravel(),
            read_binary(rank / f"{time}/polyMesh/points"),
        )
        for rank in ranks
    ]
    whole = np.full((1 + max(a.max() for a, _ in parts), 3), np.nan)
    for labels, values in parts:
        whole[labels] = values
    assert not np.isnan(whole).any()
    return whole


# One pattern, scaled up and down
PATTERN = (
    'type file; file "constant/top.txt";'
    " scale table ((0 0) (0.75 1) (1.25 0.2) (2 0.7));"
)

# Each step prescribes another pattern, and needs more control points
TURN = (
    "type solidBody; solidBodyMotionFunction rotatingMotion;"
    " rotatingMotionCoeffs { origin (0.3 0.4 1); axis (0 1 3);"
    " omega 0.2; }"
)

SOME = "supportRadius 1; greedy { tolerance 1e-2; }"


def turning_case(path, settings=SOME, displacement=TURN, walls=""):
    """A box whose top moves."""
    case = rbf_case(
        path,
        coeffs=settings
        + groups(
            top=f"type moving; patches (zMax); displacement {{ {displacement} }}",
            bottom="type fixed; patches (zMin);",
            walls=f'type sliding; patches ("[xy].*"); {walls}',
        ),
        cells=(6, 5, 4),
    )
    x = reference(case)
    x = x[side(x, "zMax")]
    values = np.stack(
        [
            0.02 * x[:, 1],
            0.03 * x[:, 0] ** 2,
            0.05 + 0.03 * np.sin(5 * x[:, 0]),
        ],
        1,
    )
    (case.path / "constant/top.txt").write_text(
        "".join(f"{words(a)} {words(d)}\n" for a, d in zip(x, values))
    )
    return case


def advance(case, end, ranks=1, **control):
    write_control(
        case,
        end=end,
        **{
            "deltaT": 0.25,
            "format": "binary",
            "startFrom": "latestTime",
            "writeInterval": 2,
            **control,
        },
    )
    return case.run("moveDynamicMesh", ranks=ranks)


def whole_and_parts(path, **given):
    """Points and selections at the end, uninterrupted and restarted at 1."""
    results = []
    for name, stops in (("whole", [2]), ("parts", [1, 2])):
        case = turning_case(path / name, **given)
        for stop in stops:
            output = advance(case, stop)
        results += [points_at(case, 2), selections(output)]
    assert np.abs(results[0] - reference(case)).max() > 0.02
    return results


def test_a_turning_body_restarts_to_the_last_bit(tmp_path):
    whole, selected, parts, again = whole_and_parts(tmp_path)
    # What was selected at first does not suffice to the end
    assert len(selected) > 1
    assert again[0][0] > selected[0][0]
    np.testing.assert_array_equal(parts, whole)


@pytest.mark.parametrize(
    "settings",
    [
        "supportRadius 1;",
        "supportRadius 1; selection all;",
        "supportRadiusFactor 4; greedy { tolerance 1e-2; }",
        "kernel thinPlate; greedy { tolerance 1e-2; }",
        "supportRadius 1; surfaceCorrection yes; greedy { tolerance 5e-2; }",
        "supportRadius 1; greedy { tolerance 5e-2; algorithm standard; }",
    ],
)
def test_settings_restart_to_the_last_bit(tmp_path, settings):
    whole, _, parts, _ = whole_and_parts(tmp_path, settings=settings)
    np.testing.assert_array_equal(parts, whole)


def test_surfaces_that_move_restart_to_the_last_bit(tmp_path):
    whole, _, parts, _ = whole_and_parts(
        tmp_path,
        walls="displacement { type solidBody;"
        " solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs"
        " { origin (0.5 0.5 0); axis (0 0 1); omega 0.1; } }",
    )
    np.testing.assert_array_equal(parts, whole)


def test_a_scaled_pattern_is_selected_once_and_for_all_restarts(tmp_path):
    whole, selected, parts, again = whole_and_parts(
        tmp_path, displacement=PATTERN
    )
    assert len(selected) == 1
    assert [s[:2] for s in selected] == [s[:2] for s in again]
    np.testing.assert_array_equal(parts, whole)


def test_ascii_files_restart_to_their_digits(tmp_path):
    results = []
    for name, stops in (("whole", [2]), ("parts", [1, 2])):
        case = turning_case(tmp_path / name)
        for stop in stops:
            output = advance(case, stop, format="ascii", digits=6)
        assert ("Time = 1\n" in output) == (name == "whole")
        results.append(case.points("2/polyMesh/points"))
    np.testing.assert_array_equal(*results)
    # As far as in binary files, to the digits
    moved = results[0] - reference(case)
    exact = turning_case(tmp_path / "exact")
    advance(exact, 2)
    np.testing.assert_allclose(
        moved, points_at(exact, 2) - reference(exact), rtol=0, atol=1e-5
    )
    assert np.abs(moved).max() > 0.2


def test_any_number_of_ranks_may_continue(tmp_path):
    whole = turning_case(tmp_path / "whole")
    advance(whole, 2)
    expected = points_at(whole, 2)

    case = turning_case(tmp_path / "parts")
    write_control(
        case, end=2, deltaT=0.25, format="binary", startFrom="latestTime"
    )
    case.decompose((2, 1, 1))
    advance(case, 1, ranks=2)
    case.run("reconstructPar", "-latestTime")
    for rank in case.path.glob("processor*"):
        shutil.rmtree(rank)
    case.decompose((1, 3, 1), "-latestTime")
    advance(case, 1.5, ranks=3)
    np.testing.assert_array_equal(points_at(case, 1.5), points_at(whole, 1.5))
    case.run("reconstructPar", "-latestTime")
    for rank in case.path.glob("processor*"):
        shutil.rmtree(rank)
    advance(case, 2)
    np.testing.assert_array_equal(points_at(case, 2), expected)


@pytest.mark.parametrize(
    "condition",
    [
        "oscillatingDisplacement",
        "angularOscillatingDisplacement",
        "solidBodyMotionDisplacement",
        "waveDisplacement",
    ],
)
def test_conditions_restart_to_the_last_bit(tmp_path, condition):
    results = []
    for name, stops in (("whole", [2]), ("parts", [1, 2])):
        case = rbf_case(
            tmp_path / name,
            {**SLIPPING, "zMax": CONDITIONS[condition][0]},
            coeffs="greedy { tolerance 1e-2; }",
        )
        write_control(
            case, end=2, deltaT=0.25, format="binary", startFrom="latestTime"
        )
        # decomposePar of v1912 cannot copy solidBodyMotionDisplacement
        ranks = 1 if condition == "solidBodyMotionDisplacement" else 2
        if ranks == 2:
            case.decompose((1, 2, 1))
        for stop in stops:
            advance(case, stop, ranks=ranks)
        results.append(points_at(case, 2))
    np.testing.assert_array_equal(*results)
    assert np.abs(results[0] - reference(case)).max() > 0.02


def test_a_motion_of_round_off_selects_no_control_points(tmp_path):
    # As of a body of six degrees of freedom in its first step
    case = turning_case(
        tmp_path,
        displacement=(
            "type uniform; value table ((0 (0 0 0)) (0.25 (0 0 5e-17))"
            " (0.5 (0 0 0.1)) (3 (0 0 0.1)));"
        ),
    )
    output = advance(case, 1)
    assert len(selections(output)) == 1
    assert selections(output)[0][3] == pytest.approx(1e-2 * 0.1)


def test_without_its_file_a_restart_selects_anew(tmp_path):
    case = turning_case(tmp_path / "whole")
    first = selections(advance(case, 1))
    advance(case, 2)
    expected = points_at(case, 2)
    shutil.rmtree(case.path / "2")
    (case.path / "1/uniform/rbfMotionSolverProperties").unlink()
    again = selections(advance(case, 2))
    assert again[0] != first[-1]
    # Both are within the tolerance at control points and about so elsewhere
    assert np.abs(points_at(case, 2) - expected).max() <= 3 * again[-1][3]


def test_control_points_that_are_gone_are_announced(tmp_path):
    case = turning_case(tmp_path / "whole")
    advance(case, 1)
    dictionary = case.path / "constant/dynamicMeshDict"
    dictionary.write_text(dictionary.read_text().replace('"[xy].*"', '"x.*"'))
    output = advance(case, 2)
    assert "selected anew" in output
    assert selections(output)


def test_the_log_ends_with_what_the_run_took(tmp_path):
    case = turning_case(tmp_path)
    output = advance(case, 2)
    known = selections(output)
    found = re.search(
        r"End\n.*^rbfMotionSolver: (\d+) steps, (\d+) selections, (\d+) of"
        r" (\d+) control points,\n    largest error (\S+) m of a displacement"
        r" of (\S+) m\n    (\S+) s of (\S+) s \((\S+) %\): conditions (\S+) s,"
        r" selection (\S+) s, propagation (\S+) s, mesh check (\S+) s$",
        output,
        re.MULTILINE | re.DOTALL,
    )
    steps, times, points, candidates = map(int, found.groups()[:4])
    error, displacement, motion, run, share, *phases = map(
        float, found.groups()[4:]
    )
    assert (steps, times) == (8, len(known))
    assert (points, candidates) == known[-1][:2]
    assert error >= max(s[2] for s in known) * 0.99
    assert 0 < displacement < 1
    assert sum(phases) == pytest.approx(motion, rel=0.05, abs=1e-4)
    assert share == pytest.approx(100 * motion / run, rel=0.05)
