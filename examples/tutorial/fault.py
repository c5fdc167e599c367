"""The staircase, the flow through barriers, and the pictures of docs/tutorial/fault.md."""

import json
import pathlib
import shutil

import matplotlib.pyplot as plt
import numpy as np
import valley
from matplotlib.collections import LineCollection, PolyCollection

import temper

CONDUCTIVITY_OVER_WIDTH = 1e-3  # of the fault, 1/day: HFB's hydraulic characteristic
features = json.loads((pathlib.Path(__file__).parent.parent / "fault.geojson").read_text(encoding="utf-8"))["features"]
line = next(np.array(f["geometry"]["coordinates"], float) for f in features if f["properties"]["name"] == "fault")
length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()


def meshed(outline, size):
    return temper.mesh_outline(temper.read_outline(outline).outline, size, target="vertex").mesh


def nearest_faces(mesh):
    """The faces of cells that FloPy finds for the line, as the list of HFB."""
    from flopy.discretization import VertexGrid
    from flopy.utils import make_hfb_array

    cells = temper.power_cells(mesh).gridprops()
    grid = VertexGrid(vertices=cells["vertices"], cell2d=cells["cell2d"], nlay=1, ncpl=cells["ncpl"])
    return [(first, second, CONDUCTIVITY_OVER_WIDTH) for first, second, _ in make_hfb_array(grid, line.tolist()).tolist()]


def faces_of(mesh, barriers):
    """The ends of each barrier's face, (barriers, 2, 2)."""
    cells = temper.power_cells(mesh)
    corners = {int(cell): set(cells.connectivity[a:b].tolist()) for cell, a, b in zip(cells.cell, cells.offsets, cells.offsets[1:])}
    return np.array([cells.points[sorted(corners[i[1]] & corners[j[1]])] for i, j, _ in barriers])


def relative_length(mesh, barriers):
    """The length of the barriers over the length of the fault."""
    return np.linalg.norm(np.diff(faces_of(mesh, barriers), axis=1), axis=2).sum() / length


def run(folder, mesh, barriers):
    """Heads, balance, and the flow through the barriers in m³ per day, with rain, two wells and the lake. Through all
    barriers water goes from west to east, so absolute values add up."""
    from flopy.mf6.utils import MfGrdFile
    from flopy.utils import CellBudgetFile

    cells, groups = temper.power_cells(mesh).gridprops(), temper.columns(mesh, [0, -25]).groups
    lake = {cell: 2.0 for name, _, cell, _ in groups if name == "lake"}
    pumped = {cell: 1500.0 for name, _, cell, _ in groups if name.endswith("well")}
    heads, balance = valley.run(folder, cells["vertices"], cells["cell2d"], lake, rain=0.0008, pumped=pumped, barriers=barriers)
    grid = MfGrdFile(str(pathlib.Path(folder, "valley.disv.grb")))
    flows = CellBudgetFile(str(pathlib.Path(folder, "valley.bud"))).get_data(text="FLOW-JA-FACE")[-1].ravel()
    between = {(i, int(j)): flows[k] for i in range(len(heads)) for k in range(grid.ia[i], grid.ia[i + 1]) for j in [grid.ja[k]]}
    return heads, balance, sum(abs(between[i[1], j[1]]) for i, j, _ in barriers)


def read_hfb(path, folder):
    """The list in a file of the package HFB, as FloPy reads it with the model of this folder."""
    import flopy

    shutil.copy(path, pathlib.Path(folder, "valley.hfb"))
    simulation = flopy.mf6.MFSimulation.load(sim_ws=folder, verbosity_level=0)
    return simulation.get_model("valley").hfb.stress_period_data.get_data(0).tolist()


def draw_cells(picture, grids):
    """Cells around the bend of the fault, for each (title, mesh, barriers)."""
    figure, panels = plt.subplots(1, len(grids), figsize=(8, 4))
    for panel, (title, mesh, barriers) in zip(panels, grids):
        near = [p for p in temper.power_cells(mesh).polygons() if np.abs(p - line[1]).max() < 420]
        panel.add_collection(PolyCollection(near, facecolor="white", edgecolor="gray", linewidth=0.6))
        panel.plot(*line.T, color="tab:blue", linewidth=1, linestyle="--")
        panel.add_collection(LineCollection(faces_of(mesh, barriers), color="tab:red", linewidth=2.2))
        panel.set(xlim=line[1, 0] + [-300, 300], ylim=line[1, 1] + [-300, 300], aspect="equal", title=title)
        panel.axis("off")
    figure.savefig(picture, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def draw_results(picture, mesh, heads, flows, reference):
    """Heads in all cells, and the flow through the barriers against the number of cells: `flows` has them by name."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.8), width_ratios=[1.5, 1], layout="constrained")
    cells = PolyCollection(temper.power_cells(mesh).polygons(), array=heads, edgecolor="face", linewidth=0.2)
    left.add_collection(cells)
    left.plot(*line.T, color="black", linewidth=1.5)
    wells = [cell for name, _, cell, _ in temper.columns(mesh, [0, -25]).groups if name.endswith("well")]
    left.plot(*mesh.points[wells].T, "^", color="tab:red", markeredgecolor="white", markersize=8)
    left.set(aspect="equal", title="Heads in meters")
    left.axis("off")
    figure.colorbar(cells, shrink=0.7)
    right.axhline(reference, color="gray", linewidth=1, label="reference")
    for (name, found), marker in zip(flows.items(), "o^s"):
        right.semilogx(*np.array(found).T, marker + "-", label=name)
    right.set(xlabel="cells", title="Flow through the fault\nin m³ per day")
    right.legend()
    figure.savefig(picture, dpi=100)
    plt.close(figure)
