# runs with: tdgl; measures: relative L2 error of a potential
"""Poisson's equation with a known solution, by the Laplacian with which pyTDGL computes the electric potential."""

import numpy as np
from benchmark import draw, variants
from scipy.sparse.linalg import spsolve
from tdgl.finite_volume import Mesh
from tdgl.finite_volume.operators import build_laplacian

import temper


def solved(mesh):
    """The error at each vertex, its relative norm, and the area of the cells over the area of the film."""
    x, y = points = np.array(mesh.points).T
    film = Mesh.from_triangulation(points.T, np.array(mesh.triangles))
    laplacian = build_laplacian(film)[0].tocsr()
    known = np.sin(2 * x) * np.sin(2 * y)
    edge, areas = film.boundary_indices, film.areas
    inner = np.setdiff1d(np.arange(len(x)), edge)
    right = -8 * known[inner] - laplacian[inner][:, edge] @ known[edge]
    error = np.zeros(len(x))
    error[inner] = abs(spsolve(laplacian[inner][:, inner].tocsc(), right).real - known[inner])
    return error, np.sqrt((areas * error**2).sum() / (areas * known**2).sum()), areas.sum() / temper.dec_operators(mesh).areas.sum()


for name, start in (("ring", temper.generate.annulus()), ("film", temper.generate.random_mesh(400))):
    meshes = variants(start, "vertex", keep="weights")
    found = {column: solved(mesh) for column, mesh in meshes.items()}
    for column, (_, error, area) in found.items():
        print(f"{name}, {column:8} error {error:.2e}  cells over film {area:.6f}")
results = {column: error for column, (_, error, _) in found.items()}
assert results["for"] < results["before"]
draw("tdgl.svg", *((meshes[column], found[column][0]) for column in ("before", "for")), "error of the potential")
