"""Solves −Δu = f with SciPy, by the exported stars, and compares with the exact solution.

Vertex-centered, by discrete exterior calculus: (d0ᵀ ★1 d0) u = ★0 f, u given on the boundary. Cell-centered, by
two-point fluxes between orthocenters: (d1 T d1ᵀ) u = ∫ f, where T = ℓ/(h_k + h_l) and on the boundary ℓ/h_k.
"""

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

import temper


def exact(p):
    return np.sin(2 * p[:, 0]) * np.cosh(p[:, 1])


def source(p):  # −Δ of it
    return 3 * exact(p)


def vertex_centered(mesh):
    """u at the vertices."""
    c = temper.dec_operators(mesh)
    points = np.asarray(mesh.points)
    boundary = np.unique(mesh.boundary_edges)
    inner = np.setdiff1d(np.arange(mesh.n_vertices), boundary)
    laplacian = c.laplacian()
    u = exact(points)  # right on the boundary; the rest is solved for
    right = (c.star0 * source(points))[inner] - laplacian[inner][:, boundary] @ u[boundary]
    u[inner] = spsolve(laplacian[inner][:, inner].tocsc(), right)
    return u


def cell_centered(mesh):
    """u at the orthocenters."""
    c = temper.dec_operators(mesh)
    d1, flux = c.d1.tocsr(), np.asarray(c.transmissibility)
    on_boundary = np.where(c.edges.is_boundary, exact(np.asarray(c.edges.midpoint)), 0)
    matrix = d1 @ sparse.diags(flux) @ d1.T
    # Of each boundary edge the value beyond it is given; its triangle sees it with the sign of the edge squared: 1.
    right = c.areas * source(np.asarray(c.orthocenters)) + abs(d1) @ (flux * on_boundary)
    return spsolve(matrix.tocsc(), right)


def relative(error, measure, values):
    return np.sqrt((measure * error**2).sum() / (measure * values**2).sum())


mesh = temper.generate.annulus(around=96, rings=12)
temper.optimize(mesh)
operators = temper.dec_operators(mesh)
assert (operators.star1 > 0).all() and (operators.transmissibility > 0).all()  # well-centered: both matrices are M-matrices

at_vertices = exact(np.asarray(mesh.points))
at_centers = exact(np.asarray(operators.orthocenters))
dec_error = relative(vertex_centered(mesh) - at_vertices, operators.star0, at_vertices)
flux_error = relative(cell_centered(mesh) - at_centers, operators.areas, at_centers)
print(f"relative L2 error: {dec_error:.2e} at the vertices, {flux_error:.2e} at the orthocenters")
assert dec_error < 3e-3 and flux_error < 5e-3
