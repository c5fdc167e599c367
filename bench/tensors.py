#!/usr/bin/env python3
"""Tensors of regions: two-point fluxes on meshes in the metric of each region.

    bench/tensors.py [--size 0.06] [--ratios 2,10,100] [--cases lens,fault] [--smooth] [--turning] [--weights]
                     [--tetrahedra]

A square has regions with different diffusion tensors K. Their axes are turned, and the ratio of the two values of each K
is given. Edges of interfaces are edges of the mesh. `optimize` gives vertices of interfaces a weight for each region.
Needs NumPy, SciPy and the module temper on PYTHONPATH. The cases:

    layers    2 to 5 tilted layers with straight interfaces
    kinked    two regions, whose interface has three kinks
    lens      a region inside another one
    junction  three regions that meet in a point
    fault     a thin zone between two regions

The pressure is linear in each region. It is continuous, and so is its flux through interfaces. Unknowns are in the
triangles. Values at the boundary are given in the weighted midpoints of its edges. Columns:

    bad       triangles that are not well-centered in their metric, in the input and in the result
    gap       the largest distance of the crossings of one interface edge, as its two regions have them, over its length
    error     L2 norm of the error at orthocenters over the norm of the pressure
    barycenters  the same on the input, with unknowns in barycenters, and fluxes through midpoints of edges
    seconds   of `optimize`

With --smooth the pressure is smooth in each of three layers, for sizes h, h/2, h/4 and h/8, and the last column is the
order. With --turning the axes of the tensor turn through the square, by 15 to 60 degrees: each triangle has one of its own, as
MODFLOW's angle1. The pressure is smooth. With --weights positions stay: the table has the bad triangles with weights 0, with one weight for each vertex,
with a weight for each region but 0 at interfaces, and with a weight for each region: by SciPy, and by `find_weights`.
--tetrahedra has a table of a cube with regions, also with --smooth (bench/tensors_tets.py), and needs gmsh.
"""

from __future__ import annotations

import argparse
import dataclasses
import time

import numpy as np
import scipy.optimize
import scipy.sparse
import scipy.sparse.linalg
import temper


def turned(ratio, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    axes = np.array([[c, -s], [s, c]])
    return axes @ np.diag([ratio, 1.0]) @ axes.T


@dataclasses.dataclass
class Case:
    name: str
    points: np.ndarray
    segments: list
    places: list  # in each region
    tensors: list  # (2, 2)
    gradients: list
    constants: list

    def outline(self):
        regions = [(x, y, i + 1, None) for i, (x, y) in enumerate(self.places)]
        return temper.Outline(self.points, self.segments, regions=regions)

    def tensor(self):
        return {i + 1: (k[0, 0], k[0, 1], k[1, 1]) for i, k in enumerate(self.tensors)}

    def pressure(self, points, region):
        gradients, constants = np.array(self.gradients), np.array(self.constants)
        return (gradients[region - 1] * points).sum(axis=1) + constants[region - 1]


def layers(n, ratio):
    """Layers between tilted lines. Along them the pressure has one slope, across them one flux."""
    tilt, points, segments, places = 0.12, [], [], []
    heights = np.linspace(0, 1, n + 1)
    for i, h in enumerate(heights):
        lift = tilt if 0 < i < n else 0.0
        points += [(0.0, h - lift / 2), (1.0, h + lift / 2)]
        segments.append((2 * i, 2 * i + 1))
        if i > 0:
            segments += [(2 * i - 2, 2 * i), (2 * i - 1, 2 * i + 1)]
            places.append((0.5, (heights[i - 1] + h) / 2))
    along = np.array([1.0, tilt]) / np.hypot(1, tilt)
    across = np.array([-along[1], along[0]])
    tensors = [turned(ratio, (40 + 75 * i) % 180) for i in range(n)]
    slope, flux = 0.7, 0.4
    gradients = [slope * along + (flux - slope * across @ k @ along) / (across @ k @ across) * across for k in tensors]
    constants = [0.0]
    for i in range(1, n):
        middle = np.array([0.5, heights[i]])
        constants.append(constants[-1] + (gradients[i - 1] - gradients[i]) @ middle)
    return Case(f"layers {n}", np.array(points), segments, places, tensors, gradients, constants)


def with_common_flux(name, ratio, points, segments, places):
    """Tensors that differ by a multiple of v vᵀ, and a pressure that is constant along v."""
    v = np.array([np.cos(0.6), np.sin(0.6)])
    tensors = [turned(1.7, 20) + i * ratio * np.outer(v, v) for i in range(len(places))]
    gradients = [np.array([-v[1], v[0]])] * len(places)
    return Case(name, np.array(points, dtype=float), segments, places, tensors, gradients, [0.0] * len(places))


SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
SIDES = [(0, 1), (1, 2), (2, 3), (3, 0)]


def kinked(ratio):
    points = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0.5), (0.25, 0.6), (0.55, 0.42), (0.8, 0.56), (1, 0.5)]
    segments = [(0, 1), (1, 8), (8, 2), (2, 3), (3, 4), (4, 0), (4, 5), (5, 6), (6, 7), (7, 8)]
    return with_common_flux("kinked", ratio, points, segments, [(0.5, 0.1), (0.5, 0.9)])


