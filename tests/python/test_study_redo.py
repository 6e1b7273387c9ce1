# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What is made again when a template was wrong and is corrected, and what the
user is told. The solver is arithmetic (study_case.py). Source of truth: the
study's README, section "When something was wrong"."""

import os

import pytest

from study_case import make_study, read

from morphfoam.study import designs, outcomes, sweep, worker
from morphfoam.study.__main__ import redo_of
from morphfoam.study.errors import StudyError

# It stops until the dictionary is corrected
GUARD = "{solve: grep -q right settings && bash solver.sh}"
POINTS = [(0.1, 0.2), (0.3, 0.4)]


@pytest.fixture
def study(tmp_path):
    """Two designs that failed because a file of the template is wrong, which
    the baseline's own steps do not look at."""
    path = make_study(
        tmp_path,
        (
            "  morph:\n    steps: {solve: bash solver.sh}",
            f"  morph:\n    steps: {GUARD}",
        ),
    )
    (tmp_path / "case/settings").write_text("wrong\n")
    study = read(path)
    designs.add(study, POINTS, designs.SAMPLED)
    worker.Worker(study, "baseline", 0).work()
    for number in (1, 2):
        worker.Worker(study, "morph", number).work()
        assert not outcomes.read(study, "morph", number).done
    return study


def correct(study, text="right\n"):
    (study.template / "settings").write_text(text)


def redo(study, *numbers):
    for number in numbers:
        worker.Worker(study, "morph", number).work()
    return outcomes.read(study, "morph", numbers[-1])


def test_a_correction_of_the_template_reaches_designs_made_again(study):
    correct(study)
    assert redo(study, 1).done
    case = outcomes.case(study, "morph", 1)
    assert (case / "settings").read_text() == "right\n"
    # and nothing else of the baseline's is replaced
    assert (case / "3/U").exists()
    assert "x               0.1;" in (case / "parameters").read_text()


def test_a_correction_reaches_designs_of_studies_without_digests(study):
    """As they were written before the baseline kept them."""
    baseline = outcomes.read(study, "baseline")
    baseline.template_files = {}
    outcomes.write(study, baseline)
    assert not redo(study, 1).done
    correct(study)
    later = os.stat(study.template / "settings").st_mtime + 60
    os.utime(study.template / "settings", (later, later))
    assert redo(study, 1).done


def test_a_file_that_the_baselines_steps_changed_stays_theirs(
    tmp_path, capsys
):
    path = make_study(
        tmp_path,
        (
            "baseline:\n  steps: {solve: bash solver.sh}",
            "baseline:\n  steps: {solve: bash solver.sh;"
            " echo made >> settings}",
        ),
    )
    (tmp_path / "case/settings").write_text("old\n")
    study = read(path)
    designs.add(study, POINTS, designs.SAMPLED)
    worker.Worker(study, "baseline", 0).work()
    correct(study, "new\n")
    sweep.keep_up(study, "morph", [1])
    said = capsys.readouterr().out
    assert "settings" in said and "-redo baseline" in said
    redo(study, 1)
    case = outcomes.case(study, "morph", 1)
    assert (case / "settings").read_text() == "old\nmade\n"


def test_the_advice_after_a_change_works(study, capsys):
    """The words that are printed, taken as they are."""
    correct(study)
    sweep.keep_up(study, "morph", [1, 2])
    said = capsys.readouterr().out
    assert "-redo failed" in said and "-redo baseline" in said
    sweep.forget(study, "morph", designs.read(study), redo_of(["failed"]))
    assert redo(study, 1, 2).done


def test_redo_baseline_makes_all_anew_that_started_from_it(study, capsys):
    correct(study)
    worker.Worker(study, "remesh", 1).work()
    worker.Worker(study, "near", 1).work()
    chosen = designs.read(study)[:1]
    sweep.forget(study, "morph", chosen, redo_of(["baseline"]))
    assert outcomes.read(study, "baseline") is None
    for strategy, number in (("morph", 1), ("morph", 2), ("near", 1)):
        assert outcomes.read(study, strategy, number) is None
    assert outcomes.read(study, "remesh", 1)
    assert "2 of morph, 1 of near" in capsys.readouterr().out


@pytest.mark.parametrize(
    "number, said",
    [(0, "is called baseline: -redo baseline"), (7, "designs are 1 to 2")],
)
def test_redo_of_what_is_not_there_is_an_error(study, number, said):
    with pytest.raises(StudyError, match=said):
        sweep.forget(study, "morph", designs.read(study), [number])


def test_redo_of_a_design_that_is_not_run_is_an_error(study):
    with pytest.raises(StudyError, match="-only"):
        sweep.forget(study, "morph", designs.read(study)[:1], [2])


def test_a_design_that_started_from_another_baseline_is_told_what_to_do(
    study,
):
    baseline = outcomes.read(study, "baseline")
    baseline.finished = "2000-01-01T00:00:00"
    outcomes.write(study, baseline)
    with pytest.raises(StudyError, match="-redo baseline"):
        sweep.keep_up(study, "morph", [1])
