#!/usr/bin/env python3
"""Which of the paper's claims hold when all figures take one and the same reading of what it leaves open.

    gallery/readings.py PROGRAM DIR

runs `temper paper reproduce` for figures 11 to 32, which are made by the optimizer, once as each figure has it and once for
each reading below, into folders of DIR (one that has its gallery.json is not made again). It puts the number of claims
that hold under each reading into gallery/readings.md, and prints which claims fail under which reading.
Claims of a figure that cannot be made under a reading do not hold under it.
"""
import json
import pathlib
import re
import subprocess
import sys

FIGURES = range(11, 33)
READINGS = [  # letter, name, options
    ("own", "as each figure has it", ""),
    ("r", "no step turns a triangle over", "--set inversion=refuse"),
    ("a", "steps may turn triangles over", "--set inversion=allow"),
    ("f", "R is the distance to the farthest neighbor", "--set search_radius=max"),
    ("n", "R is the distance to the nearest neighbor", "--set search_radius=min"),
    ("4", "weights are searched up to 4 R²", "--set weight_search_radius=4"),
    ("i", "points are visited as numbered", "--set order=input"),
    ("v", "points are visited in reverse", "--set order=reverse"),
    ("r4", "no step turns a triangle over, and weights up to 4 R²", "--set inversion=refuse,weight_search_radius=4"),
    ("all", "everything as `--for paper` has it",
     "--set order=input,search_radius=rms,weight_search_radius=1,inversion=allow,gamma=1:absolute"),
]


def claims(program: str, folder: pathlib.Path, options: str) -> dict[tuple[str, str], bool]:
    """Of the paper's claims in FIGURES, by place and sentence, whether each holds."""
    found = {}
    for figure in FIGURES:
        result = folder / str(figure) / "gallery.json"
        if not result.exists():
            run = subprocess.run([program, "paper", "reproduce", str(figure), "-o", str(result.parent), *options.split()],
                                 capture_output=True, text=True)
            if run.returncode != 0 and "cannot be made" not in run.stderr:
                sys.exit(run.stderr)
            if run.returncode != 0:
                result.write_text('{"claims": []}')
        for c in json.loads(result.read_text())["claims"]:
            if c["author"] == "paper":
                found[c["figure"], c["claim"]] = c["holds"]
    return found


def counts(held: list[dict]) -> str:
    """How many claims hold under each reading."""
    rows = ["| | one reading for figures 11 to 32 | options | claims that hold | lost | won |", "|-|-|-|-|-|-|"]
    own = held[0]
    for (letter, name, options), now in zip(READINGS, held):
        holds = {claim: now.get(claim, False) for claim in own}
        lost, won = sum(own[c] and not holds[c] for c in own), sum(holds[c] and not own[c] for c in own)
        changes = [lost, won] if options else ["", ""]
        rows.append(f"| {letter} | {name} | {f'`{options}`' if options else ''} | {sum(holds.values())} of {len(own)} | "
                    f"{changes[0]} | {changes[1]} |")
    return "\n".join(rows)


def by_claim(held: list[dict]) -> str:
    """Under which readings each claim holds that does not hold under all."""
    rows = ["| where | claim | " + " | ".join(letter for letter, _, _ in READINGS) + " |", "|-|-" + "|-" * len(READINGS) + "|"]
    for place, claim in held[0]:
        marks = [now.get((place, claim), False) for now in held]
        if all(marks):
            continue
        where = place if re.search("[^0-9-]", place) is None else "§" + place
        sentence = claim.replace("|", "\\|").replace("*", "\\*").replace("<", "&lt;")
        rows.append(f"| {where} | {sentence} | " + " | ".join("✓" if m else "✗" for m in marks) + " |")
    return "\n".join(rows)


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, top = sys.argv[1], pathlib.Path(sys.argv[2])
    held = [claims(program, top / letter, options) for letter, _, options in READINGS]
    page = pathlib.Path(__file__).resolve().parent / "readings.md"
    text = page.read_text(encoding="utf-8")
    text, blocks = re.subn(r"(<!-- readings -->\n).*?(<!-- /readings -->)",
                           lambda m: m[1] + "\n" + counts(held) + "\n\n" + m[2], text, flags=re.S)
    if blocks != 1:
        sys.exit("gallery/readings.md must have one place for the readings")
    print(counts(held), by_claim(held), sep="\n\n")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