def lens(ratio):
    points = SQUARE + [(0.2, 0.5), (0.4, 0.38), (0.65, 0.38), (0.82, 0.52), (0.6, 0.66), (0.38, 0.64)]
    segments = SIDES + [(4, 5), (5, 6), (6, 7), (7, 8), (8, 9), (9, 4)]
    return with_common_flux("lens", ratio, points, segments, [(0.1, 0.1), (0.5, 0.5)])


def junction(ratio):
    points = SQUARE + [(0.52, 0.45), (0, 0.4), (1, 0.35), (0.45, 1)]
    segments = [(0, 1), (1, 6), (6, 2), (2, 7), (7, 3), (3, 5), (5, 0), (4, 5), (4, 6), (4, 7)]
    return with_common_flux("junction", ratio, points, segments, [(0.5, 0.1), (0.2, 0.8), (0.8, 0.8)])


def fault(ratio):
    points = SQUARE + [(0.3, 0), (0.36, 0), (0.64, 1), (0.58, 1)]
    segments = [(0, 4), (4, 5), (5, 1), (1, 2), (2, 6), (6, 7), (7, 3), (3, 0), (4, 7), (5, 6)]
    return with_common_flux("fault", ratio, points, segments, [(0.1, 0.5), (0.47, 0.5), (0.9, 0.5)])


def cases(ratio):
    return [layers(n, ratio) for n in (2, 3, 5)] + [kinked(ratio), lens(ratio), junction(ratio), fault(ratio)]


# --- two-point fluxes -------------------------------------------------------------------------------------------------


@dataclasses.dataclass
class Fluxes:
    """Unknowns at `centers`; half of a transmissibility for each halfedge; places for values on the boundary."""

    centers: np.ndarray
    halves: np.ndarray
    feet: np.ndarray
    edges: temper.types.DecEdges
    edge_of_halfedge: np.ndarray


def fluxes_of_duals(mesh, tensor):
    d = temper.dec_operators(mesh, tensor=tensor)
    return Fluxes(d.orthocenters, d.half_transmissibility, d.edges.midpoint, d.edges, d.edge_of_halfedge)


def fluxes_of_barycenters(mesh, tensor):
    """K n · d / |d|² times the length, with d from the barycenter to the midpoint of the edge."""
    d = temper.dec_operators(mesh)
    points, triangles = mesh.points, mesh.triangles
    centers = points[triangles].mean(axis=1)
    of_triangles = tensor if isinstance(tensor, np.ndarray) else [tensor[int(r)] for r in mesh.regions]
    k = np.array([[[xx, xy], [xy, yy]] for xx, xy, yy in of_triangles])
    halves = np.empty(3 * len(triangles))
    for i in range(3):
        a, b = points[triangles[:, i]], points[triangles[:, (i + 1) % 3]]
        normal = np.stack([(b - a)[:, 1], -(b - a)[:, 0]], axis=1)
        way = (a + b) / 2 - centers
        halves[i::3] = np.einsum("ti,tij,tj->t", normal, k, way) / (way**2).sum(axis=1)
    feet = points[d.edges.vertices].mean(axis=1)
    return Fluxes(centers, halves, feet, d.edges, d.edge_of_halfedge)


