# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphStudy run -dryRun: what comes before the solver, and nothing else.

Source of truth: the study's README.
"""

import csv

import pytest

from study_case import command, make_study, read

from morphfoam.study import designs, outcomes
from morphfoam.study.errors import StudyError

# x beyond 0.7 has no mesh
STEPS = (
    "morph:\n    steps: {solve: bash solver.sh}",
    'morph:\n    steps:\n      mesh: \'sed -n "s/^x *//p" parameters |'
    ' tr -d ";" | tee mesh | awk "{ exit (\\$1 > 0.7) }"\'\n'
    "      solve: bash solver.sh",
)


def table(path):
    with path.open() as file:
        return {row["design"]: row for row in csv.DictReader(file)}


@pytest.fixture
def path(tmp_path):
    path = make_study(
        tmp_path,
        STEPS,
        ("method: latinHypercube, designs: 4", "method: sobol, designs: 5"),
    )
    command("sample", path)
    return path


def test_meshes_are_made_and_no_solver_runs(path):
    said = command("run", path, "-dryRun")
    study = read(path)
    bad = {d.id for d in designs.read(study) if d.parameters["x"] > 0.7}
    assert 0 < len(bad) < 5
    assert f"morph.dryRun: {5 - len(bad)} done, {len(bad)} failed" in said
    rows = table(study.folder / "results.morph.dryRun.csv")
    assert {n for n, row in rows.items() if row["status"] == "failed"} == bad
    # Of the solver: only the baseline's
    assert [p.name for p in path.parent.glob("runs.*")] == ["runs.baseline"]
    for d in designs.read(study):
        case = outcomes.case(study, "morph.dryRun", d.number)
        assert float((case / "mesh").read_text()) == d.parameters["x"]
        assert outcomes.read(study, "morph", d.number) is None


def test_it_is_made_anew_and_leaves_the_sweep_alone(path):
    command("run", path)
    study = read(path)
    before = {
        file: file.stat().st_mtime_ns
        for file in (study.folder / "outcomes/morph").glob("*.json")
    }
    command("run", path, "-dryRun")
    said = command("run", path, "-dryRun", "-only", 1, 2)
    assert "morph.dryRun: 0 of 2 designs are finished" in said
    assert before == {file: file.stat().st_mtime_ns for file in before}
    said = command("status", path)
    assert ", 0 not finished" in said and "dryRun" not in said


def test_without_steps_before_the_solver_there_is_nothing_to_do(tmp_path):
    path = make_study(tmp_path)
    command("sample", path)
    said = command("run", path, "-dryRun", status=1)
    assert "no step before solve" in said and "steps of their own" in said


def test_a_dry_run_starts_from_the_baseline_where_the_sweep_takes_the_nearest(
    tmp_path,
):
    path = make_study(
        tmp_path,
        (
            "start: nearest\n    steps: {",
            "start: nearest\n    steps: {m: ls, ",
        ),
    )
    strategy = read(path).strategy("near.dryRun")
    assert (strategy.start, [s.name for s in strategy.steps]) == (
        "baseline",
        ["m"],
    )
    with pytest.raises(StudyError):
        read(path).strategy("remesh.dryRun")
