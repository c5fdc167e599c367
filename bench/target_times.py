#!/usr/bin/env python3
"""Divides the time of each target by the time of the default, and of an older release.

    bench/target_times.py TEMPER [--against OLD] [--sets public,tetrahedra,1000,100000] [--limit 300]

TEMPER and OLD are the programs of two release builds. A set is `public` (meshes of triangles), `tetrahedra`, or a number of
random points. The folder TEMPER_SHARED (default: ../shared) has the meshes. The builds run in turn, on one thread. Times are
processor seconds: the least of three runs, or one run if it takes over 2 s. The script leaves out runs over --limit seconds.
A ratio divides the sums over the meshes. In brackets is the geometric mean of the ratios. The last numbers count the meshes
that both runs finished.
"""

import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import tempfile

SHARED = pathlib.Path(os.environ.get("TEMPER_SHARED", pathlib.Path(__file__).resolve().parents[2] / "shared"))
TRIANGLES = ("any", "valid", "vertex", "cell", "stars", "mpas", "dflowfm", "adcirc", "fem")
TETRAHEDRA = ("any", "vertex", "cell")
LONG = 2  # [s]
MOST_FOR_MODELS = 20_000  # points: targets of ocean and river models are measured up to this number


def meshes_of(name, temper, folder):
    if name.isdigit():
        file = folder / f"{name}.vtu"
        subprocess.run([temper, "example", "random", "--vertices", name, "-o", file], check=True, capture_output=True)
        return [file]
    of = SHARED / ("tets" if name == "tetrahedra" else "meshes")
    return sorted(p for p in of.glob("*") if p.is_file() and p.suffix in (".mesh", ".msh", ".vtk", ".vtu"))


def targets_of(name):
    if name == "tetrahedra":
        return TETRAHEDRA
    return TRIANGLES if not name.isdigit() or int(name) <= MOST_FOR_MODELS else (*TRIANGLES[:5], "fem")


def seconds(program, mesh, target, limit, folder):
    """Returns the processor time, or None if the program refuses the mesh or needs more than the limit."""
    least = None
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        words = [program, "optimize", mesh, "-o", folder / "out.vtu", "--for", target, "--threads", "1", "--quiet"]
        try:
            if subprocess.run(words, capture_output=True, timeout=limit).returncode != 0:
                return None
        except subprocess.TimeoutExpired:
            return None
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        now = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        least = now if least is None else min(least, now)
        if least > LONG:
            break
    return least


def ratio(above, below):
    pairs = [(a, b) for a, b in zip(above, below) if a and b]
    if not pairs:
        return "-"
    mean = statistics.geometric_mean(a / b for a, b in pairs)
    return f"{sum(a for a, _ in pairs) / sum(b for _, b in pairs):.2f} ({mean:.2f}), {len(pairs)} of {len(above)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("temper", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--sets", default="public,1000,10000,100000,tetrahedra")
    parser.add_argument("--limit", type=float, default=300)
    options = parser.parse_args()
    builds = [build.resolve() for build in (options.temper, options.against) if build]
    print("| meshes | target | seconds | over the default | over the older release |\n|-|-|-|-|-|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for of in options.sets.split(","):
            meshes, default = meshes_of(of, builds[0], folder), None
            for target in targets_of(of):
                runs = [[seconds(build, mesh, target, options.limit, folder) for build in builds] for mesh in meshes]
                now = [run[0] for run in runs]
                default = default or now
                older = ratio(now, [run[1] for run in runs]) if options.against else ""
                print(f"| {of} | {target} | {sum(filter(None, now)):.2f} | {ratio(now, default)} | {older} |", flush=True)


if __name__ == "__main__":
    main()
