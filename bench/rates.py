#!/usr/bin/env python3
"""Measures how the energy falls, against sweeps and against time, with each solver.

    bench/rates.py TEMPER [--rounds 3] [--meshes figure-18,well-centered,random] [--picture rates.svg]
    bench/rates.py --self-test

TEMPER is the program. Every solver goes on until a sweep changes nothing, or to a number of sweeps of its own. E* is
the least energy that Newton's method reaches from a solver's last mesh without a flip: so solvers that are slow have
a limit, too. Where all limits of a mesh agree, E* is the least of them, else each solver has its own.

Printed are sweeps and seconds until E − E* is 1e-2, 1e-4, 1e-6 and 1e-8 of what it was at first, and the
factor by which a sweep shortens E − E* in its last decade above rounding, the median. Where not even two decades are left behind, it is of the last half of all sweeps. Solvers
run in turn, on one thread; of each sweep's seconds the least of all rounds counts, so that what slows the machine down
for a while does not.
"""

import argparse
import csv
import itertools
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

LEVELS = (1e-2, 1e-4, 1e-6, 1e-8)
ROUNDING = 1e-13  # of E: what is nearer to E* says nothing
SAME_LIMIT = 1e-9  # relative: two limits are one optimum
STEADY = 1.5  # how much the sweeps of two decades, and of two halves of all, may differ where convergence is linear

SOLVERS = {  # name: options, most sweeps on the small mesh and on the large one, color
    "Newton": ([], 20000, 2000, "#56b4e9"),
    "Newton, relaxation 1": (["--set", "relaxation=1"], 20000, 2000, "#009e73"),
    "alternating": (["--set", "solver=alternating"], 20000, 400, "#e69f00"),
    "golden": (["--set", "solver=golden"], 8000, 60, "#d55e00"),
}


class Case:
    """A mesh: an example, what makes it ready (None: nothing does), and the γ that all solvers have."""

    def __init__(self, title, example, ready, gamma, large):
        self.title, self.example, self.ready, self.gamma, self.large = title, example, ready, gamma, large


FIXED = ["--set", "gamma=0.003"]
CASES = {
    "figure-18": Case("Figure 18's mesh, γ = 1", ["horseshoe"], None, ["--set", "gamma=1:absolute"], False),
    "well-centered": Case("Figure 18's mesh, once well-centered, γ = 0.003 ℓ", ["horseshoe"], ["--set", "tolerance=1e-3"],
                          FIXED, False),
    "random": Case("10,000 random vertices, once well-centered, γ = 0.003 ℓ", ["random", "--vertices", "10000"],
                   ["--set", "tolerance=0.1"], FIXED, True),
}


def temper(program, *words):
    result = subprocess.run([str(w) for w in (program, *words)], stdout=subprocess.DEVNULL)
    if result.returncode != 0:
        sys.exit(f"rates: exit {result.returncode}: {' '.join(str(w) for w in words)}")


class Run:
    """Energies and seconds: [0] of the input, then after each sweep; and what was flipped when."""

    def __init__(self, program, mesh, out, options, most):
        history = out.with_suffix(".csv")
        temper(program, "optimize", mesh, "-o", out, "--set", "energy=BP", "--set", "flips=immediate", "--set", "inversion=refuse",
               "--set", "repair=none", "--threads", 1, "--quiet", "--set", f"tolerance=1e-300,max_sweeps={most}", "--write",
               history, *options)
        with open(history, newline="") as file:
            rows = list(csv.DictReader(file))
        self.energies = [float(r["energy"]) for r in rows]
        self.seconds = [float(r["seconds"]) for r in rows]
        self.flips = [int(r["flips"]) for r in rows]
        self.bad = int(rows[-1]["bad"])

    @property
    def last_flip(self):
        return max((k for k, n in enumerate(self.flips) if n), default=0)


def seconds_of(runs):
    """Until the end of each sweep: sums of the least that each took in any run."""
    steps = [[b - a for a, b in zip([0.0, *run.seconds], run.seconds)] for run in runs]
    return list(itertools.accumulate(min(step) for step in zip(*steps, strict=True)))


