"""Tensors of regions of tetrahedra: the cases and the tables of `bench/tensors.py --tetrahedra`.

A cube has regions with different diffusion tensors K. gmsh makes the meshes, whose faces follow the interfaces. The
pressure is linear in each region. It is continuous, and so is its flux through interfaces. Unknowns are in the
tetrahedra. Values at the boundary are given in the orthocenters of its faces. Vertices of the boundary and
of interfaces slide. The cases:

    layers    2 to 5 tilted layers. Their inverse tensors are isotropic in the plane of the layers
    fault     a steep zone in a rock, of the same kind
    skew      two tilted layers with any tensors
    lens      a block inside a rock. The tensors differ by a multiple of v vᵀ, and the pressure is constant along v

Columns:

    bad       tetrahedra that are not well-centered in their metric, in the input and in the result
    edges     the largest difference of the crossings of an interface edge, as its regions have them, over its length
    faces     the largest distance of the centers of an interface face, as its regions have them, over its longest edge
    error     L2 norm of the error at orthocenters over the norm of the pressure
    barycenters  the same on the input, with unknowns in barycenters, and fluxes through barycenters of faces
    seconds   of `optimize`

With --smooth the pressure is smooth in each of three level layers, isotropic in their plane, for sizes that fall by √½.
"""

from __future__ import annotations

import dataclasses
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import temper

FACES = np.array([[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]])  # opposite each corner
CUBE = 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\n'


@dataclasses.dataclass
class Case:
    name: str
    geometry: str
    region_of: object  # function of places, from 0
    tensors: list  # (3, 3)
    gradients: list
    constants: list

    def pressure(self, places, region):
        return (np.array(self.gradients)[region] * places).sum(axis=1) + np.array(self.constants)[region]


def frame(normal):
    """A unit normal, and two directions of its plane."""
    normal = np.array(normal, float) / np.linalg.norm(normal)
    one = np.cross(normal, [0.3, 1.0, 0.2])
    one /= np.linalg.norm(one)
    return normal, one, np.cross(normal, one)


def isotropic_in_plane(normal, ratio, i):
    """A tensor whose inverse is isotropic within the plane, larger by the ratio across it, and a little tilted."""
    n, one, other = frame(normal)
    p = 0.2 * (one if i % 2 == 0 else other)
    scale = 1.0 + i
    across = ratio if i % 2 == 0 else 1 / ratio
    inverse = scale * (np.outer(one, one) + np.outer(other, other) + across * np.outer(n, n))
    limit = min(1.0, np.sqrt(across))
    return np.linalg.inv(inverse + scale * limit * (np.outer(p, n) + np.outer(n, p)))


def skew(ratio, i):
    n, one, other = frame((0.4 + i, 1.0, -0.7))
    return ratio * np.outer(n, n) + np.outer(one, one) + (1.5 + i) * np.outer(other, other)


def planes(name, normal, offsets, tensors):
    """Regions between parallel planes, at these parts of the way through the cube's middle along the normal."""
    n, one, other = frame(normal)
    middle = np.full(3, 0.5)
    text = CUBE
    for i, offset in enumerate(offsets):
        corners = [middle + offset * n + a * one + b * other for a, b in ((-2, -2), (2, -2), (2, 2), (-2, 2))]
        first = 100 * (i + 1)
        text += "".join(f"Point({first + k}) = {{{c[0]}, {c[1]}, {c[2]}}};\n" for k, c in enumerate(corners))
        text += "".join(f"Line({first + k}) = {{{first + k}, {first + (k + 1) % 4}}};\n" for k in range(4))
        text += f"Curve Loop({first}) = {{{first}, {first + 1}, {first + 2}, {first + 3}}};\nPlane Surface({first}) = {{{first}}};\n"
        text += f"s{i}() = BooleanIntersection{{ Surface{{{first}}}; Delete; }}{{ Volume{{1}}; }};\n"
    all_planes = ", ".join(f"s{i}()" for i in range(len(offsets)))
    text += f"BooleanFragments{{ Volume{{1}}; Delete; }}{{ Surface{{{all_planes}}}; Delete; }}\n"

    def region_of(places):
        return np.searchsorted(offsets, (places - middle) @ n)

    slope, flux = 0.7 * one - 0.3 * other, 0.4
    gradients = [slope + (flux - n @ k @ slope) / (n @ k @ n) * n for k in tensors]
    constants = [0.0]
    for i, offset in enumerate(offsets):
        constants.append(constants[-1] + (gradients[i] - gradients[i + 1]) @ (middle + offset * n))
    return Case(name, text, region_of, tensors, gradients, constants)


