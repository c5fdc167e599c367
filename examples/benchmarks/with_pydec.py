# runs with: pydec; measures: relative L2 error of a potential
"""Poisson's equation with a known solution, on PyDEC's complex: with its own stars, and with temper's."""

import numpy as np
import scipy.sparse as sparse
from benchmark import draw, variants
from pydec import simplicial_complex
from scipy.sparse.linalg import spsolve

import temper


def by_simplex(simplices, rows, values):
    place = {tuple(sorted(row)): i for i, row in enumerate(rows.tolist())}
    return np.array([values[place[tuple(sorted(simplex))]] for simplex in np.asarray(simplices).tolist()])


def complex_of(mesh):
    return simplicial_complex((np.array(mesh.points), np.array(mesh.triangles)))


def give_stars(complex, mesh):
    dual = temper.dec_operators(mesh)
    rows_of = np.arange(mesh.n_vertices)[:, None], dual.edges.vertices, mesh.triangles
    for level, (rows, star) in enumerate(zip(rows_of, (dual.star0, dual.star1, dual.star2))):
        diagonal = by_simplex(complex[level].simplices, rows, star)
        complex[level].star = sparse.diags(diagonal, format="csr")
        complex[level].star_inv = sparse.diags(1 / diagonal, format="csr")
    return complex


def solved(complex, mesh):
    """The error at each vertex, its relative norm, and the sum of ★0 over the area."""
    x, y = np.array(mesh.points).T
    known = np.exp(0.5 * x) * np.sin(y)
    laplacian = (complex[0].d.T @ complex[1].star @ complex[0].d).tocsr()
    areas = complex[0].star.diagonal()
    edge = np.unique(mesh.boundary_edges)
    inner = np.setdiff1d(np.arange(mesh.n_vertices), edge)
    right = (areas * 0.75 * known)[inner] - laplacian[inner][:, edge] @ known[edge]
    error = np.zeros(mesh.n_vertices)
    error[inner] = abs(spsolve(laplacian[inner][:, inner].tocsc(), right) - known[inner])
    right_areas = temper.dec_operators(mesh).star0
    return error, np.sqrt((right_areas * error**2).sum() / (right_areas * known**2).sum()), areas.sum() / right_areas.sum()


for name, start in (("ring", temper.generate.annulus()), ("room", temper.generate.random_mesh(1000))):
    meshes, results = variants(start, "vertex"), {}
    for column, mesh in meshes.items():
        own, given = solved(complex_of(mesh), mesh), solved(give_stars(complex_of(mesh), mesh), mesh)
        results[column] = (own if column == "before" else given)[1]
        print(f"{name}, {column:8} PyDEC's stars: error {own[1]:.2e}, ★0 {own[2]:.3f} of the area   "
              f"temper's: {given[1]:.2e}, {given[2]:.3f}")  # fmt: skip
before, after = meshes["before"], meshes["for"]
errors = solved(complex_of(before), before)[0], solved(give_stars(complex_of(after), after), after)[0]
draw("pydec.svg", (before, errors[0]), (after, errors[1]), "error of the potential")
