#!/usr/bin/env python3
"""The leak through a fault: on faces of power cells, and on the staircase that FloPy finds in a grid without the fault.

    bench/faces_leak.py [--sizes 80,40,20,10] [--reference 5]

A fault with a hydraulic characteristic of 1e-3 is in a domain of 1000 by 600 with conductivity 1 and thickness 1. Heads
solve MODFLOW's equations of DISV and HFB. A face of width w has the conductance w / (d₁ + d₂), in series with that of a
barrier on it, 1e-3 w. Needs NumPy, SciPy, FloPy, shapely and the module temper on PYTHONPATH. The cases:

    straight    from boundary to boundary. Heads are known: harmonic on both sides, and their jump is the flux over the
                characteristic. They are given in the cells along the boundary.
    bend        from boundary to boundary. Heads are given in the west and in the east.
    ends        the same, but both ends are inside
    graded      the same, with sizes that fall with the square root of the distance to an end or to the bend

Without known heads the reference is a grid of faces of size 5, graded. The table has:

    length      length of barriers over the length of the fault
    flow        flow through all barriers over that of the reference, less 1
    west, east  L2 norm of the error of heads in cells west and east of the fault, over the largest difference of heads
    order       of each error, from the next larger size to this one

The order is about 2 on faces if heads are smooth. At a bend of 37 degrees they change as r^0.83, so the order is 1.7. At
an end they change as r^0.5, so the order is 1; graded sizes bring it back to 2. A staircase has no order: its errors
come from its length, and change with each grid.
"""

from __future__ import annotations

import argparse
import dataclasses
import warnings

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import scipy.spatial
import temper

WIDTH, HEIGHT = 1000.0, 600.0
CHARACTERISTIC = 1e-3
BORDER = np.array([[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]])
SQUARE = [(0, 1), (1, 2), (2, 3), (3, 0)]
GRADED_WITHIN, LEAST = 200.0, 5000.0  # distance from ends and bends, and the square of the size over the size there


@dataclasses.dataclass
class Case:
    name: str
    line: np.ndarray  # from south to north
    is_known: bool = False
    is_graded: bool = False

    def length(self):
        return np.linalg.norm(np.diff(self.line, axis=0), axis=1).sum()

    def is_west(self, points):
        """Sides of the line, whose first and last segments go on to the boundary."""
        x = np.interp(points[:, 1], self.line[:, 1], self.line[:, 0])
        for end, other in ((0, 1), (-1, -2)):
            slope = (self.line[end, 0] - self.line[other, 0]) / (self.line[end, 1] - self.line[other, 1])
            beyond = points[:, 1] < self.line[0, 1] if end == 0 else points[:, 1] > self.line[-1, 1]
            x = np.where(beyond, self.line[end, 0] + slope * (points[:, 1] - self.line[end, 1]), x)
        return points[:, 0] < x


def cases():
    straight = np.array([[400.0, 0], [600, HEIGHT]])
    bend = np.array([[430.0, 0], [570, 280], [510, HEIGHT]])
    ends = np.array([[480.0, 100], [570, 280], [535, 466]])
    return [
        Case("straight", straight, is_known=True),
        Case("bend", bend),
        Case("ends", ends),
        Case("graded", ends, is_graded=True),
    ]


class KnownHeads:
    """Coordinates s and t are along and across the line. West of it heads are p = G t + A sin(k s) sinh(k t). East of it
    they are p + q, with q = (G + A k sin(k s) cosh(k t)) / characteristic: on the line, q is the jump, and has no slope
    across it."""

    GRADIENT, AMPLITUDE, WAVE = -1e-3, -0.1, 2 * np.pi / 900

    def __init__(self, case):
        self.case = case
        self.start, end = case.line
        self.along = (end - self.start) / case.length()

    def heads(self, points):
        s = (points - self.start) @ self.along
        t = (points - self.start) @ [self.along[1], -self.along[0]]
        k, a, g = self.WAVE, self.AMPLITUDE, self.GRADIENT
        west = g * t + a * np.sin(k * s) * np.sinh(k * t)
        return np.where(self.case.is_west(points), west, west + (g + a * k * np.sin(k * s) * np.cosh(k * t)) / CHARACTERISTIC)

    def flow(self):
        k, length = self.WAVE, self.case.length()
        return abs(self.GRADIENT * length + self.AMPLITUDE * (1 - np.cos(k * length)))


