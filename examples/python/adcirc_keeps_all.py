"""Optimizes a fort.14 in degrees, and checks its depths and boundaries.

    python3 adcirc_keeps_all.py        needs the program temper, and Matplotlib; with adcircpy it also reads both files there

temper optimize works on a map in meters, and writes degrees again. Boundaries keep their type and their nodes,
and may gain nodes. Depths are interpolated.
"""

import importlib.util
import pathlib
import subprocess
import sys

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

BAY = pathlib.Path(__file__).parent.parent / "bay.14"


def read(file):
    """Nodes (x, y, depth), triangles, and boundaries: type and nodes, open ones without a type. Nodes count from 0."""
    lines = pathlib.Path(file).read_text(encoding="utf-8").splitlines()[1:]
    count = [int(word) for word in lines.pop(0).split()[:2]]
    nodes = np.array([[float(word) for word in lines.pop(0).split()[1:4]] for _ in range(count[1])])
    triangles = np.array([[int(word) - 1 for word in lines.pop(0).split()[2:5]] for _ in range(count[0])])
    boundaries = []
    for kinds in (False, True):
        strings, _ = int(lines.pop(0).split()[0]), lines.pop(0)
        for _ in range(strings):
            length, kind = lines.pop(0).split()[:2]
            boundaries.append((kind if kinds else None, [int(lines.pop(0).split()[0]) - 1 for _ in range(int(length))]))
    return nodes, triangles, boundaries


def least_and_largest_angle(nodes, triangles):
    """In degrees, where a degree of longitude is as short as in the middle of the triangle."""
    corners = nodes[triangles, :2].copy()
    corners[..., 0] *= np.cos(np.radians(corners[..., 1].mean(axis=1)))[:, None]
    to, back = (np.roll(corners, k, axis=1) - corners for k in (-1, 1))
    angles = np.degrees(np.arccos((to * back).sum(axis=2) / np.linalg.norm(to, axis=2) / np.linalg.norm(back, axis=2)))
    return angles.min(), angles.max()


command = ["optimize", BAY, "-o", "better.14", "--for", "adcirc", "--projection", "stereographic", "--quiet"]
subprocess.run([sys.executable, "-m", "temper", *command], check=True)
before, after = read(BAY), read("better.14")
angles = [least_and_largest_angle(*grid[:2]) for grid in (before, after)]
for when, (least, largest) in zip(("before", "after"), angles):
    print(f"{when:6}  angles from {least:.1f}° to {largest:.1f}°")
assert angles[1][0] > angles[0][0] and angles[1][1] < 91 < angles[0][1]

# Each boundary keeps its type, and its old nodes in their order. The run may add nodes between them.
for (kind, old), (same, new) in zip(before[2], after[2], strict=True):
    places = iter(after[0][new, :2].tolist())
    assert kind == same and all(place in places for place in before[0][old, :2].tolist()), kind
    print(f"boundary of type {kind or 'open'}: {len(old)} nodes before, {len(new)} after")

# Depths are interpolated on the old triangles. On the map their edges are curves, which differ by millimeters.
depth = LinearTriInterpolator(Triangulation(*before[0].T[:2], before[1]), before[0][:, 2])(*after[0].T[:2])
difference = abs(depth - after[0][:, 2]).max()
print(f"depth: at most {difference:.2g} m from the old one")
assert difference < 0.01

if importlib.util.find_spec("adcircpy"):
    from adcircpy import AdcircMesh

    for file, (nodes, triangles, boundaries) in ((BAY, before), ("better.14", after)):
        mesh = AdcircMesh.open(file, crs="EPSG:4326")
        theirs = np.column_stack([mesh.coords, -np.ravel(mesh.values)])  # adcircpy has heights, up
        assert np.allclose(theirs, nodes, rtol=1e-15, atol=0)
        assert np.array_equal(mesh.triangulation.triangles, triangles)
        strings = [(kind, [int(i) - 1 for i in one["node_id"]]) for kind, some in mesh.boundaries.to_dict().items() for one in some]
        assert strings == boundaries
    print("adcircpy: reads the same nodes, depths, triangles and boundaries")
