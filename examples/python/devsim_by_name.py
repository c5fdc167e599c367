"""Takes regions, contacts and their interface from Gmsh to DEVSIM by name, and solves for a potential.

    python3 devsim_by_name.py        needs the programs gmsh and temper; with DEVSIM it also solves

Two insulators are between two contacts. So the potential is linear in each. DEVSIM takes lengths of bisectors without their
signs, which is wrong at obtuse triangles. temper optimize removes them, and --keep weights moves positions only.
"""

import importlib.util
import pathlib
import subprocess
import sys

import numpy as np

import temper

PERMITTIVITY = {"oxide": 3.9, "nitride": 7.5}
pathlib.Path("stack.geo").write_text("""SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1}; Coherence; MeshSize {:} = 0.1; MeshSize {1, 6} = 0.02;
Physical Surface("oxide") = {1}; Physical Surface("nitride") = {2};
Physical Curve("left") = {4}; Physical Curve("right") = {6}; Physical Curve("between") = {2};
""", encoding="utf-8")  # fmt: skip
subprocess.run("gmsh -2 -format msh22 -algo del2d stack.geo -o stack.msh".split(), check=True, stdout=subprocess.DEVNULL)
command = "optimize stack.msh -o better.msh --format gmsh22 --keep weights --quiet"
subprocess.run([sys.executable, "-m", "temper", *command.split()], check=True)
text = pathlib.Path("better.msh").read_text(encoding="utf-8")
assert "$NodeData" not in text  # DEVSIM's parser stops there
assert text.partition("$Nodes")[0] == pathlib.Path("stack.msh").read_text(encoding="utf-8").partition("$Nodes")[0]  # all names


def potential(x):
    """The exact potential: 0 on the left, 1 on the right, and one flux through both insulators."""
    flux = 1 / (1 / PERMITTIVITY["oxide"] + 1 / PERMITTIVITY["nitride"])
    return flux * np.where(x < 1, x / PERMITTIVITY["oxide"], 1 / PERMITTIVITY["oxide"] + (x - 1) / PERMITTIVITY["nitride"])


mesh = temper.read("better.msh")
dual = temper.dec_operators(mesh, coefficient={mesh.names[name][1]: value for name, value in PERMITTIVITY.items()})
charge = dual.laplacian() @ potential(np.array(mesh.points)[:, 0])
contacts = [np.unique(dual.edges.vertices[dual.edges.named[name]]) for name in ("left", "right")]
print("charges of the contacts:", *(f"{charge[contact].sum():.12f}" for contact in contacts))
assert (dual.star1 >= 0).all() and abs(np.delete(charge, np.concatenate(contacts))).max() < 1e-13  # no charge elsewhere


def solved(file):
    """The largest error of DEVSIM's potential."""
    import devsim

    devsim.create_gmsh_mesh(mesh=file, file=file)
    for name in PERMITTIVITY:
        devsim.add_gmsh_region(mesh=file, gmsh_name=name, region=name, material=name)
    for name, region in zip(("left", "right"), PERMITTIVITY):
        devsim.add_gmsh_contact(mesh=file, gmsh_name=name, region=region, name=name, material="metal")
    devsim.add_gmsh_interface(mesh=file, gmsh_name="between", region0="oxide", region1="nitride", name="between")
    devsim.finalize_mesh(mesh=file)
    devsim.create_device(mesh=file, device=file)
    for region, value in PERMITTIVITY.items():
        at = {"device": file, "region": region}
        devsim.node_solution(**at, name="V")
        devsim.edge_from_node_model(**at, node_model="V")
        for name, what in (("D", "(V@n0 - V@n1)"), ("D:V@n0", "1"), ("D:V@n1", "-1")):
            devsim.edge_model(**at, name=name, equation=f"{value} * EdgeInverseLength * {what}")
        devsim.equation(**at, name="Poisson", variable_name="V", edge_model="D")
    for contact, value in (("left", 0), ("right", 1)):
        at = {"device": file, "contact": contact}
        devsim.contact_node_model(**at, name=contact, equation=f"V - {value}")
        devsim.contact_node_model(**at, name=f"{contact}:V", equation="1")
        devsim.contact_equation(**at, name="Poisson", node_model=contact)
    at = {"device": file, "interface": "between"}
    for name, what in (("same", "V@r0 - V@r1"), ("same:V@r0", "1"), ("same:V@r1", "-1")):
        devsim.interface_model(**at, name=name, equation=what)
    devsim.interface_equation(**at, name="Poisson", interface_model="same", type="continuous")
    devsim.solve(type="dc", absolute_error=1e-10, relative_error=1e-10, maximum_iterations=10)
    x, v = (np.concatenate([devsim.get_node_model_values(device=file, region=r, name=name) for r in PERMITTIVITY]) for name in "xV")
    devsim.delete_device(device=file)
    return abs(v - potential(x)).max()


if importlib.util.find_spec("devsim"):
    before, after = solved("stack.msh"), solved("better.msh")
    print(f"DEVSIM: largest error of the potential {before:.1e} before, {after:.1e} after")
    assert after < 1e-12 < before