def layers(count, ratio):
    normal = (0.1, -0.06, 1.0)
    offsets = np.linspace(-0.5, 0.5, count + 1)[1:-1]
    return planes(f"layers {count}", normal, offsets, [isotropic_in_plane(normal, ratio, i) for i in range(count)])


def fault(ratio):
    normal = (1.0, 0.2, 0.55)
    rock, zone = isotropic_in_plane(normal, 2, 1), isotropic_in_plane(normal, ratio, 0)
    return planes("fault", normal, [-0.1, 0.1], [rock, zone, rock])


def lens(ratio):
    text = CUBE + "Box(2) = {0.28, 0.25, 0.35, 0.44, 0.5, 0.3};\nRotate {{0.3, 1, 0.2}, {0.5, 0.5, 0.5}, 0.3} { Volume{2}; }\n"
    text += "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
    axis, angle = np.array([0.3, 1, 0.2]) / np.linalg.norm([0.3, 1, 0.2]), 0.3
    v = np.array([np.cos(0.6), 0.2, np.sin(0.6)])

    def region_of(places):
        p = places - 0.5
        turned = p * np.cos(angle) - np.cross(axis, p) * np.sin(angle) + np.outer(p @ axis, axis) * (1 - np.cos(angle))
        return (np.abs(turned) < [0.22, 0.25, 0.15]).all(axis=1).astype(int)

    rock = skew(1.7, 0)
    gradient = np.cross(v, [0.2, 0.5, 1.0])
    return Case("lens", text, region_of, [rock, rock + ratio * np.outer(v, v)], [gradient] * 2, [0.0] * 2)


def cases(ratio):
    skewed = planes("skew", (0.1, -0.06, 1.0), [0.0], [skew(ratio, i) for i in range(2)])
    return [layers(n, ratio) for n in (2, 3, 5)] + [fault(ratio), skewed, lens(ratio)]


def meshed(case, size, folder):
    path = Path(folder) / "case.geo"
    path.write_text(case.geometry + f"Mesh.MeshSizeMin = {size};\nMesh.MeshSizeMax = {size};\nMesh.SaveAll = 1;\n")
    out = path.with_suffix(".msh")
    subprocess.run(["gmsh", "-3", str(path), "-o", str(out), "-format", "msh22", "-v", "1"], check=True)
    read = temper.read(out)
    points, tetrahedra = np.array(read.points), np.array(read.tetrahedra)
    return temper.TetMesh(points, tetrahedra, regions=case.region_of(points[tetrahedra].mean(axis=1)) + 1)


def tensor_of(case, mesh):
    k = np.array(case.tensors)[mesh.regions - 1]
    return k[:, [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]]


# --- two-point fluxes -------------------------------------------------------------------------------------------------


def face_numbers(mesh, faces):
    """The number of each halfface among sorted faces."""
    n = np.int64(len(mesh.points))
    key = lambda rows: (rows[:, 0] * n + rows[:, 1]) * n + rows[:, 2]
    halffaces = np.sort(np.asarray(mesh.tetrahedra, dtype=np.int64)[:, FACES].reshape(-1, 3), axis=1)
    return np.searchsorted(key(faces.astype(np.int64)), key(halffaces))


def solve(mesh, dual, centers, halves, given, sources=0.0):
    """Values in the tetrahedra, from halves of transmissibilities, values on the boundary, and sources."""
    number = face_numbers(mesh, dual.faces.vertices)
    resistance = np.bincount(number, 1 / halves, minlength=len(dual.faces))
    t = 1 / resistance
    inside = ~dual.faces.is_boundary
    behind, ahead = dual.faces.tetrahedra.T
    cell = np.where(behind >= 0, behind, ahead)
    i, j, ti, b, tb = behind[inside], ahead[inside], t[inside], cell[~inside], t[~inside]
    n = len(centers)
    rows, columns = np.r_[i, j, i, j, b], np.r_[i, j, j, i, b]
    matrix = scipy.sparse.csc_matrix((np.r_[ti, ti, -ti, -ti, tb], (rows, columns)), shape=(n, n))
    right = np.zeros(n) + sources
    np.add.at(right, b, tb * given[~inside])
    return scipy.sparse.linalg.spsolve(matrix, right)


