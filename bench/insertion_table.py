#!/usr/bin/env python3
"""Vertices that each rule of insertion needs: results of docs/explanation/measured.md.

    bench/insertion_table.py DIRECTORY [--no-weights] [--step N] [--moves N] [--seeds N]

DIRECTORY has instances of the challenge CG:SHOP 2025 and best_known.csv. temper starts from the constrained Delaunay
triangulation of each instance and inserts vertices by one rule. Then it removes vertices, and makes random moves. It
repeats this with other random numbers. No run has a time limit, so each result is the same on all machines. cgshop.py
judges the meshes. Each run prints a line to standard error. Needs temper's Python module.
"""

from __future__ import annotations

import argparse
import csv
import os
import sys
import tempfile
from pathlib import Path

import cgshop

RULES = ("best", "orthocenter", "circumcenter", "centroid")  # without weights orthocenters are circumcenters


def options(rule: str, seed: int, args: argparse.Namespace) -> list[str]:
    unknowns = "positions" if args.no_weights else "positions_and_weights"
    values = f"repair=vertices,insertion_place={rule},unknowns={unknowns},seed={seed}"
    return ["--boundary", "split", "--coarsen", "1e300",
            "--set", f"{values},max_sweeps=10000,coarsen_moves={args.moves}"]


def table(found: dict[tuple[str, int], list[cgshop.Result]], rules: list[str], seeds: range) -> str:
    """Counts over all runs. Added vertices are summed over the instances that all rules solve, if there are any."""
    solved = {key: {r.name for r in results if not r.verdict.faults} for key, results in found.items()}
    by_all = set.intersection(*solved.values())
    known = sum(r.known for r in found[rules[0], seeds[0]] if r.name in by_all)
    heads = ["rule", "solved", "triangles bad"]
    if by_all:
        heads += [f"added in the {len(by_all)} that all solve", f"ratio to the best known {known}"]
    lines = [f"| {' | '.join(heads)} |", "|" + "-|" * len(heads)]
    for rule in rules:
        runs = [found[rule, seed] for seed in seeds]
        cells = [f"`{rule}`", f"{sum(len(solved[rule, seed]) for seed in seeds)} of {sum(map(len, runs))}",
                 str(sum(r.verdict.bad for results in runs for r in results))]
        if by_all:
            added = [sum(r.verdict.added for r in results if r.name in by_all) for results in runs]
            cells += [", ".join(map(str, added)), f"{sum(added) / len(added) / max(known, 1):.3f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--no-weights", action="store_true", help="keep all weights at zero")
    parser.add_argument("--step", type=int, default=5, help="take every n-th instance")
    parser.add_argument("--moves", type=int, default=500, help="random moves of coarsening")
    parser.add_argument("--seeds", type=int, default=1, help="runs of each instance, with different random numbers")
    parser.add_argument("--temper", default=os.environ.get("TEMPER", "temper"), help="the program")
    args = parser.parse_args()
    with open(args.directory / "best_known.csv") as file:
        known = {row["instance"]: int(row["steiner_points"]) for row in csv.DictReader(file)}
    rules = [rule for rule in RULES if not (args.no_weights and rule == "orthocenter")]
    seeds = range(1, args.seeds + 1)
    found: dict[tuple[str, int], list[cgshop.Result]] = {(rule, seed): [] for rule in rules for seed in seeds}
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(args.directory.glob("*.instance.json"))[:: args.step]:
            for rule, seed in found:
                run = argparse.Namespace(keep=folder, start="cdt", limit=0, temper=args.temper,
                                         options=options(rule, seed, args))
                r = cgshop.run_one(path, known[path.name.removesuffix(".instance.json")], run)
                found[rule, seed].append(r)
                print(f"{r.name:42} {rule:12} {seed:3} {r.verdict.added:6} {r.known:5} {r.seconds:7.1f} s  "
                      f"{'; '.join(r.verdict.faults) or 'good'}", file=sys.stderr, flush=True)
    print(table(found, rules, seeds))


if __name__ == "__main__":
    main()
