# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A small part of Allfuzz: 30 spoilt files, always the same ones.

Source of truth: what fuzzer.py calls right: no signal, an end, no NaN, and a
message that names what was spoilt.
"""

import random

import pytest

import mutations
from fuzzer import fuzz


def test_spoilt_files_end_in_messages():
    trials, _ = fuzz(seed=2026, n=30)
    assert len(trials) == 30
    assert not [
        (t.situation, t.file, t.change, t.fault) for t in trials if t.fault
    ]
    # Some are harmless and some are not, or nothing was tried
    assert {t.status for t in trials} == {0, 1}


@pytest.mark.parametrize(
    "kinds", [mutations.TEXT, mutations.TABLE, mutations.BINARY]
)
def test_a_mutation_changes_the_file_and_a_seed_repeats_it(tmp_path, kinds):
    text = b"order (3 2 2);\nlist 3((0 0 0) (1 0.5 1e-3));\n"
    results = []
    for attempt in range(2):
        rng = random.Random(7)
        results.append([])
        for i in range(20):
            path = tmp_path / f"{attempt}.{i}"
            path.write_bytes(text)
            mutations.mutate(path, rng, kinds)
            results[-1].append(
                path.read_bytes() if path.is_file() else path.is_dir()
            )
    assert results[0] == results[1]
    assert sum(content == text for content in results[0]) == 0
