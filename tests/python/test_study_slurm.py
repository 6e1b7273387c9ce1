# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sweeps on a cluster: a real Slurm with two nodes on this machine.

Sources of truth: the closed forms of the study's solver, the table of an
undisturbed sweep, Slurm's own account of its jobs.
"""

import os
import shutil
import signal
import subprocess
import tempfile
import time

import pytest

import slurmCluster
from study_case import ROOT, make_study, read
from test_study_sweep import POINTS, processes, runs, table

from morphfoam.study import designs, outcomes, sweep
from morphfoam.study.errors import StudyError

pytestmark = pytest.mark.skipif(
    bool(slurmCluster.missing()),
    reason="Slurm is not installed: " + " ".join(slurmCluster.missing()),
)
# None of them diverges or hangs
GOOD = [(x, min(y, 0.8)) for x, y in POINTS if x < 0.9][:4]


@pytest.fixture
def cluster():
    """Paths of sockets have at most a hundred letters."""
    folder = tempfile.mkdtemp(prefix="slurm")
    try:
        with slurmCluster.SlurmCluster(folder + "/c") as made:
            yield made
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def started(folder):
    study = read(make_study(folder))
    designs.add(study, GOOD, designs.SAMPLED)
    return study


class Sweep:
    """One that is under way."""

    def __init__(self, study, cluster, pause):
        self.study, self.cluster = study, cluster
        self.process = subprocess.Popen(
            [ROOT / "bin/morphStudy", "run", study.path, "-profile", "slurm"],
            env={**cluster.environment, "PAUSE": str(pause)},
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    def started(self):
        return [
            n for n in range(1, len(GOOD) + 1) if runs(self.study, f"{n:04d}")
        ]

    def done(self):
        return list(self.study.folder.glob("outcomes/morph/*.json"))

    def end(self):
        while self.process.poll() is None:
            self.cluster.hasten()
            time.sleep(0.5)
        said = self.process.stdout.read()
        assert self.process.returncode == 0, (
            said + (self.study.folder / "snakemake.log").read_text()[-3000:]
        )
        return said


def wait_until(condition, what):
    end = time.monotonic() + 120
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.1)


def right(study):
    """Every design has what its parameters make."""
    rows = table(study, "morph")
    for n, (x, y) in enumerate(GOOD, 1):
        row = rows[f"{n:04d}"]
        assert row["status"] == "done"
        assert float(row["f"]) == pytest.approx(x * x + y)


def test_a_sweep_runs_on_the_nodes(tmp_path, cluster):
    study = started(tmp_path)
    said = Sweep(study, cluster, 0).end()
    right(study)
    assert f"[{len(GOOD)}/{len(GOOD)}]" in said and " left" in said
    assert all(runs(study, f"{n:04d}") == 1 for n in range(1, len(GOOD) + 1))
    told = cluster.ask("scontrol", "-o", "show", "job")
    assert told.count("JobState=COMPLETED") == len(GOOD) + 1
    assert "BatchHost=n1" in told and "BatchHost=n2" in told


def test_a_node_that_dies_takes_no_design_with_it(tmp_path, cluster):
    study = started(tmp_path)
    sweep_ = Sweep(study, cluster, 2)
    wait_until(lambda: len(sweep_.started()) >= 2, "nothing started")
    cluster.kill("n1")
    sweep_.end()
    right(study)
    assert cluster.state("n1").startswith("DOWN")
    # What was on that node was made again, the rest once
    again = [n for n in sweep_.started() if runs(study, f"{n:04d}") > 1]
    assert len(again) == 1


def test_a_job_that_is_preempted_is_made_again(tmp_path, cluster):
    study = started(tmp_path)
    sweep_ = Sweep(study, cluster, 2)
    wait_until(lambda: len(sweep_.started()) >= 2, "nothing started")
    told = cluster.ask(
        "sbatch", "--partition=urgent", "--output=/dev/null", "--wrap=sleep 1"
    )
    assert "Submitted" in told
    sweep_.end()
    right(study)
    assert any(runs(study, f"{n:04d}") == 2 for n in sweep_.started())


def test_a_sweep_that_is_killed_leaves_no_jobs_to_the_next(tmp_path, cluster):
    study = started(tmp_path)
    sweep_ = Sweep(study, cluster, 3)
    wait_until(lambda: len(sweep_.started()) >= 2, "nothing started")
    os.kill(sweep_.process.pid, signal.SIGKILL)
    sweep_.process.wait()
    said = Sweep(study, cluster, 0).end()
    right(study)
    assert "jobs of a former run are cancelled" in said
    wait_until(
        lambda: not cluster.ask("squeue", "--noheader").strip(),
        "jobs are left",
    )
    assert not processes(study.folder)


def test_a_full_queue_is_waited_for(tmp_path):
    folder = tempfile.mkdtemp(prefix="slurm")
    try:
        # Two jobs at once, and those that ended count until they are forgotten
        with slurmCluster.SlurmCluster(
            folder + "/c", settings="MaxJobCount=2\nMinJobAge=2"
        ) as cluster:
            study = started(tmp_path)
            Sweep(study, cluster, 0).end()
            right(study)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def test_a_profile_that_is_not_there_is_named(tmp_path):
    study = started(tmp_path)
    with pytest.raises(StudyError, match="no profile slurn. There are slurm"):
        sweep.run(study, profile="slurn")
    assert not outcomes.read(study, "morph", 1)
