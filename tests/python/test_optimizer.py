"""Optimizer: a mesh that changes a little at a time."""

import numpy as np
import pytest

import temper


def plane(n=900, seed=3):
    mesh = temper.generate.random_mesh(n, seed=seed)
    temper.optimize(mesh, progress=False)
    return mesh


def cube(side=6):
    """A body-centered lattice without its outermost centers, by Delaunay's cells of the public generator of tests."""
    from itertools import product

    number, points, tets = {}, [], []

    def vertex(p):
        if p not in number:
            number[p] = len(points)
            points.append(p)
        return number[p]

    for x, y, z in product(range(side), repeat=3):
        center = vertex((2 * x + 1, 2 * y + 1, 2 * z + 1))
        for axis in range(3):
            step = [0, 0, 0]
            step[axis] = 2
            other_center = (2 * x + 1 + step[0], 2 * y + 1 + step[1], 2 * z + 1 + step[2])
            if other_center[axis] > 2 * side:
                continue
            middle = np.add((2 * x + 1, 2 * y + 1, 2 * z + 1), np.array(step) // 2)
            ring = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = middle.copy()
                corner[(axis + 1) % 3] += a
                corner[(axis + 2) % 3] += b
                ring.append(vertex(tuple(int(c) for c in corner)))
            for a, b in zip(ring, ring[1:] + ring[:1]):
                tets.append((a, b, center, vertex(other_center)))
    return temper.TetMesh(np.array(points, dtype=float), tets)


def inner(mesh):
    inside = np.ones(mesh.n_vertices, dtype=bool)
    if isinstance(mesh, temper.Mesh):
        inside[mesh.boundary_edges.ravel()] = False
    else:
        t, f = np.nonzero(mesh.neighbors < 0)
        for corner in range(4):
            inside[mesh.tetrahedra[t, corner][f != corner]] = False
    return np.flatnonzero(inside)


def is_good(mesh):
    q = temper.quality(mesh)
    return q.well_centered_fraction == 1 if isinstance(mesh, temper.Mesh) else q.orthocenters_outside == 0


def violations(mesh, target):
    q = temper.quality(mesh)
    if target == "any":
        return 0 if is_good(mesh) else 1
    if target == "cell":
        return q.nonpositive_distances
    return q.negative_coefficients if isinstance(mesh, temper.TetMesh) else q.non_regular_edges + q.negative_boundary_duals


def entries(mesh, numbers):
    """The dual lengths or areas of the edges at each vertex, by the numbers given."""
    operators = temper.dec_operators(mesh)
    rows = {int(numbers[v]): {} for v in range(mesh.n_vertices)}
    for (a, b), value in zip(operators.edges.vertices, operators.star1):
        rows[int(numbers[a])][int(numbers[b])] = value
        rows[int(numbers[b])][int(numbers[a])] = value
    return rows


def disturb(mesh, optimizer, share, amount, seed):
    rng = np.random.default_rng(seed)
    some = rng.choice(inner(mesh), max(1, int(share * mesh.n_vertices)), replace=False)
    by = rng.uniform(-amount, amount, (len(some), mesh.points.shape[1]))
    optimizer.move(some, mesh.points[some] + by)
    return some


MESHES = {"triangles": (plane, 0.02), "tetrahedra": (cube, 0.6)}


@pytest.mark.parametrize("cells", MESHES)
def test_a_good_mesh_comes_back_as_it_was(cells):
    mesh = MESHES[cells][0]()
    optimizer = temper.Optimizer(mesh)
    assert is_good(mesh)
    before = mesh.copy()
    update = optimizer.update()
    assert mesh == before
    assert update.report.sweeps == 0
    assert all(len(part) == 0 for part in (update.vertices, update.moved, update.weighed, update.cells, update.rows))


@pytest.mark.parametrize("cells", MESHES)
def test_updates_make_the_mesh_good_and_name_all_rows_that_changed(cells):
    make, amount = MESHES[cells]
    mesh = make()
    optimizer = temper.Optimizer(mesh)
    same = spoiled = 0
    for step in range(3):
        before = mesh.copy()
        disturb(mesh, optimizer, 0.01, amount, step)
        update = optimizer.update()
        spoiled += update.report.bad_before
        assert is_good(mesh)
        assert mesh.validate() is None
        numbers = update.vertices if len(update.vertices) else np.arange(mesh.n_vertices)
        old, new = entries(before, np.arange(before.n_vertices)), entries(mesh, numbers)
        changed = set(numbers[update.rows].tolist())
        for v in range(before.n_vertices):
            if v not in changed:
                assert old[v] == new[v]
                same += 1
        kept = np.flatnonzero(numbers >= 0)
        moved = kept[(mesh.points[kept] != before.points[numbers[kept]]).any(axis=1)]
        weighed = kept[mesh.weights[kept] != before.weights[numbers[kept]]]
        assert update.moved.tolist() == moved.tolist()
        assert update.weighed.tolist() == weighed.tolist()
    assert same > mesh.n_vertices
    assert spoiled > 5


@pytest.mark.parametrize("cells", MESHES)
def test_bytes_do_not_depend_on_threads(cells):
    make, amount = MESHES[cells]
    results = []
    for threads in (1, 2):
        mesh = make()
        optimizer = temper.Optimizer(mesh, threads=threads)
        for step in range(2):
            disturb(mesh, optimizer, 0.02, amount, step)
            optimizer.update()
        results.append(mesh)
    assert results[0] == results[1]


@pytest.mark.parametrize("cells", MESHES)
def test_vertices_that_are_inserted_come_last_and_others_go(cells):
    mesh = MESHES[cells][0]()
    before = mesh.copy()
    optimizer = temper.Optimizer(mesh)
    gone = inner(mesh)[[3, 40]]
    cell = (mesh.triangles if cells == "triangles" else mesh.tetrahedra)[[100, 20]]
    new = before.points[cell].mean(axis=1)
    optimizer.remove(gone)
    optimizer.insert(new)
    update = optimizer.update()
    assert mesh.validate() is None
    assert is_good(mesh)
    kept = update.vertices >= 0
    assert set(range(before.n_vertices)) - set(update.vertices[kept].tolist()) >= set(gone.tolist())
    first = int(np.flatnonzero(~kept)[0])
    assert not kept[first:].any()
    assert np.abs(mesh.points[first : first + 2] - new).max() < 1
    assert set(range(first, mesh.n_vertices)) <= set(update.rows.tolist())


def test_a_vertex_goes_any_distance_and_takes_no_other_along():
    mesh = plane()
    optimizer = temper.Optimizer(mesh, keep="positions")
    v = inner(mesh)[10]
    others = np.delete(np.arange(mesh.n_vertices), v)
    center = mesh.points.mean(axis=0)
    before = mesh.points.copy()
    for goal in (center + 0.3, center - 0.3, center + (0.31, -0.29)):
        optimizer.move([v], [goal])
        optimizer.update()
        assert mesh.points[v].tolist() == goal.tolist()
        assert mesh.validate() is None
        assert temper.topology.count_non_regular_edges(mesh, with_constrained=False) == 0
        assert (mesh.points[others] == before[others]).all()


def test_a_flow_carries_all_points():
    mesh = plane()
    optimizer = temper.Optimizer(mesh)
    inside = inner(mesh)
    center = mesh.points.mean(axis=0)
    for _ in range(5):
        x = mesh.points[inside] - center
        angle = 0.1 * np.maximum(0, 1 - (np.linalg.norm(x, axis=1) / 0.45) ** 2)
        c, s = np.cos(angle), np.sin(angle)
        optimizer.move(inside, center + np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1]], axis=1))
        update = optimizer.update()
        inside = inner(mesh)
        assert update.report.bad_after == 0
        assert mesh.validate() is None


