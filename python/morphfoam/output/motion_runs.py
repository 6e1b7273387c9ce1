# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Runs of moveDynamicMesh that are watched for a mesh that becomes invalid."""

import subprocess
import sys
from pathlib import Path


def run_until_invalid(case, invalid, start=0.0):
    """Run moveDynamicMesh in a case until its mesh is no longer valid.

    case      folder of the case; log.moveDynamicMesh is written there
    invalid   compiled expression of a line that says the mesh is invalid, or
              that the motion is refused; at it the run is stopped
    start     time of the mesh that the run starts from [s]

    Returns the last time with a valid mesh, and the first without one: None if
    the run came to its end. A run that fails in another way ends the program.
    """
    time = valid = start
    log_file = Path(case) / "log.moveDynamicMesh"
    with log_file.open("w") as log:
        process = subprocess.Popen(
            ["moveDynamicMesh", "-case", case],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        for line in process.stdout:
            log.write(line)
            if line.startswith("Time = "):
                valid, time = time, float(line.split()[2])
            elif invalid.search(line):
                process.kill()
                process.wait()
                return valid, time
        if process.wait():
            sys.exit(f"Error: moveDynamicMesh failed, see {log_file}")
    return time, None
