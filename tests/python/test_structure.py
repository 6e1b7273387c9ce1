# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The house keeps its shape: what may include what, and names that wmake can
tell apart. Source of truth: the table of docs/architecture.md.
"""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

PAGE = ROOT / "docs/architecture.md"


def table():
    """Which folders each folder of src may include from, as the page says."""
    rows = re.findall(
        r"^\| `(\w+)` \| ([\w, ]*)\| [^|]+ \|$", PAGE.read_text(), re.MULTILINE
    )
    return {name: re.findall(r"\w+", others) for name, others in rows}


MAY_INCLUDE = table()

# Made by builds and runs
GENERATED = {"lnInclude", "build", "runs", "linux64GccDPInt32Opt"}


def sources(folder):
    """The C++ files below a folder."""
    return [
        path
        for path in (ROOT / folder).rglob("*")
        if path.suffix in (".C", ".H", ".cpp", ".hpp")
        and not GENERATED.intersection(path.parts[len(ROOT.parts) :])
    ]


def home():
    """The folder of src in which each of our headers is."""
    return {
        path.name: path.relative_to(ROOT / "src").parts[0]
        for path in sources("src")
    }


def test_every_source_folder_has_its_place():
    folders = {p.name for p in (ROOT / "src").iterdir() if p.is_dir()}
    assert folders == set(MAY_INCLUDE)


def test_the_picture_has_no_circle():
    done = set()
    while len(done) < len(MAY_INCLUDE):
        ready = {
            folder
            for folder, below in MAY_INCLUDE.items()
            if set(below) <= done
        } - done
        assert ready, f"a circle among {set(MAY_INCLUDE) - done}"
        done |= ready


@pytest.mark.parametrize("folder", MAY_INCLUDE)
def test_dependencies_point_downwards(folder):
    where = home()
    wrong = []
    for path in sources(f"src/{folder}"):
        for name in re.findall(r'#include "([^"]+)"', path.read_text()):
            target = where.get(name, folder)
            if target != folder and target not in MAY_INCLUDE[folder]:
                wrong.append(f"{path.name} includes {name} of {target}")
    assert not wrong


def test_numerics_knows_nothing_of_openfoam():
    wrong = [
        f"{path.name}: {line}"
        for path in sources("src/numerics")
        for line in re.findall(r"#include.*\.H\b.*", path.read_text())
    ]
    assert not wrong


def test_wmake_can_tell_all_files_apart():
    names = [
        p.name
        for folder in (
            "src",
            "applications",
            "benchmarks",
            "tests",
            "tutorials",
        )
        for p in sources(folder)
    ]
    assert sorted(names) == sorted(set(names))


def test_every_source_is_compiled():
    # A folder with a Make of its own is a library of its own
    listed = {
        str((made.parents[1] / word).relative_to(ROOT))
        for made in [ROOT / "Make/files", *ROOT.glob("src/**/Make/files")]
        for word in made.read_text().split()
        if "." in word
    }
    files = {
        str(p.relative_to(ROOT))
        for p in sources("src")
        if p.suffix in (".C", ".cpp")
    }
    assert files <= listed


def test_version_switches_are_in_one_header():
    users = {
        path.name
        for path in sources("src") + sources("applications")
        if re.search(r"#\s*if.*\bOPENFOAM\b", path.read_text())
    }
    assert users <= {"foamCompat.H"}


def test_every_program_is_compiled_alike():
    """C++17, and with clang what clang needs: Make/options."""
    options = [
        path
        for folder in ("", "applications", "benchmarks", "src", "tests")
        for path in (ROOT / folder).glob(
            "**/Make/options" if folder else "Make/options"
        )
    ]
    assert len(options) > 10
    for path in options:
        text = path.read_text()
        assert "-std=c++17" in text, path
        assert "$(MORPHFOAM_CLANG_FLAGS)" in text, path


@pytest.mark.parametrize(
    "call",
    [
        r"scatterList|listCombineScatter",  # wrong or deprecated from v2406 on
        r"Pstream::scatter\b",  # deprecated from v2406 on
        r"pointMesh::New\b",  # loses patches of points from v2412 on
        r"Function1<\w+>::New\b",  # needs a registry from v2112 on
        r"\bmoveAllCells\b",  # reads another place from v2212 on
        r"\b(?:min|max)Vertex\b",  # gone from v2506 on
    ],
)
def test_what_differs_between_releases_is_called_in_one_place(call):
    users = {
        path.name
        for path in sources("src") + sources("applications")
        if re.search(call, path.read_text())
    }
    assert users <= {"foamCompat.H", "motionZone.C"}


def test_every_source_says_whose_it_is_and_under_which_licence():
    files = [
        path
        for folder in (
            "src",
            "applications",
            "benchmarks",
            "tests",
            "tutorials",
            "python",
            "docs",
        )
        for path in (ROOT / folder).rglob("*")
        if path.suffix in (".C", ".H", ".cpp", ".hpp", ".py")
        and not GENERATED.intersection(path.parts[len(ROOT.parts) :])
    ]
    bare = [
        path.name
        for path in files
        if "SPDX-License-Identifier: GPL-3.0-or-later"
        not in path.read_text()[:400]
    ]
    assert not bare