def first_below(gaps, level):
    """The first sweep whose gap is at most that part of the first one, or None."""
    return next((k for k, gap in enumerate(gaps) if gap <= level * gaps[0]), None)


def crossing(gaps, value):
    """At which sweep the gap falls below a value for good, with a fraction: gaps are geometric between sweeps."""
    k = max(k for k, gap in enumerate(gaps) if gap >= value)
    if k + 1 == len(gaps) or gaps[k] == value:
        return float(k)
    return k + math.log(gaps[k] / value) / math.log(gaps[k] / max(gaps[k + 1], 1e-3 * value))


def convergence(gaps, floor):
    """How gaps above `floor` fall: (kind, first sweep, last sweep of the last decade, or of the last half)."""
    least = max(floor, gaps[-1])
    if gaps[0] < 100 * least:
        return "not reached", len(gaps) // 2, len(gaps) - 1
    ratios = [b / a for a, b in zip(gaps, gaps[1:]) if b >= least]
    end, middle, begin = (crossing(gaps, least * factor) for factor in (1, 10, 100))
    start = max(100 * least, 1e-2 * gaps[0])
    early, half = crossing(gaps, start), crossing(gaps, math.sqrt(start * least))
    first, last = math.floor(middle), math.floor(end)
    steps = ratios[-3:]
    if last - math.floor(begin) <= 3 and len(steps) == 3 and steps[0] > steps[1] > steps[2]:
        return "superlinear", first, last
    changes = (end - middle) / (middle - begin), (end - half) / (half - early)  # of the last two decades, and of halves
    if min(changes) > STEADY:
        return "sublinear so far", first, last
    return "faster at last" if max(changes) < 1 / STEADY else "linear", first, last


def factor(gaps, first, last):
    """The median of a sweep's factor in [first, last], or None."""
    ratios = [gaps[k + 1] / gaps[k] for k in range(first, last) if gaps[k] > 0]
    return statistics.median(ratios) if ratios else None


def limit_of(program, mesh, run, gamma, folder):
    """The least energy that the run, or Newton's method from its end on without a flip, reaches."""
    on = Run(program, mesh, folder / "on.vtu", gamma, 200000)
    return min(run.energies + (on.energies if not any(on.flips) else []))


def measured(program, case, rounds, folder):
    """Runs of each solver, a list a round, and E* of each."""
    mesh = folder / "input.vtu"
    temper(program, "example", *case.example, "-o", mesh)
    if case.ready is not None:
        temper(program, "optimize", mesh, "-o", mesh, "--threads", 1, "--quiet", *case.ready)
    runs, limits = {name: [] for name in SOLVERS}, {}
    for number in range(rounds):
        for name, (options, small, large, _) in SOLVERS.items():
            out = folder / "out.vtu"
            run = Run(program, mesh, out, case.gamma + options, large if case.large else small)
            runs[name].append(run)
            if number == 0:
                limits[name] = limit_of(program, out, run, case.gamma, folder)
    least = min(limits.values())
    if all(limit - least <= SAME_LIMIT * abs(least) for limit in limits.values()):
        limits = dict.fromkeys(limits, least)
    return runs, limits


def factor_text(f):
    if f is None:
        return ""
    return f"1 − {1 - f:.1e}" if 0.999 < f < 1 - 1e-9 else f"{f:.4f}"


def row_of(name, runs, limit):
    run = runs[0]
    gaps = [max(0.0, energy - limit) for energy in run.energies]
    cells = [name, f"{limit:.10g}", f"{gaps[-1] / gaps[0]:.0e}"]
    seconds = seconds_of(runs)
    for level in LEVELS:
        k = first_below(gaps, level)
        cells.append(f"over {len(gaps) - 1}" if k is None else f"{k} ({seconds[k]:.2g} s)")
    kind, first, last = convergence(gaps, ROUNDING * abs(limit))
    return cells + [factor_text(factor(gaps, first, last)), kind, str(run.last_flip), str(run.bad)]


