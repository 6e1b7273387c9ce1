#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""status.py NUMBER: running, success or failed, of a job of submit.py."""

import re
import subprocess
import sys
import time
from pathlib import Path

# A job that is put back into the queue is pending again
ALIVE = {
    "PENDING",
    "CONFIGURING",
    "RUNNING",
    "COMPLETING",
    "SUSPENDED",
    "REQUEUED",
    "REQUEUE_HOLD",
    "RESIZING",
    "SIGNALING",
    "STAGE_OUT",
    "STOPPED",
}
# A queue that does not answer says nothing about its jobs
SILENT = re.compile(r"Unable to contact|timed out|Connection refused", re.I)
# Until all machines see a file [s]
LATENCY = 5


def ended(number):
    file = Path("slurm") / f"{number}.exit"
    text = file.read_text().strip() if file.exists() else ""
    return ("success" if text == "0" else "failed") if text else None


def main():
    number = sys.argv[1]
    asked = subprocess.run(
        ["scontrol", "-o", "show", "job", number],
        text=True,
        capture_output=True,
    )
    state = re.search(r"JobState=(\w+)", asked.stdout)
    if state and state[1] in ALIVE or SILENT.search(asked.stderr):
        return "running"
    found = ended(number)
    if not found:
        time.sleep(LATENCY)
        found = ended(number)
    return found or "failed"


print(main())
