# runs with: porepy; measures: relative L2 error of a pressure by Tpfa
"""The pressure around fractures by PorePy's two-point flux (Tpfa): with its own centers, and with temper's.

Gmsh meshes the network. The pressure in the fractures and on the boundary is known.
"""

from pathlib import Path

import numpy as np
import porepy
from benchmark import at_vertices, draw, variants
from porepy.fracs.meshing import subdomains_to_mdg
from porepy.fracs.simplex import triangle_grid_from_gmsh
from scipy.sparse.linalg import spsolve

import temper


def give_centers(grid, mesh):
    """Orthocenters and weighted midpoints for a grid of the mesh; returns the triangle of each cell."""
    dual, points = temper.dec_operators(mesh), np.array(mesh.points)
    number = {tuple(point): i for i, point in enumerate(points.tolist())}
    nodes = np.array([number[tuple(node)] for node in grid.nodes[:2].T.tolist()])
    edge = {tuple(ends): i for i, ends in enumerate(dual.edges.vertices.tolist())}
    triangle = {tuple(sorted(corners)): i for i, corners in enumerate(np.array(mesh.triangles).tolist())}
    faces = np.sort(nodes[grid.face_nodes.indices.reshape(-1, 2)], axis=1).tolist()
    cells = np.sort(nodes[grid.cell_nodes().tocsc().indices.reshape(-1, 3)], axis=1).tolist()
    order = [triangle[tuple(corners)] for corners in cells]
    grid.face_centers[:2] = dual.edges.midpoint[[edge[tuple(ends)] for ends in faces]].T
    grid.cell_centers[:2] = dual.orthocenters[order].T
    return order


def solved(grid):
    """The error in each cell, and its relative norm."""
    faces = grid.get_all_boundary_faces()
    conditions = porepy.BoundaryCondition(grid, faces, ["dir"] * len(faces))
    conditions.is_internal = np.zeros(grid.num_faces, dtype=bool)  # fractures, too
    permeability = porepy.SecondOrderTensor(np.ones(grid.num_cells))
    data = porepy.initialize_data({}, "flow", {"second_order_tensor": permeability, "bc": conditions})
    porepy.Tpfa("flow").discretize(grid, data)
    matrices = data[porepy.DISCRETIZATION_MATRICES]["flow"]
    known = [np.sin(2 * x) * np.exp(2 * y) for x, y in (grid.cell_centers[:2], grid.face_centers[:2])]
    given = np.zeros(grid.num_faces)
    given[faces] = known[1][faces]
    divergence = grid.cell_faces.T
    pressure = spsolve((divergence @ matrices["flux"]).tocsc(), -divergence @ (matrices["bound_flux"] @ given))
    error = abs(pressure - known[0])
    return error, np.sqrt((grid.cell_volumes * error**2).sum() / (grid.cell_volumes * known[0] ** 2).sum())


lines = [[[0.2, 0.8], [0.3, 0.6]], [[0.3, 0.6], [0.8, 0.2]]]
square = porepy.Domain({"xmin": 0, "xmax": 1, "ymin": 0, "ymax": 1})
network = porepy.create_fracture_network([porepy.LineFracture(np.array(line)) for line in lines], domain=square)
sizes = {"cell_size": 0.08, "cell_size_fracture": 0.05}
first = porepy.create_mdg("simplex", sizes, network, file_name=Path("network.msh"))
meshes, results, errors = variants(temper.read("network.msh"), "cell"), {}, {}
for name, mesh in meshes.items():
    temper.write(f"{name}.msh", mesh)
    mdg = subdomains_to_mdg(triangle_grid_from_gmsh(Path(f"{name}.msh")))
    assert [mdg.num_subdomains(), mdg.num_interfaces()] == [first.num_subdomains(), first.num_interfaces()]
    grid = mdg.subdomains(dim=2)[0]
    own = solved(grid)
    order = give_centers(grid, mesh)
    given = solved(grid)
    results[name] = (own if name == "before" else given)[1]
    errors[name] = mesh, at_vertices(mesh, (own if name == "before" else given)[0][np.argsort(order)])
    print(f"{name:8} PorePy's centers {own[1]:.2e}  temper's {given[1]:.2e}")
assert results["for"] < results["before"] / 10
draw("porepy.svg", errors["before"], errors["for"], "error of the pressure")
