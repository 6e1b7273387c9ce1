# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""points0 that cannot be the reference is refused, never replaced.

Source of truth: the points before the first motion, to which points0 of a mesh
that morphMesh -overwrite moved is equal; and the contract: no mesh file is
changed when an input is refused.
"""

import pytest

from ffdCase import ffd_box, ffd_case, parameter

BOX = ffd_box("b", parameter("mu", [((1, 1, 1), (0, 0, 1))]))

SPOILT = {
    "empty": lambda text: "",
    "zero bytes": lambda text: "\0" * len(text),
    "no header": lambda text: text[text.index("(") - 4 :],
    "cut": lambda text: text[: len(text) // 2],
    "at one place": lambda text: text[: text.index("\n(")] + "{(0 0 0)}\n",
    "not finite": lambda text: text.replace("(0 0 0)", "(1e300 0 0)", 1),
    "too many": lambda text: text.replace("\n125\n", "\n2000000000\n", 1),
}


@pytest.mark.parametrize("spoil", SPOILT.values(), ids=SPOILT)
def test_spoilt_points0_are_refused_by_their_name(tmp_path, spoil):
    case = ffd_case(tmp_path, BOX, cells=(4, 4, 4))
    case.run("morphMesh", "-overwrite")
    points0 = case.path / "constant/polyMesh/points0"
    text = points0.read_text()
    assert spoil(text) != text
    points0.write_text(spoil(text))
    before = case.tree()
    output = case.run("morphMesh", "-overwrite", status=1)
    assert "points0" in output
    assert case.tree() == before


@pytest.mark.parametrize("ranks", [1, 2])
def test_an_empty_points0_is_refused_by_all_ranks(tmp_path, ranks):
    case = ffd_case(tmp_path, BOX, cells=(4, 4, 4))
    folders = [case.path]
    if ranks == 2:
        case.decompose((2, 1, 1))
        folders = sorted(case.path.glob("processor*"))
    case.run("morphMesh", "-overwrite", ranks=ranks)
    (folders[-1] / "constant/polyMesh/points0").write_text("")
    output = case.run("morphMesh", ranks=ranks, status=1)
    assert "points0 is there, but is no file of points" in output
