"""Diffusion tensors: meshes in the metric, and two-point fluxes that converge there and nowhere else.

    test_tensor.py    prints errors and orders of convergence on the public meshes
"""

import numpy as np
import pytest
from conftest import PUBLIC_MESHES

import temper

K = (1.0, 0.0, 100.0)
ONE = (1.0, 0.0, 1.0)
MESHES = ["skfem_square.msh", "mfem_square-disc.mesh", "sfepy_its2D.mesh"]


def matrix(tensor):
    return np.array([[tensor[0], tensor[1]], [tensor[1], tensor[2]]])


def optimized(mesh, tensor):
    """Well-centered in the metric of the tensor; boundary edges that are long there are cut."""
    better = mesh.copy()
    temper.optimize(better, tensor=tensor, boundary="split")
    return better


def refined(mesh):
    """Every triangle cut in four."""
    points, triangles = np.asarray(mesh.points), np.asarray(mesh.triangles)
    sides = np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    a, b, c = number.reshape(3, -1) + len(points)
    i, j, k = triangles.T
    children = [np.column_stack(t) for t in [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]]
    return temper.Mesh(np.vstack([points, points[edges].mean(axis=1)]), np.vstack(children))


def wave(points, size):
    """A solution, and its gradient."""
    k, phase = np.array([1.3, 2.2]) / size, 0.5
    angle = points @ k + phase
    return np.sin(angle), np.cos(angle)[..., None] * k


def flux_error(mesh, tensor, dual):
    """The relative L2 error of −div(K ∇u) = f by two-point fluxes between orthocenters: of the metric of `dual`, which are
    K-orthogonal when that is K; else with the conductivity along the normal, as is usual."""
    from scipy import sparse
    from scipy.sparse.linalg import spsolve

    points = np.asarray(mesh.points)
    size = np.ptp(points, axis=0).max() / 2
    complex = temper.dec_operators(mesh, tensor=dual)
    ends, sides = complex.edges.vertices, complex.edges.triangles
    along = points[ends[:, 1]] - points[ends[:, 0]]
    normal = np.column_stack([along[:, 1], -along[:, 0]])  # to the right, times the length
    flux = np.clip(complex.transmissibility, -1e9, 1e9)  # orthocenters that coincide have one value
    if tuple(dual) != tuple(tensor):
        flux = flux * ((normal @ matrix(tensor)) * normal).sum(axis=1) / (normal**2).sum(axis=1)
    flow = np.zeros(len(ends))  # of K ∇u to the right, by Gauss
    for at, weight in zip(*np.polynomial.legendre.leggauss(5)):
        _, gradient = wave(points[ends[:, 0]] + (1 + at) / 2 * along, size)
        flow += weight / 2 * ((gradient @ matrix(tensor)) * normal).sum(axis=1)
    left, right = sides[:, 0], sides[:, 1]
    n = len(complex.areas)
    given = wave(complex.edges.midpoint, size)[0]
    rhs, diagonal, rows, columns, values = np.zeros(n), np.zeros(n), [], [], []
    for here, there, sign in [(left, right, -1), (right, left, 1)]:
        has = here >= 0
        np.add.at(rhs, here[has], sign * flow[has])
        np.add.at(diagonal, here[has], flux[has])
        outer = has & (there < 0)
        np.add.at(rhs, here[outer], (flux * given)[outer])
        inner = has & (there >= 0)
        rows.append(here[inner]), columns.append(there[inner]), values.append(-flux[inner])
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    system = sparse.csc_matrix(entries, (n, n)) + sparse.diags(diagonal, format="csc")
    exact = wave(np.asarray(complex.orthocenters), size)[0]
    error = spsolve(system, rhs) - exact
    return np.sqrt((complex.areas * error**2).sum() / (complex.areas * exact**2).sum())


def errors_of(mesh, tensor, dual, levels=3):
    """Of a mesh, and of its refinements, each optimized in the metric of `dual`."""
    errors = []
    for level in range(levels):
        mesh = optimized(refined(mesh) if level else mesh, dual)
        errors.append(flux_error(mesh, tensor, dual))
    return np.array(errors)


