#!/usr/bin/env python3
"""Plots of cost against size and of stages, from what bench_whole_run --json has written.

    bench/plot.py [RUNS.json [FOLDER]]     default: docs/internals/performance/runs.json, and beside it
"""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402: after the choice of the backend

COSTS = {  # name in the file: label, color, marker
    "paper_ns": ("the paper's Algorithm 1", "#cc79a7", "*"),
    "golden_ns": ("its golden section alone", "#d55e00", "v"),
    "alternating_ns": ("alternating", "#e69f00", "^"),
    "newton_ns": ("Newton, the first sweeps", "#0072b2", "o"),
    "settled_ns": ("Newton, settled", "#56b4e9", "s"),
    "loop_ns": ("derivatives alone", "#009e73", "D"),
    "loop_by_stars_ns": ("derivatives, eight stars", "#666666", "x"),
    "triad_ns": ("memory alone", "#aaaaaa", "+"),
}


def save(figure, path):
    figure.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    pyplot.close(figure)


def cost_against_size(rows, path):
    figure, axes = pyplot.subplots(figsize=(6, 4))
    for key, (label, color, marker) in COSTS.items():
        points = [(r["vertices"], r[key]) for r in rows if r.get(key)]
        if points:
            axes.loglog(*zip(*points), color=color, marker=marker, markersize=4, label=label)
    axes.set_xlabel("vertices")
    axes.set_ylabel("ns per vertex and sweep, one thread")
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(figure, path)


def stages(rows, path):
    """Where the seconds of a run from file to file go, at the largest size that has both."""
    rows = [r for r in rows if r["stages_with_threads"]["total"] is not None]
    if not rows:
        return
    r = rows[-1]
    figure, axes = pyplot.subplots(figsize=(6, 1.6))
    colors = pyplot.get_cmap("tab10").colors
    runs = {"one thread": r["stages"], "all threads": r["stages_with_threads"]}
    for y, seconds in enumerate(runs.values()):
        left = 0.0
        for color, (name, value) in zip(colors, ((n, v) for n, v in seconds.items() if n != "total")):
            axes.barh(y, value, left=left, color=color, label=name if y == 0 else None)
            left += value
    axes.set_yticks(range(len(runs)), runs.keys())
    axes.invert_yaxis()
    axes.set_xlabel(f"seconds, {r['vertices']:,} vertices")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(figure, path)


def draw(runs, folder):
    # The same numbers give the same bytes.
    matplotlib.rcParams.update({"svg.hashsalt": "temper", "svg.fonttype": "none", "font.size": 9})
    rows = runs["sizes"]
    cost_against_size(rows, folder / "cost.svg")
    stages(rows, folder / "stages.svg")


def main(arguments):
    root = pathlib.Path(__file__).resolve().parent.parent
    path = pathlib.Path(arguments[0]) if arguments else root / "docs" / "internals" / "performance" / "runs.json"
    draw(json.loads(path.read_text()), pathlib.Path(arguments[1]) if len(arguments) > 1 else path.parent)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