class ComputedHeads:
    """The solution on a fine grid. Between its centers, a polynomial of degree 2 fits the nearest ones on the same side."""

    NEAREST = 15

    def __init__(self, case, size):
        grid = faces(dataclasses.replace(case, is_graded=True), size)
        self.case, self.found = case, solve(grid, case, None)
        west, y = case.is_west(grid.cells.center), grid.cells.center[:, 1]
        beyond = (y < case.line[0, 1]) | (y > case.line[-1, 1])  # of an end, where heads have no jump
        self.sides = [(grid.cells.center[side], self.found.heads[side]) for side in (west | beyond, ~west | beyond)]

    def heads(self, points):
        west, values = self.case.is_west(points), np.empty(len(points))
        for side, (centers, heads) in zip((west, ~west), self.sides):
            far, near = scipy.spatial.cKDTree(centers).query(points[side], self.NEAREST)
            x, y = np.moveaxis((centers[near] - points[side][:, None]) / far[:, -1:, None], -1, 0)
            weight = np.exp(-2 * x**2 - 2 * y**2)
            basis = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1) * weight[..., None]
            values[side] = np.einsum("pn,pn->p", np.linalg.pinv(basis)[:, 0], weight * heads[near])
        return values

    def flow(self):
        return self.found.flow


# --- grids ------------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Grid:
    cells: temper.types.CellPolygons
    barriers: set  # pairs of cells, the lower number first
    on_boundary: np.ndarray  # cells


def meshed(outline, size):
    return temper.mesh_outline(outline, size, target="vertex").mesh


def graded(case, size):
    """Sizes around the ends and bends inside, where heads change as the square root of the distance, or nearly so."""
    inside = case.line[(case.line[:, 1] > 0) & (case.line[:, 1] < HEIGHT)]
    points = np.vstack([BORDER, inside])
    outline = temper.Outline(points, SQUARE, sizes=[(i, i, size**2 / LEAST) for i in range(4, len(points))])
    mesh = meshed(outline, HEIGHT / 10)
    far = np.linalg.norm(mesh.points[:, None] - inside, axis=2).min(axis=1) / GRADED_WITHIN
    return temper.SizeField.from_values(mesh, np.clip(size * np.sqrt(far), size**2 / LEAST, size))


def faces(case, size):
    """A grid whose faces are the line."""
    line = range(4, 4 + len(case.line))
    segments = [*SQUARE, *zip(line[:-1], line[1:])]
    outline = temper.Outline([*BORDER, *case.line], segments, segment_tags=[1] * 4 + [2] * (len(line) - 1),
                             groups=[(1, 2, "fault")], faces=range(4, len(segments)))  # fmt: skip
    if case.is_graded:
        size = graded(case, size)
    mesh = meshed(outline, size)
    barriers = temper.barriers_of_lines(mesh, {"fault": CHARACTERISTIC}, cells="power")
    pairs = {(min(b.first, b.second), max(b.first, b.second)) for b in barriers}
    return Grid(temper.power_cells(mesh), pairs, np.unique(mesh.boundary_edges))


def staircase(case, size):
    """A grid without the line, with the barriers that FloPy finds."""
    from flopy.discretization import VertexGrid
    from flopy.utils import make_hfb_array

    mesh = meshed(temper.Outline(BORDER, SQUARE), size)
    cells = temper.power_cells(mesh)
    disv = cells.gridprops()
    grid = VertexGrid(vertices=disv["vertices"], cell2d=disv["cell2d"], nlay=1, ncpl=disv["ncpl"])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = make_hfb_array(grid, case.line.tolist()).tolist()
    return Grid(cells, {tuple(sorted((i[1], j[1]))) for i, j, _ in found}, np.unique(mesh.boundary_edges))


