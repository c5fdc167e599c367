#!/usr/bin/env python3
"""Random networks of lines that become faces, as hard as outlines of users can be. Each run of the mesher must end with a mesh whose
faces are exact, or with an error that names a place and the next step.

    bench/faces_fuzz.py PROGRAM --networks 5000 --keep FOLDER

Lines nearly meet, overlap, repeat points, end on the boundary or on holes, cross at 2 to 15 degrees, and are nearer to each other than the
size. Wells lie on faces, rivers cross them or end on them. A mesh is good if the judge of faces.py finds the whole length of the
lines on faces, within 1e-9, no negative coefficient and no hidden site. Prints what failed, then a table of the endings.
"""

import argparse
import collections
import json
import pathlib
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile

import faces
import numpy as np

WIDTH, HEIGHT = faces.WIDTH, faces.HEIGHT
SIZES = [25.0, 40.0, 60.0, 90.0]
SECONDS = 100  # of processor time: a run that takes more hangs


def unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def ring(center, radius, n, rng):
    angles = 2 * np.pi * (np.arange(n) + rng.uniform(-0.3, 0.3, n)) / n
    points = center + radius * np.c_[np.cos(angles), np.sin(angles)]
    return np.vstack([points, points[:1]])


class Network:
    """Lines, each made by one of the kinds in KINDS, from those before."""

    def __init__(self, seed, number):
        self.rng = rng = np.random.default_rng([seed, number])
        self.size = float(rng.choice(SIZES))
        self.lines, self.rivers, self.wells, self.holes = [], [], [], []
        self.border = None
        if rng.random() < 0.2:
            x = rng.uniform(400, 600)
            self.border = np.array([[x, 0], [x + rng.uniform(-90, 90), rng.uniform(100, 500)], [x, HEIGHT]])
        if rng.random() < 0.25:
            center = np.array([rng.choice([170.0, 830.0]), rng.uniform(150, 450)])
            self.holes.append(ring(center, rng.uniform(15, 90), rng.integers(3, 9), rng))
        self.add_line(self.somewhere())
        for _ in range(rng.integers(0, 9)):
            getattr(self, "add_" + rng.choice(KINDS))()

    def somewhere(self):
        return self.rng.uniform([20, 20], [WIDTH - 20, HEIGHT - 20])

    def near(self, p):
        """A place that rounding, or a small distance, keeps from p."""
        return p + float(self.rng.choice([0, 1e-3, 1e-2, 0.1, 1, 5])) * unit(self.rng.uniform(0, 2 * np.pi))

    def some_line(self):
        all_lines = self.lines + ([self.border] if self.border is not None else [])
        return all_lines[self.rng.integers(len(all_lines))]

    def some_segment(self):
        line = self.some_line()
        i = self.rng.integers(len(line) - 1)
        return line[i], line[i + 1]

    def on_line(self):
        a, b = self.some_segment()
        return a + self.rng.uniform(0, 1) * (b - a)

    def add_line(self, start, heading=None, end=None):
        rng = self.rng
        heading = rng.uniform(0, 2 * np.pi) if heading is None else heading
        line = [start]
        for _ in range(rng.integers(1, 5)):
            line.append(line[-1] + rng.choice([8, 40, 120, 250]) * rng.uniform(0.5, 1.5) * unit(heading))
            heading += rng.uniform(-1, 1) if rng.random() < 0.9 else rng.uniform(-3, 3)
        if end is not None:
            line.append(end)
        self.lines.append(np.array(line))

    def add_free(self):
        self.add_line(self.somewhere())

    def add_near_miss(self):
        self.add_line(self.near(self.on_line()))

    def add_tip_to_tip(self):
        self.add_line(self.near(self.some_line()[0]))

    def add_overlap(self):
        a, b = self.some_segment()
        s, t = self.rng.uniform(-0.3, 0.6), self.rng.uniform(0.6, 1.3)
        self.lines.append(np.array([a + s * (b - a), a + t * (b - a)]))

    def add_repeated(self):
        line = self.lines[self.rng.integers(len(self.lines))]
        i = self.rng.integers(len(line))
        self.lines.append(np.insert(line, i, line[i], axis=0) if self.rng.random() < 0.5 else line[::-1].copy())

    def add_parallel(self):
        a, b = self.some_segment()
        u = (b - a) / max(np.linalg.norm(b - a), 1e-12)
        offset = float(self.rng.choice([1, 3, 10, 20])) * np.array([-u[1], u[0]])
        self.lines.append(np.array([a + offset, b + self.rng.uniform(0.5, 2) * offset]))

    def add_crossing(self):
        a, b = self.some_segment()
        u = (b - a) / max(np.linalg.norm(b - a), 1e-12)
        heading = np.arctan2(u[1], u[0]) + np.radians(self.rng.uniform(2, 30)) * self.rng.choice([-1, 1])
        p = self.on_line()
        self.lines.append(np.array([p - self.rng.uniform(20, 200) * unit(heading), p + self.rng.uniform(20, 200) * unit(heading)]))

    def add_junction(self):
        p = self.on_line() if self.rng.random() < 0.7 else self.somewhere()
        heading = self.rng.uniform(0, 2 * np.pi)
        for _ in range(self.rng.integers(1, 5)):
            self.lines.append(np.array([p, p + self.rng.uniform(20, 200) * unit(heading)]))
            heading += np.radians(self.rng.choice([3, 8, 15, 40, 90]) * self.rng.uniform(0.7, 1.5))

    def add_loop(self):
        self.lines.append(ring(self.somewhere(), self.rng.choice([5, 40, 120]), self.rng.integers(3, 12), self.rng))

    def add_bow(self):
        c = self.somewhere()
        self.lines.append(np.array([c, c + [90, 60], c + [90, -10], c + [0, 70], c]))

    def add_from_boundary(self):
        x = self.rng.uniform(0, WIDTH)
        start = np.array([x, self.rng.choice([0.0, HEIGHT, 1e-3, 0.5, 4])])
        self.add_line(start, self.rng.uniform(0.03, np.pi - 0.03) * (1 if start[1] < 300 else -1))

    def add_along_boundary(self):
        x, y = self.rng.uniform(50, WIDTH - 350), self.rng.choice([0, 0.5, 3, 10])
        self.lines.append(np.array([[x, y], [x + 300, y * self.rng.uniform(0.5, 2)]]))

    def add_through(self):
        self.lines.append(np.array([[self.rng.uniform(-50, WIDTH), -20], [self.rng.uniform(0, WIDTH), HEIGHT + 30]]))

    def add_at_hole(self):
        if self.holes:
            hole = self.holes[0]
            i = self.rng.integers(len(hole) - 1)
            self.add_line(hole[i] + self.rng.choice([0, 0.5, self.rng.random()]) * (hole[i + 1] - hole[i]))

    def add_well(self):
        at = self.on_line() if self.rng.random() < 0.5 else self.some_line()[-1]
        self.wells.append(self.near(at) if self.rng.random() < 0.7 else self.somewhere())

    def add_river(self):
        p, u = self.on_line(), unit(self.rng.uniform(0, 2 * np.pi))
        kind = self.rng.integers(4)
        a, b = p - self.rng.uniform(20, 150) * u, p + self.rng.uniform(20, 150) * u
        bend = p + self.rng.uniform(20, 150) * unit(self.rng.uniform(0, 2 * np.pi))
        self.rivers.append(np.array([[a, b], [a, p], [a, p, bend], [a, self.near(p)]][kind]))


