#!/usr/bin/env python3
"""Measures meshes before and after a target: no measure of the target's client may become worse.

    bench/guard_table.py PROGRAM TARGET FILE ... [-- OPTION ...]

Prints a row for each file: what became worse, if anything, and the measures that the documentation has. Exits with 1 if
a measure is worse after. `temper check` measures most of them. For fort.14 files this script also measures the shortest
edge, the angles, the ratio of areas and the time step itself, on the sphere if the file has degrees. Time steps are
heights of triangles over the speed of a long wave in their mean depth. Public files are in the repositories
adcirc/adcirc-testsuite, Deltares/MeshKernel and thetisproject/thetis.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
import time

ROUNDING = 1e-6  # a projection to meters and back has fewer digits than a double
OWN_ROUNDING = 1e-3  # the maps of degrees change lengths and areas by this part
LEAST_DEPTH = 1.0  # on dry land waves need a speed, too
RADIUS = 6371e3

# Measures of `temper check`: +1 if larger is better.
SHAPES = {"min_angle_deg": 1, "max_angle_deg": -1, "max_smoothness": -1, "obtuse_triangles": -1}
FLOW = {"max_orthogonality": -1, "min_flow_link": 1, "small_flow_links": -1}
MPAS = {
    "min_cell_quality": 1, "min_grid_spacing": 1, "max_grid_spacing": -1, "min_triangle_quality": 1,
    "min_triangle_angle_quality": 1, "max_centroid_offset_over_size": -1,
}
COEFFICIENTS = {
    "inverted_triangles": -1, "non_regular_edges": -1, "negative_boundary_duals": -1, "orthocenters_outside": -1,
    "well_centered_fraction": 1, "max_transmissibility_over_median": -1,
}
MEASURES = {"fem": SHAPES, "adcirc": SHAPES, "dflowfm": SHAPES | FLOW, "mpas": SHAPES | MPAS}


def read_grid(path):
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


def measure_grid(path):
    """Shortest edge, angles, time step and ratio of areas of a fort.14 file: name to (value, sign)."""
    nodes, triangles = read_grid(path)
    degrees = has_degrees(nodes)
    places = {number: place(node, degrees) for number, node in nodes.items()}
    angle, largest, step, ratio, shortest, area_at = 180.0, 0.0, math.inf, 1.0, math.inf, {}
    for corners in triangles:
        a, b, c = sorted(math.dist(places[corners[k]], places[corners[k - 1]]) for k in range(3))
        # Kahan's form of Heron's formula
        area = math.sqrt(max(0.0, (c + (b + a)) * (a - (c - b)) * (a + (c - b)) * (c + (b - a)))) / 4
        angle = min(angle, math.degrees(math.asin(min(1.0, 2 * area / (b * c)))))
        largest = max(largest, math.degrees(math.acos(max(-1.0, (a * a + b * b - c * c) / (2 * a * b)))))
        shortest = min(shortest, a)
        depth = max(sum(nodes[corner][2] for corner in corners) / 3, LEAST_DEPTH)
        step = min(step, 2 * area / c / math.sqrt(9.81 * depth))
        for k in range(3):
            other = area_at.setdefault(frozenset((corners[k], corners[k - 1])), area)
            ratio = max(ratio, area / other, other / area)
    return {"least angle": (angle, 1), "largest angle": (largest, -1), "time step": (step, 1),
            "ratio of areas": (ratio, -1), "shortest edge": (shortest, 1)}


def measure(program, path, target, arguments):
    """Name to (value, sign, tolerance)."""
    report = json.loads(subprocess.run([program, "check", path, "--json", *arguments], capture_output=True, check=True).stdout)
    values = {}
    for key, sign in MEASURES.get(target, COEFFICIENTS).items():
        value = report.get(key)
        values[key] = (math.inf * -sign if value is None else value, sign, ROUNDING)
    if path.endswith(".14"):
        values |= {name: (*value, OWN_ROUNDING) for name, value in measure_grid(path).items()}
    return values, report


def projection_of(path):
    """Options that take degrees to meters."""
    if not path.endswith(".14"):
        return []
    nodes = read_grid(path)[0]
    if not has_degrees(nodes):
        return ["--projection", "none"]
    longitudes = [node[0] for node in nodes.values()]
    return ["--projection", "sphere" if max(longitudes) - min(longitudes) > 180 else "stereographic"]


def worse(before, after):
    found = []
    for name, (value, sign, tolerance) in before.items():
        now = after[name][0]
        if sign * (now - value) < -tolerance * abs(value) - (1e-6 if tolerance == ROUNDING else 0):
            found.append(f"{name} {value:.4g} → {now:.4g}")
    return found


def main(program, target, files, options):
    failures = 0
    print("| file | obtuse | least angle | time step | ratio of areas | shortest edge | orthogonality | seconds | worse |\n"
          "|-|-|-|-|-|-|-|-|-|")
    for path in files:
        arguments = projection_of(path)
        if "--projection" in options:
            arguments = []
        start = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out." + path.rsplit(".", 1)[1])
            run = subprocess.run([program, "optimize", path, "-o", out, "--for", target, "--quiet", *arguments, *options],
                                 capture_output=True, text=True)
            if run.returncode not in (0, 4):
                print(f"| {os.path.basename(path)} | exit code {run.returncode}: {run.stderr.strip()[:150]}", flush=True)
                continue
            seconds = time.monotonic() - start
            shown = [o for i, o in enumerate(options) if o in ("--flat", "--projection") or (i and options[i - 1] == "--projection")]
            before, old = measure(program, path, target, arguments + shown)
            after, new = measure(program, out, target, arguments + shown)
        found = worse(before, after)
        failures += bool(found)
        cells = [f"{old['obtuse_triangles']} → {new['obtuse_triangles']}"]
        cells += [f"{old['min_angle_deg']:.1f}° → {new['min_angle_deg']:.1f}°"]
        for name in ("time step", "ratio of areas", "shortest edge"):
            cells.append(f"{before[name][0]:.3g} → {after[name][0]:.3g}" if name in before else "")
        if not cells[3]:
            cells[3] = f"{old['max_smoothness']:.3g} → {new['max_smoothness']:.3g}"
        cells.append(f"{old['max_orthogonality']:.2g} → {new['max_orthogonality']:.2g}")
        print(f"| {os.path.basename(path)} | {' | '.join(cells)} | {seconds:.1f} | {'; '.join(found)} |", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    rest = sys.argv[3:]
    cut = rest.index("--") if "--" in rest else len(rest)
    sys.exit(main(sys.argv[1], sys.argv[2], rest[:cut], rest[cut + 1:]))
