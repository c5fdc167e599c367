#!/usr/bin/env python3
"""Prints "PASSED FAILED SKIPPED" of a JUnit file that ctest wrote.

A test that skips itself did not pass; one that could not be run at all ("Unable to find executable") failed. A program
of many tests (GoogleTest, pytest) counts as those that it says it has run.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree


def skipped(case):
    reason = case.find("skipped")
    skips_itself = reason is not None and reason.get("message", "").startswith("SKIP_")
    return case.get("status") == "disabled" or skips_itself


# What the programs print at their end.
GOOGLE = {"passed": r"^\[  PASSED  \] (\d+) test", "failed": r"^\[  FAILED  \] (\d+) test",
          "skipped": r"^\[  SKIPPED \] (\d+) test"}
PYTEST = {"passed": r"^(?:=+ )?.*?(\d+) passed.* in [\d.]+s", "failed": r"^(?:=+ )?.*?(\d+) (?:failed|error).* in [\d.]+s",
          "skipped": r"^(?:=+ )?.*?(\d+) skipped.* in [\d.]+s"}


def inner(case):
    """The counts that a program prints of its own tests, or nothing."""
    text = case.findtext("system-out") or ""
    for patterns in (GOOGLE, PYTEST):
        found = {key: re.search(pattern, text, re.M) for key, pattern in patterns.items()}
        if any(found.values()):
            return {key: int(match[1]) if match else 0 for key, match in found.items()}
    return None


def started(case):
    """A GoogleTest program began: without counts it ended before its tests did."""
    return "[==========] Running" in (case.findtext("system-out") or "")


def counts(case):
    """Passed, failed and skipped tests of one entry. A program that fails has a failed test, whatever it prints."""
    if skipped(case):
        return 0, 0, 1
    ran = case.get("status") == "run"
    own = inner(case)
    if own is None:
        return int(ran and not started(case)), int(not ran or started(case)), 0
    nothing = own["passed"] + own["skipped"] == 0
    return own["passed"], max(own["failed"], int(not ran or nothing)), own["skipped"]


cases = ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
print(*map(sum, zip(*map(counts, cases))) if cases else (0, 0, 0))
