#!/usr/bin/env python3
"""Two tilted layers with different tensors, in PorePy and MODFLOW.

    bench/tensors_clients.py [--size 0.06] [--ratio 10] [--levels 3]

A square has two layers with a tilted interface. Axes of their tensors are turned, and the ratio of the two values of
each is given. The pressure is smooth in each layer; pressure and flux are continuous. Unknowns are in triangles. Rows:

    PorePy Tpfa, centroids      the input, with PorePy's own centers
    PorePy Mpfa                 the input, multi-point fluxes
    PorePy Tpfa, temper         the mesh of `optimize`, with orthocenters and weighted midpoints
    MODFLOW                     the input as DISV, with k, k22 and angle1
    MODFLOW XT3D                the same, with XT3D
    MODFLOW, temper             the mesh of `optimize` as DISU of `temper operators --tensor`, with k = √(det K)

Columns: the L2 norm of the error over the norm of the pressure; the order from the size before; seconds to discretize and
solve; entries of the matrix; entries off the diagonal with the wrong sign, which can make maxima that no data have. The
last two lines compare transmissibilities of the clients with those of `dec_operators`. Needs NumPy, SciPy, PorePy, FloPy,
mf6 on PATH, and the module temper on PYTHONPATH.
"""

from __future__ import annotations

import argparse
import logging
import pathlib
import subprocess
import tempfile
import time
import warnings

import flopy
import numpy as np
import porepy
import scipy.sparse.linalg
import temper
from tensors import Layers, l2, turned

TILT = 0.15


class Tilted(Layers):
    """With coordinates s along and t across the interface, u = f(s) + t (q(s) − k_st f′(s))/k_tt + t² g(s) in a layer."""

    def __init__(self, ratio):
        import sympy

        x, y = sympy.symbols("x y")
        self.along = np.array([1.0, TILT]) / np.hypot(1, TILT)
        self.across = np.array([-self.along[1], self.along[0]])
        self.ratio, self.angles = ratio, (25, 115)
        self.tensors = [turned(ratio, degrees) for degrees in self.angles]
        s = self.along[0] * x + self.along[1] * (y - 0.5)
        t = self.across[0] * x + self.across[1] * (y - 0.5)
        f, slope, q = sympy.sin(2 * s + 0.3), 2 * sympy.cos(2 * s + 0.3), sympy.cos(1.5 * s)
        self.u, self.f = [], []
        for k in self.tensors:
            u = f + t * (q - (self.along @ k @ self.across) * slope) / (self.across @ k @ self.across) + t**2 * sympy.cos(s)
            ux, uy = sympy.diff(u, x), sympy.diff(u, y)
            source = -sympy.diff(k[0, 0] * ux + k[0, 1] * uy, x) - sympy.diff(k[0, 1] * ux + k[1, 1] * uy, y)
            self.u.append(sympy.lambdify((x, y), u))
            self.f.append(sympy.lambdify((x, y), source))

    def outline(self):
        left, right = 0.5, 0.5 + TILT
        points = [(0, 0), (1, 0), (1, right), (1, 1), (0, 1), (0, left)]
        segments = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (5, 2)]
        return temper.Outline(np.array(points), segments, regions=[(0.5, 0.1, 1, None), (0.5, 0.9, 2, None)])

    def error(self, mesh, centers, found):
        exact = self.at(self.u, centers, mesh.regions)
        return l2(mesh, found - exact, exact)


def wrong_signs(matrix):
    off = matrix.tocoo()
    return int(((off.row != off.col) & (off.data > 1e-12 * abs(off.data).max())).sum())


# --- PorePy -----------------------------------------------------------------------------------------------------------


def porepy_grid(mesh, dual):
    grid = porepy.TriangleGrid(np.array(mesh.points).T, np.array(mesh.triangles).T)
    grid.compute_geometry()
    if dual is None:
        return grid, None
    number = {tuple(ends): i for i, ends in enumerate(dual.edges.vertices.tolist())}
    faces = np.sort(grid.face_nodes.indices.reshape(-1, 2), axis=1).tolist()
    edges = np.array([number[tuple(ends)] for ends in faces])
    grid.face_centers[:2] = dual.edges.midpoint[edges].T
    grid.cell_centers[:2] = dual.orthocenters.T
    return grid, edges


