#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""submit.py CORES SCRIPT: a job of Slurm that runs the script; prints its number.

Where the queue takes no more jobs it is asked again. How a job ends is written
beside the workflow (slurm/<number>.exit), where any machine sees it after the
queue has forgotten the job.
"""

import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

# Seconds between two tries, and all of them
PAUSE, PATIENCE = 10, 24 * 3600
FULL = re.compile(
    r"MaxSubmitJob|MaxJobs|temporarily unable|Resource temporarily|try again"
    r"|Socket timed out|Unable to contact|Connection refused",
    re.IGNORECASE,
)


def main():
    cores, script = sys.argv[1], Path(sys.argv[2]).resolve()
    folder = Path("slurm").resolve()
    folder.mkdir(exist_ok=True)
    command = [
        "sbatch",
        "--parsable",
        "--requeue",
        f"--cpus-per-task={cores}",
        "--job-name=morphStudy",
        f"--output={folder}/%j.log",
        *shlex.split(os.environ.get("MORPHSTUDY_SBATCH", "")),
        "--wrap",
        f"rm -f {shlex.quote(str(folder))}/$SLURM_JOB_ID.exit;"
        f" bash {shlex.quote(str(script))}; status=$?;"
        f" echo $status > {shlex.quote(str(folder))}/$SLURM_JOB_ID.exit;"
        " exit $status",
    ]
    end = time.monotonic() + PATIENCE
    while True:
        done = subprocess.run(command, text=True, capture_output=True)
        if done.returncode == 0:
            number = done.stdout.split(";")[0].strip()
            (folder / f"{number}.job").touch()
            print(number)
            return 0
        if not FULL.search(done.stderr) or time.monotonic() > end:
            sys.stderr.write(done.stderr)
            return done.returncode
        time.sleep(PAUSE)


sys.exit(main())
