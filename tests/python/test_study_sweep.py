# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Designs from folder to outcome, and sweeps that are killed. The solver is
arithmetic (study_case.py), so that what must come out is known: f = x^2 + y,
g = 1 - x y, three iterations from the time it starts at."""

import csv
import json
import os
import signal
import subprocess
import sys
import time

import pytest

from study_case import ROOT, command, make_study, read

from morphfoam.study import (
    case_folder,
    designs,
    outcomes,
    process,
    status,
    sweep,
    worker,
)
from morphfoam.study.errors import StudyError

POINTS = [
    (0.1, 0.2),
    (0.95, 0.5),
    (0.3, 0.4),
    (0.15, 0.2),
    (0.5, 0.95),
    (0.6, 0.1),
]
TIMEOUT = ("optimise:", "failure: {timeout: 10}\noptimise:")


def started(folder, *changes):
    """The study with its designs, nothing run."""
    study = read(make_study(folder, *changes))
    designs.add(study, POINTS, designs.SAMPLED)
    return study


def work(study, strategy, *numbers):
    """Without the workflow engine."""
    for number in numbers:
        worker.Worker(study, strategy, number).work()
    return outcomes.read(study, strategy, numbers[-1] or None)


def runs(study, case):
    """How often a case's solver was started."""
    path = study.root / f"runs.{case}"
    return path.read_text().count("ran") if path.exists() else 0


def table(study, strategy):
    """The results without what differs from run to run."""
    with (study.folder / f"results.{strategy}.csv").open() as file:
        return {
            row["design"]: {
                k: v
                for k, v in row.items()
                if not k.startswith(("time", "cpuTime"))
            }
            for row in csv.DictReader(file)
        }


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """A whole sweep, and what it said."""
    study = started(tmp_path_factory.mktemp("undisturbed"), TIMEOUT)
    return study, command("run", study.path, "-cores", 2)


def test_every_design_is_computed_from_its_own_parameters(undisturbed):
    rows = table(undisturbed[0], "morph")
    for i in (1, 3, 4, 6):
        x, y = POINTS[i - 1]
        row = rows[f"{i:04d}"]
        assert row["status"] == "done"
        assert float(row["f"]) == pytest.approx(x * x + y, rel=1e-15)
        assert float(row["g"]) == pytest.approx(1 - x * y, rel=1e-5)
        assert row["iterations"] == "3"
    assert rows["baseline"]["f"] == "0.75"


def test_a_design_that_fails_is_recorded_and_the_rest_go_on(undisturbed):
    study, said = undisturbed
    rows = table(study, "morph")
    assert rows["0002"]["status"] == rows["0005"]["status"] == "failed"
    # It started at the baseline's time 3
    assert rows["0002"]["reason"] == (
        "solve: diverged, floating point exception at time 6"
    )
    assert rows["0005"]["reason"] == "solve: timeout after 10 s"
    assert "4 done, 2 failed, 0 not finished" in said


def test_the_sweep_says_how_far_it_is(undisturbed, capsys):
    study, said = undisturbed
    assert "baseline: done" in said
    assert "[1/6]" in said and "[6/6]" in said and " left" in said
    status.status(study)
    said = capsys.readouterr().out
    assert "morph: 4 done, 2 failed, 0 not finished" in said
    assert "1 x solve: diverged (0002): solve: diverged" in said
    assert "remesh: 0 done, 0 failed, 6 not finished" in said


def test_what_is_finished_is_not_run_again(undisturbed):
    study, _ = undisturbed
    before = {
        p: p.stat().st_mtime_ns
        for p in study.folder.glob("outcomes/morph/*.json")
    }
    assert sweep.run(study) == 0
    assert before == {p: p.stat().st_mtime_ns for p in before}
    assert [runs(study, f"{i:04d}") for i in range(1, 7)] == [1] * 6


