# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The front page: short, with pictures and links that are there, and a
dictionary that gives the log it shows. Source of truth: morphMesh, run with
that dictionary on OpenFOAM's airFoil2D.
"""

import pathlib
import re
import shutil

import pytest

from foamCase import FoamCase, environment

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text()
BLOCKS = re.findall(r"^```\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def block(with_word):
    (found,) = (b for b in BLOCKS if with_word in b)
    return found


def test_it_is_short():
    assert len(README.splitlines()) <= 100


def test_what_it_points_to_is_there():
    for target in re.findall(r'\]\(([^)#:]+)\)|src="([^"]+)"', README):
        assert (ROOT / "".join(target)).exists()
    for command in re.findall(
        r"^(?:tutorials|tests|\./)\S*", block("Alltest"), re.MULTILINE
    ):
        assert (ROOT / command).exists()
    for path in re.findall(
        r"`((?:tutorials|benchmarks|tests|docs)/[\w./]+)`", README
    ):
        assert (ROOT / path).exists()


@pytest.mark.parametrize(
    "picture",
    sorted((ROOT / "docs/pictures").glob("*")),
    ids=lambda path: path.name,
)
def test_pictures_are_small(picture):
    assert picture.stat().st_size <= 150_000


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    case = FoamCase(tmp_path_factory.mktemp("airFoil2D"))
    shutil.copytree(
        pathlib.Path(environment()["FOAM_TUTORIALS"])
        / "incompressible/simpleFoam/airFoil2D",
        case.path,
        dirs_exist_ok=True,
    )
    case.write(
        "constant/dynamicMeshDict", "dictionary", block("supportRadius 250")
    )
    return case.run("morphMesh", "-time", "1")


def test_the_dictionary_has_ten_lines_beside_its_function():
    lines = block("supportRadius 250").splitlines()
    assert len(lines) <= 12


def test_the_dictionary_gives_the_log_it_shows(log):
    shown = block("largest error").splitlines()
    selected = re.search(r"selected \d+ of \d+ control points", shown[0])[0]
    assert selected in log
    for row in shown[2:]:
        given = re.search(
            rf"^{row.split()[0]}{' '*bool(row.split()[1:])}.*$"
            if row[0] != "#"
            else "^# mesh.*$",
            log,
            re.MULTILINE,
        )[0]
        assert given.split() == row.split()
