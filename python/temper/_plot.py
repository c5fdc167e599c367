"""Pictures with matplotlib."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._dec import dec_operators
from ._mesh import Mesh, MeshLike, as_mesh
from ._measure import triangle_quality
from ._records import expect

# Those of draw_svg.
_BAD = "#c83a00"
_DUAL = "#084f9c"
_PRIMAL = "#6b7280"
_OUTLINE = "#1d232b"


def _dual_segments(mesh: Mesh) -> npt.NDArray[np.float64]:
    """Dual edges, from orthocenter to orthocenter, on the boundary from orthocenter to weighted midpoint; (e, 2, 2)."""
    complex = dec_operators(mesh)
    left, right = complex.edges.triangles.T
    ends = np.empty((len(complex.edges), 2, 2))
    for side, triangles in enumerate((left, right)):
        ends[:, side] = np.where((triangles >= 0)[:, None], complex.orthocenters[triangles], complex.edges.midpoint)
    return ends


def _least(mesh: Mesh) -> npt.NDArray[np.float64]:
    """The least h/ℓ or d/ℓ of each triangle."""
    q = triangle_quality(mesh)
    return np.minimum(q.min_h_over_l, q.min_d_over_l)


def _angles(mesh: Mesh) -> npt.NDArray[np.float64]:
    """The largest angle of each triangle [degrees]."""
    p = np.asarray(mesh.points)[mesh.triangles]
    a, b, c = (np.linalg.norm(p[:, (k + 1) % 3] - p[:, (k + 2) % 3], axis=1) for k in range(3))
    cosines = [(y * y + z * z - x * x) / (2 * y * z) for x, y, z in ((a, b, c), (b, c, a), (c, a, b))]
    return np.degrees(np.arccos(np.clip(np.min(cosines, axis=0), -1, 1)))


_COLORS: dict[str, Any] = {
    "quality": (_least, "least of h/ℓ, d/ℓ", "cividis"),
    "angle": (_angles, "largest angle [°]", "cividis_r"),
    "region": (lambda mesh: mesh.regions, "region", "tab10"),
}


def plot(
    mesh: MeshLike,
    *,
    ax: Any = None,
    primal: bool = True,
    dual: bool = True,
    orthocenters: bool = False,
    bad_triangles: bool = True,
    weights: bool = False,
    color: Literal["quality", "angle", "region"] | npt.ArrayLike | None = None,
    colorbar: bool = True,
    cmap: Any = None,
    linewidth: float | None = None,
    title: str | None = None,
) -> Any:
    """Draws a mesh with matplotlib, and returns the axes.

    Parameters
    ----------
    mesh : MeshLike
    ax : matplotlib.axes.Axes, optional
        Axes to draw on; None: a new figure.
    primal, dual : bool
        Draw the edges of the triangulation, and the edges of the power diagram between orthocenters.
    orthocenters : bool
        Draw dots at the orthocenters.
    bad_triangles : bool
        Hatch triangles that are not well-centered, by exact tests. With ``color`` they get a thick outline instead.
    weights : bool
        Draw circles of radius √\\|w\\|: solid for positive, dashed for negative weights.
    color : {"quality", "angle", "region"} or (m,) array, optional
        Fill triangles by their least h/ℓ and d/ℓ, by their largest angle, by region, or by your own numbers.
    colorbar : bool
        With ``color``: draw a key next to the axes.
    cmap : matplotlib colormap, optional
    linewidth : float, optional
        Width of edges; by default it falls with the number of triangles.
    title : str, optional

    Returns
    -------
    matplotlib.axes.Axes
    """
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection, PolyCollection

    mesh = as_mesh(mesh)
    mesh._handle.require_plane("plot()")
    _expect_axes(ax)
    if ax is None:
        ax = pyplot.subplots(figsize=(7, 6), layout="constrained")[1]
    points, triangles = np.asarray(mesh.points), np.asarray(mesh.triangles)
    corners = points[triangles]
    width = linewidth if linewidth is not None else float(np.clip(60 / np.sqrt(max(len(triangles), 1)) / 4, 0.15, 0.9))
    bad = ~triangle_quality(mesh).well_centered
    if color is not None:
        _fill(ax, mesh, corners, color, colorbar, cmap)
        if bad_triangles and bad.any():
            outlined = {"facecolors": "none", "edgecolors": _BAD, "linewidths": 3 * width}
            ax.add_collection(PolyCollection(corners[bad], **outlined, zorder=3))
    elif bad_triangles and bad.any():
        hatched = {"facecolors": "none", "edgecolors": _BAD, "linewidths": 0, "hatch": "////"}
        ax.add_collection(PolyCollection(corners[bad], **hatched, zorder=1))
    if primal:
        ax.add_collection(LineCollection(points[mesh.edges], colors=_PRIMAL, linewidths=width, zorder=2))
        boundary = points[mesh.boundary_edges]
        ax.add_collection(LineCollection(boundary, colors=_OUTLINE, linewidths=2 * width, zorder=2.1))
        constrained = mesh.constrained_edges
        outer = {tuple(sorted(edge)) for edge in mesh.boundary_edges.tolist()}
        inside = [tuple(sorted(edge)) not in outer for edge in constrained.tolist()]
        constrained = constrained[np.array(inside, dtype=bool)]
        if len(constrained):
            ax.add_collection(LineCollection(points[constrained], colors=_OUTLINE, linewidths=2 * width, zorder=2.2))
    if dual:
        ax.add_collection(LineCollection(_dual_segments(mesh), colors=_DUAL, linewidths=2 * width, zorder=2.5))
    if orthocenters:
        centers = np.asarray(dec_operators(mesh).orthocenters)
        ax.plot(*centers.T, ".", color=_DUAL, markersize=4 * width + 1, zorder=2.6)
    if weights:
        _circles(ax, points, np.asarray(mesh.weights), width)
    _frame(ax, points, title)
    return ax


def _fill(ax: Any, mesh: Mesh, corners: Any, color: Any, colorbar: bool, cmap: Any) -> None:
    from matplotlib.collections import PolyCollection

    if isinstance(color, str):
        if color not in _COLORS:
            guess = _temper.did_you_mean(color, list(_COLORS))
            raise ValueError(f"color: expected one of {', '.join(_COLORS)}, or an array; found '{color}'{guess}")
        function, label, default = _COLORS[color]
        values = np.asarray(function(mesh), dtype=np.float64)
    else:
        values, label, default = np.asarray(color, dtype=np.float64), "", "cividis"
    if values.shape != (len(corners),):
        raise ValueError(f"color: expected a number for each of {len(corners)} triangles, found shape {values.shape}")
    filled = PolyCollection(corners, array=values, cmap=cmap or default, edgecolors="face", linewidths=0.2, zorder=1)
    ax.add_collection(filled)
    if colorbar:
        ax.figure.colorbar(filled, ax=ax, label=label, shrink=0.8)


def _circles(ax: Any, points: Any, weights: Any, width: float) -> None:
    from matplotlib.collections import EllipseCollection

    for sign, color, style in ((1, "#00866b", "solid"), (-1, "#9a4f96", "dashed")):
        chosen = sign * weights > 0
        diameters = 2 * np.sqrt(np.abs(weights[chosen]))
        ax.add_collection(
            EllipseCollection(
                diameters, diameters, np.zeros(len(diameters)), units="xy", offsets=points[chosen],
                transOffset=ax.transData, facecolors="none", edgecolors=color, linewidths=width, linestyles=style, zorder=2.7,
            )  # fmt: skip
        )


def _frame(ax: Any, points: Any, title: str | None) -> None:
    """Shows the mesh and a small margin. Orthocenters of bad triangles may be far away."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.03 * max(high - low)
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    if title is not None:
        ax.set_title(title)


