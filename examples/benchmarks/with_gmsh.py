# runs with: gmsh; measures: relative error of two-point fluxes
"""A plate with a hole and a fault, meshed by Gmsh: errors of two-point fluxes, and of Poisson's equation by vertices.

The errors are geometric means (docs/reference/errors.md). Gmsh's groups and temper's weights are in the file at the end.
"""

import gmsh
import numpy as np
from benchmark import variants

import temper

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
occ = gmsh.model.occ
plate, hole = occ.addRectangle(0, 0, 0, 3, 2), occ.addDisk(0.7, 1.4, 0, 0.3, 0.3)
plate = occ.cut([(2, plate)], [(2, hole)])[0]
fault = occ.addLine(occ.addPoint(1.2, 0.3, 0), occ.addPoint(2.5, 1.6, 0))
_, pieces = occ.fragment(plate, [(1, fault)])
occ.synchronize()
gmsh.model.addPhysicalGroup(2, [tag for dim, tag in pieces[0]], name="plate")
gmsh.model.addPhysicalGroup(1, [tag for dim, tag in pieces[1]], name="fault")
gmsh.option.setNumber("Mesh.MeshSizeMax", 0.15)
gmsh.model.mesh.generate(2)
gmsh.write("faulted.msh")

mesh = temper.read("faulted.msh")
frame = temper.field_frame(mesh)
meshes, results = variants(mesh, "cell"), {}
for name, mesh in meshes.items():
    mean = temper.geometric_mean(temper.measure_errors(mesh, frame=frame).fields)
    results[name] = mean.flux.l2
    bad = temper.quality(mesh).orthocenters_outside
    print(f"{name:8}  bad {bad:2}  flux {mean.flux.l2:.2e}  Poisson {mean.poisson.l2:.2e}")
assert results["for"] < results["before"]
temper.draw_svg(meshes["for"], meshes["before"]).save("gmsh.svg")

temper.write("better.msh", meshes["for"])
gmsh.open("better.msh")  # Gmsh has groups, and weights as a view
names = [gmsh.model.getPhysicalName(dim, tag) for dim, tag in gmsh.model.getPhysicalGroups()]
assert {"plate", "fault"} <= set(names) and len(gmsh.view.getTags()) == 1
nodes = gmsh.view.getModelData(gmsh.view.getTags()[0], 0)
assert np.array_equal(np.ravel(nodes[2]), meshes["for"].weights)
gmsh.finalize()
