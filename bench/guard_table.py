#!/usr/bin/env python3
"""What a target does to fort.14 files: least angle, time step and ratio of areas, before and after.

    bench/guard_table.py PROGRAM TARGET FILE.14 ...

Time steps are heights of triangles over the speed of a long wave, from the depths of the files. Exits with 1 if one of
the three measures is worse after, by more than a map of degrees can change it. Public files are in the repository
adcirc/adcirc-testsuite.
"""

import math
import subprocess
import sys
import tempfile

TOLERANCE = 1e-3
LEAST_DEPTH = 1.0  # on dry land waves need a speed, too


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


def measure(path):
    """Least angle, time step, ratio of areas, and the number of obtuse triangles."""
    nodes, triangles = read(path)
    radius = 6371e3 * math.pi / 180 if has_degrees(nodes) else 1
    angle, step, ratio, obtuse, area_at = 180.0, math.inf, 1.0, 0, {}
    for corners in triangles:
        p = [nodes[c] for c in corners]
        shrink = math.cos(math.radians(sum(q[1] for q in p) / 3)) if radius != 1 else 1
        x = [(radius * shrink * q[0], radius * q[1]) for q in p]
        sides = [math.dist(x[k], x[(k + 1) % 3]) for k in range(3)]
        area = abs((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1])) / 2
        a, b, c = sorted(sides)
        angle = min(angle, math.degrees(math.asin(min(1.0, 2 * area / (b * c)))))
        obtuse += a * a + b * b < c * c
        depth = max(sum(q[2] for q in p) / 3, LEAST_DEPTH)
        step = min(step, 2 * area / c / math.sqrt(9.81 * depth))
        for k in range(3):
            edge = frozenset((corners[k], corners[(k + 1) % 3]))
            other = area_at.setdefault(edge, area)
            ratio = max(ratio, area / other, other / area)
    return angle, step, ratio, obtuse


def main(program, target, files):
    worse = 0
    print("| grid | obtuse | least angle | time step | ratio of areas |\n|-|-|-|-|-|")
    for path in files:
        projection = "stereographic" if has_degrees(read(path)[0]) else "none"
        with tempfile.NamedTemporaryFile(suffix=".14") as out:
            run = [program, "optimize", path, "-o", out.name, "--for", target, "--projection", projection, "--quiet"]
            if subprocess.run(run).returncode not in (0, 4):
                continue
            before, after = measure(path), measure(out.name)
        is_worse = (
            after[0] < before[0] * (1 - TOLERANCE)
            or after[1] < before[1] * (1 - TOLERANCE)
            or after[2] > before[2] * (1 + TOLERANCE)
        )
        worse += is_worse
        print(
            f"| {path} | {before[3]} → {after[3]} | {before[0]:.1f}° → {after[0]:.1f}° "
            f"| {before[1]:.3g} → {after[1]:.3g} s | {before[2]:.2f} → {after[2]:.2f} |" + (" worse" if is_worse else ""),
            flush=True,
        )
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
