#!/usr/bin/env python3
"""Measures PorePy's error on tetrahedra before and after `temper optimize`, with its own centers and with temper's.

    PYTHONPATH=BUILD/python bench/porepy_tets.py PROGRAM MESH.mesh … [--gmsh cube ball fracture] [--options …]

A row is a mesh: its tetrahedra, those that are bad before and after, the faces of negative transmissibility after, and
relative L2 errors of `Tpfa` for plane waves. The error is the geometric mean over three waves, with values given at the
centers of boundary faces. Three pairs of mesh and centers are tried. The last column is the first error over the last.
Needs porepy, and gmsh for --gmsh.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import porepy
from scipy.sparse.linalg import spsolve

import temper

WAVES = np.array([[0.8, 0.5, 0.33], [-0.4, 0.8, 0.45], [0.3, -0.5, 0.81]])  # directions
RADIANS = 2.5  # in half the longest side of the domain
FACES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
GAUSS = 0.25 + (np.eye(4) - 0.25) / np.sqrt(5)  # barycentric coordinates of a rule of degree two


def gmsh_mesh(name, path, tetrahedra=2500):
    """Makes a mesh by gmsh's defaults, with about this number of tetrahedra."""
    import gmsh

    volume = 4 * np.pi / 3 if name == "ball" else 1
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 1)
    if name == "ball":
        gmsh.model.occ.addSphere(0, 0, 0, 1)
    else:
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    if name == "fracture":
        gmsh.model.occ.rotate([(2, gmsh.model.occ.addDisk(0.5, 0.5, 0.5, 0.3, 0.3))], 0.5, 0.5, 0.5, 1, 0, 0, 0.4)
        gmsh.model.occ.fragment(gmsh.model.occ.getEntities(3), gmsh.model.occ.getEntities(2))
    gmsh.model.occ.synchronize()
    if name == "fracture":
        inside = [tag for _, tag in gmsh.model.getEntities(2) if len(gmsh.model.getAdjacencies(2, tag)[0]) != 1]
        gmsh.model.addPhysicalGroup(2, inside, name="fracture")
    gmsh.model.addPhysicalGroup(3, [tag for _, tag in gmsh.model.getEntities(3)], name="rock")
    size = 2 * (volume / tetrahedra) ** (1 / 3)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(3)
    gmsh.write(str(path))
    gmsh.finalize()


def grid_of(mesh):
    grid = porepy.TetrahedralGrid(np.array(mesh.points).T, np.array(mesh.tetrahedra).T)
    grid.compute_geometry()
    return grid


def give_centers(grid, mesh):
    """The orthocenters of tetrahedra and of faces."""
    dual = temper.dec_operators(mesh)
    number = {tuple(vertices): i for i, vertices in enumerate(dual.faces.vertices.tolist())}
    faces = np.sort(grid.face_nodes.indices.reshape(-1, 3), axis=1).tolist()
    grid.face_centers[:] = dual.faces.orthocenter[[number[tuple(vertices)] for vertices in faces]].T
    grid.cell_centers[:] = dual.orthocenters.T


def solved(grid, mesh, box):
    """The error, and the number of faces of negative transmissibility."""
    faces = grid.get_all_boundary_faces()
    conditions = porepy.BoundaryCondition(grid, faces, ["dir"] * len(faces))
    permeability = porepy.SecondOrderTensor(np.ones(grid.num_cells))
    data = porepy.initialize_data({}, "flow", {"second_order_tensor": permeability, "bc": conditions})
    porepy.Tpfa("flow").discretize(grid, data)
    matrices = data[porepy.DISCRETIZATION_MATRICES]["flow"]
    divergence = grid.cell_faces.T
    negative = (matrices["flux"].multiply(grid.cell_faces) < 0).tocsr().getnnz(axis=1) > 0
    low, high = box
    at = np.einsum("qk,mkd->qmd", GAUSS, np.array(mesh.points)[mesh.tetrahedra])
    errors = []
    for wave in WAVES / np.linalg.norm(WAVES, axis=1)[:, None]:
        k = 2 * RADIANS / (high - low).max() * wave
        u = lambda places: np.sin((places - (low + high) / 2) @ k + 0.5)  # noqa: E731
        source = k @ k * u(at).mean(axis=0) * grid.cell_volumes
        given = np.zeros(grid.num_faces)
        given[faces] = u(grid.face_centers.T)[faces]
        pressure = spsolve((divergence @ matrices["flux"]).tocsc(), source - divergence @ (matrices["bound_flux"] @ given))
        exact = u(grid.cell_centers.T)
        errors.append(np.sqrt((grid.cell_volumes * (pressure - exact) ** 2).sum() / (grid.cell_volumes * exact**2).sum()))
    return np.exp(np.mean(np.log(errors))), int(negative.sum())


def row(name, path, program, options, folder):
    better = folder / "better.msh"
    subprocess.run([program, "optimize", path, "-o", better, "--quiet", *options], check=True, stderr=subprocess.DEVNULL)
    before, after = temper.read(str(path)), temper.read(str(better))
    box = np.array(before.points).min(axis=0), np.array(before.points).max(axis=0)
    own, own_after, given = grid_of(before), grid_of(after), grid_of(after)
    give_centers(given, after)
    first, second, (last, negative) = solved(own, before, box)[0], solved(own_after, after, box)[0], solved(given, after, box)
    bad = [temper.quality(mesh).orthocenters_outside for mesh in (before, after)]
    print(
        f"| {name} | {before.n_tetrahedra} | {bad[0]} | {bad[1]} | {negative} | {first:.2e} | {second:.2e} | {last:.2e} | {first / last:.1f} |",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--gmsh", nargs="*", default=[], choices=["cube", "ball", "fracture"])
    parser.add_argument("--options", nargs=argparse.REMAINDER, default=[], help="of temper optimize")
    arguments = parser.parse_args()
    print("| mesh | tetrahedra | bad before | after | negative | PorePy | PorePy, mesh of temper | temper | ratio |\n|-|-|-|-|-|-|-|-|-|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for path in arguments.meshes:
            row(path.stem, path, arguments.program, arguments.options, folder)
        for kind in arguments.gmsh:
            gmsh_mesh(kind, folder / f"{kind}.msh")
            row(f"Gmsh, {kind}", folder / f"{kind}.msh", arguments.program, arguments.options, folder)


if __name__ == "__main__":
    sys.exit(main())
