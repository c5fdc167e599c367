"""What docs/howto/devsim.md needs from DEVSIM: a device from a file of Gmsh, its couples, and the current through it."""

import pathlib

import devsim
import numpy as np


def device_of(file, name):
    text = pathlib.Path(file).read_text(encoding="utf-8")
    pathlib.Path("device.msh").write_text(text.partition("$NodeData")[0], encoding="utf-8")  # DEVSIM's parser stops at weights
    devsim.create_gmsh_mesh(mesh=name, file="device.msh")
    devsim.add_gmsh_region(mesh=name, gmsh_name="silicon", region="silicon", material="Si")
    for contact in "left", "right":
        devsim.add_gmsh_contact(mesh=name, gmsh_name=contact, region="silicon", name=contact, material="metal")
    devsim.finalize_mesh(mesh=name)
    devsim.create_device(mesh=name, device=name)
    return {"device": name, "region": "silicon"}


def give_tet_dual(at, dual):
    """Gives DEVSIM the couples and volumes of `dual`, which are temper.dec_operators of the mesh."""
    devsim.edge_from_node_model(**at, node_model="node_index")
    ends = np.array([devsim.get_edge_model_values(**at, name=f"node_index@n{k}") for k in (0, 1)]).T.astype(int)
    number = {tuple(edge): i for i, edge in enumerate(dual.edges.vertices.tolist())}
    order = [number[tuple(sorted(edge))] for edge in ends.tolist()]
    devsim.set_edge_values(**at, name="EdgeCouple", values=(dual.star1 * dual.edges.length)[order].tolist())
    devsim.set_node_values(**at, name="NodeVolume", values=dual.star0.tolist())


def current(at):
    """Solves with a conductivity of 1 and 1 V between the contacts, and removes the device."""
    devsim.node_solution(**at, name="V")
    devsim.edge_from_node_model(**at, node_model="V")
    for name, what in (("J", "(V@n0 - V@n1)"), ("J:V@n0", "1"), ("J:V@n1", "-1")):
        devsim.edge_model(**at, name=name, equation=f"EdgeInverseLength * {what}")
    devsim.equation(**at, name="Current", variable_name="V", edge_model="J")
    for name, value in (("left", 1), ("right", 0)):
        contact = {"device": at["device"], "contact": name}
        devsim.contact_node_model(**contact, name=name, equation=f"V - {value}")
        devsim.contact_node_model(**contact, name=f"{name}:V", equation="1")
        devsim.contact_equation(**contact, name="Current", node_model=name, edge_current_model="J")
    devsim.solve(type="dc", absolute_error=1e-10, relative_error=1e-10, maximum_iterations=10)
    found = devsim.get_contact_current(device=at["device"], contact="left", equation="Current")
    volume = sum(devsim.get_node_model_values(**at, name="NodeVolume"))
    devsim.delete_device(device=at["device"])
    return f"current {abs(found):.4f}, volume {volume:.4f}"
