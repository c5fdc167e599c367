"""Makes an ocean for MPAS from a coast and a raster of depths, without weights, and checks its edges.

    python3 mpas_ocean.py        needs the program temper, and SciPy; with uxarray it also validates the grid

The raster gives sizes: shallow water gets smaller cells. --for mpas makes no weights, because MPAS has no place for them.
"""

import importlib.util
import math
import pathlib
import subprocess
import sys

import numpy as np
from scipy.io import netcdf_file

COAST = pathlib.Path(__file__).parent.parent / "islands.geojson"

# An ESRI ASCII grid of depths in meters, from north to south.
rows = [[20 + 4000 * math.sin(math.radians(2 * lon)) ** 2 for lon in range(-178, 180, 4)] for lat in range(86, -88, -4)]
header = f"ncols 90\nnrows {len(rows)}\nxllcenter -178\nyllcenter -86\ncellsize 4\n"
pathlib.Path("depth.asc").write_text(header + "\n".join(" ".join(f"{x:.0f}" for x in row) for row in rows), encoding="utf-8")

command = ["mesh", "--sphere", "--coast", COAST, "--size", "depth.asc", "--from-depth"]
command += ["positive=down,per_wavelength=8,least=400000", "--for", "mpas", "-o", "ocean.mpas.nc", "--quiet"]
run = subprocess.run([sys.executable, "-m", "temper", *command], check=True, capture_output=True, text=True)
assert run.stdout + run.stderr == ""  # no warning

with netcdf_file("ocean.mpas.nc", mmap=False) as file:
    assert "weight" not in file.variables
    m = {name: variable.data.astype("i4" if variable.data.dtype.kind == "i" else "d") for name, variable in file.variables.items()}
    radius = file.sphere_radius


def places(kind):
    return np.stack([m[f"{axis}{kind}"] for axis in "xyz"], axis=1) / radius


# The corners of cells are the centers of triangles: inside, and at one distance from the three cells.
cells, corners, edges = places("Cell"), places("Vertex"), places("Edge")
triangles = cells[m["cellsOnVertex"] - 1]
sides = np.cross(triangles, np.roll(triangles, -1, axis=1))
assert (np.einsum("nij,nj->ni", sides, corners) > -1e-12).all()
assert np.ptp(np.linalg.norm(triangles - corners[:, None], axis=2), axis=1).max() < 1e-9

# Each edge crosses the line between its cells in the middle, at a right angle, and no length is zero or negative.
beside = cells[m["cellsOnEdge"] - 1]
middle = beside.sum(axis=1) / np.linalg.norm(beside.sum(axis=1), axis=1)[:, None]
inner = (m["verticesOnEdge"] > 0).all(axis=1)
ends = corners[m["verticesOnEdge"][inner] - 1]
slant = np.einsum("nj,nj->n", ends[:, 1] - ends[:, 0], (beside[:, 1] - beside[:, 0])[inner])
assert abs(middle - edges).max() < 1e-12 and abs(slant).max() < 1e-12
assert m["dcEdge"].min() > 0 and m["dvEdge"].min() > 0 and m["areaCell"].min() > 0 and m["kiteAreasOnVertex"].min() >= 0
assert math.isclose(m["areaCell"].sum(), m["areaTriangle"].sum(), rel_tol=1e-12)

# Edges are short where the water is shallow.
shallow = 20 + 4000 * np.sin(2 * m["lonEdge"]) ** 2 < 1000
lengths = [np.median(m["dcEdge"][inner & where]) / 1000 for where in (shallow, ~shallow)]
print(f"{len(cells)} cells, {m['cullCell'].sum()} of them at the coast, for MPAS-Tools' culler")
print(f"median of dcEdge: {lengths[0]:.0f} km where it is shallow, {lengths[1]:.0f} km elsewhere")
assert lengths[0] < 0.7 * lengths[1]

if importlib.util.find_spec("uxarray"):
    import uxarray

    grid = uxarray.open_grid("ocean.mpas.nc")
    assert (grid.n_face, grid.n_edge, grid.n_node) == (len(cells), len(edges), len(corners)) and grid.validate()
    assert np.allclose(grid.face_areas, m["areaCell"] / radius**2, rtol=1e-6)
    print(f"uxarray: the grid is valid; its areas add up to {float(grid.face_areas.sum()) / (4 * math.pi):.4f} of the sphere")
