# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Fixtures that several files of tests share."""

import json

import pytest


@pytest.fixture
def at_once(monkeypatch):
    """Designs of a study in this process: what the workflow engine costs is not what
    these tests are about."""

    from morphfoam.study import sweep, worker

    def engine(study, workflow, cores, profile, progress):
        plan = json.loads((workflow / "plan.json").read_text())
        for job in plan["jobs"].values():
            strategy, number = job["command"].split()[-2:]
            worker.Worker(study, strategy, int(number)).work()
        progress.update()

    monkeypatch.setattr(sweep, "engine", engine)
