# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Surfaces whose files are wrong: the message says where.

Source of truth: the definition of the Wavefront format (vertices count from 1),
and numbers that a double can hold.
"""

import pytest

from fuzzCases import surface

OBJ = {
    "beyond the last vertex": (
        "f 1 2 3",
        "f 1 2 300000",
        ["line 5", "300000", "from 1 to 4"],
    ),
    "vertex zero": ("f 1 2 3", "f 0 2 3", ["line 5", "vertex 0"]),
    "backwards": ("f 1 2 3", "f -1 2 3", ["line 5", "vertex -1"]),
    "no number": ("f 1 2 3", "f 1 b 3", ["line 5", "'b'"]),
    "two corners": ("f 1 2 3", "f 1 2", ["line 5", "three vertices"]),
    "two coordinates": ("v 1 0 0", "v 1 0", ["line 2", "three numbers"]),
    "no finite coordinate": ("v 1 0 0", "v 1e300 0 0", ["vertex 2", "1e+300"]),
    "overflow": ("v 1 0 0", "v 1e400 0 0", ["line 2"]),
}


@pytest.mark.parametrize("old, new, phrases", OBJ.values(), ids=OBJ)
def test_a_wrong_line_is_named(tmp_path, old, new, phrases):
    case = surface(tmp_path)
    file = case.path / "in.obj"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))
    output = case.run("morphSurface", "in.obj", "out.obj", status=1)
    for phrase in ["in.obj", *phrases]:
        assert phrase in output
    assert not (case.path / "out.obj").exists()


@pytest.mark.parametrize(
    "text", ["", "solid a\nendsolid a\n"], ids=["no bytes", "no facets"]
)
def test_an_empty_surface_is_called_empty(tmp_path, text):
    case = surface(tmp_path)
    (case.path / "in.stl").write_text(text)
    output = case.run("morphSurface", "in.stl", "out.stl", status=1)
    assert "in.stl" in output and "empty" in output


STL = {
    "two coordinates": ("vertex 1 0 0", "vertex 1 0", "three numbers"),
    "a byte between numbers": (
        "vertex 1 0 0",
        "vertex 1 0\xd00",
        "three numbers",
    ),
    "two corners": ("      vertex 1 0 0\n", "", "2 vertices"),
    "no number": ("vertex 1 0 0", "vertex 1 b 0", "three numbers"),
    "overflow": ("vertex 1 0 0", "vertex 1e400 0 0", "three numbers"),
    "an unknown word": ("endfacet", "endfaced", "endfaced"),
}


@pytest.mark.parametrize("old, new, phrase", STL.values(), ids=STL)
def test_a_wrong_line_of_a_text_stl_is_named(tmp_path, old, new, phrase):
    case = surface(tmp_path)
    file = case.path / "in.stl"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="latin-1")
    output = case.run("morphSurface", "in.stl", "out.stl", status=1)
    assert "in.stl, line " in output and phrase in output


def test_an_stl_of_another_case_and_several_solids_is_read(tmp_path):
    case = surface(tmp_path)
    file = case.path / "in.stl"
    text = file.read_text()
    file.write_text(
        "  "
        + text.upper().replace("SOLID A", "solid A", 1)
        + text.replace("solid a", "solid two words")
    )
    output = case.run("morphSurface", "in.stl", "out.stl")
    assert "Surface of 8 triangles" in output


def test_a_binary_file_that_is_cut_is_refused(tmp_path):
    case = surface(tmp_path)
    file = case.path / "in.stlb"
    case.run("morphSurface", "in.stlb", "out.stl")
    file.write_bytes(file.read_bytes()[:-30])
    output = case.run("morphSurface", "in.stlb", "out2.stl", status=1)
    assert "in.stlb" in output
    assert not (case.path / "out2.stl").exists()


@pytest.mark.parametrize("time", ["nan", "1e400", "soon"])
def test_a_time_that_is_none_is_refused(tmp_path, time):
    case = surface(tmp_path)
    output = case.run(
        "morphSurface", "-time", time, "in.obj", "out.obj", status=1
    )
    assert "-time" in output and time in output
