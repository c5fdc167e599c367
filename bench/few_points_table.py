#!/usr/bin/env python3
"""Vertices that temper mesh --points few adds in so many seconds: results of docs/explanation/measured.md.

    bench/few_points_table.py [--most SECONDS]

Outlines are examples of the repository and the boundaries and points of meshes of temper.generate. Seconds are seconds
of the processor, so other programs do not change the table much. Needs temper's Python module.
"""

from __future__ import annotations

import argparse
import collections
import time
from collections.abc import Iterator
from pathlib import Path

import temper

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
AT = (0.25, 1, 8)  # seconds


def outline_of(mesh: temper.Mesh) -> temper.Outline:
    """The boundary of a mesh, and all its points."""
    edges = collections.Counter()
    for a, b, c in mesh.triangles.tolist():
        edges.update(frozenset(e) for e in ((a, b), (b, c), (c, a)))
    return temper.Outline(mesh.points, [sorted(edge) for edge, sides in edges.items() if sides == 1])


def outlines() -> Iterator[tuple[str, temper.Outline]]:
    for name in ("harbour.poly", "aquifer.geojson"):
        yield f"`examples/{name}`", temper.read_outline(EXAMPLES / name).outline
    yield "`temper example sparse-horseshoe`", outline_of(temper.generate.sparse_horseshoe())
    yield "`temper example horseshoe`", outline_of(temper.generate.horseshoe())
    for n in (40, 160):
        yield f"`temper example random --vertices {n}`", outline_of(temper.generate.random_mesh(n))


def added(outline: temper.Outline, target: str, most: float) -> list[str]:
    """New vertices of the best mesh at each time."""
    counts: list[tuple[float, int]] = []
    first = time.process_time()

    def observe(progress: temper.Progress) -> bool:
        seconds = time.process_time() - first
        if progress.n_vertices is not None and progress.last.bad == 0:
            counts.append((seconds, progress.n_vertices))
        return seconds < most

    made = temper.mesh_outline(outline, None, target=target, time_limit=3600.0, threads=1, observer=observe)
    if made.bad == 0:
        counts.append((time.process_time() - first, made.mesh.n_vertices))
    cells = []
    for at in AT:
        done = [n for seconds, n in counts if seconds <= at] if at < most else [n for _, n in counts]
        cells.append(str(min(done) - len(outline.points)) if done else "bad")
    return cells


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=float, default=AT[-1], help="seconds of the processor for each mesh")
    args = parser.parse_args()
    at = ", ".join(f"{s:g}" for s in AT)
    print(f"| outline | points | with weights: {at} s | without |\n|-|-|-|-|")
    for name, outline in outlines():
        cells = (", ".join(added(outline, target, args.most)) for target in ("any", "mpas"))
        print(f"| {name} | {len(outline.points)} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
