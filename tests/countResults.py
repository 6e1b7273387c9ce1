# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Sum of the JUnit reports of the test suites: countResults.py FOLDER SUITE...

A suite may leave several reports: SUITE.xml and SUITE.*.xml. One that left none,
or a report without tests, counts as a failure. What was skipped is listed with
its reason.
"""

import collections
import pathlib
import sys
import xml.etree.ElementTree as tree


class Count:
    """Passed and failed tests, and why tests were skipped."""

    def __init__(self):
        self.passed = 0
        self.failed = 0
        self.reasons = collections.Counter()

    def add(self, other):
        self.passed += other.passed
        self.failed += other.failed
        self.reasons += other.reasons

    def __str__(self):
        skipped = sum(self.reasons.values())
        return f"{self.passed} passed, {self.failed} failed" + (
            f", {skipped} skipped" if skipped else ""
        )


def reason(case, skipped):
    """What a skipped test says: an attribute (pytest), or nothing (GoogleTest,
    whose disabled tests are only marked)."""
    return skipped.get("message") or f"{case.get('name')} says no reason"


def count(report):
    """The tests of a report."""
    found = Count()
    cases = list(tree.parse(report).getroot().iter("testcase"))
    for case in cases:
        skipped = case.find("skipped")
        if case.find("failure") is not None or case.find("error") is not None:
            found.failed += 1
        elif skipped is not None:
            found.reasons[reason(case, skipped)] += 1
        elif case.get("status") == "notrun":
            found.reasons[f"{case.get('name')} is disabled"] += 1
        else:
            found.passed += 1
    found.failed += not cases
    return found


def main(folder, suites):
    """Print a line for each suite and the sum; 0 if nothing failed."""
    total = Count()
    print()
    for suite in suites:
        folder = pathlib.Path(folder)
        reports = sorted(
            {*folder.glob(f"{suite}.xml"), *folder.glob(f"{suite}.*.xml")}
        )
        found = Count()
        found.failed += not reports
        for report in reports:
            found.add(count(report))
        print(f"{suite}: {found}")
        total.add(found)
    for why, times in sorted(total.reasons.items()):
        print(f"skipped {times}: {why}")
    print(total)
    return 1 if total.failed or not total.passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
