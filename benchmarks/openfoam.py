# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Files and programs of OpenFOAM, for benchmarks that make cases."""

import subprocess
import sys


def header(name, kind="dictionary"):
    """The head of a file: the class of what it holds, and its name."""
    return (
        f"FoamFile {{ version 2.0; format ascii; class {kind}; "
        f"object {name}; }}\n"
    )


def run(path, *command):
    """What a command prints in a folder; ends the program if it fails."""
    done = subprocess.run(
        command, cwd=path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    output = done.stdout.decode()
    if done.returncode:
        sys.exit(f"{command} in {path} failed:\n{output[-3000:]}")
    return output