def order(errors):
    """The mean over the levels."""
    return np.log2(errors[0] / errors[-1]) / (len(errors) - 1)


def test_there_and_back_keeps_what_stayed_bit_for_bit():
    mesh = temper.generate.random_mesh(200)
    tensor = (3.0, 1.1, 0.7)
    there = temper.mapped(mesh, tensor)
    assert np.array_equal(temper.mapped_back(there, mesh, tensor).points, mesh.points)
    better = optimized(mesh, tensor)
    boundary = np.unique(mesh.boundary_edges)
    assert np.array_equal(np.asarray(better.points)[boundary], np.asarray(mesh.points)[boundary])
    assert not np.array_equal(better.points, mesh.points)
    assert temper.quality(temper.mapped(better, tensor)).well_centered_fraction == 1
    q = np.asarray(there.points) @ np.asarray(there.points).T
    x = np.asarray(mesh.points)
    assert np.allclose(q, np.sqrt(np.linalg.det(matrix(tensor))) * x @ np.linalg.inv(matrix(tensor)) @ x.T)


def test_a_run_in_the_metric_is_the_run_of_the_mapped_mesh():
    mesh = temper.generate.random_mesh(150)
    there = temper.mapped(mesh, K)
    report = temper.optimize(there, boundary="split")
    better = mesh.copy()
    same = temper.optimize(better, tensor=K, boundary="split")
    assert better == temper.mapped_back(there, mesh, K, report.vertices)
    assert [record.energy for record in same.history] == [record.energy for record in report.history]
    size = temper.SizeField.from_values(mesh, np.ones(mesh.n_vertices))
    before = better.copy()
    for name, wrong in [("tracer", {"hooks": temper.Hooks(tracer=print)}), ("size_field", {"size_field": size})]:
        with pytest.raises(ValueError, match=f"{name}: is of the mesh's plane"):
            temper.optimize(better, tensor=K, **wrong)
    with pytest.raises(temper.TemperError, match="tensor: expected"):
        temper.optimize(better, tensor=(1, 2, 1))
    with pytest.raises(temper.TemperError, match="sphere"):
        temper.optimize(temper.generate.random_sphere(vertices=50), tensor=K)
    assert better == before


def test_operators_of_a_tensor_are_k_orthogonal_and_have_its_energy():
    tensor = (3.0, 1.1, 0.7)
    mesh = optimized(temper.generate.random_mesh(200), tensor)
    c = temper.dec_operators(mesh, tensor=tensor)
    points, edges = np.asarray(mesh.points), c.edges
    inner = ~edges.is_boundary
    along = (points[edges.vertices[:, 1]] - points[edges.vertices[:, 0]])[inner]
    dual = (c.orthocenters[edges.triangles[:, 0]] - c.orthocenters[edges.triangles[:, 1]])[inner]
    assert np.abs((along @ np.linalg.inv(matrix(tensor)) * dual).sum(axis=1)).max() < 1e-12
    assert np.isclose(c.star0.sum(), temper.dec_operators(mesh).areas.sum()) and np.allclose(c.areas, temper.dec_operators(mesh).areas)
    assert np.isclose(c.power_cells().areas.sum(), c.areas.sum())
    slope = np.array([0.3, -0.8])
    u = points @ slope
    residual = c.laplacian() @ u
    free = np.setdiff1d(np.arange(len(points)), mesh.boundary_edges)
    assert np.abs(residual[free]).max() < 1e-11, "linear functions are in the kernel"
    plain = mesh.copy()
    plain.weights = np.zeros(len(points))
    energy = u @ (temper.dec_operators(plain, tensor=tensor).laplacian() @ u)
    assert np.isclose(energy, c.areas.sum() * slope @ matrix(tensor) @ slope), "u·Lu = ∫ ∇u·K∇u"
    with pytest.raises(temper.TemperError, match="sphere"):
        temper.dec_operators(temper.generate.random_sphere(vertices=50), tensor=tensor)
    for wrong in [(1, 2, 1), (-1, 0, 1), (1, 0, np.nan), (1, 0, 1e9)]:
        with pytest.raises(temper.TemperError, match="tensor: expected"):
            temper.mapped(mesh, wrong)


