#!/usr/bin/env python3
"""Faults on faces of power cells: twenty random networks are meshed and judged.

    bench/faces.py TEMPER [--seed S] [--networks N] [--first K] [--size H] [--keep FOLDER] [--optimize]
    bench/faces.py TEMPER --examples upr [--mrst FOLDER]      those of MRST's module UPR, instead

Each network has 1 to 12 faults in a domain of 1000 by 600: kinked lines with tips inside, crossings down to 15 degrees,
junctions, ends on the boundary, a loop, wells, two regions. The judge takes points, weights and triangles from the mesh,
and the faults from the outline. Everything else it computes itself:

    pieces      pairs of vertices that the mesh has for faults: those whose dual is on a fault, and all
    length      length of faults on faces over their length, less 1
    negative    edges with a negative coefficient: a dual of negative length
    hidden      vertices without a power cell
    behind      faces that do not cross the line between the two vertices, but its extension. MODFLOW cannot take them
    least face  least over all faces on faults: length over the median length of the faces of its two cells
    seconds     time of temper mesh

--optimize: temper optimize runs on each mesh, and the judge looks at its result, too.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy as np

WIDTH, HEIGHT = 1000.0, 600.0
LEAST_ANGLE = np.radians(15)
CORNERS = np.array([[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]])


# --- networks ---------------------------------------------------------------------------------------------------------


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def segments_of(line):
    return list(zip(line[:-1], line[1:]))


def distance(p, a, b):
    along = b - a
    t = np.clip(np.dot(p - a, along) / np.dot(along, along), 0, 1)
    return np.linalg.norm(p - a - t * along)


def crossing(a, b, c, d):
    """The parts of both segments at their crossing, or None."""
    u, v = b - a, d - c
    det = cross(u, v)
    if abs(det) < 1e-9 * np.linalg.norm(u) * np.linalg.norm(v):
        return None
    s, t = cross(c - a, v) / det, cross(c - a, u) / det
    return (s, t) if 0 <= s <= 1 and 0 <= t <= 1 else None


def least_angle(u, v):
    """Angle between two lines without direction."""
    c = abs(np.dot(u, v)) / (np.linalg.norm(u) * np.linalg.norm(v))
    return np.arccos(min(1.0, c))


class Network:
    """Lines that become faces. Each new line keeps angles of 15 degrees and a distance of ends from all others."""

    def __init__(self, rng, size):
        self.rng, self.size = rng, size
        self.lines, self.loops, self.wells, self.rivers = [], [], [], []
        self.border, self.corners = None, CORNERS

    def all_lines(self):
        return self.lines + self.loops + ([self.border] if self.border is not None else [])

    def fits(self, line, joined=None):
        """`joined`: ends of the line on other lines or on the boundary, which may be near them."""
        near = 0.4 * self.size
        free = [p for i, p in enumerate(line) if not joined or i not in joined]
        for p in free:
            if not (near < p[0] < WIDTH - near and near < p[1] < HEIGHT - near):
                return False
        for a, b in segments_of(line):
            if np.linalg.norm(b - a) < 2 * self.size:
                return False
        is_closed = np.array_equal(line[0], line[-1])
        for i, (a, b) in enumerate(segments_of(line)):
            for c, d in segments_of(line)[i + 2 : len(line) - 2 if is_closed and i == 0 else None]:
                if crossing(a, b, c, d):
                    return False
        for other in self.all_lines():
            for c, d in segments_of(other):
                for p in free:
                    if distance(p, c, d) < near:
                        return False
                for a, b in segments_of(line):
                    if (hit := crossing(a, b, c, d)) and least_angle(b - a, d - c) < LEAST_ANGLE:
                        return False
                    touches = min(distance(c, a, b), distance(d, a, b))
                    if touches < near and not (hit and joined):
                        return False
                    if hit and not joined and min(hit[0], 1 - hit[0]) * np.linalg.norm(b - a) < near:
                        return False
        return True

    def random_line(self, start=None, heading=None):
        rng = self.rng
        p = start if start is not None else rng.uniform([60, 60], [WIDTH - 60, HEIGHT - 60])
        direction = rng.uniform(0, 2 * np.pi) if heading is None else heading
        line = [p]
        for _ in range(rng.integers(1, 4)):
            line.append(line[-1] + rng.uniform(90, 260) * np.array([np.cos(direction), np.sin(direction)]))
            direction += rng.uniform(-0.7, 0.7)
        return np.array(line)

    def add_line(self, joined=None, start=None, heading=None, tries=400):
        for _ in range(tries):
            line = self.random_line(start() if start else None, heading() if heading else None)
            if self.fits(line, joined):
                self.lines.append(line)
                return line
        return None

    def point_on(self, line):
        a, b = segments_of(line)[self.rng.integers(len(line) - 1)]
        return a + self.rng.uniform(0.3, 0.7) * (b - a)

    def add_junction(self):
        if not self.lines:
            return None
        line = self.lines[self.rng.integers(len(self.lines))]
        return self.add_line({0}, lambda: self.point_on(line))

    def add_from_boundary(self):
        def start():
            x = self.rng.uniform(80, WIDTH - 80)
            return np.array([x, 0.0 if self.rng.random() < 0.5 else HEIGHT])

        for _ in range(400):
            p = start()
            up = 1 if p[1] == 0 else -1
            line = self.random_line(p, up * self.rng.uniform(LEAST_ANGLE, np.pi - LEAST_ANGLE))
            if self.fits(line, {0}):
                self.lines.append(line)
                return line
        return None

    def add_crossing(self, angle):
        """A line through the middle of another one, at this angle."""
        for _ in range(400):
            line = self.lines[self.rng.integers(len(self.lines))]
            a, b = segments_of(line)[self.rng.integers(len(line) - 1)]
            p = a + self.rng.uniform(0.35, 0.65) * (b - a)
            heading = np.arctan2(*(b - a)[::-1]) + angle * self.rng.choice([-1, 1])
            u = np.array([np.cos(heading), np.sin(heading)])
            new = np.array([p - self.rng.uniform(60, 130) * u, p + self.rng.uniform(60, 130) * u])
            if self.fits(new):
                self.lines.append(new)
                return new
        return None

    def add_loop(self):
        for _ in range(400):
            center, radius = self.rng.uniform([150, 150], [WIDTH - 150, HEIGHT - 150]), self.rng.uniform(60, 110)
            n = self.rng.integers(5, 9)
            angles = 2 * np.pi * (np.arange(n) + self.rng.uniform(-0.2, 0.2, n)) / n
            ring = center + radius * np.c_[np.cos(angles), np.sin(angles)]
            ring = np.vstack([ring, ring[:1]])
            saved, self.lines = self.lines, []
            crosses = any(crossing(*s, *t) for s in segments_of(ring) for line in saved for t in segments_of(line))
            self.lines = saved
            if not crosses and self.fits(ring):
                self.loops.append(ring)
                return

    def add_border(self):
        x = self.rng.uniform(400, 600)
        self.border = np.array([[x, 0], [x + self.rng.uniform(-60, 60), 250], [x + self.rng.uniform(-60, 60), HEIGHT]])

    def add_well(self):
        for _ in range(400):
            p = self.rng.uniform([40, 40], [WIDTH - 40, HEIGHT - 40])
            apart = [distance(p, c, d) for line in self.all_lines() for c, d in segments_of(line)]
            apart += [np.linalg.norm(p - q) for q in self.wells]
            if min(apart, default=np.inf) > 0.6 * self.size:
                self.wells.append(p)
                return


def network(seed, number, size):
    rng = np.random.default_rng([seed, number])
    net = Network(rng, size)
    wanted = 1 + number % 12
    if number % 5 == 3:
        net.add_border()
    if number % 4 == 2:
        net.add_loop()
    net.add_line()
    kinds = ["crossing", "junction", "boundary", "free"]
    while len(net.lines) < wanted:
        kind = kinds[(number + len(net.lines)) % 4]
        before = len(net.lines)
        if kind == "crossing":
            net.add_crossing(np.radians([15, 25, 40, 60, 90][(number + len(net.lines)) % 5]))
        elif kind == "junction":
            net.add_junction()
        elif kind == "boundary":
            net.add_from_boundary()
        else:
            net.add_line()
        if len(net.lines) == before and not net.add_line():
            break
    for _ in range(number % 3):
        net.add_well()
    return net


def feature(kind, coordinates, **properties):
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": kind, "coordinates": np.asarray(coordinates).tolist()},
    }


def as_geojson(net):
    features = []
    if net.border is None:
        features.append(feature("Polygon", [np.vstack([net.corners, net.corners[:1]])], region=1))
    else:
        b = net.border
        left = np.vstack([[[0, 0]], b, [[0, HEIGHT]], [[0, 0]]])
        right = np.vstack([[[WIDTH, 0]], [[WIDTH, HEIGHT]], b[::-1], [[WIDTH, 0]]])
        features.append(feature("Polygon", [left], region=1, name="west", **{"as": "faces"}))
        features.append(feature("Polygon", [right], region=2, name="east"))
    for i, line in enumerate(net.lines + net.loops):
        features.append(feature("LineString", line, name=f"fault {i + 1}", **{"as": "faces"}))
    for i, river in enumerate(net.rivers):
        features.append(feature("LineString", river, name=f"river {i + 1}"))
    for i, well in enumerate(net.wells):
        features.append(feature("Point", well, name=f"well {i + 1}"))
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32632"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


# --- judge ------------------------------------------------------------------------------------------------------------


def read_vtu(path):
    """Points, weights, triangles, and the pairs of vertices of faces, of a VTU file in ASCII."""
    text = path.read_text()

    def array(name):
        found = re.search(r'<DataArray[^>]*Name="%s"[^>]*>(.*?)</DataArray>' % re.escape(name), text, re.S)
        return np.array(found[1].split(), dtype=float) if found else None

    points = re.search(r"<Points>.*?<DataArray[^>]*>(.*?)</DataArray>", text, re.S)[1]
    points = np.array(points.split(), dtype=float).reshape(-1, 3)[:, :2]
    weights = array("weight")
    types, offsets = array("types").astype(int), array("offsets").astype(int)
    corners = array("connectivity").astype(int)
    triangles = np.array([corners[o - 3 : o] for o, t in zip(offsets, types) if t == 5])
    is_pair = np.zeros(len(types), bool) if array("temper:face") is None else (array("temper:face") == 1) & (types == 3)
    pairs = np.sort(corners[np.add.outer(offsets[is_pair], [-2, -1])], axis=1)
    return points, np.zeros(len(points)) if weights is None else weights, triangles, pairs


def orthocenters(points, weights, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    p = (np.sum(u * u, 1) - weights[triangles[:, 1]] + weights[triangles[:, 0]]) / 2
    q = (np.sum(v * v, 1) - weights[triangles[:, 2]] + weights[triangles[:, 0]]) / 2
    det = cross(u, v)
    return a + np.c_[p * v[:, 1] - q * u[:, 1], q * u[:, 0] - p * v[:, 0]] / det[:, None]


class Duals:
    """Signed dual length of each edge, and its two ends. Boundary edges end at the foot on the edge."""

    def __init__(self, points, weights, triangles):
        centers = orthocenters(points, weights, triangles)
        a, b, c = (points[triangles[:, k]] for k in range(3))
        turned = cross(b - a, c - a) < 0
        ends = np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        left = (ends[:, 0] < ends[:, 1]) != np.tile(turned, 3)
        of_triangle = np.tile(np.arange(len(triangles)), 3)
        self.edges, edge = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True)
        edge = edge.ravel()
        along = points[self.edges[:, 1]] - points[self.edges[:, 0]]
        self.size = np.linalg.norm(along, axis=1)
        normal = np.c_[-along[:, 1], along[:, 0]] / self.size[:, None]
        height = np.sum((centers[of_triangle] - points[self.edges[edge, 0]]) * normal[edge], axis=1)
        self.length = np.bincount(edge, np.where(left, height, -height), len(self.edges))
        self.ends = np.full((len(self.edges), 2, 2), np.nan)
        order = np.argsort(edge, kind="stable")
        twins = np.flatnonzero(edge[order][:-1] == edge[order][1:])
        for k in (0, 1):
            self.ends[edge[order[twins]], k] = centers[of_triangle[order[twins + k]]]


def covered(intervals):
    total, end = 0.0, -np.inf
    for low, high in sorted(intervals):
        total += max(0.0, high - max(low, end))
        end = max(end, high)
    return total


def judge(points, weights, triangles, pairs, segments):
    duals = Duals(points, weights, triangles)
    near = 1e-9 * WIDTH
    whole = found = 0.0
    on_fault = np.zeros(len(duals.edges), dtype=bool)
    for a, b in segments:
        length = np.linalg.norm(b - a)
        u = (b - a) / length
        n = np.array([-u[1], u[0]])
        with np.errstate(invalid="ignore"):
            off = np.abs((duals.ends - a) @ n).max(1)
            along = (duals.ends - a) @ u
            good = (off < near) & (along.min(1) > -near) & (along.max(1) < length + near)
        good &= duals.length > near
        on_fault |= good
        found += covered([(s.min(), s.max()) for s in along[good]])
        whole += length
    faces_of = [[] for _ in points]
    is_face = duals.length > 1e-6 * duals.size
    for (i, j), length in zip(duals.edges[is_face], duals.length[is_face]):
        faces_of[i].append(length)
        faces_of[j].append(length)
    least = np.inf
    for e in np.flatnonzero(on_fault):
        i, j = duals.edges[e]
        least = min(least, duals.length[e] / np.median(faces_of[i] + faces_of[j]))
    tiny = 1e-9 * duals.size
    i, j = duals.edges.T
    is_behind = (duals.length > tiny) & (np.abs(weights[i] - weights[j]) > duals.size**2)
    pairs = {tuple(pair) for pair in pairs.tolist()}
    return {
        "pieces": (len(pairs & {tuple(edge) for edge in duals.edges[on_fault].tolist()}), len(pairs)),
        "length": found / whole - 1,
        "negative": int(np.sum(duals.length < -tiny)),
        "hidden": sum(1 for faces in faces_of if not faces),
        "behind": int(np.sum(is_behind)),
        "least face": least,
        "weights": float(np.abs(weights).max()),
    }


def without_doubles(segments):
    kept = []
    for a, b in segments:
        if not any(np.allclose(a, c) and np.allclose(b, d) for c, d in kept):
            kept.append((a, b))
    return kept


def run(*words):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True)


def row(name, net, path, seconds):
    mesh = read_vtu(path)
    segments = without_doubles([s for line in net.all_lines() for s in segments_of(line)])
    found = judge(*mesh, segments)
    on_faces, pieces = found["pieces"]
    good = (
        abs(found["length"]) < 1e-9
        and found["negative"] == found["hidden"] == found["behind"] == 0
        and on_faces == pieces
        and found["least face"] >= 0.1
    )
    print(
        f"{name:>22} {len(net.all_lines()):6} {len(mesh[0]):7} {on_faces:5} of {pieces:5} {found['length']:10.1e} {found['negative']:8} "
        f"{found['hidden']:6} {found['behind']:6} {found['least face']:10.3f} {seconds:7.1f}  {'' if good else 'BAD'}",
        flush=True,
    )
    return good


def random_networks(options):
    for number in range(options.first, options.networks):
        yield str(number), network(options.seed, number, options.size)


def examples_of_upr(options):
    import faces_upr

    for example in faces_upr.examples(options.mrst):
        net = Network(None, example.size)
        net.corners, net.lines, net.rivers = example.corners, example.lines, example.rivers
        yield example.name, net


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("temper")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--networks", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--size", type=float, default=30)
    parser.add_argument("--examples", choices=["upr"])
    parser.add_argument("--mrst", help="folder of MRST, for two more examples")
    parser.add_argument("--keep")
    parser.add_argument("--optimize", action="store_true")
    options = parser.parse_args()
    folder = pathlib.Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    print("               network  lines   cells         pieces     length negative hidden behind least face seconds")
    n_good = n = 0
    for name, net in examples_of_upr(options) if options.examples else random_networks(options):
        outline, mesh, again = (folder / f"{name}{suffix}" for suffix in (".geojson", ".vtu", "_again.vtu"))
        outline.write_text(json.dumps(as_geojson(net)))
        runs = [(name, mesh, ["mesh", outline, "-o", mesh, "--size", net.size, "--split-crossings", "--threads", 1])]
        if options.optimize:
            runs.append((f"{name} again", again, ["optimize", mesh, "-o", again]))
        n += 1
        good = True
        for title, path, words in runs:
            started = time.perf_counter()
            made = run(options.temper, *words, "--for", "vertex", "--encoding", "ascii")
            seconds = time.perf_counter() - started
            if made.returncode:
                print(f"{title:>22} {made.stderr.strip()}", flush=True)
                good = False
                break
            good &= row(title, net, path, seconds)
        n_good += good
    print(f"{n_good} of {n} are good")
    return int(n_good < n)


if __name__ == "__main__":
    sys.exit(main())