def solve(f, values_on_boundary, sources):
    """Values in the triangles. `values_on_boundary`: at the foot of each edge; used on the boundary."""
    inside = ~f.edges.is_boundary
    resistance = np.zeros(len(f.edges))
    np.add.at(resistance, f.edge_of_halfedge, 1 / f.halves)
    t = 1 / resistance
    left, right = f.edges.triangles.T
    cell = np.where(left >= 0, left, right)
    n = len(f.centers)
    i, j, ti = left[inside], right[inside], t[inside]
    b, tb = cell[~inside], t[~inside]
    rows = np.r_[i, j, i, j, b]
    columns = np.r_[i, j, j, i, b]
    matrix = scipy.sparse.csc_matrix((np.r_[ti, ti, -ti, -ti, tb], (rows, columns)), shape=(n, n))
    right_side = sources.copy()
    np.add.at(right_side, b, tb * values_on_boundary[~inside])
    return scipy.sparse.linalg.spsolve(matrix, right_side)


def l2(mesh, error, values):
    areas = temper.dec_operators(mesh).areas
    middle = (areas * values).sum() / areas.sum()
    return np.sqrt((areas * error**2).sum() / (areas * (values - middle) ** 2).sum())


def error_of(case, mesh, f):
    left, right = f.edges.triangles.T
    region = mesh.regions[np.where(left >= 0, left, right)]
    found = solve(f, case.pressure(f.feet, region), np.zeros(len(f.centers)))
    exact = case.pressure(f.centers, mesh.regions)
    return l2(mesh, found - exact, exact)


# --- tables -----------------------------------------------------------------------------------------------------------


def meshed(case, size):
    return temper.mesh_outline(case.outline(), size, optimize=False).mesh


def bad(mesh, tensor):
    """Triangles with an orthocenter outside, or a dual edge beside its edge, in the metric."""
    d = temper.dec_operators(mesh, tensor=tensor)
    e, n = d.edges, mesh.n_triangles
    wrong = np.zeros(n, bool)
    for side, height in ((0, e.left_height), (1, e.right_height)):
        t = e.triangles[:, side]
        crosses = (e.crossing > 0) & (e.crossing < e.length)
        wrong[t[(t >= 0) & ((height <= 0) | ~crosses)]] = True
    return int(wrong.sum())


def gap(mesh, tensor):
    """Orthocenters, feet and normals decide where a dual edge crosses an interface: from the left and from the right."""
    weights = mesh.cell_data.get("corner_weights")
    if weights is None:
        return 0.0
    d = temper.dec_operators(mesh, tensor=tensor)
    apart = 0.0
    points, triangles = mesh.points, mesh.triangles
    parts = {}
    for t, corners in enumerate(triangles):
        xx, xy, yy = tensor[int(mesh.regions[t])]
        scale = np.sqrt(xx * yy - xy * xy)
        for i in range(3):
            a, b = corners[i], corners[(i + 1) % 3]
            x, y = points[b] - points[a]
            squared = (yy * x * x - 2 * xy * x * y + xx * y * y) / scale
            part = 0.5 + (weights[t, i] - weights[t, (i + 1) % 3]) / (2 * squared)
            key = (min(a, b), max(a, b))
            if key in parts:
                apart = max(apart, abs(parts[key] - (part if a < b else 1 - part)))
            else:
                parts[key] = part if a < b else 1 - part
    assert len(d.edges) == len(parts)
    return apart


def exact_table(size, ratios, names):
    print(f"{'case':<10} {'ratio':>5} {'triangles':>9} {'bad':>11} {'gap':>8} {'error':>8} {'barycenters':>11} {'seconds':>7}")
    for ratio in ratios:
        for case in (case for case in cases(ratio) if not names or case.name in names):
            mesh, tensor = meshed(case, size), case.tensor()
            before, on_barycenters = bad(mesh, tensor), error_of(case, mesh, fluxes_of_barycenters(mesh, tensor))
            start = time.perf_counter()
            temper.optimize(mesh, tensor=tensor, boundary="split", progress=False)
            seconds = time.perf_counter() - start
            after = bad(mesh, tensor)
            error = error_of(case, mesh, fluxes_of_duals(mesh, tensor))
            print(
                f"{case.name:<10} {ratio:5g} {mesh.n_triangles:9d} {before:5d} {after:5d} {gap(mesh, tensor):8.1e} "
                f"{error:8.1e} {on_barycenters:11.1e} {seconds:7.2f}",
                flush=True,
            )


# --- a smooth pressure ------------------------------------------------------------------------------------------------


