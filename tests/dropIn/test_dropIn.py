# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A small part of Allrun: OpenFOAM's tutorials with two lines changed.

Source of truth: OpenFOAM's own motion solvers on the same cases.
"""

import pathlib
import subprocess

import pytest

import dropInPage
from dropIn import compare, same, try_out
from foamCase import ROOT, environment
from movingTutorials import tutorials
from tutorialCase import TutorialCase


@pytest.fixture(scope="module")
def source():
    folder = environment().get("FOAM_TUTORIALS")
    if not folder or not pathlib.Path(folder).is_dir():
        pytest.skip("OpenFOAM's tutorials are not installed")
    subprocess.run(
        ["wmake", "libso", ROOT / "tests/dropIn/motionClock"],
        env=environment(),
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    return pathlib.Path(folder)


def test_tutorials_are_found_by_their_dictionaries(source):
    names = {tutorial.name for tutorial in tutorials(source)}
    assert "mesh/moveDynamicMesh/SnakeRiverCanyon" in names
    # A mesh that is refined does not move
    assert not any("damBreakWithObstacle" in name for name in names)
    if environment()["WM_PROJECT_VERSION"] == "v1912":
        assert len(names) == 72


CASES = {
    # Conditions of pointDisplacement, overset: its own solver
    "basic/overLaplacianDyMFoam/heatTransfer": "same",
    # Rigid zones
    "incompressible/overPimpleDyMFoam/simpleRotor": "same",
    # Velocities of one component, as the message prints them
    "incompressible/pimpleFoam/laminar/movingCone": "change",
    # What the message says cannot be
    "incompressible/pimpleFoam/laminar/contactAngleCavity": "limit",
}


@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_the_originals(tmp_path, source, name):
    tutorial = next(t for t in tutorials(source) if t.name == name)
    result = try_out(tutorial, source, tmp_path / "case")
    assert result["outcome"] == CASES[name], result
    if CASES[name] == "limit":
        return
    run = dropInPage.measured(result)
    assert run["moved"] > 0 and run["restless"] == 0
    assert run["difference"] <= tutorial.tolerance
    # The clock was before both solvers
    assert run["original"]["step"] > 0 and run["morphFoam"]["step"] > 0
    assert name.split("/")[-1] in dropInPage.page([result])


def test_a_mesh_that_does_not_follow_is_not_called_the_same(tmp_path, source):
    name = "basic/overLaplacianDyMFoam/heatTransfer"
    tutorial = next(t for t in tutorials(source) if t.name == name)
    case = TutorialCase(tutorial, source, tmp_path / "case")
    case.prepare()
    original = case.run("original")
    field = case.case / "0/pointDisplacement"
    field.write_text(field.read_text().replace("(0.2 0 0)", "(0.21 0 0)"))
    found = compare(tutorial, original, case.run("ours", case.two_lines()))
    assert not same(tutorial, found)
    assert found["difference"] == pytest.approx(0.05, rel=1e-6)
