# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A study whose solver is closed-form arithmetic, for tests of morphStudy."""

import pathlib
import subprocess

import pytest
from closedFormStudy import STUDY

for module in ("yaml", "scipy", "sklearn", "deap", "snakemake", "matplotlib"):
    pytest.importorskip(module)

ROOT = pathlib.Path(__file__).resolve().parents[2]

# As bash arithmetic, so that many of them cost nothing. It goes on from the time
# it finds; x beyond 0.9 diverges, y beyond 0.9 hangs
SOLVER = """
. ./parameters.sh
time=$(ls -d [0-9]* 2>/dev/null | sort -n | tail -1)
echo "ran" >> "$MORPHSTUDY_STUDY/runs.$(basename "$PWD")"
sleep ${PAUSE:-0}
for i in 1 2 3; do echo "Time = $((time + i))"; done
awk "BEGIN { exit !($x > 0.9) }" && { echo sigFpe; kill -FPE $$; }
awk "BEGIN { exit !($y > 0.9) }" && sleep 30
mkdir -p $((time + 3))
awk "BEGIN { print $x + ${time:-0} }" > $((time + 3))/U
awk "BEGIN { printf \\"f = %.17g\\\\n\\", $x*$x + $y; print \\"g = \\" 1 - $x*$y }"
"""


def make_study(folder, *changes, text=STUDY):
    """The study file, each change a pair (old, new) of words in it."""
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "case").mkdir(exist_ok=True)
    (folder / "case/solver.sh").write_text(
        "sed -n 's/^\\([a-z]*\\) *\\(.*\\);/\\1=\\2/p' parameters"
        " > parameters.sh\n" + SOLVER
    )
    (folder / "study.yaml").write_text(text)
    return folder / "study.yaml"


def read(path):
    from morphfoam.study.study_file import StudyFile

    return StudyFile(path)


def command(*words, status=0):
    """Run morphStudy; returns what it says."""
    done = subprocess.run(
        [ROOT / "bin/morphStudy", *map(str, words)],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    assert done.returncode == status, done.stdout
    return done.stdout
