#!/usr/bin/env python3
"""Instances of the challenge CG:SHOP 2025: conversion, runs of temper, and an exact judge.

    cgshop.py poly INSTANCE OUT.poly      the outline, as temper mesh reads it
    cgshop.py cdt INSTANCE OUT.vtu        its constrained Delaunay triangulation (needs temper's Python module)
    cgshop.py solution SOLUTION OUT.vtu   the mesh of a solution that lies beside its instance, for pictures
    cgshop.py label PICTURE LEFT RIGHT    puts these numbers of new vertices over both meshes of a picture, which is from
                                          `temper draw MESH.vtu --before WINNERS.vtu`; `judge` prints the right one
    cgshop.py judge INSTANCE MESH.vtu     verdict about a mesh, in rational arithmetic, without temper
    cgshop.py run DIRECTORY [options] [-- options of temper]
                                          runs all instances of a directory and prints a table

An instance is a JSON file of https://cgshop.ibr.cs.tu-bs.de/competition/cg-shop-2025. `run` judges each mesh and
divides the number of added vertices by the number in best_known.csv beside the instances.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

# --- instances -----------------------------------------------------------------------------------------


class Instance(NamedTuple):
    points: list[tuple[int, int]]
    boundary: list[int]
    """The polygon around the domain, by numbers of points."""
    constraints: list[tuple[int, int]]

    def segments(self) -> list[tuple[int, int]]:
        """Edges of the polygon, then the constraints."""
        around = self.boundary
        return [*zip(around, around[1:] + around[:1]), *self.constraints]


def read_instance(path: Path) -> Instance:
    data = json.loads(path.read_text())
    return Instance(list(zip(data["points_x"], data["points_y"])), data["region_boundary"],
                    [(a, b) for a, b in data["additional_constraints"]])


def write_poly(instance: Instance, path: Path) -> None:
    segments = instance.segments()
    lines = [f"{len(instance.points)} 2 0 0"]
    lines += [f"{i} {x} {y}" for i, (x, y) in enumerate(instance.points)]
    lines += [f"{len(segments)} 0"]
    lines += [f"{i} {a} {b}" for i, (a, b) in enumerate(segments)]
    path.write_text("\n".join([*lines, "0", ""]))


def divided(instance: Instance, segment: tuple[int, int]) -> list[list[int]]:
    """The edges into which the points on a segment divide it."""
    p, q = (instance.points[i] for i in segment)
    on_it = [(dot(p, q, r), i) for i, r in enumerate(instance.points) if cross(p, q, r) == 0]
    chain = [i for along, i in sorted(on_it) if 0 <= along <= dot(p, q, q)]
    return [[a, b] for a, b in zip(chain, chain[1:])]


def write_cdt(instance: Instance, path: Path) -> None:
    import numpy as np

    import temper

    points, segments = np.array(instance.points, float), [divided(instance, s) for s in instance.segments()]
    hull = temper.generate.constrained_delaunay(points, np.array(sum(segments, [])), carve=False)
    around = {frozenset(edge) for edges in segments[:len(instance.boundary)] for edge in edges}
    sides: dict[frozenset[int], list[int]] = {}
    for t, (a, b, c) in enumerate(hull.triangles.tolist()):
        for ends in ((a, b), (b, c), (c, a)):
            sides.setdefault(frozenset(ends), []).append(t)
    outside: set[int] = set()
    queue = [t for ends, near in sides.items() if len(near) == 1 and ends not in around for t in near]
    while queue:
        t = queue.pop()
        if t in outside:
            continue
        outside.add(t)
        a, b, c = hull.triangles[t].tolist()
        for ends in map(frozenset, ((a, b), (b, c), (c, a))):
            queue += [] if ends in around else sides[ends]
    inside = [t for t in range(hull.n_triangles) if t not in outside]
    lines = sum(segments[len(instance.boundary):], [])
    mesh = temper.Mesh(points, hull.triangles[inside], constrained_edges=np.array(lines, int).reshape(-1, 2),
                       fixed=np.arange(len(points)))
    temper.write(path, mesh)


def write_solution(path: Path, out: Path) -> None:
    import numpy as np

    import temper

    solution = json.loads(path.read_text())
    instance = read_instance(path.with_name(solution["instance_uid"] + ".instance.json"))
    added = zip(solution["steiner_points_x"], solution["steiner_points_y"])
    points = instance.points + [(Fraction(x), Fraction(y)) for x, y in added]
    neighbors: dict[int, list[int]] = {v: [] for v in range(len(points))}
    for a, b in solution["edges"]:
        neighbors[a].append(b)
        neighbors[b].append(a)
    triangles = []
    for a, around in neighbors.items():
        around.sort(key=lambda v: math.atan2(points[v][1] - points[a][1], points[v][0] - points[a][0]))
        for b, c in zip(around, around[1:] + around[:1]):
            if a < min(b, c) and c in neighbors[b] and cross(points[a], points[b], points[c]) > 0:
                triangles.append((a, b, c))
    lines = []
    for p, q in instance.constraints:
        ends = points[p], points[q]
        on_it = {v for v, r in enumerate(points) if cross(*ends, r) == 0 and 0 <= dot(*ends, r) <= dot(*ends, ends[1])}
        lines += [edge for edge in solution["edges"] if on_it.issuperset(edge)]
    mesh = temper.Mesh(np.array(points, float), triangles, constrained_edges=np.array(lines, int).reshape(-1, 2))
    temper.write(out, mesh)


HEADING = re.compile(r"<text ([^>]*)>(?:(?!</text>).)*(?:before|after):.*?</text>\n")
TICK = re.compile(r'<path d="M0 0l0.25 0.3 0.5-0.8".*?/>\n')


def label(picture: Path, left: str, right: str) -> None:
    """Replaces the numbers of bad triangles, since right angles do not count in the challenge."""
    names = iter((("the winners", left), ("temper", right)))

    def heading(match: re.Match[str]) -> str:
        name, count = next(names)
        return f'<text {match[1]}>{name}: <tspan font-weight="bold">{count}</tspan> new vertices</text>\n'

    text, found = HEADING.subn(heading, TICK.sub("", picture.read_text()))
    if found != 2:
        sys.exit(f"{picture}: has {found} headings of temper draw --before, expected 2")
    picture.write_text(text)


# --- meshes --------------------------------------------------------------------------------------------


class Triangulation(NamedTuple):
    points: list[tuple[Fraction, Fraction]]
    weights: list[Fraction]
    triangles: list[tuple[int, int, int]]


def read_vtu(path: Path) -> Triangulation:
    """Reads an ASCII file of temper. Decimal numbers become the doubles that they stand for, exactly."""
    piece = xml.etree.ElementTree.parse(path).getroot().find("./UnstructuredGrid/Piece")
    array = {a.get("Name", ""): (a.text or "").split() for a in piece.iter("DataArray")}
    number = lambda text: Fraction(float(text))  # noqa: E731
    xyz = array[next(iter(piece.find("Points"))).get("Name", "")]
    points = [(number(xyz[i]), number(xyz[i + 1])) for i in range(0, len(xyz), 3)]
    weights = [number(w) for w in array.get("weight", ["0"] * len(points))]
    corners, ends = [int(i) for i in array["connectivity"]], [int(i) for i in array["offsets"]]
    cells = [(kind, corners[end - {"1": 1, "3": 2, "5": 3}[kind]:end]) for kind, end in zip(array["types"], ends)]
    return Triangulation(points, weights, [tuple(c) for kind, c in cells if kind == "5"])


# --- the judge -----------------------------------------------------------------------------------------


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def dot(a, b, c):
    return (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1])


class Verdict(NamedTuple):
    faults: list[str]
    bad: int
    """Triangles that are not well-centered."""
    added: int
    """Vertices that are not points of the instance."""
    off_lines: float
    """Greatest distance of a vertex from the segment that it divides, over the length of the segment: 0 is exact."""
    weighted: bool


def is_well_centered(points, weights) -> bool:
    """The orthocenter is inside, and each dual edge crosses its primal edge: all strictly, in rational arithmetic."""
    for i in range(3):
        p, q, r = points[i], points[i - 2], points[i - 1]
        wp, wq, wr = weights[i], weights[i - 2], weights[i - 1]
        if not abs(wp - wq) < dot(p, q, q):
            return False
        dp, dq, dr = dot(p, q, r), dot(q, r, p), dot(r, p, q)
        if not dp * (dr + wq - wr) + dq * (dr + wp - wr) > 0:
            return False
    return True


def chain_along(a: int, b: int, on_line: dict, points) -> tuple[list[int], Fraction] | None:
    """Follows edges from vertex a to vertex b along their segment. Returns the vertices, and how far they are off."""
    chain, worst, length2 = [a], Fraction(0), dot(points[a], points[b], points[b])
    while chain[-1] != b:
        here = chain[-1]
        best = None
        for v in on_line[here]:
            along = dot(points[a], points[v], points[b])
            if not dot(points[a], points[here], points[b]) < along <= length2:
                continue
            off = abs(cross(points[a], points[b], points[v])) / length2
            if off <= Fraction(1, 10**12) and (best is None or along < best[0]):
                best = (along, off, v)
        if best is None:
            return None
        worst = max(worst, best[1])
        chain.append(best[2])
    return chain, worst


def judge(instance: Instance, mesh: Triangulation) -> Verdict:
    faults: list[str] = []
    points = mesh.points
    at = {p: i for i, p in enumerate(points)}
    if len(at) < len(points):
        faults.append("two vertices at one place")
    vertex = [at.get((Fraction(x), Fraction(y)), -1) for x, y in instance.points]
    missing = [i for i, v in enumerate(vertex) if v < 0]
    if missing:
        return Verdict([f"points {missing} are no vertices"], 0, 0, 0.0, False)

    # A consistent orientation, and a boundary that is the polygon once, make the triangles a partition of the domain.
    halfedges: dict[tuple[int, int], int] = {}
    neighbors: dict[int, set[int]] = {v: set() for v in range(len(points))}
    for t, (a, b, c) in enumerate(mesh.triangles):
        if not cross(points[a], points[b], points[c]) > 0:
            faults.append(f"triangle {t} is not counter-clockwise")
        for h in ((a, b), (b, c), (c, a)):
            if h in halfedges:
                faults.append(f"edge {h} twice in one direction")
            halfedges[h] = t
            neighbors[h[0]].add(h[1])
            neighbors[h[1]].add(h[0])
    lonely = [v for v, near in neighbors.items() if not near]
    if lonely:
        faults.append(f"vertices {lonely[:5]} in no triangle")
    border = {h for h in halfedges if (h[1], h[0]) not in halfedges}
    worst = Fraction(0)
    covered: set[tuple[int, int]] = set()
    outer = len(instance.boundary)
    for i, (p, q) in enumerate(instance.segments()):
        found = chain_along(vertex[p], vertex[q], neighbors, points)
        if found is None:
            faults.append(f"segment {p}-{q} is not covered by edges")
            continue
        worst = max(worst, found[1])
        if i < outer:
            covered.update(zip(found[0], found[0][1:]))
    if covered != border and {(b, a) for a, b in covered} != border:
        faults.append("the boundary is not the polygon")

    bad = sum(not is_well_centered([points[v] for v in t], [mesh.weights[v] for v in t]) for t in mesh.triangles)
    if bad:
        faults.append(f"{bad} triangles are not well-centered")
    weighted = any(w != mesh.weights[0] for w in mesh.weights)
    return Verdict(faults, bad, len(points) - len(instance.points), float(worst), weighted)


# --- runs ----------------------------------------------------------------------------------------------


class Result(NamedTuple):
    name: str
    known: int
    seconds: float
    code: int
    verdict: Verdict


def run_one(path: Path, known: int, args: argparse.Namespace) -> Result:
    name = path.name.removesuffix(".instance.json")
    instance = read_instance(path)
    folder = Path(args.keep) if args.keep else Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    out = folder / f"{name}.vtu"
    out.unlink(missing_ok=True)
    if args.start == "outline":
        write_poly(instance, folder / f"{name}.poly")
        command = ["mesh", f"{folder}/{name}.poly", "--enclosed", "all"]
    else:
        write_cdt(instance, folder / f"{name}.cdt.vtu")
        command = ["optimize", f"{folder}/{name}.cdt.vtu", "--fix", "1"]
    command += ["-o", str(out), "--encoding", "ascii", "--time-limit", str(args.limit), "--quiet", *args.options]
    begin = time.monotonic()
    done = subprocess.run([args.temper, *command], capture_output=True, text=True)
    seconds = time.monotonic() - begin
    if out.exists():
        verdict = judge(instance, read_vtu(out))
    else:
        verdict = Verdict([f"no mesh: {done.stderr.strip()[-300:]}"], 0, 0, 0.0, False)
    return Result(name, known, seconds, done.returncode, verdict)


def run_all(args: argparse.Namespace) -> int:
    folder = Path(args.directory)
    with open(folder / "best_known.csv") as file:
        known = {row["instance"]: int(row["steiner_points"]) for row in csv.DictReader(file)}
    chosen = [p for p in sorted(folder.glob("*.instance.json")) if re.search(args.only, p.name)][args.first::args.step]
    results = []
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for r in pool.map(lambda p: run_one(p, known[p.name.removesuffix(".instance.json")], args), chosen):
            v = r.verdict
            print(f"{r.name:42} {v.added:6} {r.known:5} {v.added / max(r.known, 1):6.2f} {r.seconds:7.1f} s  "
                  f"exit {r.code}  {'; '.join(v.faults) or 'good'}", flush=True)
            results.append(r)
    good = [r for r in results if not r.verdict.faults]
    added, best = sum(r.verdict.added for r in good), sum(r.known for r in good)
    print(f"{len(good)} of {len(results)} well-centered; of these {added} vertices added, best known {best}, "
          f"ratio {added / max(best, 1):.3f}; greatest distance from lines "
          f"{max((r.verdict.off_lines for r in results), default=0):.1e}; "
          f"{sum(r.verdict.weighted for r in good)} with weights")
    return 0 if len(good) == len(results) else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    for verb, other in (("poly", "OUT.poly"), ("cdt", "OUT.vtu"), ("judge", "MESH.vtu"), ("solution", "OUT.vtu")):
        sub = verbs.add_parser(verb)
        sub.add_argument("given", type=Path)
        sub.add_argument("other", type=Path, metavar=other)
    title = verbs.add_parser("label")
    title.add_argument("given", type=Path)
    title.add_argument("counts", nargs=2)
    run = verbs.add_parser("run")
    run.add_argument("directory", help="folder with the instances and best_known.csv")
    run.add_argument("--start", choices=["outline", "cdt"], default="outline")
    run.add_argument("--limit", type=float, default=60, help="time limit of each run in seconds")
    run.add_argument("--temper", default=os.environ.get("TEMPER", "temper"), help="the program")
    run.add_argument("--jobs", type=int, default=1)
    run.add_argument("--only", default="", help="regular expression for names of instances")
    run.add_argument("--first", type=int, default=0, help="skip this number of instances")
    run.add_argument("--step", type=int, default=1, help="take every n-th instance")
    run.add_argument("--keep", help="folder for outlines and meshes")
    mine, options = sys.argv[1:], []
    if "--" in mine:
        at = mine.index("--")
        mine, options = mine[:at], mine[at + 1:]
    args = parser.parse_args(mine)
    if args.verb == "run":
        args.options = options
        return run_all(args)
    if args.verb == "solution":
        write_solution(args.given, args.other)
        return 0
    if args.verb == "label":
        label(args.given, *args.counts)
        return 0
    instance = read_instance(args.given)
    if args.verb == "judge":
        verdict = judge(instance, read_vtu(args.other))
        print("\n".join([*verdict.faults, f"{verdict.added} vertices added"]))
        return 1 if verdict.faults else 0
    (write_poly if args.verb == "poly" else write_cdt)(instance, args.other)
    return 0


if __name__ == "__main__":
    sys.exit(main())
