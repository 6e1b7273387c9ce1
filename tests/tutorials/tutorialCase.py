# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Tutorials to run as regressions: in a copy, beside what they refer to.

    case = tutorial("airFoil2D", tmp_path)
    run(case, "./Allrun", "-noPictures")
"""

import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def tutorial(name, folder):
    """A copy of a tutorial as it is in the repository, in a house of its own."""
    house = Path(folder) / "house"
    house.mkdir()
    for part in ("bin", "etc", "python", "build"):
        (house / part).symlink_to(ROOT / part)
    # Others may be referred to, and are not changed
    (house / "tutorials").mkdir()
    for other in (ROOT / "tutorials").iterdir():
        if other.name != name:
            (house / "tutorials" / other.name).symlink_to(other)
    copy = house / "tutorials" / name
    shutil.copytree(
        ROOT / "tutorials" / name,
        copy,
        ignore=shutil.ignore_patterns(
            "0",
            "[1-9]*",
            "runs",
            "results",
            "log.*",
            "polyMesh",
            "postProcessing",
            "processor*",
            "*.foam",
            "__pycache__",
        ),
    )
    return copy


def run(folder, *command, status=0):
    """What the command prints; it has to exit with the given status."""
    done = subprocess.run(
        command,
        cwd=folder,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    assert done.returncode == status, done.stdout[-3000:]
    return done.stdout
