#!/usr/bin/env python3
"""Errors after runs with weights, with positions, and with both: results of docs/explanation/measured.md.

    bench/weights_table.py TEMPER MESH ...

Each mesh gets weights, or is optimized with each set of unknowns; errors are those of temper errors on the held-back fields over those
of the input, and each row gives geometric means over the meshes. Also counted: triangles that stay not well-centered,
and meshes where the scheme's matrix is an M-matrix in the end.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

RUNS = {
    "input": None,
    "least change of weights": ["weights", "--mode", "change"],
    "center of weights": ["weights", "--mode", "center"],
    "best weights": ["weights", "--mode", "accuracy"],
    "E_BP, weights alone": ["optimize", "--set", "objective=energy", "--keep", "positions"],
    "E_BP, positions alone": ["optimize", "--set", "objective=energy", "--keep", "weights"],
    "E_BP, both": ["optimize", "--set", "objective=energy"],
    "accuracy, weights alone": ["optimize", "--keep", "positions"],
    "accuracy, positions alone": ["optimize", "--keep", "weights"],
    "accuracy, both": ["optimize"],
}
ERRORS = [("★1, L2", "star1", "l2"), ("Poisson, L2", "poisson", "l2"), ("Poisson, max", "poisson", "max"),
          ("flux, L2", "flux", "l2")]


def run(*words):
    words = [str(w) for w in words]
    result = subprocess.run(words, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(words)}: {result.stderr}")
    return result.stdout


def measured(temper, mesh, before):
    report = json.loads(run(temper, "errors", mesh, "--against", before, "--fields", "held-back", "--json"))
    mean = report["against"]["ratios"]["mean"]["held-back"]
    return {"bad": report["not_well_centered"], "triangles": report["triangles"],
            "poisson": report["matrices"]["poisson"]["m_matrix"], "flux": report["matrices"]["flux"]["m_matrix"],
            "ratios": [mean[scheme][norm] for _, scheme, norm in ERRORS]}


def row(temper, words, meshes, folder):
    results = []
    for mesh in meshes:
        after = mesh
        if words is not None:
            after = folder / (mesh.name + ".vtu")
            run(temper, words[0], mesh, "-o", after, "--quiet", *words[1:])
        results.append(measured(temper, after, mesh))
    return results


def mean(values):
    return math.exp(sum(math.log(v) for v in values) / len(values)) if all(0 < v < math.inf for v in values) else math.inf


def main(temper, *meshes):
    meshes = [pathlib.Path(m) for m in meshes]
    print("| unknowns | triangles not well-centered | M-matrix: Poisson | flux | " +
          " | ".join(name for name, _, _ in ERRORS) + " |")
    print("|-" * (4 + len(ERRORS)) + "|")
    with tempfile.TemporaryDirectory() as scratch:
        for name, words in RUNS.items():
            results = row(temper, words, meshes, pathlib.Path(scratch))
            ratios = [mean([r["ratios"][i] for r in results]) for i in range(len(ERRORS))]
            print(f"| {name} | {sum(r['bad'] for r in results)} of {sum(r['triangles'] for r in results)} | "
                  f"{sum(r['poisson'] for r in results)} | {sum(r['flux'] for r in results)} | " + " | ".join(f"{r:.3f}" for r in ratios) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