def with_porepy(problem, mesh, method, dual=None):
    grid, edges = porepy_grid(mesh, dual)
    kxx, kxy, kyy = np.array([problem.tensor()[int(r)] for r in mesh.regions]).T
    permeability = porepy.SecondOrderTensor(kxx=kxx, kyy=kyy, kxy=kxy)
    outside = grid.get_all_boundary_faces()
    conditions = porepy.BoundaryCondition(grid, outside, ["dir"] * len(outside))
    start = time.perf_counter()
    data = porepy.initialize_data({}, "flow", {"second_order_tensor": permeability, "bc": conditions})
    method("flow").discretize(grid, data)
    matrices = data[porepy.DISCRETIZATION_MATRICES]["flow"]
    divergence = grid.cell_faces.T
    values = np.zeros(grid.num_faces)
    cells = np.abs(grid.cell_faces[outside]).argmax(axis=1)
    values[outside] = problem.at(problem.u, grid.face_centers[:2, outside].T, mesh.regions[np.asarray(cells).ravel()])
    matrix = (divergence @ matrices["flux"]).tocsc()
    found = scipy.sparse.linalg.spsolve(matrix, problem.sources(mesh) - divergence @ (matrices["bound_flux"] @ values))
    seconds = time.perf_counter() - start
    error = problem.error(mesh, grid.cell_centers[:2].T, found)
    return error, seconds, matrix.nnz, wrong_signs(matrix), (grid, matrices["flux"], edges)


# --- MODFLOW ----------------------------------------------------------------------------------------------------------