def error_of(case, mesh, dual, centers, halves, feet):
    behind, ahead = dual.faces.tetrahedra.T
    region = mesh.regions - 1
    given = case.pressure(feet, region[np.where(behind >= 0, behind, ahead)])
    exact = case.pressure(centers, region)
    sources = case.sources(mesh, dual.volumes) if isinstance(case, Smooth) else 0.0
    error, v = solve(mesh, dual, centers, halves, given, sources) - exact, dual.volumes
    middle = (v * exact).sum() / v.sum()
    return np.sqrt((v * error**2).sum() / (v * (exact - middle) ** 2).sum())


def error_of_duals(case, mesh, tensor):
    d = temper.dec_operators(mesh, tensor=tensor)
    return error_of(case, mesh, d, d.orthocenters, d.half_transmissibility, d.faces.orthocenter)


def error_of_barycenters(case, mesh):
    """K n · d / |d|² times the area, with d from the barycenter to the barycenter of the face."""
    d = temper.dec_operators(mesh)
    points, corners = np.asarray(mesh.points), np.asarray(mesh.tetrahedra)
    k = np.array(case.tensors)[mesh.regions - 1]
    centers = points[corners].mean(axis=1)
    halves = np.empty(4 * len(corners))
    for f in range(4):
        a, b, c = (points[corners[:, i]] for i in FACES[f])
        normal = np.cross(b - a, c - a) / 2
        way = (a + b + c) / 3 - centers
        normal *= np.sign((normal * way).sum(axis=1))[:, None]
        halves[f::4] = np.einsum("ti,tij,tj->t", normal, k, way) / (way**2).sum(axis=1)
    return error_of(case, mesh, d, centers, halves, points[d.faces.vertices].mean(axis=1))


def gaps(mesh, tensor):
    """The two sides of interface faces differ by so much of an edge, at most: at crossings of edges, and at centers."""
    weights = mesh.cell_data.get("corner_weights")
    if weights is None:
        return 0.0, 0.0
    points, corners = np.asarray(mesh.points), np.asarray(mesh.tetrahedra)
    full = tensor[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)
    metric = np.linalg.inv(full) * np.cbrt(np.linalg.det(full))[:, None, None]
    sides, of_edges, of_faces = {}, 0.0, 0.0
    for t, region in enumerate(mesh.regions):
        for f in FACES:
            order = f[np.argsort(corners[t, f])]
            key = tuple(corners[t, order])
            other = sides.pop(key, None)
            if other is None:
                sides[key] = (t, order)
            elif mesh.regions[other[0]] != region:
                found = [feet_and_center(points[list(key)], metric[s], weights[s, o]) for s, o in (other, (t, order))]
                longest = max(np.linalg.norm(points[key[i]] - points[key[i - 1]]) for i in range(3))
                of_edges = max(of_edges, np.abs(found[0][0] - found[1][0]).max())
                of_faces = max(of_faces, np.linalg.norm(found[0][1] - found[1][1]) / longest)
    return of_edges, of_faces


def feet_and_center(points, metric, weights):
    """d/ℓ of the edges of a triangle, and its orthocenter."""
    u, v = points[1] - points[0], points[2] - points[0]
    feet = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        e = points[j] - points[i]
        feet.append(0.5 + (weights[i] - weights[j]) / (2 * e @ metric @ e))
    uv = np.array([u, v])
    right = [(u @ metric @ u + weights[0] - weights[1]) / 2, (v @ metric @ v + weights[0] - weights[2]) / 2]
    return np.array(feet), points[0] + np.linalg.solve(uv @ metric @ uv.T, right) @ uv