# --- solution ---------------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Found:
    heads: np.ndarray
    flow: float  # through all barriers
    length: float  # of barriers


def solve(grid, case, known):
    cells, n = grid.cells, len(grid.cells.area)
    i, j = cells.faces.T.astype(int)
    conductance = cells.face_width / cells.face_distances.sum(axis=1)
    is_barrier = np.fromiter((pair in grid.barriers for pair in zip(i.tolist(), j.tolist())), bool, len(i))
    width = cells.face_width[is_barrier]
    conductance[is_barrier] = 1 / (1 / conductance[is_barrier] + 1 / (CHARACTERISTIC * width))
    heads = np.zeros(n)
    fixed = np.zeros(n, bool)
    if known:
        fixed[grid.on_boundary] = True
        heads[fixed] = known.heads(cells.center[fixed])
    else:
        west, east = cells.center[:, 0] == 0, cells.center[:, 0] == WIDTH
        fixed, heads = west | east, west.astype(float)
    off = scipy.sparse.coo_matrix((conductance, (i, j)), shape=(n, n))
    off = (off + off.T).tocsr()
    matrix = scipy.sparse.diags(np.asarray(off.sum(axis=1)).ravel()) - off
    free = ~fixed
    known_part = -matrix[free][:, fixed] @ heads[fixed]
    heads[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free].tocsc(), known_part, permc_spec="MMD_AT_PLUS_A")
    flows = conductance[is_barrier] * np.abs(heads[i] - heads[j])[is_barrier]
    return Found(heads, flows.sum(), width.sum())


def errors(grid, case, reference):
    """Errors of the flow, and of heads west and east; and the relative length of barriers."""
    found = solve(grid, case, reference if case.is_known else None)
    exact = reference.heads(grid.cells.center)
    west, area = case.is_west(grid.cells.center), grid.cells.area
    rms = [np.sqrt(np.average((found.heads - exact)[side] ** 2, weights=area[side])) for side in (west, ~west)]
    return [found.flow / reference.flow() - 1, *(np.array(rms) / np.ptp(exact))], found.length / case.length()


def table(case, sizes, reference):
    for kind in (faces, staircase):
        if kind is staircase and case.is_graded:
            continue
        before = None
        for size in sizes:
            try:
                grid = kind(case, size)
            except NotImplementedError as error:  # FloPy, if a bend of the line makes it visit a cell twice
                print(f"{case.name:10} {kind.__name__:9} {size:5g}  FloPy: {error}")
                before = None
                continue
            found, length = errors(grid, case, reference)
            orders = [" " * 5] * 3
            if before:
                orders = [f"{np.log(abs(b / f)) / np.log(before[0] / size):5.1f}" for b, f in zip(before[1], found)]
            print(f"{case.name:10} {kind.__name__:9} {size:5g} {len(grid.cells.area):6} {length:7.3f} {found[0]:10.2e} {orders[0]} "
                  f"{found[1]:9.1e} {orders[1]} {found[2]:9.1e} {orders[2]}", flush=True)  # fmt: skip
            before = size, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    numbers = lambda text: [float(number) for number in text.split(",")]  # noqa: E731
    parser.add_argument("--sizes", type=numbers, default=[80, 40, 20, 10])
    parser.add_argument("--reference", type=float, default=5.0)
    options = parser.parse_args()
    print("case       barriers   size  cells  length       flow order      west order      east order")
    references = {}  # by the line
    for case in cases():
        if id(case.line) not in references:
            references[id(case.line)] = KnownHeads(case) if case.is_known else ComputedHeads(case, options.reference)
        table(case, options.sizes, references[id(case.line)])


if __name__ == "__main__":
    main()
