#!/usr/bin/env python3
"""Puts the claims, their verdicts and the readings of the figures into two pages of docs/: update_docs.py DIR.

DIR is what `temper paper reproduce -o DIR` wrote, all figures of it. What stands between <!-- claims --> and
<!-- /claims --> becomes DIR/claims.md, and so DIR/settings.md. The test `claims` compares them.
"""
import pathlib
import re
import sys


def main(folder):
    docs = pathlib.Path(__file__).parents[1] / "docs"
    for name, place in (("claims", "explanation/paper-claims.md"), ("settings", "internals/paper-readings.md")):
        page = docs / place
        text = page.read_text(encoding="utf-8")
        found = pathlib.Path(folder, name + ".md").read_text(encoding="utf-8")
        text, blocks = re.subn(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", lambda m: m[1] + "\n" + found + "\n" + m[2],
                               text, flags=re.S)
        if blocks != 1:
            sys.exit(f"docs/{place} must have one place for the {name}")
        page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
