#!/usr/bin/env python3
"""Prints "PASSED FAILED SKIPPED" of a JUnit file that ctest wrote. A skipped or disabled test did not pass."""

import sys
import xml.etree.ElementTree as ElementTree

cases = ElementTree.parse(sys.argv[1]).getroot().findall("testcase")
states = [case.get("status") for case in cases]
passed = states.count("run")
skipped = states.count("notrun") + states.count("disabled")
print(passed, len(states) - passed - skipped, skipped)
