# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The sum at the end of tests/Alltest.

Source of truth: reports that pytest itself writes of tests whose outcome is
known, and one as GoogleTest writes it.
"""

import subprocess
import sys

import pytest

from foamCase import ROOT

TESTS = """
import pytest


def test_passes():
    pass


@pytest.mark.skip(reason="no wind tunnel")
@pytest.mark.parametrize("i", [1, 2])
def test_skips(i):
    pass
"""

FAILS = """
import pytest


def test_fails():
    assert False


@pytest.fixture
def broken():
    raise RuntimeError


def test_error(broken):
    pass
"""

GOOGLE = """<testsuites tests="3" disabled="1">
<testsuite name="Kernel">
<testcase name="passes" status="run" result="completed"/>
<testcase name="DISABLED_later" status="notrun" result="suppressed"/>
<testcase name="skips" status="run" result="skipped">
<skipped message="no AVX-512"/></testcase>
</testsuite></testsuites>"""


def report(folder, suite, tests):
    """The report of pytest on these tests."""
    (folder / "test_it.py").write_text(tests)
    subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            f"--rootdir={folder}",
            f"--junitxml={folder/suite}.xml",
            "test_it.py",
        ],
        cwd=folder,
        stdout=subprocess.DEVNULL,
    )


def counted(folder, *suites):
    """Exit status and lines."""
    done = subprocess.run(
        [sys.executable, ROOT / "tests/countResults.py", folder, *suites],
        text=True,
        stdout=subprocess.PIPE,
        check=False,
    )
    return done.returncode, done.stdout.strip().splitlines()


def test_skipped_tests_are_counted_and_their_reasons_listed(tmp_path):
    report(tmp_path, "python", TESTS)
    (tmp_path / "numerics.xml").write_text(GOOGLE)
    (tmp_path / "numerics.portable.xml").write_text(GOOGLE)
    assert counted(tmp_path, "numerics", "python") == (
        0,
        [
            "numerics: 2 passed, 0 failed, 4 skipped",
            "python: 1 passed, 0 failed, 2 skipped",
            "skipped 2: DISABLED_later is disabled",
            "skipped 2: no AVX-512",
            "skipped 2: no wind tunnel",
            "3 passed, 0 failed, 6 skipped",
        ],
    )


def test_failures_errors_and_missing_reports_are_failures(tmp_path):
    report(tmp_path, "python", FAILS)
    assert counted(tmp_path, "python", "gone") == (
        1,
        [
            "python: 0 passed, 2 failed",
            "gone: 0 passed, 1 failed",
            "0 passed, 3 failed",
        ],
    )


@pytest.mark.parametrize(
    "text, status, last",
    [
        (
            '<testsuites><testcase name="a"/></testsuites>',
            0,
            "1 passed, 0 failed",
        ),
        ("<testsuites></testsuites>", 1, "0 passed, 1 failed"),
    ],
)
def test_a_report_without_tests_is_a_failure(tmp_path, text, status, last):
    (tmp_path / "numerics.xml").write_text(text)
    found, lines = counted(tmp_path, "numerics")
    assert (found, lines[-1]) == (status, last)