KINDS = [name[4:] for name in vars(Network) if name.startswith("add_") and name != "add_line"]


def inside(net, p, margin=1e-7):
    """Says whether p is inside the domain, and not on its boundary."""
    if not (margin < p[0] < WIDTH - margin and margin < p[1] < HEIGHT - margin):
        return False
    for hole in net.holes:
        crossings = 0
        for a, b in faces.segments_of(hole):
            if faces.distance(p, a, b) < margin:
                return False
            if (a[1] > p[1]) != (b[1] > p[1]):
                crossings += p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        if crossings % 2:
            return False
    return True


def parts_inside(net, a, b):
    """The parts of a segment inside the domain."""
    corners = np.vstack([faces.CORNERS, faces.CORNERS[:1]])
    cuts = [0.0, 1.0]
    for c, d in [s for line in [corners, *net.holes] for s in faces.segments_of(line)]:
        det = faces.cross(b - a, d - c)
        if abs(det) > 1e-9 * np.linalg.norm(b - a) * np.linalg.norm(d - c):
            t, s = faces.cross(c - a, d - c) / det, faces.cross(c - a, b - a) / det
            if -1e-9 < t < 1 + 1e-9 and -1e-6 < s < 1 + 1e-6:
                cuts.append(min(1.0, max(0.0, float(t))))
    cuts.sort()
    return [
        (a + s * (b - a), a + t * (b - a))
        for s, t in zip(cuts, cuts[1:])
        if (t - s) * np.linalg.norm(b - a) > 1e-7 and inside(net, a + (s + t) / 2 * (b - a))
    ]


def expected_segments(net):
    lines = net.lines + ([net.border] if net.border is not None else [])
    whole = [(a, b) for line in lines for a, b in faces.segments_of(line) if np.linalg.norm(b - a) > 0]
    return [part for a, b in whole for part in parts_inside(net, a, b)]