class Layers:
    """Layers, each with a tensor, a pressure `u` and a source `f`. Regions count from 1."""

    tensor = Case.tensor

    @staticmethod
    def at(functions, points, region):
        values = np.empty(len(points))
        for i, function in enumerate(functions):
            values[region == i + 1] = function(*points[region == i + 1].T)
        return values

    def sources(self, mesh):
        """Integrals over triangles, by the rule of three points that is exact for degree 2."""
        corners = mesh.points[mesh.triangles]
        places = [(corners.sum(axis=1) + 3 * corners[:, i]) / 6 for i in range(3)]
        return temper.dec_operators(mesh).areas * sum(self.at(self.f, p, mesh.regions) for p in places) / 3


class Smooth(Layers):
    """Three level layers with any tensors. Around its lower or upper interface at y₀, with pressure f(x) and flux s(x)
    there, a layer has u = f + (y − y₀) (s − kxy f′)/kyy + (y − y₀)² g(x). So pressure and flux are continuous."""

    HEIGHTS = (1 / 3, 2 / 3)

    def __init__(self, ratio):
        import sympy

        x, y = sympy.symbols("x y")
        self.tensors = [turned(ratio, degrees) for degrees in (25, 100, 150)]
        low, high = (sympy.Rational(i, 3) for i in (1, 2))

        def layer(k, f, s, at, g):
            return f + (y - at) * (s - k[0, 1] * sympy.diff(f, x)) / k[1, 1] + (y - at) ** 2 * g

        f, s = sympy.sin(2 * x + 0.3), sympy.cos(1.5 * x)
        layers = [layer(self.tensors[i], f, s, low, sympy.cos(x + i)) for i in (0, 1)]
        k, middle = self.tensors[1], layers[1]
        flux = k[0, 1] * sympy.diff(middle, x) + k[1, 1] * sympy.diff(middle, y)
        layers.append(layer(self.tensors[2], middle.subs(y, high), flux.subs(y, high), high, sympy.sin(x)))
        sources = []
        for k, u in zip(self.tensors, layers):
            ux, uy = sympy.diff(u, x), sympy.diff(u, y)
            sources.append(-sympy.diff(k[0, 0] * ux + k[0, 1] * uy, x) - sympy.diff(k[0, 1] * ux + k[1, 1] * uy, y))
        self.u = [sympy.lambdify((x, y), u) for u in layers]
        self.f = [sympy.lambdify((x, y), f) for f in sources]

    def outline(self):
        points = [(0, 0), (1, 0), (1, 1 / 3), (1, 2 / 3), (1, 1), (0, 1), (0, 2 / 3), (0, 1 / 3)]
        segments = [(i, (i + 1) % 8) for i in range(8)] + [(2, 7), (3, 6)]
        return temper.Outline(np.array(points), segments, regions=[(0.5, (2 * i + 1) / 6, i + 1, None) for i in range(3)])

    def error(self, mesh, f):
        left, right = f.edges.triangles.T
        region = mesh.regions[np.where(left >= 0, left, right)]
        found = solve(f, self.at(self.u, f.feet, region), self.sources(mesh))
        exact = self.at(self.u, f.centers, mesh.regions)
        return l2(mesh, found - exact, exact)


def smooth_table(size, ratios):
    print(f"{'ratio':>5} {'size':>8} {'triangles':>9} {'bad':>5} {'error':>9} {'barycenters':>11} {'quotient':>8} {'order':>5}")
    for ratio in ratios:
        problem, before = Smooth(ratio), None
        for level in range(4):
            h = size / 2**level
            mesh, tensor = meshed(problem, h), problem.tensor()
            on_barycenters = problem.error(mesh, fluxes_of_barycenters(mesh, tensor))
            temper.optimize(mesh, target="cell", tensor=tensor, boundary="split", progress=False)
            error = problem.error(mesh, fluxes_of_duals(mesh, tensor))
            order = "" if before is None else f"{np.log2(before / error):5.2f}"
            print(
                f"{ratio:5g} {h:8.4f} {mesh.n_triangles:9d} {bad(mesh, tensor):5d} {error:9.2e} {on_barycenters:11.2e} "
                f"{error / on_barycenters:8.3f} {order}",
                flush=True,
            )
            before = error


# --- axes that turn ---------------------------------------------------------------------------------------------------


