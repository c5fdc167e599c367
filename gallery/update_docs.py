#!/usr/bin/env python3
"""Puts the claims and their verdicts into docs/paper.md: update_docs.py DIR.

DIR is what `temper reproduce -o DIR` wrote, all figures of it. The lines between <!-- claims --> and <!-- /claims -->
become a table of the claims, and after it what explains those that do not hold.
"""
import json
import pathlib
import re
import sys


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*").replace("\n", " ")


def place(claim):
    return f"fig. {claim['figure']}" if re.fullmatch("[0-9-]+", claim["figure"]) else f"§{claim['figure']}"


def report(claims):
    hold = sum(claim["holds"] for claim in claims)
    lines = [f"{hold} of {len(claims)} claims hold.", "",
             "| where | claim | the paper | temper | holds |", "|-|-|-|-|-|"]
    for claim in claims:
        texts = [cell(claim[key]) for key in ("claim", "paper", "temper")]
        lines.append("| " + " | ".join([place(claim), *texts, "✓" if claim["holds"] else "**✗**"]) + " |")
    failing = [claim for claim in claims if not claim["holds"]]
    if failing:
        lines += ["", "Why the others do not:", ""]
        lines += [f"- *{cell(claim['claim'])}* ({place(claim)}): {cell(claim['why'])}" for claim in failing]
    return "\n".join(lines)


def main(folder):
    claims = json.loads(pathlib.Path(folder, "gallery.json").read_text(encoding="utf-8"))["claims"]
    if not claims:
        sys.exit(f"{folder}/gallery.json has no claims")
    page = pathlib.Path(__file__).parents[1] / "docs" / "paper.md"
    text, blocks = re.subn(r"(<!-- claims -->\n).*?(<!-- /claims -->)", lambda m: m[1] + "\n" + report(claims) + "\n\n" + m[2],
                           page.read_text(encoding="utf-8"), flags=re.S)
    if blocks != 1:
        sys.exit("docs/paper.md must have one place for the claims")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
