#!/usr/bin/env python3
"""The same domain meshed by other programs, and what temper makes of their meshes: the table of docs/compared.md.

    bench/other_meshers.py [--write]      --write puts the table into docs/compared.md

The valley of examples/aquifer.geojson, without its lines and wells, gets edges of about 120 m. The unit ball gets edges of
about 0.2. Each program runs with its defaults, except that Triangle gets the least angle that FloPy's examples give it. Needs
gmsh, meshkernel, triangle and tetgen of the Python package index, and the module temper on PYTHONPATH. The columns are:

    bad                       elements that are not well-centered; for tetrahedra, those whose orthocenter is outside
    after temper              the same, after temper.optimize with weights
    after, without weights    the same after temper.optimize(target="mpas"), which takes and gives no weights, for triangles
"""

import json
import pathlib

import numpy as np
import page_table
import temper

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/compared.md"
SIZE, SPACING = 120.0, 0.2  # of the valley, in meters; of the ball


def valley(divided):
    """Its corners, and with `divided` points between them, about SIZE apart."""
    features = json.loads((ROOT / "examples/aquifer.geojson").read_text())["features"]
    ring = next(feature["geometry"]["coordinates"][0] for feature in features if feature["geometry"]["type"] == "Polygon")
    corners = np.array(ring)[:-1] - [680000, 5240000]
    if not divided:
        return corners
    sides = zip(corners, np.roll(corners, -1, axis=0))
    return np.vstack([np.linspace(a, b, max(1, round(np.linalg.norm(b - a) / SIZE)), endpoint=False) for a, b in sides])


def gmsh_mesh(make, corners, coordinates):
    """Points, and elements with so many corners, after `make` has built the geometry and its sizes."""
    import gmsh

    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 1)
    make(gmsh)
    gmsh.model.mesh.generate(corners - 1)
    tags, points, _ = gmsh.model.mesh.getNodes()
    elements = gmsh.model.mesh.getElementsByType({3: 2, 4: 4}[corners])[1].reshape(-1, corners)
    gmsh.finalize()
    return used(points.reshape(-1, 3)[np.argsort(tags), :coordinates], np.searchsorted(np.sort(tags), elements))


def used(points, elements):
    """Without points of no element."""
    kept, numbers = np.unique(elements, return_inverse=True)
    return points[kept], numbers.reshape(np.shape(elements))


def gmsh_valley(gmsh):
    corners = [gmsh.model.geo.addPoint(x, y, 0, SIZE) for x, y in valley(divided=False)]
    lines = [gmsh.model.geo.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(lines)])
    gmsh.model.geo.synchronize()


def gmsh_ball(gmsh):
    gmsh.model.occ.addSphere(0, 0, 0, 1)
    gmsh.model.occ.synchronize()
    for bound in ("Min", "Max"):
        gmsh.option.setNumber(f"Mesh.MeshSize{bound}", SPACING)


def kernel_mesh(orthogonal):
    import meshkernel

    kernel, ring = meshkernel.MeshKernel(), valley(divided=True)
    ring = np.vstack([ring, ring[:1]])
    kernel.mesh2d_make_triangular_mesh_from_polygon(meshkernel.GeometryList(*ring.T.copy()))
    if orthogonal:
        keep = meshkernel.ProjectToLandBoundaryOption.DO_NOT_PROJECT_TO_LANDBOUNDARY
        empty = meshkernel.GeometryList()
        kernel.mesh2d_compute_orthogonalization(keep, meshkernel.OrthogonalizationParameters(), empty, empty)
    made = kernel.mesh2d_get()
    assert set(made.nodes_per_face) == {3}
    return used(np.column_stack([made.node_x, made.node_y]), made.face_nodes.reshape(-1, 3))


def triangle_mesh():
    import triangle

    ring = valley(divided=True)
    sides = np.column_stack([np.arange(len(ring)), np.roll(np.arange(len(ring)), -1)])
    made = triangle.triangulate({"vertices": ring, "segments": sides}, f"pq30a{0.75 * SIZE**2 / 2}")
    return used(made["vertices"], made["triangles"])


def tetgen_mesh():
    """Fills the surface of Gmsh's triangles, which stays."""
    import tetgen

    points, faces = gmsh_mesh(gmsh_ball, 3, coordinates=3)
    made = tetgen.TetGen(points, faces.astype(np.int32))
    made.tetrahedralize(plc=True, quality=True, maxvolume=SPACING**3 / 6 / np.sqrt(2), nobisect=True)
    return used(made.node, made.elem)


def temper_mesh(target):
    ring = valley(divided=False)
    sides = np.column_stack([np.arange(len(ring)), np.roll(np.arange(len(ring)), -1)])
    return temper.mesh_outline(temper.Outline(ring, sides), SIZE, target=target, threads=1).mesh


def row(domain, name, made):
    mesh = made if not isinstance(made, tuple) else temper.Mesh(*made) if made[0].shape[1] == 2 else temper.TetMesh(*made)
    before, better = temper.quality(mesh), mesh.copy()
    temper.optimize(better, threads=1)
    cells = [domain, name, before.orthocenters_outside, temper.quality(better).orthocenters_outside]
    if isinstance(mesh, temper.Mesh):
        plain = temper_mesh("mpas") if name == "temper" else temper.Mesh(mesh.points, mesh.triangles)
        temper.optimize(plain, target="mpas", threads=1)
        cells += [mesh.n_triangles, temper.quality(plain).orthocenters_outside]
    else:
        cells += [mesh.n_tetrahedra, ""]
    return "| {0} | {1} | {4} | {2} | {3} | {5} |\n".format(*cells)


def table():
    made = [("valley", "Gmsh", lambda: gmsh_mesh(gmsh_valley, 3, coordinates=2)), ("valley", "MeshKernel", lambda: kernel_mesh(False)),
            ("valley", "MeshKernel, orthogonalized", lambda: kernel_mesh(True)), ("valley", "Triangle, for FloPy", triangle_mesh),
            ("valley", "temper", lambda: temper_mesh("any")), ("ball", "Gmsh", lambda: gmsh_mesh(gmsh_ball, 4, coordinates=3)),
            ("ball", "TetGen", tetgen_mesh)]  # fmt: skip
    lines = ["| domain | mesher | elements | bad | after temper | after, without weights |\n", "|-|-|-:|-:|-:|-:|\n"]
    for domain, name, make in made:
        lines.append(row(domain, name, make()))
        print(lines[-1], end="", flush=True)
    return "".join(lines)


if __name__ == "__main__":
    page_table.main(__doc__, PAGE, table)
