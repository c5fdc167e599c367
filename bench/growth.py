#!/usr/bin/env python3
"""Measures how time grows with the size of the input, for each verb, on shapes that are hard on it.

    bench/growth.py BUILD [--verbs check,optimize] [--shapes fan,strip] [--limit 60] [--check]

BUILD is a build folder with the program. Each row is a run of the program at sizes that grow by a factor of 3; a row
ends at the shape's largest size, or with the first run that takes more than --limit processor seconds. What is shown are
those of the largest run and the exponent p of n^p, between the two largest ones that took a tenth of a
second or more: n log n is below 1.1 at these sizes. --check exits with 1 when an exponent is above 1.35, which noise
alone does not do, or a run is cut off.
"""

import argparse
import math
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile

FACTOR = 3
LARGEST_EXPONENT = 1.35
LEAST_SECONDS = 0.1  # below, starting the program counts too much


class Shape:
    """A family of meshes by number of triangles, about; `most`: of the largest that is measured."""

    def __init__(self, name, what, most, make):
        self.name, self.what, self.most, self.make = name, what, most, make


def fan(n):
    """n triangles at one vertex, the middle of a polygon."""
    points = [(0.0, 0.0)] + [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
    return points, [(0, 1 + k, 1 + (k + 1) % n) for k in range(n)]


def squares(columns, rows, is_there=lambda i, j: True):
    """Squares of a grid, each cut by the same diagonal; those that are there."""
    number, points, triangles = {}, [], []

    def vertex(i, j):
        if (i, j) not in number:
            number[i, j] = len(points)
            points.append((float(i), float(j)))
        return number[i, j]

    for j in range(rows):
        for i in range(columns):
            if is_there(i, j):
                a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
                triangles += [(a, b, c), (a, c, d)]
    return points, triangles


def strip(n):
    """One row of squares: no vertex is inside, and all diagonals are ties."""
    return squares(n // 2, 1)


def grid(n):
    """As many rows as columns: all diagonals are ties."""
    side = round(math.sqrt(n / 2))
    return squares(side, side)


def holes(n):
    """A grid with a hole in each 4 × 4 squares."""
    side = 4 * round(math.sqrt(n / 30))
    return squares(side, side, lambda i, j: i % 4 != 1 or j % 4 != 1)


def islands(n):
    """Triangles that touch nothing."""
    side = math.ceil(math.sqrt(n))
    points, triangles = [], []
    for k in range(n):
        i, j = k % side, k // side
        points += [(i, j), (i + 0.8, j + 0.1), (i + 0.3, j + 0.7)]
        triangles.append((3 * k, 3 * k + 1, 3 * k + 2))
    return points, triangles


def nested(n):
    """Rings in rings, of eight triangles each: every component lies in a hole of all those around it."""
    points, triangles = [], []
    for k in range(max(1, n // 8)):
        inner, outer, first = 2.0 * k + 1, 2.0 * k + 2, 8 * k
        points += [(s * r, t * r) for r in (inner, outer) for s, t in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        for i in range(4):
            j = (i + 1) % 4
            triangles += [(first + i, first + 4 + i, first + 4 + j), (first + i, first + 4 + j, first + j)]
    return points, triangles


SHAPES = [
    Shape("fan", "triangles at one vertex", 300_000, fan),
    Shape("strip", "one row of squares, all diagonals parallel", 2_000_000, strip),
    Shape("grid", "rows of squares, all diagonals parallel", 2_000_000, grid),
    Shape("holes", "a grid with a hole in each 4 × 4 squares", 300_000, holes),
    Shape("islands", "triangles that touch nothing", 100_000, islands),
    Shape("nested", "rings in rings", 100_000, nested),
]

# Options of a verb's run; {mesh} is the shape's file, {out} a place for what it writes.
VERBS = {
    "check": "check {mesh}",
    "convert": "convert {mesh} -o {out}.vtu",
    "draw": "draw {mesh} -o {out}.svg",
    "operators": "operators {mesh} -o {out}",
    "explain": "explain {mesh}",
    "optimize": "optimize {mesh} -o {out}.vtu --quiet",
    "optimize, repair=vertices": "optimize {mesh} -o {out}.vtu --quiet --set repair=vertices",
    "optimize --boundary split": "optimize {mesh} -o {out}.vtu --quiet --boundary split",
    "weights": "weights {mesh} -o {out}.vtu",
    "errors": "errors {mesh}",
}


def write_off(path, points, triangles):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines(f"{x!r} {y!r} 0\n" for x, y in points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)


def run(command, limit):
    """Processor seconds of a run, or None when it was cut off; and its exit status."""

    def set_limit():
        seconds = math.ceil(limit)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))  # SIGXCPU, and if that is of no use SIGKILL

    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=set_limit)
    _, status, usage = os.wait4(process.pid, 0)
    code = os.waitstatus_to_exitcode(status)
    if code == -signal.SIGXCPU:
        return None, None
    return usage.ru_utime + usage.ru_stime, code


def exponent(runs):
    """p of n^p between the two largest runs that say something, or None."""
    telling = [(n, s) for n, s in runs if s >= LEAST_SECONDS][-2:]
    if len(telling) < 2:
        return None
    (n, s), (m, t) = telling
    return math.log(t / s) / math.log(m / n)


def measured(program, template, shape, limit, folder):
    """(triangles, seconds) of each run of a row, and whether the last one was cut off or failed."""
    runs, n = [], 1000
    while n <= shape.most:
        points, triangles = shape.make(n)
        mesh = folder / f"{shape.name}.off"
        write_off(mesh, points, triangles)
        words = [word.format(mesh=mesh, out=folder / "out") for word in template.split()]
        seconds, status = run([program, *words], limit)
        if seconds is None:
            return runs, f"over {limit:g} s at {len(triangles)}"
        if status not in (0, 3, 4, 6):  # what it found is bad, or stayed so; no weights
            return runs, f"exit {status} at {len(triangles)}"
        runs.append((len(triangles), seconds))
        n *= FACTOR
    return runs, ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--verbs", default=",".join(VERBS), help="of the table, separated by commas")
    parser.add_argument("--shapes", default=",".join(s.name for s in SHAPES))
    parser.add_argument("--limit", type=float, default=60, help="processor seconds a run")
    parser.add_argument("--check", action="store_true", help="exit with 1 when a row grows too fast or is cut off")
    given = parser.parse_args()
    program, failed = given.build / "apps" / "temper" / "temper", False
    print("| verb | shape | triangles | s | exponent | |\n|-|-|-|-|-|-|")
    with tempfile.TemporaryDirectory() as folder:
        for verb in given.verbs.split(","):
            for shape in (s for s in SHAPES if s.name in given.shapes.split(",")):
                runs, end = measured(program, VERBS[verb], shape, given.limit, pathlib.Path(folder))
                p = exponent(runs)
                failed = failed or end != "" or (p is not None and p > LARGEST_EXPONENT)
                n, seconds = runs[-1] if runs else (0, 0)
                shown = "" if p is None else f"{p:.2f}"
                print(f"| {verb} | {shape.name} | {n} | {seconds:.2f} | {shown} | {end} |", flush=True)
    return 1 if given.check and failed else 0


if __name__ == "__main__":
    sys.exit(main())