def processes(folder):
    """What runs in a folder or below."""
    found = []
    for entry in os.listdir("/proc"):
        try:
            if entry.isdigit() and os.readlink(
                f"/proc/{entry}/cwd"
            ).startswith(str(folder)):
                found.append(int(entry))
        except OSError:
            pass
    return found


def wait_until(condition, what):
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.02)


def test_killed_in_the_middle_it_goes_on_and_repeats_nothing(
    undisturbed, tmp_path
):
    study = started(tmp_path, TIMEOUT)
    sweep_ = subprocess.Popen(
        [ROOT / "bin/morphStudy", "run", study.path, "-cores", "1"],
        env={**os.environ, "PAUSE": "0.5"},
        stdout=subprocess.DEVNULL,
    )
    # In the middle of a design: it has started, another has finished
    folder = study.folder / "outcomes/morph"
    wait_until(lambda: list(folder.glob("*.json")), "no design finished")
    done = {p.stem for p in folder.glob("*.json")}
    wait_until(
        lambda: any(
            runs(study, f"{i:04d}")
            for i in range(1, 7)
            if f"{i:04d}" not in done
        ),
        "no second design",
    )
    sweep_.send_signal(signal.SIGKILL)
    sweep_.wait()
    wait_until(lambda: not processes(study.folder), "something still runs")
    done = {p.stem for p in folder.glob("*.json")}
    assert 0 < len(done) < 6
    half_made = [
        d.name
        for d in (study.folder / "morph").iterdir()
        if d.name not in done
    ]
    assert half_made

    command("run", study.path, "-cores", "2")
    assert table(study, "morph") == table(undisturbed[0], "morph")
    assert all(runs(study, name) == 1 for name in ["baseline", *done])
    assert all(
        runs(study, name) == 2 for name in half_made if runs(study, name)
    )


def test_a_worker_whose_engine_is_gone_does_nothing(tmp_path):
    study = started(tmp_path)
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "morphfoam.study.worker",
            study.path,
            study.path,
            "remesh",
            "1",
        ],
        env={**os.environ, "PYTHONPATH": ROOT / "python"},
    )
    assert done.returncode == 1
    assert not study.folder.joinpath("remesh").exists()


