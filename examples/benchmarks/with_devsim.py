# runs with: devsim; measures: relative L2 error of a potential
"""A charged layer between two grounded contacts, by DEVSIM: −V″ = 1, so V = x (2 − x)/2.

With DEVSIM's own couples and volumes, with them on a mesh whose positions alone were optimized, and with temper's.
"""

import devsim
import numpy as np
from benchmark import draw, variants

import temper


def device_of(mesh, name):
    """A device whose boundary edges on the left and on the right are contacts."""
    points, ends = np.array(mesh.points), np.array(mesh.boundary_edges)
    elements = [n for triangle in np.array(mesh.triangles).tolist() for n in (2, 0, *triangle)]
    for contact, x in ((1, 0.0), (2, 2.0)):
        there = ends[(points[ends, 0] == x).all(axis=1)]
        elements += [n for edge in there.tolist() for n in (1, contact, *edge)]
    flat = np.column_stack([points, np.zeros(len(points))]).ravel().tolist()
    names = ["oxide", "left", "right"]
    devsim.create_gmsh_mesh(mesh=name, coordinates=flat, elements=elements, physical_names=names)
    devsim.add_gmsh_region(mesh=name, gmsh_name="oxide", region="oxide", material="Oxide")
    for contact in names[1:]:
        devsim.add_gmsh_contact(mesh=name, gmsh_name=contact, region="oxide", name=contact, material="metal")
    devsim.finalize_mesh(mesh=name)
    devsim.create_device(mesh=name, device=name)
    return {"device": name, "region": "oxide"}


def give_dual(at, mesh):
    """temper's couples and volumes instead of DEVSIM's."""
    dual = temper.dec_operators(mesh)
    devsim.edge_from_node_model(**at, node_model="node_index")
    ends = [devsim.get_edge_model_values(**at, name=f"node_index@n{k}") for k in (0, 1)]
    number = {tuple(edge): i for i, edge in enumerate(dual.edges.vertices.tolist())}
    order = [number[tuple(sorted(edge))] for edge in np.array(ends).T.astype(int).tolist()]
    couples = (dual.star1 * dual.edges.length)[order]
    devsim.set_edge_values(**at, name="EdgeCouple", values=couples.tolist())
    devsim.set_node_values(**at, name="NodeVolume", values=dual.star0.tolist())


def solved(mesh, name, dual):
    """The error at each vertex, its relative norm, and the sum of the volumes."""
    at = device_of(mesh, name)
    if dual:
        give_dual(at, mesh)
    devsim.node_solution(**at, name="V")
    devsim.edge_from_node_model(**at, node_model="V")
    devsim.edge_model(**at, name="E", equation="(V@n0 - V@n1) * EdgeInverseLength")
    devsim.edge_model(**at, name="E:V@n0", equation="EdgeInverseLength")
    devsim.edge_model(**at, name="E:V@n1", equation="-EdgeInverseLength")
    devsim.node_model(**at, name="charge", equation="-1")
    devsim.equation(**at, name="Poisson", variable_name="V", edge_model="E", node_model="charge")
    for contact in ("left", "right"):
        side = {"device": name, "contact": contact}
        devsim.contact_node_model(**side, name=f"{contact}_V", equation="V")
        devsim.contact_node_model(**side, name=f"{contact}_V:V", equation="1")
        devsim.contact_equation(**side, name="Poisson", node_model=f"{contact}_V")
    devsim.solve(type="dc", absolute_error=1e-10, relative_error=1e-10, maximum_iterations=10)
    potential = np.array(devsim.get_node_model_values(**at, name="V"))
    x = np.array(mesh.points)[:, 0]
    known = x * (2 - x) / 2
    error, volume = abs(potential - known), sum(devsim.get_node_model_values(**at, name="NodeVolume"))
    return error, np.sqrt((error**2).mean() / (known**2).mean()), volume


plate = temper.generate.random_mesh(400, polygon=[(0, 0), (2, 0), (2, 1), (0, 1)])
meshes = {**variants(plate, "vertex"), "positions": plate.copy()}
temper.optimize(meshes["positions"], keep="weights")
found = {name: solved(mesh, name, dual=name not in ("before", "positions")) for name, mesh in meshes.items()}
for name, (_, error, volume) in found.items():
    outside = temper.quality(meshes[name]).orthocenters_outside
    print(f"{name:9}  bad triangles {outside:3}  error {error:.2e}  sum of volumes {volume:.6f} of 2")
assert abs(found["before"][2] - 2) > 0.1  # cells overlap
assert all(abs(found[name][2] - 2) < 1e-6 for name in meshes if name != "before")
results = {name: error for name, (_, error, _) in found.items()}
draw("devsim.svg", *((meshes[name], found[name][0]) for name in ("before", "positions")), "error of the potential")
