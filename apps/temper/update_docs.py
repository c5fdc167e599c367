#!/usr/bin/env python3
"""Puts the program's own help into docs/cli.md: update_docs.py PROGRAM.

Every block after a line <!-- temper ARGUMENTS --> becomes what that command prints. A test compares them.
"""
import pathlib
import re
import subprocess
import sys


def main(program):
    page = pathlib.Path(__file__).parents[2] / "docs" / "cli.md"

    def block(match):
        text = subprocess.run([program, *match[1].split()], check=True, capture_output=True, text=True).stdout
        return f"<!-- temper {match[1]} -->\n```text\n{text}```"

    text, blocks = re.subn(r"<!-- temper (.*?) -->\n```text\n.*?```", block, page.read_text(), flags=re.S)
    if blocks == 0:
        sys.exit("docs/cli.md has no block to update")
    page.write_text(text)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
