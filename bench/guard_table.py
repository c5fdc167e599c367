#!/usr/bin/env python3
"""Measures fort.14 files before and after a target: obtuse triangles, least angle, time step and ratio of areas.

    bench/guard_table.py PROGRAM TARGET FILE.14 ...

Time steps are heights of triangles over the speed of a long wave in their mean depth. Exits with 1 if one of the last
three measures is worse after, by more than a map of degrees can change it. Public files are in the repository
adcirc/adcirc-testsuite.
"""

import math
import os
import resource
import subprocess
import sys
import tempfile

TOLERANCE = 1e-3
ROUNDING = 1e-9
LEAST_DEPTH = 1.0  # on dry land waves need a speed, too
RADIUS = 6371e3


def read(path):
    with open(path) as file:
        file.readline()
        n_triangles, n_nodes = (int(word) for word in file.readline().split()[:2])
        nodes = {}
        for _ in range(n_nodes):
            number, *values = file.readline().split()
            nodes[number] = tuple(float(value) for value in values[:3])
        triangles = [file.readline().split()[2:5] for _ in range(n_triangles)]
    return nodes, triangles


def has_degrees(nodes):
    return all(abs(x) <= 360 and abs(y) <= 90 for x, y, _ in nodes.values())


def place(node, degrees):
    """In meters; degrees are on the sphere."""
    if not degrees:
        return node[0], node[1], 0.0
    longitude, latitude = math.radians(node[0]), math.radians(node[1])
    across = RADIUS * math.cos(latitude)
    return across * math.cos(longitude), across * math.sin(longitude), RADIUS * math.sin(latitude)


def measure(path):
    """Least angle, time step, ratio of areas, and the numbers of obtuse triangles and of nodes."""
    nodes, triangles = read(path)
    degrees = has_degrees(nodes)
    places = {number: place(node, degrees) for number, node in nodes.items()}
    angle, step, ratio, obtuse, area_at = 180.0, math.inf, 1.0, 0, {}
    for corners in triangles:
        a, b, c = sorted(math.dist(places[corners[k]], places[corners[k - 1]]) for k in range(3))
        # Kahan's form of Heron's formula
        area = math.sqrt(max(0.0, (c + (b + a)) * (a - (c - b)) * (a + (c - b)) * (c + (b - a)))) / 4
        angle = min(angle, math.degrees(math.asin(min(1.0, 2 * area / (b * c)))))
        obtuse += a * a + b * b < c * c * (1 - ROUNDING)
        depth = max(sum(nodes[corner][2] for corner in corners) / 3, LEAST_DEPTH)
        step = min(step, 2 * area / c / math.sqrt(9.81 * depth))
        for k in range(3):
            other = area_at.setdefault(frozenset((corners[k], corners[k - 1])), area)
            ratio = max(ratio, area / other, other / area)
    return angle, step, ratio, obtuse, len(nodes)


def projection_of(nodes):
    if not has_degrees(nodes):
        return "none"
    longitudes = [node[0] for node in nodes.values()]
    return "sphere" if max(longitudes) - min(longitudes) > 180 else "stereographic"


def main(program, target, files):
    worse = 0
    print("| grid | vertices | obtuse | least angle | time step | ratio of areas | CPU |\n|-|-|-|-|-|-|-|")
    for path in files:
        start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        projection = projection_of(read(path)[0])
        with tempfile.NamedTemporaryFile(suffix=".14") as out:
            run = [program, "optimize", path, "-o", out.name, "--for", target, "--projection", projection, "--quiet"]
            if subprocess.run(run).returncode not in (0, 4):
                worse += 1
                continue
            seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start
            before, after = measure(path), measure(out.name)
        is_worse = (
            after[0] < before[0] * (1 - TOLERANCE)
            or after[1] < before[1] * (1 - TOLERANCE)
            or after[2] > before[2] * (1 + TOLERANCE)
        )
        worse += is_worse
        print(
            f"| {os.path.basename(path)} | {before[4]} | {before[3]} → {after[3]} | {before[0]:.1f}° → {after[0]:.1f}° "
            f"| {before[1]:.3g} → {after[1]:.3g} s | {before[2]:.2f} → {after[2]:.2f} | {seconds:.1f} s |" + (" worse" if is_worse else ""),
            flush=True,
        )
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