def _expect_axes(ax: Any) -> None:
    if ax is not None and not hasattr(ax, "add_collection"):
        raise TypeError(f"ax: expected axes of Matplotlib or None, found {type(ax).__name__}")


def plot_history(report: Any, *, ax: Any = None) -> Any:
    """Plots bad triangles and energy against sweeps, from a report of ``optimize``. Returns the axes."""
    from matplotlib import pyplot

    from ._reports import OptimizeReport, SurfaceOptimizeReport

    history = (report if isinstance(report, SurfaceOptimizeReport) else expect("report", report, OptimizeReport)).history
    _expect_axes(ax)
    if ax is None:
        ax = pyplot.subplots(figsize=(6, 3.5), layout="constrained")[1]
    sweeps = [record.sweep for record in history]
    ax.step(sweeps, [record.bad for record in history], where="post", color=_BAD, label="bad triangles")
    ax.set_xlabel("sweep")
    ax.set_ylabel("bad triangles", color=_BAD)
    ax.set_yscale("symlog", linthresh=1)
    ax.set_ylim(bottom=0)
    energy = ax.twinx()
    energy.plot(sweeps, [record.energy for record in history], color=_DUAL, label="energy")
    energy.set_ylabel("energy, at each sweep's γ", color=_DUAL)
    return ax