def modflow(problem, mesh, centers, folder, add_grid, flow):
    """Heads with fixed values in the triangles at the boundary."""
    simulation = flopy.mf6.MFSimulation(sim_name="s", sim_ws=str(folder), exe_name="mf6")
    flopy.mf6.ModflowTdis(simulation)
    flopy.mf6.ModflowIms(simulation, outer_dvclose=1e-11, inner_dvclose=1e-12, rcloserecord=1e-10, linear_acceleration="bicgstab",
                         outer_maximum=200, inner_maximum=500)
    model = flopy.mf6.ModflowGwf(simulation, modelname="m")
    name = add_grid(model)
    flopy.mf6.ModflowGwfic(model, strt=0.0)
    flopy.mf6.ModflowGwfnpf(model, icelltype=0, **flow)
    edges = temper.dec_operators(mesh).edges
    at_boundary = np.unique(edges.triangles[edges.is_boundary].max(axis=1))
    heads = problem.at(problem.u, centers, mesh.regions)
    flopy.mf6.ModflowGwfchd(model, stress_period_data=[(name(t), heads[t]) for t in at_boundary])
    sources = problem.sources(mesh)
    inner = np.setdiff1d(np.arange(mesh.n_triangles), at_boundary)
    flopy.mf6.ModflowGwfwel(model, stress_period_data=[(name(t), sources[t]) for t in inner], maxbound=len(inner))
    flopy.mf6.ModflowGwfoc(model, head_filerecord="m.hds", saverecord=[("HEAD", "LAST")])
    simulation.write_simulation(silent=True)
    start = time.perf_counter()
    done = subprocess.run(["mf6"], cwd=folder, capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if "Normal termination" not in done.stdout:
        raise SystemExit(f"mf6 failed:\n{done.stdout[-2000:]}")
    found = flopy.utils.HeadFile(str(folder / "m.hds")).get_data().ravel()
    return problem.error(mesh, centers, found), seconds


def with_disv(problem, mesh, folder, xt3d):
    centers = mesh.points[mesh.triangles].mean(axis=1)

    def add_grid(model):
        vertices = [(i, *p) for i, p in enumerate(mesh.points.tolist())]
        clockwise = mesh.triangles[:, ::-1].tolist()
        cells = [(t, *centers[t].tolist(), 3, *corners) for t, corners in enumerate(clockwise)]
        flopy.mf6.ModflowGwfdisv(model, nlay=1, ncpl=mesh.n_triangles, nvert=len(vertices), top=np.ones(mesh.n_triangles), botm=np.zeros((1, mesh.n_triangles)), vertices=vertices,
                                 cell2d=cells)
        return lambda t: (0, int(t))

    angles = np.array(problem.angles)[mesh.regions - 1]
    options = {"xt3doptions": ["xt3d"]} if xt3d else {}
    flow = {"k": np.full(mesh.n_triangles, problem.ratio), "k22": np.ones(mesh.n_triangles), "angle1": angles, **options}
    return modflow(problem, mesh, centers, folder, add_grid, flow)


def with_disu(problem, mesh, tensor, folder):
    (folder / "layers.csv").write_text("vertex,top,bottom 1\n*,1,0\n")
    temper.write(folder / "mesh.vtu", mesh)
    regions = [f"--tensor={r}={','.join(repr(float(x)) for x in k)}" for r, k in tensor.items()]
    subprocess.run(["temper", "operators", "mesh.vtu", "-o", "operators", "--layers", "layers.csv", "--cells", "triangles",
                    "--format", "disu", *regions], cwd=folder, check=True, capture_output=True)  # fmt: skip
    arrays = arrays_of((folder / "operators" / "mesh.disu").read_text())
    dual = temper.dec_operators(mesh, tensor=tensor)
    k = np.array([np.sqrt(kxx * kyy - kxy**2) for kxx, kxy, kyy in (tensor[int(r)] for r in mesh.regions)])

    def add_grid(model):
        flopy.mf6.ModflowGwfdisu(model, nodes=mesh.n_triangles, nja=len(arrays["ja"]), **arrays)
        return lambda t: (int(t),)

    model_folder = folder / "model"
    model_folder.mkdir()
    error, seconds = modflow(problem, mesh, dual.orthocenters, model_folder, add_grid, {"k": k})
    return error, seconds, conductances(arrays, k), dual


def arrays_of(text):
    """The arrays of a DISU file, with cells counted from 0, as FloPy has them."""
    arrays, name = {}, None
    for line in text.splitlines():
        words = line.split()
        if words and words[0].lower() in ("top", "bot", "area", "iac", "ja", "ihc", "cl12", "hwva"):
            name = words[0].lower()
            arrays[name] = []
        elif not words or words[0] in ("BEGIN", "END") or words[0].isupper():
            name = name if words and words[0] == "INTERNAL" else None
        elif name:
            arrays[name] += map(float, words)
    whole = {"iac": 0, "ja": 1, "ihc": 0}
    return {key: np.array(v, int) - whole[key] if key in whole else np.array(v) for key, v in arrays.items()}


def conductances(arrays, k):
    """MODFLOW's conductance of each connection of two cells, as its equations have it (NPF, harmonic mean)."""
    starts = np.r_[0, np.cumsum(arrays["iac"])]
    ja, lengths, widths = (arrays[name] for name in ("ja", "cl12", "hwva"))
    found = {}
    for n in range(len(starts) - 1):
        for i in range(starts[n] + 1, starts[n + 1]):
            found[n, int(ja[i])] = (k[n] / lengths[i], widths[i])
    return {(n, m): w / (1 / a + 1 / found[m, n][0]) for (n, m), (a, w) in found.items() if n < m}


# --- table ------------------------------------------------------------------------------------------------------------


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=float, default=0.06)
    parser.add_argument("--ratio", type=float, default=10)
    parser.add_argument("--levels", type=int, default=3)
    arguments = parser.parse_args()
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")
    problem, before, off = Tilted(arguments.ratio), {}, {}
    tensor = problem.tensor()
    print(f"{'scheme':<24} {'triangles':>9} {'error':>9} {'order':>5} {'seconds':>7} {'entries':>8} {'wrong signs':>11}")

    def show(name, mesh, error, seconds, entries="", wrong=""):
        order = f"{np.log2(before[name] / error):5.2f}" if name in before else ""
        before[name] = error
        print(f"{name:<24} {mesh.n_triangles:9d} {error:9.2e} {order:>5} {seconds:7.2f} {entries:>8} {wrong:>11}", flush=True)

    for level in range(arguments.levels):
        given = temper.mesh_outline(problem.outline(), arguments.size / 2**level, optimize=False).mesh
        better = given.copy()
        temper.optimize(better, target="cell", tensor=tensor, boundary="split", progress=False)
        dual = temper.dec_operators(better, tensor=tensor)
        show("PorePy Tpfa, centroids", given, *with_porepy(problem, given, porepy.Tpfa)[:4])
        show("PorePy Mpfa", given, *with_porepy(problem, given, porepy.Mpfa)[:4])
        *row, (grid, flux, edges) = with_porepy(problem, better, porepy.Tpfa, dual)
        show("PorePy Tpfa, temper", better, *row)
        off["PorePy"] = abs(np.abs(flux).max(axis=1).toarray().ravel() / dual.transmissibility[edges] - 1).max()
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for part in ("plain", "xt3d", "disu"):
                (folder / part).mkdir()
            show("MODFLOW", given, *with_disv(problem, given, folder / "plain", False))
            show("MODFLOW XT3D", given, *with_disv(problem, given, folder / "xt3d", True))
            error, seconds, of_modflow, dual = with_disu(problem, better, tensor, folder / "disu")
            show("MODFLOW, temper", better, error, seconds)
        inner = ~dual.edges.is_boundary
        pairs = np.sort(dual.edges.triangles[inner], axis=1)
        ours = dict(zip(map(tuple, pairs.tolist()), dual.transmissibility[inner]))
        assert ours.keys() == of_modflow.keys()
        off["MODFLOW"] = max(abs(value / ours[pair] - 1) for pair, value in of_modflow.items())
    for name, value in off.items():
        print(f"transmissibilities of {name} over those of dec_operators, less 1: at most {value:.1e}")


if __name__ == "__main__":
    main()
