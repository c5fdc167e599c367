"""PyDEC's simplicial complex with temper's stars; the same problem with SciPy alone.

PyDEC numbers and orients simplices its own way, and its own dual is the circumcentric one without weights. So temper's
values are carried over by the simplices' vertices: edge by edge, with the sign of its orientation where it matters (a
diagonal star has none), and then a complex of PyDEC's is given the Hodge stars.

Without PyDEC the same numbers are computed with temper's d0 and stars alone; with it, both are compared.
"""

import importlib.util

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

import temper

mesh = temper.generate.annulus()
temper.optimize(mesh)
operators = temper.dec_operators(mesh)


def lowest_modes(d0, star0, star1, count=5):
    """The lowest eigenvalues of −Δ with natural conditions: d0ᵀ ★1 d0 u = λ ★0 u. The first is 0: constants."""
    stiffness = (d0.T @ star1 @ d0).tocsc()
    return np.sort(eigsh(stiffness, count, M=star0.tocsc(), sigma=-1e-3, return_eigenvectors=False))


def by_simplex(simplices, rows, values):
    """The values of `rows` of vertices in the order of `simplices`."""
    place = {tuple(sorted(row)): i for i, row in enumerate(np.asarray(rows).tolist())}
    return np.array([values[place[tuple(sorted(s))]] for s in np.asarray(simplices).tolist()])


def give_stars(complex):
    """Sets ★0, ★1, ★2 of a pydec.simplicial_complex of the same mesh to temper's; returns it."""
    vertices = np.arange(mesh.n_vertices)[:, None]
    rows_of = (vertices, operators.edges.vertices, mesh.triangles)
    for level, (rows, star) in enumerate(zip(rows_of, (operators.star0, operators.star1, operators.star2))):
        diagonal = by_simplex(complex[level].simplices, rows, star)
        complex[level].star = sparse.diags(diagonal, format="csr")
        complex[level].star_inv = sparse.diags(1 / diagonal, format="csr")
    return complex


ours = lowest_modes(operators.d0.tocsr(), operators.star(0), operators.star(1))
print("lowest modes of the annulus:", np.round(ours, 4))
assert abs(ours[0]) < 1e-9 and (np.diff(ours) > -1e-9).all()
assert abs(ours[1] - ours[2]) < 0.02 * ours[1]  # cos φ and sin φ: a pair

if importlib.util.find_spec("pydec") is not None:
    from pydec import simplicial_complex

    complex = give_stars(simplicial_complex((np.array(mesh.points), np.array(mesh.triangles))))
    theirs = lowest_modes(complex[0].d, complex[0].star, complex[1].star)
    print("the same, by PyDEC's complex:", np.round(theirs, 4))
    assert np.allclose(ours, theirs)
else:
    print("PyDEC is not installed: its complex was not tried")
