#!/usr/bin/env python3
"""Measures conserved data over many changes of a mesh: how far sums change, and whether values keep their bounds.

    bench/conserve.py [--vertices 2000] [--steps 100] [--check]

The mesh carries a bell with values from 0 to 1, as means over cells and over power cells. In each step the vertices
inside a vortex turn around its center, an update makes the mesh good, and the data follow to the new cells. The next step
begins with these data, so that errors could add up. A row has, over all steps:

- the largest change of a sum of value times area or volume, over the domain or a region, over its first value, with areas
  from the operators
- the largest distance of a value from the first range
- the height of the bell at the end, since means smooth
- seconds of the processor for a step's data; tetrahedra have them within the update

--check exits with 1 if a sum changes by more than 1e-13 or a value leaves the range.
"""

import argparse
import math
import sys
import time

import numpy as np
from loop import cube, inner_vertices, violations

import temper

LARGEST_CHANGE = 1e-13
ANGLE = 0.05  # by which the center of the vortex turns in a step


def plane(n):
    return temper.generate.random_mesh(n, seed=1)


def regions(n):
    """The plane with three regions, side by side."""
    mesh = plane(n)
    x = mesh.points[mesh.triangles].mean(axis=1)[:, 0]
    low, high = mesh.points[:, 0].min(), mesh.points[:, 0].max()
    return temper.Mesh(mesh.points, mesh.triangles, regions=np.searchsorted([0.12, 0.5], (x - low) / (high - low)).astype(np.int32))


def sphere(n):
    return temper.generate.random_sphere(n, seed=1)


MESHES = {"plane": plane, "regions": regions, "sphere": sphere, "tetrahedra": cube}


def sizes(mesh, of):
    """Areas or volumes of cells, or of power cells: these are star0, because the mesh is well-centered."""
    operators = temper.dec_operators(mesh)
    if of == "points":
        return operators.star0
    return operators.areas if isinstance(mesh, temper.Mesh) else operators.volumes


def middle_of(mesh):
    """The center of the vortex: in the plane, whose domain is an L, in its lower left part."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    return low + (0.3 if isinstance(mesh, temper.Mesh) and mesh.space.is_plane else 0.5) * (high - low)


def bell(mesh, of):
    """A bell beside the center of the vortex: 1 on top, 0 far away."""
    cells = mesh.triangles if isinstance(mesh, temper.Mesh) else mesh.tetrahedra
    places = mesh.points if of == "points" else mesh.points[cells].mean(axis=1)
    width = np.ptp(mesh.points, axis=0).max() / 8
    top = middle_of(mesh) + 0.5 * width * np.eye(places.shape[1])[0]
    if isinstance(mesh, temper.Mesh) and not mesh.space.is_plane:
        top = mesh.space.radius * np.array([0.6, 0, 0.8])
    return np.exp(-np.sum((places - top) ** 2, axis=1) / width**2)


def turned(mesh, free):
    """The vertices that turn around the third axis, and their new places."""
    x = mesh.points - middle_of(mesh)
    radius = (0.12 if np.any(mesh.regions) else 0.2) * np.ptp(mesh.points, axis=0).max()  # no line is on the way
    angle = ANGLE * np.maximum(0, 1 - np.sum(x**2, axis=1) / radius**2) ** 2
    if not isinstance(mesh, temper.Mesh):
        angle *= 0.6  # so that no tetrahedron turns over
    elif not mesh.space.is_plane:
        angle = ANGLE * np.maximum(0, mesh.points[:, 2]) ** 2 / mesh.space.radius**2
    some = free[angle[free] > 0]
    cos, sin = np.cos(angle), np.sin(angle)
    places = mesh.points.copy()
    places[:, 0] += cos * x[:, 0] - sin * x[:, 1] - x[:, 0]
    places[:, 1] += sin * x[:, 0] + cos * x[:, 1] - x[:, 1]
    return some, places[some]


def carried(make, of, arguments):
    """One row: the measures of a bell over all steps."""

    def sums(u):
        """Over the domain; for data of cells also over each region."""
        amounts = sizes(mesh, of) * u
        regions = np.unique(mesh.regions) if of == "cells" else []
        return np.array([math.fsum(amounts), *(math.fsum(amounts[mesh.regions == r]) for r in regions)])

    mesh = make(arguments.vertices)
    temper.optimize(mesh, threads=1, progress=False)
    data = lambda: mesh.point_data if of == "points" else mesh.cell_data  # noqa: E731
    first = bell(mesh, of)
    data()["u"] = first
    mesh.point_data_rules, mesh.cell_data_rules = "conserve", "conserve"
    expected = sums(first)
    optimizer = temper.Optimizer(mesh, threads=1)
    change = beyond = seconds = 0.0
    changed = 0
    for _ in range(arguments.steps):
        free = inner_vertices(mesh)
        if isinstance(mesh, temper.Mesh):
            free = np.setdiff1d(free, mesh.constrained_edges)
        optimizer.move(*turned(mesh, free))
        changed += len(optimizer.update().cells)
        assert violations(mesh, "any") == 0, "the mesh is not well-centered, so star0 are no areas"
        start = time.process_time()
        u = data()["u"]
        data()["u"] = u
        seconds += time.process_time() - start
        change = max(change, np.abs(sums(u) / expected - 1).max())
        beyond = max(beyond, first.min() - u.min(), u.max() - first.max(), 0.0)
    return change, beyond, u.max() / first.max(), changed / arguments.steps, seconds / arguments.steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meshes", default=",".join(MESHES))
    parser.add_argument("--vertices", type=int, default=2000)
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    print("| mesh | data of | largest change of the sum | beyond the range | top at the end | cells changed per step | data [s] |")
    print("|-|-|-|-|-|-|-|")
    missed = False
    for name in arguments.meshes.split(","):
        for of in ("cells", "points"):
            change, beyond, top, changed, seconds = carried(MESHES[name], of, arguments)
            print(f"| {name} | {of} | {change:.1e} | {beyond:.1e} | {top:.2f} | {changed:.0f} | {seconds:.4f} |", flush=True)
            missed = missed or change > LARGEST_CHANGE or beyond > 0
    return 1 if arguments.check and missed else 0


if __name__ == "__main__":
    sys.exit(main())
