#!/usr/bin/env python3
"""Best weights: gaps, verified by bench/check_best.py, and errors of star 1 over those of the input.

    bench/best_weights_table.py TEMPER MESH ...

`★1` is the mean of temper errors over all fields, L2. The table has the geometric mean over the meshes, the number of meshes
on which the error rises, and the largest number of the rest. Rows of each mesh go to stderr; a mesh without weights has none.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

CHECK = pathlib.Path(__file__).with_name("check_best.py")
RUNS = {
    "change": ["--mode", "change"],
    "center": ["--mode", "center"],
    "accuracy": ["--mode", "accuracy"],
    "accuracy --for stars": ["--mode", "accuracy", "--for", "stars"],
}


def run(*words):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True)


def measured(temper, mesh, options, folder):
    """Error of star 1 over the input's, and the gap that the other program proves."""
    out, proof = folder / "out.vtu", folder / "proof.json"
    start = time.perf_counter()
    report = json.loads(run(temper, "weights", mesh, "-o", out, "--encoding", "ascii", "--certificate", proof, "--json",
                            *options).stdout)  # fmt: skip
    seconds = time.perf_counter() - start
    if not report["solved"]:
        return None
    errors = json.loads(run(temper, "errors", out, "--against", mesh, "--json").stdout)
    star = errors["against"]["ratios"]["mean"]["all"]["star1"]["l2"]
    gap = None
    if report["optimality"]:
        check = run(sys.executable, CHECK, out, proof)
        if check.returncode != 0:
            sys.exit(f"{mesh} {options}: {check.stdout}{check.stderr}")
        gap = float(check.stdout.split("relative gap ")[1].split(",")[0])
    return star, gap, seconds


def main(temper, *meshes):
    rows = {name: [] for name in RUNS}
    with tempfile.TemporaryDirectory() as scratch:
        for mesh in map(pathlib.Path, meshes):
            for name, options in RUNS.items():
                result = measured(temper, mesh, options, pathlib.Path(scratch))
                print(mesh.name, name, result or "no weights", file=sys.stderr, flush=True)
                rows[name] += [result] if result else []
    print("| weights | ★1: mean | larger than 1 | largest | gap | seconds |\n|-|-|-|-|-|-|")
    for name, results in rows.items():
        stars, gaps, seconds = zip(*results)
        gap = f"{max(gaps):.0e}" if None not in gaps else ""
        print(f"| `{name}` | {statistics.geometric_mean(stars):.3f} | {sum(star > 1 for star in stars)} of {len(stars)} | "
              f"{max(stars):.3f} | {gap} | {max(seconds):.2f} |")  # fmt: skip


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
