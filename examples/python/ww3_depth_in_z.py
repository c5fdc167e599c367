"""Optimizes a mesh of WAVEWATCH III with depths in z, and checks depths and the open boundary.

    python3 ww3_depth_in_z.py        needs the program temper, and Matplotlib; with meshio it also reads the file there

WAVEWATCH III reads Gmsh's format 2: nodes in degrees with the depth as z, open boundary nodes as points, and triangles.
temper optimize --flat takes z as data. The mesh has no weights, so the file has no other section,
which the model would not read.
"""

import importlib.util
import pathlib
import subprocess
import sys

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

BAY = pathlib.Path(__file__).parent.parent / "bay.14"


def read_as_the_model(file):
    """Nodes, triangles and boundary nodes by the rules of READMSH. Nodes count from 0."""
    rows = [line.split() for line in pathlib.Path(file).read_text(encoding="utf-8").splitlines() if not line.startswith("$")]
    assert rows.pop(0) == ["2", "0", "8"]  # the model reads whole numbers, and stops at 2.2
    nodes = np.array([[float(word) for word in rows.pop(0)[1:4]] for _ in range(int(rows.pop(0)[0]))])
    elements = [[int(word) for word in rows.pop(0)] for _ in range(int(rows.pop(0)[0]))]
    assert not rows  # nothing behind
    corners = {kind: [element[3 + element[2] :] for element in elements if element[1] == kind] for kind in (15, 2)}
    assert sum(map(len, corners.values())) == len(elements)
    return nodes, np.array(corners[2]) - 1, np.ravel(corners[15]) - 1


def temper(*arguments):
    subprocess.run([sys.executable, "-m", "temper", *map(str, arguments), "--quiet"], check=True)


# A mesh of the model from a fort.14: the nodes and triangles, and the nodes of the first open boundary.
lines = BAY.read_text(encoding="utf-8").splitlines()
m, n = map(int, lines[1].split()[:2])
length = int(lines[4 + n + m].split()[0])
boundary = [int(line) for line in lines[5 + n + m : 5 + n + m + length]]
triangles = [line.split()[2:] for line in lines[2 + n : 2 + n + m]]
elements = [f"15 2 0 0 {i}" for i in boundary] + [f"2 3 0 {k} 0 {' '.join(t)}" for k, t in enumerate(triangles, 1)]
text = ["$MeshFormat", "2 0 8", "$EndMeshFormat", "$Nodes", str(n), *lines[2 : 2 + n], "$EndNodes"]
text += ["$Elements", str(len(elements)), *(f"{k} {e}" for k, e in enumerate(elements, 1)), "$EndElements", ""]
pathlib.Path("sea.msh").write_text("\n".join(text), encoding="utf-8")

temper("optimize", "sea.msh", "-o", "better.msh", "--format", "gmsh22", "--flat", "--projection", "stereographic", "--for", "adcirc")
before, after = read_as_the_model("sea.msh"), read_as_the_model("better.msh")

# Boundary nodes keep their places and order. Depths are linear on the old triangles of the map, which differ a little in degrees.
assert np.array_equal(before[0][before[2]], after[0][after[2]])
depth = LinearTriInterpolator(Triangulation(*before[0].T[:2], before[1]), before[0][:, 2])(*after[0].T[:2])
difference = abs(depth - after[0][:, 2]).max()
print(f"{len(after[0])} nodes, {len(after[2])} of them open boundary; depth at most {difference:.2g} m from the old one")
assert difference < 0.01
corners = after[0][after[1], :2]
u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
assert (u[:, 0] * v[:, 1] > u[:, 1] * v[:, 0]).all()  # counter-clockwise, as the model needs them

if importlib.util.find_spec("meshio"):
    import meshio

    mesh = meshio.read("better.msh", "gmsh")
    kinds = {block.type: block.data for block in mesh.cells}
    assert np.array_equal(mesh.points, after[0]) and np.array_equal(kinds["triangle"], after[1])
    assert np.array_equal(np.ravel(kinds["vertex"]), after[2]) and not mesh.point_data
    print("meshio: reads the same nodes, depths, triangles and boundary nodes")
