# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Tutorials that move the mesh in each time step, in short form and in
temporary copies.

Sources of truth: the same case with a mesh that moves as a whole, for which no
motion solver has to find where the points go; OpenFOAM's own solver of a rigid
body; the formula of the twist.
"""

import csv
import re

import pytest

from tutorialCase import run, tutorial


def rows(path, key="run"):
    with path.open() as file:
        return {row[key]: row for row in csv.DictReader(file)}


def selections(log):
    return re.findall(
        r"^rbfMotionSolver: selected (\d+) of (\d+)",
        log.read_text(),
        re.MULTILINE,
    )


@pytest.fixture(scope="module")
def cylinder(tmp_path_factory):
    case = tutorial("oscillatingCylinder", tmp_path_factory.mktemp("cylinder"))
    run(case, "./Allrun", "-short")
    return case


def test_forces_on_the_cylinder_are_those_on_a_rigid_mesh(cylinder):
    forces = rows(cylinder / "results/forces.csv")
    ours, rigid = forces["oscillating"], forces["rigid"]
    assert float(ours["mean Cd"]) == pytest.approx(
        float(rigid["mean Cd"]), rel=3e-3
    )
    assert float(ours["Cl at the period"]) == pytest.approx(
        float(rigid["Cl at the period"]), rel=2e-2
    )
    assert float(ours["phase [deg]"]) == pytest.approx(
        float(rigid["phase [deg]"]), abs=1.5
    )


def test_the_wake_of_the_cylinder_locks_in(cylinder):
    forces = rows(cylinder / "results/forces.csv")
    assert float(forces["oscillating"]["lift frequency"]) == pytest.approx(
        1 / 6, rel=1e-2
    )


def test_a_cylinder_that_oscillates_is_selected_once(cylinder):
    assert len(selections(cylinder / "runs/oscillating/log.pimpleFoam")) == 1


def test_lift_of_the_pitching_aerofoil_is_that_on_a_rigid_mesh(
    tmp_path_factory,
):
    case = tutorial("pitchingAerofoil", tmp_path_factory.mktemp("aerofoil"))
    run(case, "./Allrun", "-noPictures", "-endTime", "1")
    forces = rows(case / "results/forces.csv")
    assert (
        float(forces["morphed"]["rms difference of Cl, of its largest"]) < 0.01
    )
    assert len(selections(case / "runs/morphed/log.pimpleFoam")) == 1


def test_a_floating_body_goes_where_it_does_with_a_rigid_body_solver(
    tmp_path_factory,
):
    case = tutorial("floatingBody", tmp_path_factory.mktemp("floating"))
    run(case, "./Allrun", "-noPictures", "-endTime", "0.15")
    for row in rows(case / "results/trajectory.csv", "motion").values():
        assert float(row["largest difference, of that"]) < 0.02
        assert float(row["largest, rbf"]) > 1e-4
    restart = rows(case / "results/restart.csv", "figure")
    assert len(restart) == 2
    for row in restart.values():
        assert float(row["value"]) < 1e-6


def test_a_column_twists_by_180_degrees_and_comes_back(tmp_path_factory):
    case = tutorial("twistingColumn", tmp_path_factory.mktemp("column"))
    run(case, "./Allrun", "-noPictures")
    twist = rows(case / "results/twist.csv", "time")
    assert float(twist["10"]["twist [deg]"]) == 180
    for time in ("10", "30"):
        assert float(twist[time]["largest distance"]) < 0.005
        assert float(twist[time]["non-orthogonality"]) < 14
    for time in ("20", "40"):
        assert float(twist[time]["largest distance"]) < 1e-14


def test_a_wing_on_springs_pitches_as_with_a_rigid_body_solver(
    tmp_path_factory,
):
    case = tutorial("wingMotion", tmp_path_factory.mktemp("wing"))
    run(
        case,
        "./Allrun",
        "-noPictures",
        "-steadySteps",
        "50",
        "-endTime",
        "0.0002",
    )
    motion = rows(case / "results/trajectory.csv", "motion")
    assert float(motion["pitch [deg]"]["largest difference, of that"]) < 0.01
    assert float(motion["pitch [deg]"]["largest, rbf"]) > 0.003
