"""The pictures of docs/explanation/why.md."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import patheffects

import temper

RED, BLUE, GRAY, DARK = "#c83a00", "#084f9c", "#6b7280", "#22272e"
COLORS = ["#f3c3ac", "#7690c8", "#9fb3d0", "#c6d7d6", "#e1e6c6", "#fff2a0"]  # the first for all below zero
plt.rcParams.update({"font.size": 13, "svg.hashsalt": "temper"})


def label(axis, text, at, offset=(0, 0), color=DARK):
    halo = [patheffects.withStroke(linewidth=4, foreground="white")]
    axis.annotate(text, at, offset, textcoords="offset points", ha="center", va="center", color=color, path_effects=halo)


def save(figure, file):
    figure.savefig(file, metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)


def draw_edge(fan, file):
    """The two triangles at the edge from 0 to 1, their circumcenters, and the dual edge between them."""
    figure, axis = plt.subplots(figsize=(7, 4.6), layout="constrained")
    points, triangles = np.array(fan.points), np.array(fan.triangles)
    centers = temper.dec_operators(fan).orthocenters
    at_edge = np.flatnonzero(((triangles == 0) | (triangles == 1)).sum(axis=1) == 2)
    axis.triplot(*points.T, triangles, color=GRAY, linewidth=1)
    for t, color in zip(at_edge, ("#f3c3ac", "#d3ddee")):
        corners = points[triangles[t]]
        axis.fill(*corners.T, color=color, zorder=0)
        far = next(v for v in triangles[t] if v > 1)
        axis.plot(*centers[t], "o", color=RED if color == "#f3c3ac" else BLUE, markersize=9)
        label(axis, f"center of 0-1-{far}", centers[t], (0, 18 * np.sign(centers[t][1])), RED if color == "#f3c3ac" else BLUE)
    axis.annotate("", centers[at_edge[1]], centers[at_edge[0]], arrowprops={"arrowstyle": "-", "linestyle": "--", "color": RED, "linewidth": 2})
    axis.plot(*points[[0, 1]].T, color=DARK, linewidth=2)
    for v, point in enumerate(points):
        away = point - points.mean(axis=0)
        label(axis, str(v), point, tuple(12 * away / max(np.linalg.norm(away), 0.3)))
    axis.set(aspect="equal")
    axis.set_axis_off()
    save(figure, file)


def draw_flow(fan, u, heat, file):
    """Arrows along the edges at vertex 0, as long as the heat that flows, and the temperatures."""
    figure, axis = plt.subplots(figsize=(7, 4.6), layout="constrained")
    points = np.array(fan.points)
    axis.triplot(*points.T, np.array(fan.triangles), color=GRAY, linewidth=1)
    axis.quiver(*points[1:].T / 2, *-points[1:].T * heat, pivot="mid", scale=4, color=[RED] + 5 * [BLUE], zorder=3)
    for v, (point, temperature) in enumerate(zip(points, u)):
        label(axis, f"{temperature:.3g}", point, (-36, -16) if v == 0 else (0, 12 if point[1] >= 0 else -12), RED if v == 0 else DARK)
    axis.set(aspect="equal")
    axis.set_axis_off()
    axis.margins(0.08)
    save(figure, file)


def draw_fields(meshes, fields, titles, file):
    """Temperatures on each mesh; red below zero."""
    figure, axes = plt.subplots(len(meshes), 1, figsize=(7, 5.4), layout="constrained")
    for axis, mesh, u, title in zip(axes, meshes, fields, titles):
        points, triangles = np.array(mesh.points), np.array(mesh.triangles)
        drawn = axis.tricontourf(*points.T, triangles, u, [-1, -1e-9, 0.01, 0.03, 0.1, 0.3, 1], colors=COLORS)
        axis.triplot(*points.T, triangles, color=GRAY, linewidth=0.4)
        axis.set(title=title, aspect="equal")
        axis.set_axis_off()
    bar = figure.colorbar(drawn, ax=axes, label="temperature", shrink=0.8)
    bar.set_ticks([-1, -1e-9, 0.01, 0.03, 0.1, 0.3, 1], labels=["below 0", "0", "0.01", "0.03", "0.1", "0.3", "1"])
    save(figure, file)
