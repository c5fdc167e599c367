#!/usr/bin/env python3
"""Puts the claims, their verdicts and the readings of the figures into the two pages beside this file: update_docs.py DIR.

DIR is what `temper paper reproduce -o DIR` wrote, all figures of it. What stands between <!-- claims --> and
<!-- /claims --> becomes DIR/claims.md, and so DIR/settings.md. The test `claims` compares them.
"""
import pathlib
import re
import sys


def main(folder):
    for name, place in (("claims", "claims.md"), ("settings", "readings.md")):
        page = pathlib.Path(__file__).parent / place
        text = page.read_text(encoding="utf-8")
        found = pathlib.Path(folder, name + ".md").read_text(encoding="utf-8")
        text, blocks = re.subn(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", lambda m: m[1] + "\n" + found + "\n" + m[2],
                               text, flags=re.S)
        if blocks != 1:
            sys.exit(f"gallery/{place} must have one place for the {name}")
        page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