@pytest.mark.parametrize(
    "change, words",
    [
        (lambda o: o.move([0], [(50.0, 0.0)]), "cannot move"),
        (lambda o: o.insert([(50.0, 0.0)]), "outside the mesh"),
        (lambda o: o.insert([tuple(o.mesh.points[7])]), "a vertex is there"),
        (lambda o: o.insert([(np.nan, 0.0)]), "finite"),
        (lambda o: o.move([7], [(np.inf, 0.0)]), "finite"),
        (lambda o: o.set_weights([7], [np.inf]), "finite"),
    ],
)
def test_an_impossible_change_leaves_the_mesh_and_all_changes_wait(change, words):
    mesh = plane(300)
    before = mesh.copy()
    optimizer = temper.Optimizer(mesh)
    v = inner(mesh)[5]
    optimizer.move([v], [before.points[v] + 0.001])
    change(optimizer)
    for _ in range(2):
        with pytest.raises(temper.TemperError, match=words):
            optimizer.update()
        assert mesh == before
    optimizer.forget()
    optimizer.move([v], [before.points[v] + 0.001])
    assert v in optimizer.update().moved


def test_numbers_and_shapes_are_checked_at_once():
    mesh = plane(300)
    optimizer = temper.Optimizer(mesh)
    with pytest.raises(temper.TemperError, match="vertex 9999 is not in the mesh"):
        optimizer.move([9999], [(0, 0)])
    with pytest.raises(temper.TemperError, match="expected 2, one for each vertex, found 1"):
        optimizer.move([1, 2], [(0, 0)])
    with pytest.raises(ValueError, match="points"):
        optimizer.move([1], [(0, 0, 0)])
    with pytest.raises(TypeError, match="mesh"):
        temper.Optimizer(mesh.points)
    with pytest.raises(temper.TemperError, match="change"):
        temper.Optimizer(mesh, options={"energy": "F"})