def test_interrupted_it_stops_at_once_and_says_so(undisturbed):
    study, _ = undisturbed
    outcomes.path(study, "morph", 1).unlink()
    sweep_ = subprocess.Popen(
        [ROOT / "bin/morphStudy", "run", study.path],
        text=True,
        env={**os.environ, "PAUSE": "20"},
        stdout=subprocess.PIPE,
        # Shells let what they start in the background ignore it
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    wait_until(lambda: runs(study, "0001") == 2, "no design started")
    sweep_.send_signal(signal.SIGINT)
    assert "The same command goes on from here" in sweep_.communicate()[0]
    assert sweep_.returncode == 130
    wait_until(lambda: not processes(study.folder), "something still runs")


def test_two_sweeps_at_once_are_refused(undisturbed):
    with sweep.only_one(undisturbed[0]):
        with pytest.raises(StudyError, match="another morphStudy is at work"):
            sweep.run(undisturbed[0])


def test_a_design_may_not_take_more_cores_than_there_are(tmp_path):
    study = started(
        tmp_path, ("baseline:\n  steps", "cores: 4\nbaseline:\n  steps")
    )
    with pytest.raises(StudyError, match="takes 4 cores.* there are 2"):
        sweep.run(study, cores=2)


def test_a_profile_is_passed_on(tmp_path, capsys):
    study = started(tmp_path)
    assert sweep.run(study, "remesh", profile=str(tmp_path / "slurm")) == 1
    assert "Error: profile given but no config.yaml found" in (
        capsys.readouterr().out
    )
    (tmp_path / "slurm").mkdir()
    (tmp_path / "slurm/config.yaml").write_text("cores: 1\n")
    assert (
        sweep.run(
            study, "remesh", profile=str(tmp_path / "slurm"), only=[1, 3]
        )
        == 0
    )
    assert " left" in capsys.readouterr().out


def test_a_failing_baseline_stops_the_sweep(tmp_path, capsys):
    study = started(
        tmp_path,
        (
            "x: {bounds: [0, 1], baseline: 0.5}",
            "x: {bounds: [0, 1], baseline: 0.95}",
        ),
    )
    assert sweep.run(study) == 1
    said = capsys.readouterr().out
    assert "Error: the baseline failed: solve: diverged" in said
    assert not (study.folder / "outcomes/morph").exists()


def test_designs_start_from_the_baselines_fields(tmp_path):
    study = started(tmp_path)
    assert work(study, "baseline", 0).status == "done"
    outcome = work(study, "morph", 1)
    case = outcomes.case(study, "morph", 1)
    # The baseline ended at time 3; the solver adds the time to x
    assert float((case / "6/U").read_text()) == pytest.approx(0.1 + 3)
    assert outcome.started_from == "baseline"


def test_remeshed_designs_start_from_the_template(tmp_path):
    study = started(tmp_path)
    outcome = work(study, "remesh", 1)
    case = outcomes.case(study, "remesh", 1)
    assert float((case / "3/U").read_text()) == pytest.approx(0.1)
    assert outcome.started_from == "template"
    assert not outcomes.case(study, "baseline").exists()


def test_nearest_is_the_nearest_earlier_design_that_did_not_fail(tmp_path):
    study = started(tmp_path)
    work(study, "baseline", 0)
    table_ = designs.read(study)
    # 4 (0.15, 0.2): 1 (0.1, 0.2) is nearer than 3 (0.3, 0.4), then the baseline
    assert worker.nearer(study, table_, 4) == [1, 3]
    assert work(study, "near", 1, 4).started_from == "0001"
    case = outcomes.case(study, "near", 4)
    # Fields of design 1 under the baseline's time
    assert sorted(p.name for p in case.iterdir() if p.is_dir()) == ["3", "6"]
    assert (case / "3/U").read_text() == (
        outcomes.case(study, "near", 1) / "6/U"
    ).read_text()
    # 1 fails: 3 is not there yet, so it is the baseline
    outcome = outcomes.read(study, "near", 1)
    outcome.status = "failed"
    outcomes.write(study, outcome)
    assert work(study, "near", 4).started_from == "baseline"


def test_the_plan_waits_for_what_a_design_starts_from(tmp_path):
    study = started(tmp_path)
    chosen = designs.read(study)
    jobs = sweep.plan(study, "near", chosen, study.path)
    assert jobs["0004"]["after"] == ["baseline", "0001"]
    assert jobs["0001"]["after"] == ["baseline"]
    assert list(sweep.plan(study, "remesh", chosen, study.path)) == [
        f"{i:04d}" for i in range(1, 7)
    ]


def test_the_outcome_says_why_a_response_is_missing(tmp_path):
    study = started(tmp_path, ("'f = (\\S+)'", "'lift = (\\S+)'"))
    assert work(study, "remesh", 1).reason == (
        "response f: log.solve has nothing like lift = (\\S+)"
    )


def test_a_response_outside_its_limits_fails_the_design(tmp_path):
    study = started(
        tmp_path,
        ("regex: 'f = (\\S+)'", "regex: 'f = (\\S+)', limits: [0, 0.3]"),
    )
    assert work(study, "remesh", 1).status == "done"
    assert work(study, "remesh", 3).reason == (
        "response f is 0.49, outside its limits [0, 0.3]"
    )


def test_a_step_must_say_what_is_expected(tmp_path):
    study = started(
        tmp_path,
        (
            "steps: {solve: bash solver.sh}",
            ("steps: {solve: {run: bash solver.sh, expect: converged}}"),
        ),
    )
    assert work(study, "remesh", 1).reason == (
        "solve: its log does not say 'converged'"
    )


def test_a_failed_design_is_tried_again_as_often_as_asked(tmp_path):
    study = started(
        tmp_path, ("optimise:", "failure: {retries: 2}\noptimise:")
    )
    outcome = work(study, "remesh", 2)
    assert outcome.attempts == 3 and outcome.status == "failed"
    assert runs(study, "0002") == 3
    assert work(study, "remesh", 1).attempts == 1


def test_designs_made_in_another_way_are_not_mixed(tmp_path):
    study = started(tmp_path)
    work(study, "remesh", 1)
    make_study(tmp_path, ("solve: bash solver.sh", "solve: bash ./solver.sh"))
    with pytest.raises(StudyError, match="design 0001.*steps differ"):
        sweep.keep_up(read(study.path), "remesh", [1])


def test_changed_responses_are_read_again_without_a_run(tmp_path):
    study = started(tmp_path)
    work(study, "remesh", 1)
    study = read(
        make_study(
            tmp_path, ("optimise:", ("  h: {expression: f + 2*x}\noptimise:"))
        )
    )
    sweep.keep_up(study, "remesh", [1])
    assert outcomes.read(study, "remesh", 1).responses["h"] == (
        pytest.approx(0.21 + 0.2)
    )
    assert runs(study, "0001") == 1


def test_designs_of_another_baseline_are_not_mixed(tmp_path):
    study = started(tmp_path)
    work(study, "baseline", 0)
    work(study, "morph", 1)
    sweep.keep_up(study, "morph", [1])
    outcomes.path(study, "baseline").unlink()
    with pytest.raises(StudyError, match="0001.*baseline that is no more"):
        sweep.keep_up(study, "morph", [1])


def test_a_change_of_the_template_is_said(tmp_path, capsys):
    study = started(tmp_path)
    work(study, "remesh", 1)
    sweep.keep_up(study, "remesh", [1])
    assert capsys.readouterr().out == ""
    with (study.template / "solver.sh").open("a") as file:
        file.write("true\n")
    sweep.keep_up(study, "remesh", [1])
    assert "has changed since 1 of the finished designs" in (
        capsys.readouterr().out
    )


def test_failed_designs_are_redone_on_request(tmp_path):
    study = started(tmp_path)
    work(study, "remesh", 1, 2)
    sweep.forget(study, "remesh", designs.read(study), ["failed"])
    assert outcomes.read(study, "remesh", 1)
    assert outcomes.read(study, "remesh", 2) is None
    sweep.forget(study, "remesh", designs.read(study), [1])
    assert outcomes.read(study, "remesh", 1) is None


def test_copies_of_the_template_leave_out_what_runs_leave_behind(tmp_path):
    study = read(
        make_study(
            tmp_path,
            (
                "template: case",
                "template: .\nexclude: ['*.png', constant/old]",
            ),
        )
    )
    for name in (
        "system/controlDict",
        "constant/old/a",
        "constant/new/a",
        "processor0/0/U",
        "postProcessing/a",
        "log.solve",
        "a.png",
        "study.study/morph/0001/a",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    target = study.folder / "morph/0002"
    case_folder.copy_template(study, target)
    assert {
        str(p.relative_to(target)) for p in target.rglob("*") if p.is_file()
    } == {
        "system/controlDict",
        "constant/new/a",
        "case/solver.sh",
        "study.yaml",
    }


def test_copies_of_a_case_have_its_mesh_and_its_last_time(tmp_path):
    for name in (
        "0/U",
        "50/U",
        "100/U",
        "100/polyMesh/points",
        "log.a",
        "constant/polyMesh/faces",
        "postProcessing/a/0/b",
        "processor0/50/U",
        "processor0/100/U",
        "system/0.5/a",
    ):
        (tmp_path / "a" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "a" / name).touch()
    assert case_folder.copy_case(tmp_path / "a", tmp_path / "b") == "100"
    assert {
        str(p.relative_to(tmp_path / "b"))
        for p in (tmp_path / "b").rglob("*")
        if p.is_file()
    } == {
        "0/U",
        "100/U",
        "100/polyMesh/points",
        "constant/polyMesh/faces",
        "processor0/100/U",
        "system/0.5/a",
    }


def test_columns_are_averaged_over_the_window(tmp_path):
    study = started(
        tmp_path,
        (
            "file: log.solve, regex: 'f = (\\S+)'",
            ("file: 'post/*/f.dat', column: f, window: 2"),
        ),
        (
            "file: log.solve, regex: 'g = (\\S+)'",
            ("file: log.solve, regex: 'Time = (\\S+)', window: 2"),
        ),
        (
            "{solve: bash solver.sh}",
            (
                "{solve: bash solver.sh; mkdir -p post/0 post/20 post/3;"
                " printf '# Time\\tf\\n1 9\\n2 (4)\\n3 5\\n' > post/20/f.dat;"
                " touch post/0/f.dat post/3/f.dat}"
            ),
        ),
    )
    assert work(study, "remesh", 1).responses == {"f": 4.5, "g": 2.5}


def test_commands_print_several_responses_and_run_once(tmp_path):
    print_ = "command: 'echo x >> called; echo f 1.5; echo g 2'"
    study = started(
        tmp_path,
        ("file: log.solve, regex: 'f = (\\S+)'", print_),
        ("file: log.solve, regex: 'g = (\\S+)'", print_),
    )
    assert work(study, "remesh", 1).responses == {"f": 1.5, "g": 2}
    called = outcomes.case(study, "remesh", 1) / "called"
    assert called.read_text() == "x\n"


def test_notes_are_blank_where_they_cannot_be_read(tmp_path):
    study = started(
        tmp_path,
        (
            "optimise:",
            (
                "notes:\n  last: {file: log.solve, regex: 'Time = (.*)'}\n"
                "  none: {file: log.solve, regex: 'selected (.*)'}\noptimise:"
            ),
        ),
    )
    outcome = work(study, "remesh", 1)
    assert outcome.status == "done" and outcome.notes == {"last": 3}


def test_a_picture_is_kept_and_its_failure_is_noted(tmp_path):
    study = started(
        tmp_path, ("optimise:", "picture: echo made > picture.png\noptimise:")
    )
    assert work(study, "remesh", 1).picture == "remesh/0001/picture.png"
    study = read(
        make_study(tmp_path, ("optimise:", "picture: exit 1\noptimise:"))
    )
    outcome = work(study, "remesh", 3)
    assert outcome.status == "done"
    assert outcome.picture == "none: see 0003/log.picture"


def test_times_of_steps_are_wall_and_processor_time(tmp_path):
    _, wall, cpu = process.run("sleep 0.3", tmp_path, tmp_path / "log")
    assert 0.3 <= wall and cpu < 0.2
    _, wall, cpu = process.run(
        "for ((i = 0; i < 100000; ++i)); do :; done",
        tmp_path,
        tmp_path / "log",
    )
    assert 0.05 < cpu < wall + 0.05


def test_a_timeout_ends_all_that_a_command_started(tmp_path):
    status, wall, _ = process.run(
        "sleep 51.7 & bash -c 'sleep 52.7; true'",
        tmp_path,
        tmp_path / "log",
        0.5,
    )
    assert status is None and 0.5 <= wall < 10
    wait_until(lambda: not processes(tmp_path), "something still runs")


def test_an_outcome_is_whole_or_not_there(tmp_path, monkeypatch):
    study = started(tmp_path)
    outcome = outcomes.Outcome(strategy="remesh", number=1, parameters={})

    def crash(*_, **__):
        raise OSError("disk full")

    monkeypatch.setattr(json, "dump", crash)
    with pytest.raises(OSError):
        outcomes.write(study, outcome)
    assert outcomes.read(study, "remesh", 1) is None
