# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""One version everywhere. Source of truth: the file VERSION."""

import re

import pytest
import yaml

from ffdCase import ffd_box, ffd_case, parameter
from foamCase import ROOT, FoamCase
from rbfCase import groups, rbf_case

VERSION = (ROOT / "VERSION").read_text().strip()
LINE = f"morphFoam {VERSION}"


@pytest.mark.parametrize("command", ["morphMesh", "morphSurface"])
def test_commands_tell_it_and_do_nothing_else(tmp_path, command):
    case = FoamCase(tmp_path)
    assert case.run(command, "-version").splitlines() == [LINE]
    assert "-version" in case.run(command, "-help")
    assert case.tree() == {}


def test_the_log_of_a_run_has_it_once(tmp_path):
    rbf = rbf_case(
        tmp_path / "rbf",
        control={"end": 3},
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type uniform;"
            " value (0 0 0.1); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    ffd = ffd_case(
        tmp_path / "ffd",
        ffd_box("body", parameter("a", [((1, 1, 1), (0.1, 0, 0))])),
        control={"end": 3},
    )
    for case in (rbf, ffd):
        lines = case.run("moveDynamicMesh").splitlines()
        assert lines.count(LINE) == 1


def test_other_files_have_the_same():
    assert re.fullmatch(r"\d+\.\d+\.\d+", VERSION)
    changes = (ROOT / "CHANGELOG.md").read_text()
    assert re.search(r"^## \[(\d.*?)\]", changes, re.MULTILINE)[1] == VERSION
    assert (
        (ROOT / "debian/changelog")
        .read_text()
        .startswith(f"morphfoam ({VERSION}) ")
    )


def test_the_citation_is_valid():
    # What the schema of version 1.2.0 requires, and the types of what is there
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["cff-version"] == "1.2.0"
    assert citation["version"] == VERSION
    assert {"title", "message", "authors"} <= set(citation)
    released = re.search(
        rf"^## \[{VERSION}\] - (\S+)$",
        (ROOT / "CHANGELOG.md").read_text(),
        re.MULTILINE,
    )[1]
    assert str(citation["date-released"]) == released
    for work in (citation, *citation["references"]):
        for author in work["authors"]:
            assert set(author) in ({"name"}, {"family-names", "given-names"})
    for work in citation["references"]:
        assert {"type", "title", "authors"} <= set(work)
        assert isinstance(work.get("start", 1), int)
