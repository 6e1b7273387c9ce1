# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sum of the JUnit reports of the test suites: countResults.py FOLDER SUITE...

A suite that left no report, or one without tests, counts as a failure.
"""

import pathlib
import sys
import xml.etree.ElementTree as tree


def count(report):
    """Passed and failed tests of a report."""
    if not report.exists():
        return 0, 1
    cases = list(tree.parse(report).getroot().iter("testcase"))
    failed = sum(
        any(child.tag in ("failure", "error") for child in case)
        for case in cases)
    skipped = sum(
        any(child.tag == "skipped" for child in case) for case in cases)
    return len(cases) - failed - skipped, failed if cases else 1


def main(folder, suites):
    """Print a line for each suite and the sum; 0 if nothing failed."""
    total = [0, 0]
    print()
    for suite in suites:
        passed, failed = count(pathlib.Path(folder)/f"{suite}.xml")
        print(f"{suite}: {passed} passed, {failed} failed")
        total[0] += passed
        total[1] += failed
    print(f"{total[0]} passed, {total[1]} failed")
    return 1 if total[1] or not total[0] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