class Turning:
    """A square whose tensor has the values `ratio` and 1, and axes that turn by some degrees from corner to corner."""

    def __init__(self, ratio, degrees):
        import sympy

        x, y = sympy.symbols("x y")
        angle = sympy.rad(25 + degrees * (x + sympy.sin(2.2 * y)) / 2)
        c, s = sympy.cos(angle), sympy.sin(angle)
        k = [ratio * c * c + s * s, (ratio - 1) * c * s, ratio * s * s + c * c]
        u = sympy.sin(2 * x + 0.3) * sympy.cos(1.5 * y) + x * y
        ux, uy = sympy.diff(u, x), sympy.diff(u, y)
        f = -sympy.diff(k[0] * ux + k[1] * uy, x) - sympy.diff(k[1] * ux + k[2] * uy, y)
        self.k, self.u, self.f = (sympy.lambdify((x, y), function) for function in (k, u, f))

    def tensors(self, mesh):
        return np.stack(self.k(*mesh.points[mesh.triangles].mean(axis=1).T), axis=1)

    def error(self, mesh, f):
        corners = mesh.points[mesh.triangles]
        places = [(corners.sum(axis=1) + 3 * corners[:, i]) / 6 for i in range(3)]
        sources = temper.dec_operators(mesh).areas * sum(self.f(*p.T) for p in places) / 3
        return l2(mesh, solve(f, self.u(*f.feet.T), sources) - self.u(*f.centers.T), self.u(*f.centers.T))


def turning_table(size, ratios):
    print(f"{'degrees':>7} {'ratio':>5} {'triangles':>9} {'bad':>11} {'error':>8} {'barycenters':>11} {'seconds':>7}")
    for ratio in ratios:
        for degrees in (15, 30, 60):
            problem = Turning(ratio, degrees)
            mesh = temper.mesh_outline(temper.Outline(np.array(SQUARE, float), SIDES), size, optimize=False).mesh
            tensor = problem.tensors(mesh)
            before, on_barycenters = bad(mesh, tensor), problem.error(mesh, fluxes_of_barycenters(mesh, tensor))
            mesh.cell_data["K"] = tensor
            start = time.perf_counter()
            temper.optimize(mesh, tensor=tensor, boundary="split", progress=False)
            seconds = time.perf_counter() - start
            tensor = mesh.cell_data["K"]
            error = problem.error(mesh, fluxes_of_duals(mesh, tensor))
            print(
                f"{degrees:7d} {ratio:5g} {mesh.n_triangles:9d} {before:5d} {bad(mesh, tensor):5d} {error:8.1e} "
                f"{on_barycenters:11.1e} {seconds:7.2f}",
                flush=True,
            )


# --- weights alone ----------------------------------------------------------------------------------------------------


