#!/usr/bin/env python3
"""Measures what docs/internals/performance.md and docs/explanation/cost.md show, and writes their tables and pictures.

    bench/measure.py BUILD [--sizes 1000,10000,100000,1000000] [--rounds 3] [--tables-only]

BUILD is a build folder of the bench preset. On a quiet machine: 10⁶ vertices take some minutes. The numbers go to
docs/internals/performance/*.json, from there into the tables of both pages between their marks, and into the plots
(bench/plot.py). --tables-only: from the numbers that are there.
"""

import argparse
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import plot

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs" / "internals" / "performance.md"
COST = ROOT / "docs" / "explanation" / "cost.md"
SETS = ("baseline", "avx2", "avx512")


def whole_runs(build, options):
    program = build / "apps" / "temper" / "temper"
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "runs.json"
        command = [build / "bench" / "bench_whole_run", "--sizes", options.sizes, "--rounds", options.rounds]
        command += ["--temper", program] if program.exists() else []
        subprocess.run([*map(str, command), "--json", str(path)], check=True)
        return json.loads(path.read_text())


def kernels(build):
    """Nanoseconds an iteration by name: the least of three."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "kernels.json"
        subprocess.run([str(build / "bench" / "bench_kernels"), "--benchmark_repetitions=3", f"--benchmark_out={path}",
                        "--benchmark_out_format=json"], check=True, stdout=subprocess.DEVNULL)
        return least_times(json.loads(path.read_text()))


def least_times(report):
    unit = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    result = {}
    for row in report["benchmarks"]:
        if row.get("run_type", "iteration") != "iteration":
            continue
        label = row.get("label", "")
        name = row["name"].split("/")[0] + (f"/{label}" if label in SETS else "".join(row["name"].partition("/")[1:]))
        result[name] = min(result.get(name, math.inf), round(row["cpu_time"] * unit[row["time_unit"]], 3))
    return result


def number(x, digits=0):
    if x is None:
        return ""
    if isinstance(x, float) and x != 0 and digits == 0 and abs(x) < 10:
        return f"{x:.2g}"
    return f"{x:,.{digits}f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "-|" + "-:|" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def sweeps_table(rows):
    keys = ("newton_ns", "settled_ns", "alternating_ns", "golden_ns", "paper_ns", "loop_ns", "loop_by_stars_ns", "triad_ns")
    head = ["vertices", "Newton", "settled", "alternating", "golden", "paper", "loop", "loop, eight stars", "triad"]
    return table(head, [[number(r["vertices"])] + [number(r[k]) for k in keys] for r in rows])


def cost_table(rows):
    def cells(r):
        seconds = [r[key]["total"] for key in ("stages", "stages_with_threads")]
        return [number(r["vertices"]), number(r["triangles"]), *(number(s, 1) for s in seconds),
                number(r["program_peak_bytes"] / r["vertices"])]
    head = ["vertices", "triangles", "seconds, one thread", "two threads", "bytes per vertex"]
    return table(head, [cells(r) for r in rows])


def bounds_table(bounds):
    """The bounds that are missed, and how many are met."""
    cells = [[b["what"], f"{b['value']:.3g}", f"at least {b['least']:.3g}" if "least" in b else f"at most {b['most']:.3g}"]
             for b in bounds if b["met"] is False]
    met = sum(bool(b["met"]) for b in bounds)
    return table(["bound that is missed", "measured", "wanted"], [*cells, [f"{met} other bounds are met", "", ""]])


def write_tables(runs):
    rows = runs["sizes"]
    put_tables(COST, {"cost": cost_table(rows)})
    put_tables(DOCUMENT, {"sweeps": sweeps_table(rows), "bounds": bounds_table(runs["bounds"])})


def put_tables(page, tables):
    text = page.read_text()
    for name, body in tables.items():
        mark = re.compile(rf"(<!-- written by bench/measure.py: {name} -->\n).*?(<!-- end -->)", re.DOTALL)
        text, count = mark.subn(lambda m: m[1] + body + "\n" + m[2], text)
        if count != 1:
            sys.exit(f"measure: {page.name} has {count} places for the table '{name}'")
    page.write_text(text)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("build", type=pathlib.Path, nargs="?")
    parser.add_argument("--sizes", default="1000,10000,100000,1000000")
    parser.add_argument("--rounds", default="3")
    parser.add_argument("--tables-only", action="store_true")
    options = parser.parse_args(arguments)
    folder = ROOT / "docs" / "internals" / "performance"
    files = {name: folder / f"{name}.json" for name in ("runs", "kernels")}
    if not options.tables_only:
        if options.build is None:
            parser.error("a build folder is expected")
        folder.mkdir(exist_ok=True)
        files["kernels"].write_text(json.dumps(kernels(options.build), indent=1) + "\n")
        files["runs"].write_text(json.dumps(whole_runs(options.build, options), indent=1) + "\n")
    runs = json.loads(files["runs"].read_text())
    write_tables(runs)
    plot.draw(runs, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
