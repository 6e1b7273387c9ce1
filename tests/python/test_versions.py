# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""tests/versions/Allcheck compiles our sources against the headers of a tree of
OpenFOAM, and notices what does not compile or is deprecated. Source of truth:
the compiler.
"""

import importlib.machinery
import importlib.util
import os
import subprocess

import pytest

from foamCase import ROOT, environment
from rbfCase import groups, rbf_case

SCRIPT = ROOT / "tests/versions/Allcheck"


def allcheck(*arguments):
    done = subprocess.run(
        [SCRIPT, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
    )
    row = (
        [
            cell.strip()
            for cell in done.stdout.splitlines()[-1].split("|")
            if cell.strip()
        ]
        if done.stdout
        else []
    )
    return done.returncode, row, done.stderr


@pytest.fixture(scope="module")
def script():
    loader = importlib.machinery.SourceFileLoader("Allcheck", str(SCRIPT))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader("Allcheck", loader)
    )
    loader.exec_module(module)
    return module


def contents(folder):
    return {
        path: os.lstat(path).st_mtime_ns
        for path in [folder, *folder.glob("*"), *folder.glob("src/*")]
    }


def test_a_file_compiles_against_the_openfoam_that_builds_us():
    env = environment()
    with open(os.path.join(env["WM_PROJECT_DIR"], "META-INFO/api-info")) as f:
        api = f.read().split()[0].removeprefix("api=")
    status, row, errors = allcheck(
        "-files", "src/motion/uniformDisplacement.C", env["WM_PROJECT_DIR"]
    )
    assert (status, errors) == (0, "")
    assert row == ["v" + api, "1", "0", "0", "0", "0"]


def test_what_does_not_compile_is_told_and_the_tree_stays(tmp_path):
    """A release without any header."""
    (tmp_path / "META-INFO").mkdir()
    (tmp_path / "src/OpenFOAM").mkdir(parents=True)
    (tmp_path / "META-INFO/api-info").write_text("api=3012\npatch=0\n")
    before = contents(tmp_path)
    status, row, errors = allcheck(
        "-files", "src/motion/(uniform|values)Displacement.C", tmp_path
    )
    assert status == 1
    assert row == ["v3012", "0", "2", "0", "0", "0"]
    assert "src/motion/uniformDisplacement.C does not compile" in errors
    assert "No such file" in errors
    assert contents(tmp_path) == before


def test_what_is_no_openfoam_is_refused(tmp_path):
    status, _, errors = allcheck(tmp_path)
    assert status == 1 and "no tree of openfoam.com" in errors


def test_deprecated_calls_count_where_we_make_them(script):
    ours = f"{ROOT}/src/foam/foamCompat.H"
    text = f"""\
{ours}:73:5: warning: 'scatter' is deprecated [-Wdeprecated-declarations]
{ours}:73:5: warning: 'scatter' is deprecated [-Wdeprecated-declarations]
{ours}:80:5: warning: unused variable 'a' [-Wunused-variable]
/elsewhere/Pstream.H:7:5: warning: 'x' is deprecated [-Wdeprecated-declarations]
{ours}:99:5: note: declared here
"""
    outcome = script.Outcome(["a.C"], 0, text)
    assert len(outcome.deprecated) == 1 and len(outcome.warnings) == 1
    assert not outcome.failed


@pytest.mark.parametrize("libraries", ["dynamicMeshDict", "controlDict"])
@pytest.mark.parametrize("key", ["motionSolver", "solver"])
def test_the_words_of_every_release_are_understood(tmp_path, key, libraries):
    """As docs/pages/versions.md has them. Source of truth: motionSolver::New
    and dlLibraryTable of each release."""
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            top="type moving; patches (zMax); displacement { type uniform;"
            " value (0 0 0.1); }",
            bottom="type fixed; patches (zMin);",
        ),
    )
    dictionary = tmp_path / "constant/dynamicMeshDict"
    text = dictionary.read_text().replace(
        "motionSolver        rbf", f"{key}        rbf"
    )
    if libraries == "controlDict":
        text = text.replace("motionSolverLibs    (morphMotionSolvers);", "")
        with open(tmp_path / "system/controlDict", "a") as control:
            control.write("libs (morphMotionSolvers);\n")
    dictionary.write_text(text)
    case.run("moveDynamicMesh")
    assert case.points("1/polyMesh/points")[:, 2].max() == pytest.approx(1.1)


def test_every_source_file_is_compiled(script):
    listed = subprocess.run(
        ["git", "ls-files", "*.C"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        universal_newlines=True,
    )
    if listed.returncode:
        pytest.skip("no git repository")
    assert {str(ROOT / path) for path in listed.stdout.split()} <= set(
        script.sourceFiles()
    )
