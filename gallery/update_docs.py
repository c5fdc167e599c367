#!/usr/bin/env python3
"""Puts the claims and their verdicts into docs/paper.md: update_docs.py DIR.

DIR is what `temper reproduce -o DIR` wrote, all figures of it. What stands between <!-- claims --> and
<!-- /claims --> becomes DIR/claims.md. The test `claims` compares the two.
"""
import pathlib
import re
import sys


def main(folder):
    claims = pathlib.Path(folder, "claims.md").read_text(encoding="utf-8")
    page = pathlib.Path(__file__).parents[1] / "docs" / "paper.md"
    text, blocks = re.subn(r"(<!-- claims -->\n).*?(<!-- /claims -->)", lambda m: m[1] + "\n" + claims + "\n" + m[2],
                           page.read_text(encoding="utf-8"), flags=re.S)
    if blocks != 1:
        sys.exit("docs/paper.md must have one place for the claims")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