@pytest.mark.parametrize("name", ["", *MESHES])
def test_fluxes_converge_with_orthocenters_of_the_metric_and_not_with_those_of_the_plane(name):
    pytest.importorskip("scipy")
    if name and not (PUBLIC_MESHES / name).exists():
        pytest.skip("public meshes are not here")
    mesh = temper.read(PUBLIC_MESHES / name) if name else temper.generate.random_mesh(150)
    of_one, of_k, of_plane = errors_of(mesh, ONE, ONE), errors_of(mesh, K, K), errors_of(mesh, K, ONE)
    assert order(of_one) > 1.7 and order(of_k) > 1.7, (of_one, of_k)
    assert order(of_plane) < 0.2 and of_plane[-1] > 10 * of_k[-1], (of_plane, of_k)


def main():
    print("| mesh | K = 1 | order | K, orthocenters of its metric | order | K, of the plane | order |")
    print("|-|-|-|-|-|-|-|")
    for name in MESHES:
        cells = [name.split(".")[0]]
        for tensor, dual in [(ONE, ONE), (K, K), (K, ONE)]:
            errors = errors_of(temper.read(PUBLIC_MESHES / name), tensor, dual, levels=4)
            cells += [", ".join(f"{e:.2g}" for e in errors), f"{order(errors):.2f}"]
        print("| " + " | ".join(cells) + " |")



def layered(n=3, ratio=10.0):
    """A square of tilted layers with turned tensors, and a pressure that is linear in each: its gradients and constants."""
    points, segments, places = [], [], []
    heights = np.linspace(0, 1, n + 1)
    for i, height in enumerate(heights):
        lift = 0.06 if 0 < i < n else 0.0
        points += [(0.0, height - lift), (1.0, height + lift)]
        segments.append((2 * i, 2 * i + 1))
        if i > 0:
            segments += [(2 * i - 2, 2 * i), (2 * i - 1, 2 * i + 1)]
            places.append((0.5, (heights[i - 1] + height) / 2, i, None))
    outline = temper.Outline(np.array(points), segments, regions=places)
    along = np.array([1.0, 0.12]) / np.hypot(1, 0.12)
    across = np.array([-along[1], along[0]])
    tensors, gradients, constants = {}, [], [0.0]
    for i in range(n):
        angle = np.radians(40 + 75 * i)
        axis = np.array([np.cos(angle), np.sin(angle)])
        k = np.eye(2) + (ratio - 1) * np.outer(axis, axis)
        tensors[i + 1] = (k[0, 0], k[0, 1], k[1, 1])
        gradients.append(0.7 * along + (0.4 - 0.7 * across @ k @ along) / (across @ k @ across) * across)
        if i > 0:
            constants.append(constants[-1] + (gradients[-2] - gradients[-1]) @ [0.5, heights[i]])
    return temper.mesh_outline(outline, 0.12, optimize=False).mesh, tensors, np.array(gradients), np.array(constants)


def error_of_linear_pressure(mesh, tensors, gradients, constants):
    """Two-point fluxes with values at the boundary: the largest error at orthocenters, over the range of the pressure."""
    d = temper.dec_operators(mesh, tensor=tensors)
    left, right = d.edges.triangles.T
    inside = ~d.edges.is_boundary
    cell = np.where(left >= 0, left, right)

    def pressure(places, triangles):
        region = mesh.regions[triangles] - 1
        return (gradients[region] * places).sum(axis=1) + constants[region]

    n, t = mesh.n_triangles, d.transmissibility
    rows = np.r_[left[inside], right[inside], left[inside], right[inside], cell[~inside]]
    columns = np.r_[left[inside], right[inside], right[inside], left[inside], cell[~inside]]
    matrix = np.zeros((n, n))
    np.add.at(matrix, (rows, columns), np.r_[t[inside], t[inside], -t[inside], -t[inside], t[~inside]])
    source = np.zeros(n)
    np.add.at(source, cell[~inside], (t * pressure(d.edges.midpoint, cell))[~inside])
    exact = pressure(d.orthocenters, np.arange(n))
    return abs(np.linalg.solve(matrix, source) - exact).max() / np.ptp(exact)


