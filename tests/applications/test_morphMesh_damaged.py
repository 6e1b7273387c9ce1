# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Meshes whose files are damaged: a message names them, nothing is written.

Source of truth: what polyMesh needs of its files: labels below the numbers of
points and cells, patches one after the other, lists as long as they say.
"""

import re

import pytest

from ffdCase import ffd_box, ffd_case, parameter
from fuzzCases import rbf

BOX = ffd_box("b", parameter("mu", [((1, 1, 1), (0, 0, 1))]))


def replaced(pattern, by):
    return lambda text: re.sub(pattern, by, text, count=1)


DAMAGED = {
    "a point of a face beyond all": (
        "faces",
        replaced(r"\n4\(\d+", "\n4(99999"),
    ),
    "faces without end": ("faces", replaced(r"\n240\n", "\n2000000000\n")),
    "a negative owner": ("owner", replaced(r"\n\(\n\d+", "\n(\n-7")),
    "an owner beyond memory": (
        "owner",
        replaced(r"\n\(\n\d+", "\n(\n2000000000"),
    ),
    "points that are cut": ("points", lambda text: text[: len(text) // 2]),
    "no position": ("points", replaced(r"\n\(0 0 0\)", "\n(1e300 0 0)")),
    "overflow": ("points", replaced(r"\n\(0 0 0\)", "\n(1e400 0 0)")),
    "patches without end": ("boundary", replaced(r"\n6\n", "\n2000000000\n")),
    "a patch elsewhere": ("boundary", replaced(r"nFaces\s+16", "nFaces 15")),
    "an empty file": ("neighbour", lambda text: ""),
}


@pytest.mark.parametrize("file, damage", DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_file_of_the_mesh_is_an_error(tmp_path, file, damage):
    case = ffd_case(tmp_path, BOX, cells=(4, 4, 4))
    path = case.path / "constant/polyMesh" / file
    text = path.read_text()
    assert damage(text) != text
    path.write_text(damage(text))
    before = case.tree()
    output = case.run("morphMesh", status=1)
    assert "constant/polyMesh" in output
    assert file in output or "Illegal cell label" in output
    assert case.tree() == before


def test_a_zone_of_another_mesh_is_named(tmp_path):
    case = rbf(tmp_path)
    zones = case.path / "constant/polyMesh/pointZones"
    zones.write_text(zones.read_text().replace("37", "99999"))
    output = case.run("morphMesh", status=1)
    for phrase in ("'zone'", "'middle'", "pointZones", "99999"):
        assert phrase in output


def test_a_zone_too_long_to_be_read_is_an_error(tmp_path):
    case = rbf(tmp_path)
    zones = case.path / "constant/polyMesh/pointZones"
    zones.write_text(zones.read_text().replace("2(37 38)", "2000000000{1}"))
    assert "polyMesh" in case.run("morphMesh", status=1)


@pytest.mark.parametrize("time", ["nan", "inf", "1e400"])
def test_a_time_that_is_none_is_refused(tmp_path, time):
    case = ffd_case(tmp_path, BOX, cells=(2, 2, 2))
    output = case.run("morphMesh", "-time", time, status=1)
    assert "-time" in output and f"'{time}'" in output


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    "file", ["faces", "points", "owner", "boundary", "pointZones"]
)
def test_no_number_in_the_head_of_a_file_is_a_signal(tmp_path, file, ranks):
    """Which version a file has is of no consequence, whatever it is."""
    case = rbf(tmp_path)
    folder = "."
    if ranks > 1:
        case.decompose((2, 1, 1))
        folder = "processor1"
    path = case.path / folder / "constant/polyMesh" / file
    text, n = re.subn(r"version +2.0;", "version 2e+150;", path.read_text())
    assert n == 1
    path.write_text(text)
    case.run("morphMesh", ranks=ranks)
