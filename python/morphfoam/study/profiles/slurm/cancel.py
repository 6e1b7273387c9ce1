#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""cancel.py NUMBER...: jobs that are no longer wanted."""

import subprocess
import sys

sys.exit(subprocess.run(["scancel", *sys.argv[1:]]).returncode)
