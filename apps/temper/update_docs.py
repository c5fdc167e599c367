#!/usr/bin/env python3
"""Puts what the program prints into docs/: its help into cli.md, examples into explain.md. update_docs.py PROGRAM.

Every block after a line <!-- temper ARGUMENTS --> becomes what that command line prints. Tests compare them.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile


def update(page, program):
    folder = str(pathlib.Path(program).resolve().parent)
    environment = {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"], "LC_ALL": "C.UTF-8"}

    def block(match):
        with tempfile.TemporaryDirectory() as scratch:
            run = subprocess.run("temper " + match[1], shell=True, cwd=scratch, env=environment, check=True,
                                 capture_output=True, text=True)
        return f"<!-- temper {match[1]} -->\n```text\n{run.stdout}```"

    text, blocks = re.subn(r"<!-- temper (.*?) -->\n```text\n.*?```", block, page.read_text(), flags=re.S)
    if blocks == 0:
        sys.exit(f"{page} has no block to update")
    page.write_text(text)


def main(program):
    for name in ("cli.md", "explain.md"):
        update(pathlib.Path(__file__).parents[2] / "docs" / name, program)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
