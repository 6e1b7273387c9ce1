# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A restart from a state that is not as it was written.

Source of truth: the uninterrupted run, whose mesh a restart gives or is refused
with the name of the file.
"""

import re
import shutil

import numpy as np
import pytest

from boxCase import write_control
from fuzzCases import restart
from rbfCase import points_at

STATE = "1/uniform/rbfMotionSolverProperties"


def replaced(pattern, by):
    return lambda text: re.sub(pattern, by, text, count=1, flags=re.DOTALL)


SPOILT = {
    "empty": lambda text: "",
    "zeros": lambda text: "\0" * len(text),
    "cut": lambda text: text[: len(text) * 2 // 3],
    "negative radius": replaced(
        r"supportRadius\s+[^;]*;", "supportRadius -1;"
    ),
    "radius zero": replaced(r"supportRadius\s+[^;]*;", "supportRadius 0;"),
    "another radius": replaced(
        r"supportRadius\s+[^;]*;", "supportRadius 1.25;"
    ),
    "no radius": replaced(r"supportRadius\s+[^;]*;", ""),
    "radius without value": replaced(
        r"supportRadius\s+[^;]*;", "supportRadius;"
    ),
    "a list too long": replaced(
        r"controlPoints\s+\d+", "controlPoints 2000000000"
    ),
    "a negative length": replaced(r"controlPoints\s+\d+", "controlPoints -1"),
    "a repeated value": replaced(
        r"controlPoints\s+.*?\);", "controlPoints 2000000000{(0 0 0)};"
    ),
    "a huge position": replaced(r"\n\(\S+ ", "\n(1e300 "),
    "no control points": replaced(r"controlPoints\s+.*?\)\s*;", ""),
    "another position": replaced(r"\n\(\S+ ", "\n(0.123 "),
}


def moved_once(path, ranks):
    case = restart(path)
    if ranks > 1:
        case.decompose((2, 1, 1), "-latestTime")
    root = case.path / "processor0" if ranks > 1 else case.path
    return case, root / STATE


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("spoil", SPOILT.values(), ids=SPOILT)
def test_a_spoilt_state_is_refused_by_its_name(tmp_path, spoil, ranks):
    if ranks == 2 and spoil not in (
        SPOILT["empty"],
        SPOILT["cut"],
        SPOILT["negative radius"],
    ):
        pytest.skip("the same reader on the master")
    case, state = moved_once(tmp_path, ranks)
    text = state.read_text()
    assert spoil(text) != text
    state.write_text(spoil(text))
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    assert STATE in output and "is not as it was written" in output
    assert not (case.path / "2").exists()


def test_a_folder_in_its_place_is_refused(tmp_path):
    case, state = moved_once(tmp_path, 1)
    state.unlink()
    state.mkdir()
    assert STATE in case.run("moveDynamicMesh", status=1)


@pytest.mark.parametrize("ranks", [1, 2])
def test_without_the_state_the_radius_has_to_be_given(tmp_path, ranks):
    case, state = moved_once(tmp_path, ranks)
    text = state.read_text()
    state.unlink()
    output = case.run("moveDynamicMesh", ranks=ranks, status=1)
    assert STATE in output and "'supportRadius'" in output

    # The remedy works: the same motion within the tolerance of the selection
    radius = re.search(r"supportRadius\s+(\S+);", text)[1]
    dictionary = case.path / "constant/dynamicMeshDict"
    dictionary.write_text(
        dictionary.read_text()
        + f"rbfMotionSolverCoeffs {{ supportRadius {radius}; }}\n"
    )
    case.run("moveDynamicMesh", ranks=ranks)
    again = points_at(case, 2)
    state.write_text(text)
    for folder in [case.path / "2", *case.path.glob("processor*/2")]:
        shutil.rmtree(folder, ignore_errors=True)
    write_control(case, end=2, startFrom="latestTime")
    case.run("moveDynamicMesh", ranks=ranks)
    assert np.abs(again - points_at(case, 2)).max() < 1e-5