def test_weights_that_hide_a_vertex_change():
    mesh = plane(300)
    optimizer = temper.Optimizer(mesh)
    v = inner(mesh)[5]
    optimizer.set_weights([v], [-1.0])
    update = optimizer.update()
    assert v in update.weighed
    assert mesh.weights[v] > -1
    assert update.report.bad_after == 0


@pytest.mark.parametrize("target", ["any", "vertex", "cell"])
@pytest.mark.parametrize("make", [plane, lambda: cube(8)])
def test_an_update_changes_few_vertices(make, target):
    mesh = make()
    temper.optimize(mesh, target=target, progress=False)
    optimizer = temper.Optimizer(mesh, target=target)
    cells = mesh.triangles if isinstance(mesh, temper.Mesh) else mesh.tetrahedra
    amount = 0.2 * np.median(np.linalg.norm(mesh.points[cells[:, 0]] - mesh.points[cells[:, 1]], axis=1))
    for step in range(5):
        disturb(mesh, optimizer, 0.01, amount, step)
        update = optimizer.update()
        assert violations(mesh, target) == 0
        assert len(np.union1d(update.moved, update.weighed)) <= 0.05 * mesh.n_vertices


@pytest.mark.parametrize("make", [lambda: temper.generate.random_sphere(500), lambda: temper.generate.random_periodic(500)])
def test_other_surfaces(make):
    mesh = make()
    temper.optimize(mesh, progress=False)
    optimizer = temper.Optimizer(mesh)
    rng = np.random.default_rng(1)
    for _ in range(3):
        some = rng.choice(mesh.n_vertices, 5, replace=False)
        optimizer.move(some, mesh.points[some] + rng.uniform(-0.01, 0.01, (5, mesh.points.shape[1])))
        update = optimizer.update()
        assert update.report.bad_after == 0
        assert mesh.validate() is None


def test_a_size_field_moves_through_a_mesh():
    mesh = plane()
    coarse = 1.2 * np.median(temper.size.local_size(mesh))
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    optimizer = temper.Optimizer(mesh)
    for step in range(4):
        center = low + (high - low) * (0.2 + 0.2 * step, 0.5)
        sizes = np.minimum(coarse, 0.4 * coarse + 0.3 * np.linalg.norm(mesh.points - center, axis=1))
        field = temper.SizeField.from_values(mesh, sizes)
        optimizer.resize(field)
        before = mesh.copy()
        update = optimizer.update()
        assert is_good(mesh) and mesh.validate() is None
        over = temper.size.measure_size(mesh, field).over_field
        assert over.p05 > 1 / np.sqrt(2) and over.p95 < np.sqrt(2)
        old = update.vertices >= 0
        assert 0 < old.sum() < before.n_vertices and not old.all()
        stayed = np.setdiff1d(np.flatnonzero(old), update.moved)
        assert np.array_equal(mesh.points[stayed], before.points[update.vertices[stayed]])
        far = np.linalg.norm(mesh.points - center, axis=1) > 0.5 * np.linalg.norm(high - low)
        assert np.isin(np.flatnonzero(far), update.rows).mean() < 0.7 or step == 0
    with pytest.raises(TypeError, match="size_field: expected a SizeField, found float"):
        optimizer.resize(0.1)
    with pytest.raises(TypeError, match="triangles alone"):
        temper.Optimizer(cube(2)).resize(field)
    optimizer.resize(temper.size.input_size_field(temper.generate.random_sphere(50)))
    with pytest.raises(temper.TemperError, match="another space"):
        optimizer.update()
    optimizer.forget()
    assert len(optimizer.update().rows) == 0