def as_geojson(net):
    outer = np.vstack([faces.CORNERS, faces.CORNERS[:1]])
    features = []
    if net.border is None:
        features.append(faces.feature("Polygon", outer, region=1))
        features[-1]["geometry"]["coordinates"] = [outer.tolist()] + [h.tolist() for h in net.holes]
    else:
        b = net.border
        left = np.vstack([[[0, 0]], b, [[0, HEIGHT]], [[0, 0]]])
        right = np.vstack([[[WIDTH, 0]], [[WIDTH, HEIGHT]], b[::-1], [[WIDTH, 0]]])
        for name, region, polygon in (("west", 1, left), ("east", 2, right)):
            features.append(faces.feature("Polygon", polygon, region=region, name=name, **{"as": "faces"}))
            holes = [h.tolist() for h in net.holes if (h[0][0] < 500) == (region == 1)]
            features[-1]["geometry"]["coordinates"] = [polygon.tolist(), *holes]
    for i, line in enumerate(net.lines):
        features.append(faces.feature("LineString", line, name=f"fault {i + 1}", **{"as": "faces"}))
    for i, line in enumerate(net.rivers):
        features.append(faces.feature("LineString", line, name=f"river {i + 1}"))
    for i, well in enumerate(net.wells):
        features.append(faces.feature("Point", well, name=f"well {i + 1}"))
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32632"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


def judged(net, mesh):
    """What is wrong with a mesh, or nothing."""
    found = faces.judge(*faces.read_vtu(mesh), expected_segments(net))
    wrong = []
    if abs(found["length"]) > 1e-9:
        wrong.append(f"length off by {found['length']:.1e}")
    if found["negative"]:
        wrong.append("negative coefficients")
    if found["hidden"]:
        wrong.append("hidden sites")
    return " and ".join(wrong), found


def kind_of(message):
    """An error without its places, names and numbers."""
    text = message.strip().split("\n")[-1]
    text = re.sub(r"^.*?\.geojson(:[\d:]+)?:? ?", "", text)
    text = re.sub(r"'(fault|river|well) \d+'", r"'\1'", text)
    text = re.sub(r"(segment|point|feature|line|tag) \d+", r"\1 N", text)
    text = re.sub(r"\([-\d.e+]+, [-\d.e+]+\)", "(x, y)", text)
    return re.sub(r"\d[\d.e+-]*", "N", text)


def run_one(program, net, folder, number):
    """Returns the kind of ending, whether it is right, and the seconds."""
    outline, mesh = folder / f"{number}.geojson", folder / f"{number}.vtu"
    outline.write_text(json.dumps(as_geojson(net)))
    words = [program, "mesh", outline, "-o", mesh, "--size", net.size, "--for", "vertex", "--split-crossings", "--enclosed", "all",
             "--encoding", "ascii", "--threads", 1]  # fmt: skip
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    made = subprocess.run([str(w) for w in words], capture_output=True, text=True, preexec_fn=limit)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if made.returncode == -signal.SIGXCPU:
        return f"hangs: more than {SECONDS} s", False, seconds, None
    if made.returncode < 0 or made.returncode >= 100:
        return f"crash: exit code {made.returncode}", False, seconds, None
    if made.returncode:
        has_place = "(" in made.stderr and "Next:" in made.stderr
        return "error: " + kind_of(made.stderr), has_place, seconds, None
    wrong, found = judged(net, mesh)
    return "mesh: " + (wrong or "good"), not wrong, seconds, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("temper")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--networks", type=int, default=5000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", help="folder for the outlines of networks that fail")
    options = parser.parse_args()
    folder = pathlib.Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    endings, times, failed = collections.Counter(), [], 0
    signal.signal(signal.SIGINT, signal.default_int_handler)  # shells ignore it for jobs in the background
    try:
        for number in range(options.first, options.first + options.networks):
            net = Network(options.seed, number)
            ending, is_right, seconds, found = run_one(options.temper, net, folder, number)
            endings[ending] += 1
            times.append(seconds)
            if not is_right:
                failed += 1
                print(f"{number}: {ending} {found or ''} ({seconds:.1f} s)", flush=True)
            else:
                (folder / f"{number}.geojson").unlink()
            (folder / f"{number}.vtu").unlink(missing_ok=True)
    except KeyboardInterrupt:
        print("interrupted")
    median, largest = statistics.median(times or [0.0]), max(times, default=0.0)
    print(f"\n{len(times)} networks, {failed} failed; seconds of a processor: median {median:.2f}, largest {largest:.1f}")
    print("\n| ending | networks |\n|-|-|")
    for ending, count in endings.most_common():
        print(f"| {ending} | {count} |")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
