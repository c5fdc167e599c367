#!/usr/bin/env python3
"""Checks that code compiled for one instruction set cannot be linked into what runs without it.

    scripts/check_instruction_sets.py BUILD   exit 1 and one line a symbol that other objects could link to

Sources NAME_SET.cpp are compiled with instructions that not every processor has. An inline function of a common header
that such an object defines is the same to the linker as that of any other object: it may keep this one. So these
objects may define nothing for others but what is in the namespace of their set.
"""

import pathlib
import re
import subprocess
import sys

SETS = ("avx2", "avx512")
SYMBOL = re.compile(r"^[0-9a-f]+ ([A-Zuvw]) (.*)$")


def foreign_symbols(path, own):
    """What an object defines for others outside of its namespace."""
    listed = subprocess.run(["nm", "-C", "--defined-only", str(path)], capture_output=True, text=True, check=True)
    matches = filter(None, map(SYMBOL.match, listed.stdout.splitlines()))
    return [name for _, name in (match.groups() for match in matches) if f"temper::{own}::" not in name]


def main(arguments):
    if len(arguments) != 1:
        print(__doc__.split("\n\n")[1].strip(), file=sys.stderr)
        return 2
    problems, count = [], 0
    for own in SETS:
        for path in sorted(pathlib.Path(arguments[0]).rglob(f"*_{own}.cpp.o")):
            count += 1
            problems += [f"{path}: {name}" for name in foreign_symbols(path, own)]
    if count == 0:
        problems = [f"{arguments[0]}: no objects of instruction sets here"]
    print("\n".join(problems) if problems else f"check_instruction_sets: {count} objects keep to themselves")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
