# runs with: pyvista; measures: largest angle, in degrees
"""The angles of a ring's triangles, as VTK measures them."""

import pyvista

import temper

results, ring = {}, temper.generate.annulus()
for name, options in (("before", None), ("energy", {"objective": "energy"}), ("default", {})):
    mesh = ring.copy()
    if options is not None:
        temper.optimize(mesh, options=options)
    temper.write(f"{name}.vtu", mesh)
    grid = pyvista.read(f"{name}.vtu")
    weights = grid.point_data.get("weight", 0 * mesh.weights)  # files without weights have no such array
    assert (weights == mesh.weights).all() and grid.n_cells == mesh.n_triangles
    angles = grid.cell_quality(["min_angle", "max_angle"])
    results[name] = angles["max_angle"].max()
    print(f"{name:8} angles from {angles['min_angle'].min():.1f} to {results[name]:.1f}, obtuse {(angles['max_angle'] > 90).sum()}")
assert results["default"] < 90 < results["before"]