class Smooth:
    """Three level layers. Around its lower or upper interface at z₀, with pressure f and upward flux s there, a layer has
    u = f + (z − z₀) (s − kxz ∂f/∂x − kyz ∂f/∂y)/kzz + (z − z₀)² g. So pressure and flux are continuous."""

    HEIGHTS = (1 / 3, 2 / 3)

    def __init__(self, ratio):
        import sympy

        x, y, z = self.axes = sympy.symbols("x y z")
        flat = planes("smooth", (0, 0, 1), [h - 0.5 for h in self.HEIGHTS], [isotropic_in_plane((0, 0, 1), ratio, i) for i in range(3)])
        self.geometry, self.region_of, self.tensors = flat.geometry, flat.region_of, flat.tensors
        low, high = (sympy.Rational(i, 3) for i in (1, 2))
        grad = lambda u: [sympy.diff(u, axis) for axis in self.axes]
        flux = lambda k, u: [sum(float(k[i, j]) * grad(u)[j] for j in range(3)) for i in range(3)]

        def layer(k, f, s, at, g):
            across = s - float(k[0, 2]) * sympy.diff(f, x) - float(k[1, 2]) * sympy.diff(f, y)
            return f + (z - at) * across / float(k[2, 2]) + (z - at) ** 2 * g

        f, s = sympy.sin(2 * x + 0.3) * sympy.cos(y), sympy.cos(1.5 * x + y)
        layers = [layer(self.tensors[i], f, s, low, sympy.cos(x + i) + y) for i in (0, 1)]
        middle = layers[1]
        up = flux(self.tensors[1], middle)[2].subs(z, high)
        layers.append(layer(self.tensors[2], middle.subs(z, high), up, high, sympy.sin(x + y)))
        sources = [-sum(sympy.diff(q, axis) for q, axis in zip(flux(k, u), self.axes)) for k, u in zip(self.tensors, layers)]
        self.u = [sympy.lambdify(self.axes, u) for u in layers]
        self.f = [sympy.lambdify(self.axes, source) for source in sources]

    @staticmethod
    def at(functions, places, region):
        values = np.empty(len(places))
        for i, function in enumerate(functions):
            values[region == i] = function(*places[region == i].T)
        return values

    def pressure(self, places, region):
        return self.at(self.u, places, region)

    def sources(self, mesh, volumes):
        """Integrals over tetrahedra, by the rule of four points that is exact for degree 2."""
        corners = np.asarray(mesh.points)[np.asarray(mesh.tetrahedra)]
        near, far = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
        places = [far * corners.sum(axis=1) + (near - far) * corners[:, i] for i in range(4)]
        return volumes * sum(self.at(self.f, p, mesh.regions - 1) for p in places) / 4


def smooth_table(size, ratios):
    head = ("ratio", "size", "tetrahedra", "bad", "error", "barycenters", "quotient", "order", "seconds")
    print("{:>5} {:>6} {:>10} {:>13} {:>8} {:>11} {:>8} {:>5} {:>7}".format(*head))
    with tempfile.TemporaryDirectory() as folder:
        for ratio in ratios:
            problem, before = Smooth(ratio), None
            for level in range(4):
                h = size / np.sqrt(2) ** level
                mesh = meshed(problem, h, folder)
                on_barycenters = error_of_barycenters(problem, mesh)
                bad = temper.dec_operators(mesh, tensor=tensor_of(problem, mesh)).summarize().not_well_centered
                start = time.perf_counter()
                temper.optimize(mesh, target="cell", tensor=tensor_of(problem, mesh), boundary="slide", progress=False)
                seconds = time.perf_counter() - start
                tensor = tensor_of(problem, mesh)
                error = error_of_duals(problem, mesh, tensor)
                after = temper.dec_operators(mesh, tensor=tensor).summarize().not_well_centered
                width = mesh.n_tetrahedra ** (-1 / 3)
                order = "" if before is None else f"{np.log(before[0] / error) / np.log(before[1] / width):5.2f}"
                print(
                    f"{ratio:5g} {h:6.3f} {mesh.n_tetrahedra:10d} {bad:6d} {after:6d} {error:8.1e} {on_barycenters:11.1e} "
                    f"{error / on_barycenters:8.3f} {order:>5} {seconds:7.2f}",
                    flush=True,
                )
                before = error, width


def table(size, ratios, names):
    head = ("case", "ratio", "tetrahedra", "bad", "edges", "faces", "error", "barycenters", "seconds")
    print("{:<10} {:>5} {:>10} {:>13} {:>8} {:>8} {:>8} {:>11} {:>7}".format(*head))
    with tempfile.TemporaryDirectory() as folder:
        for ratio in ratios:
            for case in (case for case in cases(ratio) if not names or case.name in names):
                mesh = meshed(case, size, folder)
                on_barycenters = error_of_barycenters(case, mesh)
                before = temper.dec_operators(mesh, tensor=tensor_of(case, mesh)).summarize().not_well_centered
                start = time.perf_counter()
                temper.optimize(mesh, tensor=tensor_of(case, mesh), boundary="slide", progress=False)
                seconds = time.perf_counter() - start
                tensor = tensor_of(case, mesh)
                after = temper.dec_operators(mesh, tensor=tensor).summarize().not_well_centered
                of_edges, of_faces = gaps(mesh, tensor)
                error = error_of_duals(case, mesh, tensor)
                print(
                    f"{case.name:<10} {ratio:5g} {mesh.n_tetrahedra:10d} {before:6d} {after:6d} {of_edges:8.1e} "
                    f"{of_faces:8.1e} {error:8.1e} {on_barycenters:11.1e} {seconds:7.2f}",
                    flush=True,
                )
