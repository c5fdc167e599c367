#!/usr/bin/env python3
"""Compares the benchmark programs of two builds, pair by pair, and fails when the new one costs more.

    bench/compare.py OLD NEW [--pairs 5] [--args "--sizes 100000"] [--require "newton_ns<=0.35"]
    bench/compare.py --self-test

OLD and NEW are two bench_whole_run or two bench_kernels. They run in turn, old new old new: what slows the machine down
for a while slows both. Of every number that both report, the median over the pairs counts, of the ratios new / old and
of the differences. A number is worse only past both thresholds: a large ratio of next to nothing is noise, and so is a
large difference of a long time. --require bounds the ratio of the numbers of that name, at one size with
"newton_ns@100000<=0.35", and says what else may not be missed. Exit 1 when something is worse or a requirement is
missed, 2 when there is nothing to compare.
"""

import argparse
import json
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

# From which difference on a number is worse, by what its name ends with. Other numbers are not costs.
ABSOLUTE = {"_ns": 5.0, "_seconds": 0.02, "_bytes": 2.0**20, "sweeps": 1.0, "sweeps_to_well_centered": 1.0}
REQUIREMENT = re.compile(r"^\s*([\w/]+)(?:@(\d+))?\s*(<=|>=)\s*([\d.]+)\s*$")


def numbers_of(report):
    """Costs by name and size: ("newton_ns", "100000"), or ("gather/0", "") of Google Benchmark, in nanoseconds."""
    result = {}
    for row in report.get("sizes", []):
        for key, value in row.items():
            if isinstance(value, (int, float)) and threshold(key) is not None:
                result[key, str(row["vertices"])] = float(value)
    unit = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    for row in report.get("benchmarks", []):
        if row.get("run_type", "iteration") == "iteration":
            result[row["name"], ""] = row["cpu_time"] * unit[row["time_unit"]]
    return result


def threshold(key):
    return next((value for end, value in ABSOLUTE.items() if key.endswith(end)), None)


