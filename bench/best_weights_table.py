#!/usr/bin/env python3
"""Best weights of each mesh: gaps, verified by bench/check_best.py, and errors of star 1 over those of the input.

    bench/best_weights_table.py TEMPER MESH ...

`star 1` is the mean of temper errors over all fields, L2. A mesh without weights has no row. The last line has the
largest number of each column.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

CHECK = pathlib.Path(__file__).with_name("check_best.py")
RUNS = {
    "change": ["--mode", "change"],
    "center": ["--mode", "center"],
    "accuracy": ["--mode", "accuracy"],
    "accuracy, stars": ["--mode", "accuracy", "--for", "stars"],
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
    print("| mesh | " + " | ".join(f"★1: {name}" for name in RUNS) + " | gap: center | gap: accuracy | seconds |")
    print("|-" * (4 + len(RUNS)) + "|")
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for mesh in map(pathlib.Path, meshes):
            results = [measured(temper, mesh, options, pathlib.Path(scratch)) for options in RUNS.values()]
            stars = [r[0] if r else float("nan") for r in results]
            if not results[2]:
                print(f"| {mesh.name} | no weights |", flush=True)
                continue
            rows.append([*stars, results[1][1], max(results[2][1], results[3][1]), results[2][2]])
            *stars, center, accuracy, seconds = rows[-1]
            print(f"| {mesh.name} | " + " | ".join("—" if s != s else f"{s:.3f}" for s in stars) +
                  f" | {center:.0e} | {accuracy:.0e} | {seconds:.2f} |", flush=True)
    *stars, center, accuracy, seconds = (max(x for x in column if x == x) for column in zip(*rows))
    print("| largest | " + " | ".join(f"{s:.3f}" for s in stars) + f" | {center:.0e} | {accuracy:.0e} | {seconds:.2f} |")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
