#!/usr/bin/env python3
"""Point sets that temper.best_connectivity decides: results of docs/explanation/measured.md.

    bench/connectivity_table.py [--time-limit SECONDS] [--sets N] [--most-points N] [DIRECTORY ...]

Rows are random points in a square, and lattices of equilateral triangles whose vertices were moved at random. Each
directory adds instances of the challenge CG:SHOP 2025, by number of points. All points are vertices, and no point is
added. Proofs are checked once more. Needs temper's Python module.
"""

from __future__ import annotations

import argparse
import pathlib
import tempfile
import time
from collections.abc import Iterator

import numpy as np

import temper

RANDOM_POINTS = (10, 20, 40, 60)
LATTICES = (4, 6, 8)  # rows and columns
MOVED = (0.2, 0.38)  # of the length of an edge


def random_points(n: int, seed: int) -> temper.Mesh:
    return temper.generate.constrained_delaunay(np.random.default_rng([seed, n]).uniform(size=(n, 2)))


def moved_lattice(rows: int, most: float, seed: int) -> temper.Mesh:
    rng = np.random.default_rng([seed, rows])
    j, i = np.divmod(np.arange(rows * rows), rows)
    points = np.column_stack([i + 0.5 * (j % 2), np.sqrt(0.75) * j]) + rng.uniform(-most, most, (rows * rows, 2))
    number = lambda i, j: j * rows + i  # noqa: E731
    last = rows - 1
    around = [number(i, 0) for i in range(last)] + [number(last, j) for j in range(last)]
    around += [number(i, last) for i in range(last, 0, -1)] + [number(0, j) for j in range(last, 0, -1)]
    return temper.generate.constrained_delaunay(points, np.column_stack([around, around[1:] + around[:1]]))


def instances(directory: pathlib.Path, most_points: int) -> Iterator[tuple[str, temper.Mesh]]:
    import cgshop

    by_size = lambda path: (int(path.name.split("_")[1]), path.name)  # noqa: E731
    for path in sorted(directory.glob("*.instance.json"), key=by_size):
        instance = cgshop.read_instance(path)
        if len(instance.points) > most_points:
            continue
        with tempfile.TemporaryDirectory() as folder:
            mesh = pathlib.Path(folder) / "in.vtu"
            cgshop.write_cdt(instance, mesh)
            yield "CG:SHOP", temper.read(mesh)


def sets(args: argparse.Namespace) -> Iterator[tuple[str, temper.Mesh]]:
    for n in RANDOM_POINTS:
        if n <= args.most_points:
            yield from (("random", random_points(n, seed)) for seed in range(args.sets))
    for rows in LATTICES:
        for most in MOVED:
            if rows * rows <= args.most_points:
                yield from (("lattice", moved_lattice(rows, most, seed)) for seed in range(args.sets))
    for directory in args.directories:
        yield from instances(directory, args.most_points)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directories", nargs="*", type=pathlib.Path)
    parser.add_argument("--time-limit", type=float, default=60)
    parser.add_argument("--sets", type=int, default=20)
    parser.add_argument("--most-points", type=int, default=60)
    parser.add_argument("--constraints", action="append", choices=["well_centered", "heights_only"], help="both without this")
    args = parser.parse_args()
    rows: dict[tuple[str, str], list[tuple[str, float, int, int, int]]] = {}
    for title, mesh in sets(args):
        for constraints in args.constraints or ["well_centered", "heights_only"]:
            start = time.perf_counter()
            report = temper.best_connectivity(mesh, constraints=constraints, time_limit=args.time_limit)
            seconds = time.perf_counter() - start
            verdict = "found" if report.margin > 0 else "none" if report.proof else "undecided"
            if report.proof:
                assert temper.check_certificate(mesh, report.proof) == "proves", title
            programs = report.programs + report.complete_programs
            lemmas = len(report.proof.lemmas) if report.proof else 0
            rows.setdefault((title, constraints), []).append((verdict, seconds, programs, lemmas, mesh.n_vertices))
    print("| points | constraints | sets | found | none exists | undecided | most programs | most lemmas | most seconds |")
    print("|-|-|-|-|-|-|-|-|-|")
    for (title, constraints), results in rows.items():
        count = [sum(verdict == each for verdict, *_ in results) for each in ("found", "none", "undecided")]
        seconds, programs, lemmas, points = (list(column) for column in list(zip(*results))[1:])
        print(f"| {title}, {min(points)} to {max(points)} | `{constraints}` | {len(results)} | {count[0]} | {count[1]} | {count[2]} | "
              f"{max(programs)} | {max(lemmas)} | {max(seconds):.2g} |")  # fmt: skip


if __name__ == "__main__":
    main()
