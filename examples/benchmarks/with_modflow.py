# runs with: flopy, program mf6; measures: relative L2 error of heads
"""Heads h = x² − y² in a ring, by MODFLOW 6 on a DISV grid of power cells, with given heads in the cells along the boundary."""

import flopy
import numpy as np
from benchmark import variants

import temper


def disv_of(mesh, folder):
    """Vertices and cells of the file mesh.disv as FloPy takes them, counted from 0."""
    (path,) = temper.columns(mesh, [1.0, 0.0]).write(folder, formats=["disv"])
    rows = [line.split() for line in open(path)]

    def block(name):
        return rows[rows.index(["BEGIN", name]) + 1 : rows.index(["END", name])]

    vertices = [[int(i) - 1, float(x), float(y)] for i, x, y in block("VERTICES")]
    cells = [[int(i) - 1, float(x), float(y), int(n), *(int(k) - 1 for k in corners)]
             for i, x, y, n, *corners in block("CELL2D")]  # fmt: skip
    return vertices, cells


def error_of(mesh, folder):
    vertices, cells = disv_of(mesh, f"{folder}_grid")
    x, y = np.asarray(mesh.points).T
    known = x**2 - y**2
    simulation = flopy.mf6.MFSimulation(sim_name="ring", sim_ws=folder)
    flopy.mf6.ModflowTdis(simulation)
    flopy.mf6.ModflowIms(simulation, outer_dvclose=1e-10, inner_dvclose=1e-11, rcloserecord=1e-12)
    flow = flopy.mf6.ModflowGwf(simulation, modelname="ring")
    flopy.mf6.ModflowGwfdisv(flow, nlay=1, ncpl=len(cells), nvert=len(vertices), top=1.0, botm=0.0,
                             vertices=vertices, cell2d=cells)  # fmt: skip
    flopy.mf6.ModflowGwfnpf(flow)
    flopy.mf6.ModflowGwfic(flow)
    heads = [[(0, int(v)), float(known[v])] for v in np.unique(mesh.boundary_edges)]
    flopy.mf6.ModflowGwfchd(flow, stress_period_data=heads)
    flopy.mf6.ModflowGwfoc(flow, head_filerecord="ring.hds", saverecord=[("HEAD", "LAST")])
    simulation.write_simulation(silent=True)
    done, messages = simulation.run_simulation(silent=True)
    assert done, messages
    heads, areas = flow.output.head().get_data().ravel(), temper.dec_operators(mesh).star0
    return np.sqrt((areas * (heads - known) ** 2).sum() / (areas * known**2).sum())


results = {name: error_of(mesh, name) for name, mesh in variants(temper.generate.annulus(), "vertex").items()}
for name, error in results.items():
    print(f"{name:8}  error of heads {error:.2e}")
assert results["accuracy"] < results["before"] / 1.5
