# runs with: xarray, uxarray, temper-netcdf; measures: relative L2 error of a divergence
"""The divergence of a velocity from its normal components at the edges, with the arrays of MPAS files that xarray reads."""

import numpy as np
import uxarray
import xarray
from benchmark import variants

import temper


def divergence_error(mesh, name):
    """The relative norm of the error, and the shortest dual edge over the median."""
    temper.write(f"{name}.mpas.nc", mesh)
    grid, file = uxarray.open_grid(f"{name}.mpas.nc"), xarray.open_dataset(f"{name}.mpas.nc")
    assert (grid.n_face, grid.n_edge, grid.n_node) == (file.sizes["nCells"], file.sizes["nEdges"], file.sizes["nVertices"])
    cells = file.cellsOnEdge.values - 1
    inner = (file.verticesOnEdge.values > 0).all(axis=1)  # edges of the boundary end at one corner
    x, y, angle = (file[key].values for key in ("xEdge", "yEdge", "angleEdge"))
    normal = np.sin(2 * x) * np.cos(angle) + np.cos(2 * y) * np.sin(angle)
    total = np.zeros(grid.n_face)
    np.add.at(total, cells[:, 0], normal * file.dvEdge.values)
    np.add.at(total, cells[:, 1], -normal * file.dvEdge.values)
    areas = file.areaCell.values
    known = 2 * np.cos(2 * file.xCell.values) - 2 * np.sin(2 * file.yCell.values)
    at = np.setdiff1d(np.arange(grid.n_face), cells[~inner])  # cells away from the boundary
    error = np.sqrt((areas * (total / areas - known) ** 2)[at].sum() / (areas * known**2)[at].sum())
    return error, file.dvEdge.values[inner].min() / np.median(file.dvEdge.values)


harbor = temper.read_outline("examples/harbour.poly").outline
# On a ring of nearly equal triangles errors of neighbors cancel, until vertices move.
for place, start in (("ring", temper.generate.annulus()), ("harbor", temper.mesh_outline(harbor, 0.4, optimize=False).mesh)):
    numbers = {name: divergence_error(mesh, name) for name, mesh in variants(start, "mpas", keep="weights").items()}
    for name, (error, shortest) in numbers.items():
        print(f"{place:6}  {name:8}  error of the divergence {error:.4f}  shortest dual edge over the median {shortest:.3f}")
results = {name: error for name, (error, _) in numbers.items()}
assert results["for"] < results["before"] / 1.5
