# runs with: skfem; measures: relative L2 error of linear elements
"""A Poisson problem with a known solution, by linear elements of scikit-fem, on random points and on a ring."""

import numpy as np
from benchmark import draw, variants
from skfem import Basis, ElementTriP1, Functional, LinearForm, MeshTri, condense, solve
from skfem.models.poisson import laplace

import temper


def exact(x):
    return np.exp(0.5 * x[0]) * np.sin(x[1])


@LinearForm
def load(v, w):
    return 0.75 * exact(w.x) * v


@Functional
def squared_error(w):
    return (w.u - exact(w.x)) ** 2


@Functional
def squared(w):
    return exact(w.x) ** 2


def solved(mesh):
    """The error at each vertex, its relative norm, the entries of the wrong sign, and the condition number."""
    basis = Basis(MeshTri(np.array(mesh.points).T.copy(), np.array(mesh.triangles).T.copy()), ElementTriP1(), intorder=6)
    stiffness, edge = laplace.assemble(basis), basis.mesh.boundary_nodes()
    u = basis.zeros()
    u[edge] = exact(basis.mesh.p[:, edge])
    u = solve(*condense(stiffness, load.assemble(basis), x=u, D=edge))
    error = np.sqrt(squared_error.assemble(basis, u=basis.interpolate(u)) / squared.assemble(basis))
    entries = stiffness.tocoo()
    wrong = ((entries.row < entries.col) & (entries.data > 1e-12 * abs(entries.data).max())).sum()
    inner = basis.complement_dofs(edge)
    return abs(u - exact(basis.mesh.p)), error, wrong, np.linalg.cond(stiffness[inner][:, inner].toarray())


for name, start in (("ring", temper.generate.annulus()), ("room", temper.generate.random_mesh(400))):
    meshes = variants(start, "fem", keep="weights")
    weighted = start.copy()
    temper.optimize(weighted)
    found = {column: solved(mesh) for column, mesh in {**meshes, "weighted": weighted}.items()}
    for column, (_, error, wrong, condition) in found.items():
        print(f"{name}, {column:8} error {error:.2e}  entries of the wrong sign {wrong:2}  condition {condition:4.0f}")
results = {column: error for column, (_, error, _, _) in found.items()}
draw("scikit-fem.svg", *((meshes[column], found[column][0]) for column in ("before", "for")), "error of the solution")
