"""Functions that the scripts of this folder share. Each script measures a solver on a mesh before and after `optimize`."""

import numpy as np
from matplotlib import pyplot

import temper


def variants(mesh, target, keep=()):
    """The mesh, and copies after `optimize` with the options of each column of the table in docs/explanation/measured.md."""
    columns = {
        "energy": {"options": {"objective": "energy"}},
        "default": {},
        "accuracy": {"target": target, "options": {"objective": "accuracy"}},
        "for": {"target": target},
    }
    meshes = {"before": mesh, **{name: mesh.copy() for name in columns}}
    for name, chosen in columns.items():
        temper.optimize(meshes[name], keep=keep, **chosen)
    return meshes


def at_vertices(mesh, values):
    """The mean over the triangles at each vertex."""
    corners = np.asarray(mesh.triangles)
    return np.bincount(corners.ravel(), np.repeat(values, 3)) / np.bincount(corners.ravel())


def draw(file, before, after, label):
    """Two pairs of a mesh and values at its vertices, in the same colors, two for each power of ten: bright is a small error."""
    width, height = np.ptp(np.asarray(before[0].points), axis=0)
    pyplot.rcParams["font.size"] = 13  # 12 pixels at the width of a page
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.6 * height / width + 0.6), layout="constrained")
    top = int(np.ceil(2 * np.log10(before[1].max())))
    levels = np.round([10 ** (k / 2) for k in range(top - 6, top + 1)], 9)
    for ax, (mesh, values), title in zip(axes, (before, after), ("before", "after")):
        shown = np.maximum(values, levels[0])  # the lowest color is also for all that is smaller
        drawn = ax.tricontourf(*np.asarray(mesh.points).T, mesh.triangles, shown, levels, norm="log", cmap="cividis_r")
        ax.plot(*np.asarray(mesh.points)[np.asarray(mesh.boundary_edges)].transpose(2, 1, 0), color="black", linewidth=1)
        ax.set(title=f"{title}: at most {values.max():.0e}", aspect="equal")
        ax.set_axis_off()
    figure.colorbar(drawn, ax=axes, label=label, format="%.0e")
    figure.savefig(file, dpi=100)
