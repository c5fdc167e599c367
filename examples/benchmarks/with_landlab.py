# runs with: landlab; measures: relative L2 error of a height
"""Soil that creeps down a hill until the hill is half as high, by explicit steps on Landlab's grid.

The edge of the hill stays, and the height decays exponentially. The smallest ratio of cell to links bounds a step.
"""

import numpy as np
from benchmark import draw, variants
from landlab import VoronoiDelaunayGrid

import temper

SIDE = 1000.0


def creep(mesh):
    """The error at each point, its relative norm, the steps, and the cells with faces in another order than links."""
    grid = VoronoiDelaunayGrid(*np.array(mesh.points).T.copy())
    x, y = grid.x_of_node, grid.y_of_node
    edge = (x == 0) | (x == SIDE) | (y == 0) | (y == SIDE)
    grid.status_at_node[edge] = grid.BC_NODE_IS_FIXED_VALUE  # Landlab takes points along a side for inner ones
    core, links = grid.core_nodes, grid.active_links
    ratio = np.zeros(grid.number_of_links)  # width of the face over length of the link
    ratio[links] = grid.length_of_face[grid.face_at_link[links]] / grid.length_of_link[links]
    areas = grid.cell_area_at_node[core]
    outflow = ratio[grid.links_at_node[core]] * (grid.links_at_node[core] >= 0)
    fastest = (outflow.sum(axis=1) / areas).max()

    time = np.log(2) * SIDE**2 / (2 * np.pi**2)
    steps = int(np.ceil(time * fastest))
    height = np.sin(np.pi * x / SIDE) * np.sin(np.pi * y / SIDE)
    known = height / 2
    for _ in range(steps):
        fall = np.zeros(grid.number_of_links)
        fall[links] = grid.calc_diff_at_link(height)[links]
        inflow = outflow * fall[grid.links_at_node[core]] * grid.link_dirs_at_node[core]
        height[core] -= time / steps * inflow.sum(axis=1) / areas
    error = np.zeros(len(x))
    error[core] = abs(height - known)[core]
    by_link = grid.face_at_link[grid.links_at_node[core]]
    by_link[grid.links_at_node[core] < 0] = -1
    by_cell = grid.faces_at_cell[grid.cell_at_node[core]]
    mixed = (by_cell != by_link[:, : by_cell.shape[1]]).any(axis=1).sum()
    error_at = dict(zip(zip(x.round(6), y.round(6)), error))  # Landlab sorts the points
    at_points = np.array([error_at[tuple(place)] for place in np.array(mesh.points).round(6).tolist()])
    return at_points, np.sqrt((areas * error[core] ** 2).sum() / (areas * known[core] ** 2).sum()), steps, mixed


square = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
meshes = variants(temper.generate.random_mesh(300, polygon=square), "vertex", keep="weights")
hills = {name: creep(mesh) for name, mesh in meshes.items()}
for name, (_, error, steps, mixed) in hills.items():
    print(f"{name:8} {steps:4} steps  error {error:.2e}  {mixed:2} cells with faces in another order than links")
results = {name: error for name, (_, error, _, _) in hills.items()}
assert results["for"] < results["before"] / 2 and hills["for"][2] < hills["before"][2] / 3
draw("landlab.svg", *((meshes[name], hills[name][0]) for name in ("before", "for")), "error of the height")
