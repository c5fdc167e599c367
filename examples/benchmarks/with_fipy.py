# runs with: fipy; measures: relative L2 error of a temperature
"""Heat in a room, by FiPy's diffusion term: with its own cell centers, and with temper's orthocenters.

The walls have the temperatures of a known harmonic function.
"""

import numpy as np
from benchmark import at_vertices, draw, variants
from fipy import CellVariable, DiffusionTerm
from fipy.meshes.mesh2D import Mesh2D

import temper


def faces_and_cells(dual):
    return dual.edges.vertices.T, dual.d1.tocsr().indices.reshape(-1, 3).T


class OrthogonalMesh(Mesh2D):
    """FiPy's mesh of triangles, with cells at orthocenters and faces at weighted midpoints."""

    def __init__(self, mesh):
        self.dual = temper.dec_operators(mesh)
        super().__init__(np.array(mesh.points).T, *faces_and_cells(self.dual))

    def _calcCellCenters(self):
        return self.dual.orthocenters.T.copy()

    def _calcFaceCenters(self):
        return self.dual.edges.midpoint.T.copy()

    def _calcCellVolumes(self):
        return self.dual.areas.copy()


def own(mesh):
    return Mesh2D(np.array(mesh.points).T, *faces_and_cells(temper.dec_operators(mesh)))


def solved(grid):
    """The error in each cell, and its relative norm."""

    def exact(x, y):
        return np.exp(x) * np.sin(y)

    temperature = CellVariable(mesh=grid)
    temperature.constrain(exact(*grid.faceCenters.value), where=grid.exteriorFaces)
    DiffusionTerm().solve(var=temperature)
    known, areas = exact(*grid.cellCenters.value), grid.cellVolumes
    error = abs(temperature.value - known)
    return error, np.sqrt((areas * error**2).sum() / (areas * known**2).sum())


for name, start in (("ring", temper.generate.annulus()), ("room", temper.generate.random_mesh(1000))):
    meshes = variants(start, "cell")
    for centers, grid_of in (("centroids", own), ("orthocenters", OrthogonalMesh)):
        numbers = {column: solved(grid_of(mesh))[1] for column, mesh in meshes.items()}
        print(f"{name}, {centers:12}", *(f"  {column} {number:.2e}" for column, number in numbers.items()))
results = {**numbers, "before": solved(own(start))[1]}
assert results["for"] < results["default"] < results["energy"] < results["before"] / 10
errors = [(meshes[column], at_vertices(meshes[column], solved(grid)[0]))
          for column, grid in (("before", own(meshes["before"])), ("for", OrthogonalMesh(meshes["for"])))]  # fmt: skip
draw("fipy.png", *errors, "error of the temperature")