@pytest.mark.parametrize("n, ratio", [(2, 2.0), (3, 10.0), (5, 5.0)])
def test_two_point_fluxes_are_exact_for_a_pressure_that_is_linear_in_each_region(n, ratio):
    mesh, tensors, *pressure = layered(n, ratio)
    assert (temper.dec_operators(mesh, tensor=tensors).transmissibility < 0).any()
    temper.optimize(mesh, tensor=tensors, boundary="split", progress=False)
    assert error_of_linear_pressure(mesh, tensors, *pressure) < 1e-12
    weights = mesh.cell_data["corner_weights"]
    assert weights.shape == (mesh.n_triangles, 3)
    d = temper.dec_operators(mesh, tensor=tensors)
    assert (d.star1 > 0).all() and (d.half_transmissibility > 0).all()
    resistance = np.zeros(len(d.edges))
    np.add.at(resistance, d.edge_of_halfedge, 1 / d.half_transmissibility)
    assert np.allclose(1 / resistance, d.transmissibility, rtol=1e-12)
    assert np.isclose(d.star0.sum(), 1) and np.isclose(d.power_cells().areas.sum(), 1)


def test_weights_for_regions_keep_the_equations_of_interfaces():
    mesh, tensors, *pressure = layered(3, 1.5)
    report = temper.find_weights(mesh, goal="elastic", tensor=tensors)
    mesh.cell_data["corner_weights"] = report.corner_weights
    assert (report.corner_weights != 0).any()
    assert error_of_linear_pressure(mesh, tensors, *pressure) < 1e-12
    with pytest.raises(temper.TemperError, match="goal: center, accuracy, least and fewest have no equations"):
        temper.find_weights(mesh, goal="least", tensor=tensors)


def test_proofs_with_tensors_are_checked_with_them():
    mesh, tensors, *_ = layered(3)
    proof = temper.find_weights(mesh, goal="margin", tensor=tensors).certificate
    assert temper.check_certificate(mesh, proof, tensor=tensors) == "proves"
    assert temper.check_certificate(mesh, proof) != "proves"
    assert temper.types.Certificate.from_json(proof.to_json()) == proof
    searched = temper.types.ConnectivityProof("well_centered", [])
    with pytest.raises(ValueError, match="tensor: proofs over connectivities are for meshes without tensors"):
        temper.check_certificate(mesh, searched, tensor=tensors)


def test_equal_tensors_of_regions_are_one_tensor():
    mesh, *_ = layered(3)
    copy = mesh.copy()
    temper.optimize(mesh, tensor=(1.0, 0.0, 3.0), progress=False)
    temper.optimize(copy, tensor=dict.fromkeys((1, 2, 3), (1.0, 0.0, 3.0)), progress=False)
    assert mesh == copy
    values = np.tile([1.0, 0.0, 3.0], (mesh.n_triangles, 1))
    assert np.array_equal(temper.dec_operators(mesh, tensor=values).star1, temper.dec_operators(mesh, tensor=(1.0, 0.0, 3.0)).star1)


def test_wrong_tensors_of_regions_are_told():
    mesh, tensors, *_ = layered(2)
    with pytest.raises(ValueError, match="tensor: expected a value for each of the regions 1, 2; there is none for"):
        temper.dec_operators(mesh, tensor={1: (1, 0, 1)})
    with pytest.raises(ValueError, match="tensor: expected kxx, kxy, kyy, or one for each triangle"):
        temper.dec_operators(mesh, tensor=np.ones((5, 3)))
    with pytest.raises(temper.TemperError, match="triangle 0: tensor: expected a positive definite tensor"):
        temper.dec_operators(mesh, tensor=np.zeros((mesh.n_triangles, 3)))


