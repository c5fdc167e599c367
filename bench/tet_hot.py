#!/usr/bin/env python3
"""Measures what the HOT energies of tetrahedra do to errors, after the default run.

    bench/tet_hot.py PROGRAM MESH …

A row is a star. Its numbers are geometric means over the meshes of the mean L2 errors that `temper errors` prints, over
those without a HOT energy.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import geometric_mean

ERRORS = {"star0": "★0", "star1": "★1", "star2": "★2", "poisson": "Poisson", "flux": "flux"}


def errors_after(program, mesh, folder, *options):
    out = Path(folder) / "out.vtu"
    subprocess.run([program, "optimize", mesh, "-o", out, "--quiet", *options], check=True, capture_output=True)
    measured = subprocess.run([program, "errors", out, "--json"], check=True, capture_output=True).stdout
    return {name: error["l2"] for name, error in json.loads(measured)["errors"]["mean"]["all"].items()}


def main():
    program, *meshes = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        before = [errors_after(program, mesh, folder) for mesh in meshes]
        print("| |", " | ".join(ERRORS.values()), "|\n|" + "-|" * (1 + len(ERRORS)))
        for star in range(4):
            after = [errors_after(program, mesh, folder, "--set", f"energy=F,star={star}") for mesh in meshes]
            ratios = (geometric_mean(a[name] / b[name] for a, b in zip(after, before)) for name in ERRORS)
            print(f"| `star={star}` |", " | ".join(f"{ratio:.2f}" for ratio in ratios), "|", flush=True)


if __name__ == "__main__":
    main()
