"""Takes a mesh from Gmsh to FiPy, gives two conductivities by the names of groups, and measures the error.

    python3 fipy_by_name.py        needs the program gmsh, and SciPy; with FiPy it also solves by FiPy

−div(K grad u) = f in sand and clay. The solution u is known: u and the flux are continuous across the slanted border.
"""

import importlib.util
import pathlib
import subprocess

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

import temper

CONDUCTIVITY = {"sand": 1.0, "clay": 0.05}
pathlib.Path("plate.geo").write_text("""
Point(1) = {0, 0, 0}; Point(2) = {0.8, 0, 0}; Point(3) = {2, 0, 0}; Point(4) = {2, 1, 0}; Point(5) = {1.2, 1, 0}; Point(6) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1}; Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2}; MeshSize {:} = 0.06;
Physical Surface("sand") = {1}; Physical Surface("clay") = {2}; Physical Curve("wall") = {1 : 6};
""", encoding="utf-8")  # fmt: skip
subprocess.run(["gmsh", "-2", "plate.geo", "-o", "plate.msh"], check=True, stdout=subprocess.DEVNULL)


def known(points, k):
    """u and f where the conductivity is k, from the places along and across the border."""
    along, across = ((points - [0.8, 0]) @ [[0.4, 1], [1, -0.4]] / np.hypot(0.4, 1)).T
    return np.cos(along) * (1 + np.sin(across) / k), np.cos(along) * (k + 2 * np.sin(across))


def relative(error, areas, u):
    return np.sqrt((areas * error**2).sum() / (areas * u**2).sum())


class Problem:
    """A mesh with its conductivities, and u at the orthocenters by two-point fluxes between them."""

    def __init__(self, mesh):
        names = {tag: name for name, (dimension, tag) in mesh.names.items() if dimension == 2}
        self.points = np.array(mesh.points)
        self.k = np.array([CONDUCTIVITY[names[tag]] for tag in mesh.regions.tolist()])
        self.dual = dual = temper.dec_operators(mesh, coefficient=self.k)
        self.on_wall = np.isin(range(len(dual.edges.length)), dual.edges.named["wall"])
        self.u_of_faces = known(dual.edges.midpoint, self.k[dual.edges.triangles.max(axis=1)])[0]
        around, flux = dual.d1.tocsr(), dual.transmissibility
        u, f = known(dual.orthocenters, self.k)
        right = dual.areas * f + abs(around) @ (flux * self.on_wall * self.u_of_faces)
        self.u = spsolve((around @ sparse.diags(flux) @ around.T).tocsc(), right)
        self.error = relative(self.u - u, dual.areas, u)


mesh = temper.read("plate.msh")
before = Problem(mesh)
temper.optimize(mesh, target="cell")
after = Problem(mesh)
print(f"two-point fluxes by SciPy: error {before.error:.2e} before, {after.error:.2e} after")
assert (after.dual.transmissibility > 0).all() and after.error < before.error / 4

if importlib.util.find_spec("fipy"):
    from fipy import CellVariable, DiffusionTerm, LinearLUSolver
    from fipy.meshes.mesh2D import Mesh2D

    class OrthogonalMesh(Mesh2D):
        """FiPy's mesh of triangles, with cells at orthocenters and faces at weighted midpoints (docs/howto/fipy.md)."""

        def _calcCellCenters(self):
            return after.dual.orthocenters.T.copy()

        def _calcFaceCenters(self):
            return after.dual.edges.midpoint.T.copy()

        def _calcCellVolumes(self):
            return after.dual.areas.copy()

    def solved(problem, kind):
        """u by FiPy, and its error."""
        grid = kind(problem.points.T, problem.dual.edges.vertices.T, problem.dual.d1.tocsr().indices.reshape(-1, 3).T)
        u, f = known(grid.cellCenters.value.T, problem.k)
        variable, k, source = (CellVariable(mesh=grid, value=value) for value in (0.0, problem.k, f))
        variable.constrain(problem.u_of_faces, where=problem.on_wall)
        (DiffusionTerm(k.harmonicFaceValue) + source).solve(variable, solver=LinearLUSolver())
        return variable.value, relative(variable.value - u, problem.dual.areas, u)

    own, (u, error) = solved(before, Mesh2D)[1], solved(after, OrthogonalMesh)
    print(f"FiPy: error {own:.2e} before, {error:.2e} after")
    assert np.allclose(u, after.u, rtol=1e-9, atol=0) and error < own / 10  # FiPy has the fluxes of dec_operators