# --- tetrahedra -------------------------------------------------------------------------------------------------------


def cubes_in_layers(n=3):
    """Cubes of six tetrahedra around a diagonal, inner vertices moved; regions 1 and 2 below and above z = 1."""
    grid = np.stack(np.meshgrid(*[np.arange(n + 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    number = lambda p: (p[..., 0] * (n + 1) + p[..., 1]) * (n + 1) + p[..., 2]
    base = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    tets = []
    for order in [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]:
        corners = [base]
        for axis in order:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        tets.append(number(np.stack(corners, axis=1)))
    tets = np.concatenate(tets)
    regions = 1 + (grid[tets].mean(axis=1)[:, 2] > 1)
    free = ((grid > 0) & (grid < n)).all(axis=1) & (grid[:, 2] != 1)
    grid[free] += 0.1 * np.random.default_rng(2).uniform(-1, 1, (free.sum(), 3))
    return temper.TetMesh(grid, tets, regions=regions)


LAYERS = {1: (1, 0, 0, 1, 0, 0.2), 2: (3, 0, 0, 3, 0, 9)}


def test_scalar_tensors_of_tetrahedra_are_a_coefficient():
    mesh = cubes_in_layers()
    scalar = {1: (2, 0, 0, 2, 0, 2), 2: (7, 0, 0, 7, 0, 7)}
    found, expected = temper.dec_operators(mesh, tensor=scalar), temper.dec_operators(mesh, coefficient={1: 2, 2: 7})
    assert np.allclose(found.star1, expected.star1, rtol=1e-12)
    assert np.allclose(found.transmissibility, expected.transmissibility, rtol=1e-12)
    of_cells = np.array([scalar[int(r)] for r in mesh.regions])
    assert np.array_equal(temper.dec_operators(mesh, tensor=of_cells).star1, found.star1)
    assert found.half_transmissibility.shape == (4 * mesh.n_tetrahedra,)
    assert len(expected.half_transmissibility) == 0


def test_operators_of_tetrahedra_with_tensors_can_be_pickled():
    import pickle

    found = temper.dec_operators(cubes_in_layers(), tensor=LAYERS)
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.transmissibility, found.transmissibility)


def test_tetrahedra_with_tensors_of_layers_get_corner_weights():
    mesh = cubes_in_layers()
    before = temper.dec_operators(mesh, tensor=LAYERS).summarize().not_well_centered
    report = temper.optimize(mesh, tensor=LAYERS, effort="quick")
    after = temper.dec_operators(mesh, tensor=LAYERS).summarize().not_well_centered
    assert after < before
    assert report.history[0].bad == before
    weights = mesh.cell_data["corner_weights"]
    assert weights.shape == (mesh.n_tetrahedra, 4)
    found = temper.find_weights(mesh, goal="elastic", tensor=LAYERS, constraints="distances")
    assert found.corner_weights.shape == weights.shape
    mesh.weights = found.corner_weights
    assert np.array_equal(mesh.cell_data["corner_weights"], found.corner_weights)
    mesh.weights = np.zeros(len(mesh.points))
    assert "corner_weights" not in mesh.cell_data


def test_wrong_tensors_of_tetrahedra_say_what_was_expected():
    mesh = cubes_in_layers(2)
    with pytest.raises(ValueError, match="tensor: expected kxx, kxy, kxz, kyy, kyz, kzz, found 3 numbers"):
        temper.dec_operators(mesh, tensor=(1, 0, 1))
    with pytest.raises(ValueError, match=r"one for each tetrahedron, shape \(48, 6\)"):
        temper.dec_operators(mesh, tensor=np.ones((4, 6)))
    with pytest.raises(temper.TemperError, match="positive definite"):
        temper.dec_operators(mesh, tensor=(1, 0, 0, -1, 0, 1))
    with pytest.raises(temper.TemperError, match="four for each of 48 tetrahedra"):
        mesh.weights = np.ones((3, 4))


if __name__ == "__main__":
    main()