def run(program, arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.json"
        google = "kernels" in pathlib.Path(program).name
        output = [f"--benchmark_out={path}", "--benchmark_out_format=json"] if google else ["--json", str(path)]
        subprocess.run([program, *arguments, *output], check=True, stdout=subprocess.DEVNULL)
        return numbers_of(json.loads(path.read_text()))


class Change:
    """One number in all pairs."""

    def __init__(self, name, pairs, relative, absolute):
        self.name, self.size = name
        self.old, self.new = (statistics.median(side) for side in zip(*pairs))
        self.ratio = statistics.median(new / old if old else (1.0 if new == old else float("inf")) for old, new in pairs)
        difference = statistics.median(new - old for old, new in pairs)
        limit = absolute if absolute is not None else (threshold(self.name) or ABSOLUTE["_ns"])
        self.worse = self.ratio > 1 + relative and difference > limit
        self.better = self.ratio < 1 - relative and difference < -limit

    def verdict(self):
        return "WORSE" if self.worse else "better" if self.better else ""


def compare(pairs, options):
    """The changes of all numbers that are in every run."""
    names = [name for name in pairs[0][0] if all(name in side for pair in pairs for side in pair)]
    return [Change(name, [(old[name], new[name]) for old, new in pairs], options.relative, options.absolute)
            for name in names]


def check_requirement(text, changes):
    """What is missed, in lines."""
    match = REQUIREMENT.match(text)
    if not match:
        sys.exit(f"compare: expected NAME<=RATIO or NAME@SIZE<=RATIO, found {text!r}")
    name, size, sense, limit = match.groups()
    found = [c for c in changes if c.name in (name, name + "_ns") and size in (None, c.size)]
    if not found:
        return [f"{text}: no such number"]
    missed = [c for c in found if not (c.ratio <= float(limit) if sense == "<=" else c.ratio >= float(limit))]
    return [f"{text}: {c.ratio:.3f} at {c.size or 'all sizes'}" for c in missed]


def print_table(changes):
    print(f"{'number':<34} {'vertices':>9} {'old':>12} {'new':>12} {'new/old':>8}")
    for c in changes:
        print(f"{c.name:<34} {c.size:>9} {c.old:>12.5g} {c.new:>12.5g} {c.ratio:>8.3f} {c.verdict()}".rstrip())


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("old", nargs="?")
    parser.add_argument("new", nargs="?")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--args", default="", help="for both programs, as one word")
    parser.add_argument("--old-args", default="", help="for the old one besides")
    parser.add_argument("--new-args", default="", help="for the new one besides")
    parser.add_argument("--relative", type=float, default=0.05, help="worse by more than this part (default: %(default)s)")
    parser.add_argument("--absolute", type=float, help="and by more than this; default: 5 ns, 20 ms, 1 MiB, 1 sweep")
    parser.add_argument("--require", action="append", default=[], metavar="NAME[@SIZE]<=RATIO")
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args(arguments)
    if options.self_test:
        return self_test()
    if options.new is None or options.pairs < 1:
        parser.error("two programs are expected, and at least one pair of runs")
    old_arguments, new_arguments = (shlex.split(options.args) + shlex.split(own)
                                    for own in (options.old_args, options.new_args))
    pairs = [(run(options.old, old_arguments), run(options.new, new_arguments)) for _ in range(options.pairs)]
    changes = compare(pairs, options)
    if not changes:
        print("compare: the two programs report no number in common", file=sys.stderr)
        return 2
    print_table(changes)
    missed = [line for text in options.require for line in check_requirement(text, changes)]
    for line in missed:
        print(f"MISSED {line}")
    return 1 if missed or any(c.worse for c in changes) else 0


def self_test():
    """Programs that report what they are told to, one list of numbers a run."""
    script = """#!/usr/bin/env python3
import json, pathlib, sys
count = pathlib.Path(__file__ + ".runs")
run = int(count.read_text()) if count.exists() else 0
count.write_text(str(run + 1))
rows = {rows}
pathlib.Path(sys.argv[sys.argv.index("--json") + 1]).write_text(json.dumps({{"sizes": [rows[run % len(rows)]]}}))
"""

    def exit_of(old, new, *more):
        with tempfile.TemporaryDirectory() as folder:
            programs = []
            for name, values in (("old", old), ("new", new)):
                rows = [{"vertices": 1000, "newton_ns": x} for x in values]
                path = pathlib.Path(folder) / name
                path.write_text(script.format(rows=repr(rows)))
                path.chmod(0o755)
                programs.append(str(path))
            result = subprocess.run([sys.executable, __file__, *programs, "--pairs", "3", *more], capture_output=True)
            return result.returncode

    cases = {
        "the same": (0, [100], [100]),
        "slower past both thresholds": (1, [100], [120]),
        "slower by a small part": (0, [1000], [1030]),
        "slower by next to nothing": (0, [10], [12]),
        "thresholds are options": (1, [10], [12], "--absolute", "1"),
        "one slow run of three": (0, [100], [100, 500, 100]),
        "a slow spell hits both": (0, [100, 300, 100], [100, 300, 101]),
        "faster": (0, [100], [50]),
        "a requirement is met": (0, [100], [30], "--require", "newton<=0.35"),
        "a requirement is missed": (1, [100], [40], "--require", "newton<=0.35"),
        "a requirement of a size": (0, [100], [30], "--require", "newton_ns@1000<=0.35"),
        "a requirement of what is not there": (1, [100], [30], "--require", "newton@7<=0.35"),
    }
    failed = [name for name, (expected, *case) in cases.items() if exit_of(*case) != expected]
    for name in failed:
        print(f"compare: self-test failed: {name}", file=sys.stderr)
    print(f"compare: {len(cases) - len(failed)} of {len(cases)} cases of the self-test pass")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