class WeightProgram:
    """The linear program of least violations of heights and crossings, with a column for each vertex, or for each vertex
    and region."""

    MARGIN = 0.01

    def __init__(self, mesh, tensor, has_regions):
        self.mesh, self.tensor = mesh, tensor
        corners, regions = mesh.triangles, mesh.regions
        keys = [(int(v), int(r) if has_regions else 0) for t, r in zip(corners, regions) for v in t]
        self.columns = {key: i for i, key in enumerate(dict.fromkeys(keys))}
        self.of = lambda v, r: self.columns[int(v), int(r) if has_regions else 0]
        self.metric = {}
        for r, (xx, xy, yy) in tensor.items():
            k = np.array([[xx, xy], [xy, yy]])
            self.metric[r] = np.sqrt(np.linalg.det(k)) * np.linalg.inv(k)
        self.rows, self.bounds = [], []
        for t, r in zip(corners, regions):
            self.add_triangle(t, int(r))
        self.interface = self.find_interface()

    def add_triangle(self, corners, r):
        points, m = self.mesh.points, self.metric[r]
        for i in range(3):
            a, b, c = corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]
            u, v = points[b] - points[a], points[c] - points[a]
            uu, uv, vv = u @ m @ u, u @ m @ v, v @ m @ v
            twice = 2 * np.sqrt(uu * vv - uv * uv)
            self.rows.append([(self.of(a, r), (1 - uv / uu) / twice), (self.of(b, r), uv / uu / twice), (self.of(c, r), -1 / twice)])
            self.bounds.append((vv - uv) / twice - self.MARGIN)
            for sign in (1, -1):
                self.rows.append([(self.of(a, r), sign / (2 * uu)), (self.of(b, r), -sign / (2 * uu))])
                self.bounds.append(0.5 - self.MARGIN)

    def find_interface(self):
        sides = {}
        for t, r in zip(self.mesh.triangles, self.mesh.regions):
            for i in range(3):
                sides.setdefault(frozenset((int(t[i]), int(t[(i + 1) % 3]))), set()).add(int(r))
        return [(tuple(edge), sorted(r)) for edge, r in sides.items() if len(r) == 2]

    def bad(self, mode):
        n, m = len(self.columns), len(self.rows)
        scale = np.mean([np.ptp(self.mesh.points[t], axis=0).max() ** 2 for t in self.mesh.triangles])
        entries = [(row, column, value) for row, parts in enumerate(self.rows) for column, value in parts]
        rows, columns, values = (np.array(x) for x in zip(*entries))
        a = scipy.sparse.csr_matrix((values * scale, (rows, columns)), shape=(m, n))
        if mode == "0":
            weights = np.zeros(n)
        else:
            limits = [(-20, 20)] * n
            if mode == "0 at interfaces":
                for edge, regions in self.interface:
                    for v in edge:
                        for r in regions:
                            limits[self.of(v, r)] = (0, 0)
            equations = {}
            if mode == "equal feet":
                equations = {"A_eq": self.equations(scale, n, m), "b_eq": np.zeros(len(self.interface))}
            found = scipy.optimize.linprog(
                np.r_[np.zeros(n), np.ones(m)],
                A_ub=scipy.sparse.hstack([-a, -scipy.sparse.eye(m)]).tocsr(),
                b_ub=self.bounds,
                bounds=limits + [(0, None)] * m,
                method="highs",
                **equations,
            )
            weights = found.x[:n]
        values = a @ weights + np.array(self.bounds) + self.MARGIN
        return int((values.reshape(-1, 9).min(axis=1) <= 0).sum())

    def equations(self, scale, n, m):
        rows, columns, values = [], [], []
        for k, ((a, b), regions) in enumerate(self.interface):
            u = self.mesh.points[b] - self.mesh.points[a]
            for r, sign in zip(regions, (1, -1)):
                factor = sign * scale / (u @ self.metric[r] @ u)
                rows += [k, k]
                columns += [self.of(a, r), self.of(b, r)]
                values += [factor, -factor]
        return scipy.sparse.csr_matrix((values, (rows, columns)), shape=(len(self.interface), n + m))


def weights_table(size, ratios):
    print(f"{'case':<10} {'ratio':>5} {'triangles':>9} {'0':>5} {'one':>5} {'regions, 0':>10} {'regions':>7} {'temper':>6}")
    for ratio in ratios:
        for case in cases(ratio):
            mesh, tensor = meshed(case, size), case.tensor()
            one, regions = WeightProgram(mesh, tensor, False), WeightProgram(mesh, tensor, True)
            report = temper.find_weights(mesh, goal="elastic", tensor=tensor)
            mesh.cell_data["corner_weights"] = report.corner_weights
            print(
                f"{case.name:<10} {ratio:5g} {mesh.n_triangles:9d} {regions.bad('0'):5d} {one.bad('one'):5d} "
                f"{regions.bad('0 at interfaces'):10d} {regions.bad('equal feet'):7d} {bad(mesh, tensor):6d}",
                flush=True,
            )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=float, help="of edges; default 0.06, and 0.15 for tetrahedra")
    parser.add_argument("--ratios", default="2,10,100")
    parser.add_argument("--cases", default="", help="default: all")
    parser.add_argument("--smooth", action="store_true")
    parser.add_argument("--turning", action="store_true")
    parser.add_argument("--weights", action="store_true")
    parser.add_argument("--tetrahedra", action="store_true")
    arguments = parser.parse_args()
    ratios = [float(r) for r in arguments.ratios.split(",")]
    names = [name for name in arguments.cases.split(",") if name]
    if arguments.tetrahedra:
        import tensors_tets

        if arguments.smooth:
            return tensors_tets.smooth_table(arguments.size or 0.4, ratios)
        return tensors_tets.table(arguments.size or 0.15, ratios, names)
    size = arguments.size or 0.06
    if not (arguments.smooth or arguments.turning or arguments.weights):
        return exact_table(size, ratios, names)
    return (smooth_table if arguments.smooth else turning_table if arguments.turning else weights_table)(size, ratios)


if __name__ == "__main__":
    main()
