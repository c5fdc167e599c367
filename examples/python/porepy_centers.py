"""Cell and face centers of PorePy's grid, for its two-point flux approximation; the same problem with SciPy alone.

PorePy's Tpfa takes the vector from cell center to face center, and projects it on the face normal. On simplex grids it
puts cell centers at centroids and face centers at midpoints: not orthogonal, so the scheme does not converge. With
cells at temper's orthocenters and faces at its weighted midpoints every such vector is normal to its face, and as long
as the h of that side: half transmissibilities are ℓ/h, and their harmonic sum is temper's flux.

Without PorePy the arrays are made and checked, and the pressure is computed with SciPy.
"""

import importlib.util

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

import temper

mesh = temper.generate.annulus()
temper.optimize(mesh)
operators = temper.dec_operators(mesh)
edges = operators.edges


def centers_for_porepy():
    """cell_centers (3, cells) and face_centers (3, faces); faces in temper's order of edges."""
    cells = np.vstack([operators.orthocenters.T, np.zeros(mesh.n_triangles)])
    faces = np.vstack([edges.midpoint.T, np.zeros(len(edges))])
    return cells, faces


cells, faces = centers_for_porepy()
along = np.asarray(mesh.points)[edges.vertices[:, 1]] - np.asarray(mesh.points)[edges.vertices[:, 0]]
half = np.zeros((2, len(edges)))
for side in range(2):
    there = edges.triangles[:, side] >= 0
    vector = (faces[:2, there] - cells[:2, edges.triangles[there, side]]).T
    assert np.abs((vector * along[there]).sum(1)).max() < 1e-12 * np.abs(along).max()  # orthogonal to the face
    half[side, there] = edges.length[there] / np.linalg.norm(vector, axis=1)
inner = ~edges.is_boundary
harmonic = 1 / (1 / half[0, inner] + 1 / half[1, inner])
assert np.allclose(harmonic, operators.transmissibility[inner], rtol=1e-10)  # what Tpfa computes is temper's flux

# A linear pressure is exact.
pressure_at = lambda p: 3 * p[0] - 2 * p[1]  # noqa: E731: a formula
d1 = operators.d1.tocsr()
given = np.where(edges.is_boundary, pressure_at(faces), 0)
pressure = spsolve((d1 @ sparse.diags(operators.transmissibility) @ d1.T).tocsc(), abs(d1) @ (operators.transmissibility * given))
error = np.abs(pressure - pressure_at(cells)).max()
print(f"linear pressure by two-point fluxes: largest error {error:.1e}")
assert error < 1e-11

if importlib.util.find_spec("porepy") is not None:
    import porepy

    grid = porepy.TriangleGrid(np.array(mesh.points).T, np.array(mesh.triangles).T)
    grid.compute_geometry()
    order = {tuple(pair): i for i, pair in enumerate(edges.vertices.tolist())}
    ends = grid.face_nodes.indices.reshape(-1, 2)
    grid.cell_centers = cells
    grid.face_centers = faces[:, [order[tuple(sorted(pair))] for pair in ends.tolist()]]
    print("PorePy's grid has temper's centers:", grid.num_cells, "cells")
else:
    print("PorePy is not installed: its grid was not tried")
