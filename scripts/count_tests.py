#!/usr/bin/env python3
"""Prints "PASSED FAILED SKIPPED" of a JUnit file that ctest wrote.

A test that skips itself did not pass; one that could not be run at all ("Unable to find executable") failed.
"""

import sys
import xml.etree.ElementTree as ElementTree


def skipped(case):
    reason = case.find("skipped")
    skips_itself = reason is not None and reason.get("message", "").startswith("SKIP_")
    return case.get("status") == "disabled" or skips_itself


cases = ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
n_passed = sum(case.get("status") == "run" for case in cases)
n_skipped = sum(map(skipped, cases))
print(n_passed, len(cases) - n_passed - n_skipped, n_skipped)
