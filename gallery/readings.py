#!/usr/bin/env python3
"""How many of the paper's claims hold when all figures take one and the same reading of what it leaves open.

    gallery/readings.py PROGRAM DIR

runs `temper reproduce` for figures 11 to 32, which are made by the optimiser, once as each figure has it and once for
each reading below, into folders of DIR (one that has its gallery.json is not made again), and writes the table into
docs/paper.md.
"""
import json
import pathlib
import subprocess
import sys

FIGURES = "11-32"
READINGS = [
    ("as each figure has it", []),
    ("no step turns a triangle over", ["--refuse-inversions"]),
    ("R is the distance to the farthest neighbour", ["--search-radius", "max"]),
    ("R is the distance to the nearest neighbour", ["--search-radius", "min"]),
    ("weights are searched up to 4 R²", ["--weight-reach", "4"]),
    ("no step turns a triangle over, and weights up to 4 R²", ["--refuse-inversions", "--weight-reach", "4"]),
]
BEGIN, END = "<!-- readings -->", "<!-- /readings -->"


def claims(program: str, folder: pathlib.Path, options: list[str]) -> dict[str, bool]:
    """Of the paper's claims in FIGURES, whether each holds."""
    result = folder / "gallery.json"
    if not result.exists():
        subprocess.run([program, "reproduce", FIGURES, "-o", str(folder), *options], check=True,
                       stdout=subprocess.DEVNULL)
    found = json.loads(result.read_text())["claims"]
    return {f"{c['figure']}: {c['claim']}": c["holds"] for c in found if c["author"] == "paper"}


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, top = sys.argv[1], pathlib.Path(sys.argv[2])
    rows = ["| one reading for figures 11 to 32 | options | claims that hold | lost | won |", "|-|-|-|-|-|"]
    own: dict[str, bool] = {}
    for number, (name, options) in enumerate(READINGS):
        held = claims(program, top / str(number), options)
        own = own or held
        lost = sum(own[c] and not held[c] for c in own)
        won = sum(held[c] and not own[c] for c in own)
        rows.append(f"| {name} | {' '.join(f'`{o}`' for o in [' '.join(options)] if o)} | "
                    f"{sum(held.values())} of {len(held)} | {lost if number else ''} | {won if number else ''} |")
    page = pathlib.Path(__file__).resolve().parent.parent / "docs" / "paper.md"
    text = page.read_text()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    page.write_text(before + BEGIN + "\n\n" + "\n".join(rows) + "\n\n" + END + after)
    print("\n".join(rows))


if __name__ == "__main__":
    main()