def draw(results, path):
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as pyplot

    # The same numbers give the same bytes.
    matplotlib.rcParams.update({"svg.hashsalt": "temper", "svg.fonttype": "none", "font.size": 8})
    figure, grid = pyplot.subplots(len(results), 2, figsize=(8, 2.7 * len(results)), squeeze=False, sharey="row")
    for axes, (title, runs, limits) in zip(grid, results):
        for name, (*_, color) in SOLVERS.items():
            run = runs[name][0]
            gaps, seconds = [energy - limits[name] for energy in run.energies], seconds_of(runs[name])
            wanted = sorted({round(1.08**i) for i in range(200)} | set(range(1, 20)))
            shown = [k for k in wanted if k < len(gaps) and gaps[k] > ROUNDING * abs(limits[name])]
            relative = [gaps[k] / gaps[0] for k in shown]
            axes[0].loglog(shown, relative, color=color, linewidth=1.2, label=name)
            axes[1].loglog([seconds[k] for k in shown], relative, color=color, linewidth=1.2)
        axes[0].set_title(title, loc="left", fontsize=8)
        axes[0].set_ylabel("(E − E*) / (E₀ − E*)")
        for side in axes:
            side.grid(True, which="major", color="#dddddd", linewidth=0.6)
    grid[-1][0].set_xlabel("sweeps")
    grid[-1][1].set_xlabel("seconds")
    grid[0][0].legend(fontsize=7, frameon=False)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")


def self_test():
    """Sequences whose convergence is known."""

    def kind(gaps, floor=1e-13):
        return convergence(gaps, floor)[0]

    linear = [0.9**k for k in range(400)]
    _, first, last = convergence(linear, 1e-13)
    cases = {
        "geometric": kind(linear) == "linear",
        "its factor": math.isclose(factor(linear, first, last), 0.9, rel_tol=1e-12),
        "its first sweep below 1e-2": first_below(linear, 1e-2) == math.ceil(math.log(1e-2) / math.log(0.9)),
        "never below": first_below(linear, 1e-30) is None,
        "fast first, then geometric": kind([1e3 * 0.1**k + 0.9**k for k in range(400)]) == "linear",
        "quadratic": kind([0.5 ** (2**k) for k in range(7)]) == "superlinear",
        "like 1/k²": kind([1 / k**2 for k in range(1, 5000)]) == "sublinear so far",
        "noise near rounding does not count": kind(linear[:280] + [1e-14, 3e-14, 2e-14]) == "linear",
        "less than two decades": kind([1.0, 0.5, 0.2]) == "not reached",
    }
    failed = [name for name, passed in cases.items() if not passed]
    for name in failed:
        print(f"rates: self-test failed: {name}", file=sys.stderr)
    print(f"rates: {len(cases) - len(failed)} of {len(cases)} cases of the self-test pass")
    return 1 if failed else 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--meshes", default=",".join(CASES), help="of the list, separated by commas")
    parser.add_argument("--picture", help="SVG of the gap against sweeps and seconds (needs matplotlib)")
    parser.add_argument("--self-test", action="store_true")
    given = parser.parse_args(arguments)
    if given.self_test:
        return self_test()
    if given.program is None or given.rounds < 1 or not set(given.meshes.split(",")) <= set(CASES):
        parser.error("a program, at least one round, and meshes of the list are expected")
    results = []
    for case in (CASES[name] for name in given.meshes.split(",")):
        with tempfile.TemporaryDirectory() as folder:
            runs, limits = measured(given.program, case, given.rounds, pathlib.Path(folder))
        results.append((case.title, runs, limits))
        levels = " | ".join(f"{x:.0e}" for x in LEVELS)
        print(f"{case.title}\n\n| solver | E* | left | {levels} | factor | convergence | last flip | bad |\n"
              f"|-|{'-:|' * 7}-|-:|-:|")
        for name in SOLVERS:
            print(f"| {' | '.join(row_of(name, runs[name], limits[name]))} |")
        print(flush=True)
    if given.picture:
        draw(results, given.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
