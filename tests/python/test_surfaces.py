"""Curved surfaces: from arrays, files and other libraries, and every function that takes them."""

import json
import pickle
import subprocess
import types

import numpy as np
import pytest
from conftest import optimized

import temper

sparse = pytest.importorskip("scipy.sparse")

AROUND, THROUGH = 20, 8


@pytest.fixture(scope="module")
def torus():
    """Trapezoids, each cut in two, with points moved along the torus, as in the tutorial."""
    i, j = np.divmod(np.arange(AROUND * THROUGH), THROUGH)
    u = 2 * np.pi * (i + 0.1 * np.sin(7 * i + 3 * j)) / AROUND
    v = 2 * np.pi * (j + 0.1 * np.cos(5 * i + 2 * j)) / THROUGH
    away = 1 + 0.4 * np.cos(v)
    follows, up = (i + 1) % AROUND * THROUGH, (j + 1) % THROUGH
    a, b, c, d = i * THROUGH + j, follows + j, follows + up, i * THROUGH + up
    corners = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    return temper.SurfaceMesh(np.column_stack([away * np.cos(u), away * np.sin(u), 0.4 * np.sin(v)]), corners)


@pytest.fixture(scope="module")
def better(torus):
    return optimized(torus)


def arrays_of_matrix(matrix):
    return matrix.starts, matrix.columns, matrix.signs


def test_the_arrays_of_a_mesh_are_those_it_was_made_from(torus):
    mesh = temper.SurfaceMesh(torus.points, torus.triangles, constrained_edges=[(1, 0)], fixed=[7], regions=np.zeros(320, int))
    assert np.array_equal(mesh.points, torus.points) and np.array_equal(mesh.triangles, torus.triangles)
    assert (mesh.n_vertices, mesh.n_triangles, mesh.n_edges, len(mesh.boundary_edges)) == (160, 320, 480, 0)
    assert np.sort(mesh.constrained_edges).tolist() == [[0, 1]] and mesh.fixed.tolist() == [7] and mesh.validate() is None
    assert mesh != torus and pickle.loads(pickle.dumps(mesh)) == mesh == mesh.copy()
    mesh.fixed = []
    mesh.set_constrained(mesh.constrained_edges, False)
    assert mesh == torus and repr(mesh) == "<temper.SurfaceMesh: 160 vertices, 320 triangles>"
    assert "temper.SurfaceMesh" in mesh._repr_html_() and mesh.find_halfedge(0, 1) in mesh.star(0)
    mesh.weights = np.arange(160.0)
    assert mesh.weights[7] == 7 and temper.weight_change(torus, torus.weights, mesh.weights) > 0


def test_a_plane_lifted_to_zero_has_the_results_of_the_plane(ring):
    lifted = temper.SurfaceMesh(np.column_stack([ring.points, np.zeros(ring.n_vertices)]), ring.triangles)
    flat, curved = temper.quality(ring), temper.quality(lifted)
    same = [name for name in ("orthocenters_outside", "edges_not_crossed", "non_regular_edges") if getattr(flat, name) == getattr(curved, name)]
    assert len(same) == 3 and curved.min_h_over_l == pytest.approx(flat.min_h_over_l)
    for goal in ("margin", "elastic"):
        one, two = temper.find_weights(ring, goal=goal), temper.find_weights(lifted, goal=goal)
        assert one.verdict == two.verdict and np.allclose(one.weights, two.weights, rtol=1e-9)
    assert temper.check_certificate(lifted, two.certificate) == temper.check_certificate(ring, one.certificate)
    assert temper.weight_margin(lifted) == pytest.approx(temper.weight_margin(ring))
    one, two = temper.dec_operators(ring), temper.dec_operators(lifted)
    for name in ("star0", "star1", "star2", "areas", "transmissibility"):
        assert np.allclose(getattr(one, name), getattr(two, name), rtol=1e-10, atol=0), name
    for name in ("d0", "d1"):
        assert all(map(np.array_equal, arrays_of_matrix(getattr(one, name)), arrays_of_matrix(getattr(two, name))))
    assert np.allclose(two.orthocenters[:, :2], one.orthocenters) and not two.orthocenters[:, 2].any()
    for name, values in vars(temper.triangle_quality(ring)).items():
        assert np.allclose(values, getattr(temper.triangle_quality(lifted), name)), name


def test_a_motion_changes_nothing_but_rounding(torus):
    turn, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    moved = temper.SurfaceMesh(torus.points @ turn.T + [1, 2, 3], torus.triangles)
    one, two = temper.dec_operators(torus), temper.dec_operators(moved)
    assert np.allclose(one.star1, two.star1, atol=1e-10) and np.allclose(one.orthocenters @ turn.T + [1, 2, 3], two.orthocenters, atol=1e-8)


def test_stars_are_the_cotangents_of_libigl(torus, better):
    """-L of igl.cotmatrix, by the naive formula, has the operators of a mesh without weights. Boundaries too."""
    half = torus.triangles[torus.points[torus.triangles][:, :, 2].mean(axis=1) > 0]
    used, numbers = np.unique(half, return_inverse=True)
    part = temper.SurfaceMesh(torus.points[used], numbers.reshape(-1, 3))
    assert len(part.boundary_edges) > 0 and np.any(better.weights)
    for mesh in (torus, part):
        p, t = mesh.points, mesh.triangles
        rows = []
        for k in range(3):
            i, j, o = t[:, k], t[:, (k + 1) % 3], t[:, (k + 2) % 3]
            u, v = p[i] - p[o], p[j] - p[o]
            cotangent = (u * v).sum(axis=1) / np.linalg.norm(np.cross(u, v), axis=1)
            rows += [(i, j, -cotangent / 2), (j, i, -cotangent / 2), (i, i, cotangent / 2), (j, j, cotangent / 2)]
        i, j, values = map(np.concatenate, zip(*rows))
        naive = sparse.csr_matrix((values, (i, j)), (len(p), len(p)))
        assert abs(naive - temper.dec_operators(mesh).laplacian()).max() < 1e-9 * abs(naive).max()
    cotangents = temper.SurfaceMesh(better.points, better.triangles)
    assert abs(temper.dec_operators(cotangents).star1 - temper.dec_operators(better).star1).max() > 1e-3


def test_operators_have_the_laws_of_the_calculus(better):
    dec = temper.dec_operators(better)
    assert (dec.star0 > 0).all() and (dec.star1 > 0).all() and dec.summarize().not_well_centered == 0
    assert dec.star0.sum() == pytest.approx(dec.areas.sum()) == pytest.approx(dec.power_cells().areas.sum())
    assert abs(dec.d1.tocsr() @ dec.d0.tocsr()).max() == 0 and abs(dec.laplacian() @ np.ones(160)).max() < 1e-10
    cells = dec.power_cells()
    assert cells.corners.shape[1] == 3 and np.allclose(np.bincount(cells.vertices, cells.polygon_areas), dec.star0)
    # The dual of CombinatorialSpaces.jl with given centers: lengths between centers, over both midpoints.
    left, right = dec.edges.triangles.T
    middle = dec.edges.midpoint
    dual = sum(np.linalg.norm(dec.orthocenters[side] - middle, axis=1) for side in (left, right))
    assert np.allclose(dual / dec.edges.length, dec.star1)
    doubled = temper.dec_operators(better, coefficient=np.full(better.n_triangles, 2.0))
    assert np.allclose(doubled.star1, 2 * dec.star1)
    again = pickle.loads(pickle.dumps(dec))
    assert np.array_equal(again.star1, dec.star1) and again.d0 == dec.d0


def test_optimize_makes_a_surface_well_centered_near_the_input(torus, better):
    mesh, seen = torus.copy(), []
    mesh.point_data["height"], mesh.cell_data["number"] = mesh.points[:, 2], np.arange(320)
    report = temper.optimize(mesh, progress=seen.append)
    assert isinstance(report, temper.types.SurfaceOptimizeReport) and len(seen) >= report.sweeps
    assert (report.bad_before, report.bad_after) == tuple(temper.quality(m).orthocenters_outside for m in (torus, mesh))
    assert 0 < report.surface_distance <= 0.005 * report.diagonal
    assert mesh == better and abs(mesh.point_data["height"] - mesh.points[:, 2]).max() < 0.05
    assert report.data.interpolated == ["height"] and "surface_distance" in str(report) and " → 0" in report._repr_html_()
    assert len(report.as_dict()["history"]) == len(report.history) == report.sweeps + 1
    kept = torus.copy()
    temper.optimize(kept, effort="quick", keep="positions")
    assert np.array_equal(kept.points, torus.points) and np.any(kept.weights)
    assert temper.optimize(torus.copy(), effort="quick", options={"surface_distance": 0.001}).surface_distance <= 0.001 * report.diagonal
    assert temper.optimize(torus.copy(), progress=lambda progress: False).stopped == "canceled"
    solved = torus.copy()
    temper.optimize(solved, target="vertex")
    assert temper.explain_duals(solved, "vertex").violations == 0 < temper.explain_duals(torus, "vertex").violations
    assert temper.explain_duals(torus, "any") is None


def test_what_belongs_to_points_follows_them_when_some_are_inserted_or_removed():
    globe = temper.generate.icosahedral(1)
    for seed in range(2, 40):  # until a repair changes the vertices
        points = globe.points + 0.23 * np.random.default_rng(seed).normal(size=(42, 3))
        points *= [1, 1, 0.8] / np.linalg.norm(points, axis=1)[:, None]
        mesh = temper.SurfaceMesh(points, globe.triangles, fixed=[5])
        mesh.point_data["number"] = np.arange(42.0)
        mesh.point_data_rules = "keep"
        report = temper.optimize(mesh, options={"surface_distance": 0.05, "repair_trials": 4000})
        if report.vertices_removed + report.vertices_inserted:
            break
    former, place = report.vertices, mesh._vertices_of_points()
    assert len(former) == mesh.n_vertices and len(place) == 42 and report.vertices_removed == (place < 0).sum()
    assert np.array_equal(place[former[former >= 0]], np.flatnonzero(former >= 0))
    assert np.array_equal(mesh.point_data["number"][former >= 0], former[former >= 0])
    assert np.array_equal(mesh.fixed, place[[5]]) and np.array_equal(mesh.points[place[5]], points[5])


def test_weights_alone_and_with_intrinsic_flips(torus):
    own = temper.find_weights(torus, goal="fewest")
    assert own.verdict == "infeasible" and own.intrinsic is None
    assert temper.check_certificate(torus, own.certificate) == "proves"
    found = temper.find_weights(torus, goal="fewest", flips="intrinsic")
    flipped = found.intrinsic
    assert flipped.bad_before == temper.quality(torus).orthocenters_outside > flipped.bad_after and flipped.flips > 0
    assert np.array_equal(flipped.weights, found.weights) and flipped.triangles.shape == (320, 3)
    assert flipped.areas.sum() == pytest.approx(temper.dec_operators(torus).areas.sum())  # the surface stays
    assert flipped.star0.sum() == pytest.approx(flipped.areas.sum()) and (flipped.star1 < 0).sum() < (temper.dec_operators(torus).star1 < 0).sum()
    assert abs(flipped.laplacian() @ np.ones(160)).max() < 1e-9 and len(flipped.edges.midpoint) == 0
    if found.verdict == "infeasible":
        assert temper.check_certificate(flipped, found.certificate) == "proves"
        assert temper.check_certificate(flipped, own.certificate) != "proves"
    why = temper.explain(torus)
    assert (why.triangles, why.verdict) == (320, "infeasible") and len(why.worst) == why.bad == flipped.bad_before


def test_files_and_operators_are_those_of_the_program(torus, better, in_scratch):
    temper.write("torus.obj", torus)
    assert temper.read("torus.obj") == torus
    subprocess.run(["temper", "optimize", "torus.obj", "-o", "program.vtu", "--quiet"], check=True)
    subprocess.run(["temper", "operators", "program.vtu", "-o", "program", "--format", "npz"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["temper", "draw", "program.vtu", "--before", "torus.obj", "-o", "program.svg"], check=True, stdout=subprocess.DEVNULL)
    mesh = temper.read("torus.obj")
    temper.optimize(mesh)
    temper.write("python.vtu", mesh)
    assert (in_scratch / "program.vtu").read_bytes() == (in_scratch / "python.vtu").read_bytes()
    assert mesh == better == temper.read("program.vtu")
    dec = temper.dec_operators(mesh)
    dec.write("python", formats=["npz"])
    for name in ("operators", "d0", "d1", "star0", "star1", "star2"):
        assert (in_scratch / "program" / f"{name}.npz").read_bytes() == (in_scratch / "python" / f"{name}.npz").read_bytes()
    with np.load("program/operators.npz") as npz:
        for name in ("star0", "star1", "star2", "transmissibility"):
            assert np.array_equal(npz[name], getattr(dec, name)), name
        assert np.array_equal(npz["orthocenters"], dec.orthocenters) and np.array_equal(npz["d1_data"], dec.d1.signs)
    assert temper.draw_svg(mesh, torus).count("<path") > 0
    subprocess.run(["temper", "weights", "torus.obj", "--mode", "fewest", "--flips", "intrinsic", "-o", "arrays"], stdout=subprocess.DEVNULL)
    temper.find_weights(torus, goal="fewest", flips="intrinsic").intrinsic.write("mine")
    for name in ("operators", "d0", "star1"):
        assert (in_scratch / "arrays" / f"{name}.npz").read_bytes() == (in_scratch / "mine" / f"{name}.npz").read_bytes()


def test_other_libraries_have_surfaces(torus, better, ring):
    given = types.SimpleNamespace(
        points=torus.points, cells=[types.SimpleNamespace(type="triangle", data=torus.triangles)], point_data={}, cell_data={},
        field_data={}, point_sets={}, cell_sets={},
    )  # fmt: skip
    assert temper.SurfaceMesh.from_meshio(given) == torus
    unused = types.SimpleNamespace(**vars(given))
    unused.points = np.vstack([[9, 9, 9], torus.points])
    unused.cells = [types.SimpleNamespace(type=kind, data=1 + np.array(cells)) for kind, cells in (("triangle", torus.triangles), ("line", [[0, 1]]))]
    with pytest.warns(temper.TemperWarning, match="1 point of no triangle is dropped: point 0"):
        part = temper.SurfaceMesh.from_meshio(unused)
    assert np.array_equal(part.points, torus.points) and part.lines.tolist() == [[0, 1]] == np.sort(part.constrained_edges).tolist()
    part.point_data["z"] = part.points[:, 2]
    assert len(part._form().points) == len(part.point_data["z"]) == 160
    assert temper.quality(given) == temper.quality(torus) and isinstance(temper.quality(given), temper.types.SurfaceQuality)
    for take in (temper.as_mesh, temper.from_meshio, temper.plot):
        with pytest.raises(temper.TemperError, match="point . has z = "):
            take(given)
    given.points, given.cells[0].data = ring.points, ring.triangles
    with pytest.raises(TypeError, match="expected a curved surface"):
        temper.SurfaceMesh.from_meshio(given)
    meshio = pytest.importorskip("meshio")
    grid = torus.to_meshio()
    assert isinstance(grid, meshio.Mesh)
    temper.optimize(grid)
    assert np.array_equal(grid.points, better.points) and np.array_equal(grid.point_data["weight"], better.weights)


def test_a_bad_surface_is_an_error_that_names_the_place(torus):
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for triangles, points, message in (
        ([(0, 1, 4)], corners, "triangle 0 uses point 4"),
        ([(0, 1, 2)], corners, "point 3 belongs to no triangle"),
        ([(0, 1, 2), (0, 1, 3), (0, 1, 4)], [*corners, (1, 1, 1)], "0-1|edge"),
        ([(0, 1, 1), (0, 2, 3)], corners, "triangle 0"),
        ([(0, 1, 2), (0, 2, 3)], [*corners[:3], (0, 0, np.nan)], "point 3|finite"),
    ):
        with pytest.raises(temper.TemperError, match=message):
            temper.SurfaceMesh(points, triangles)
    strip = [(np.cos(a) * (1 + s * np.cos(a / 2)), np.sin(a) * (1 + s * np.cos(a / 2)), s * np.sin(a / 2))
             for a in np.linspace(0, 2 * np.pi, 13)[:-1] for s in (-0.3, 0.3)]  # fmt: skip
    quads = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(11)] + [(22, 23, 0, 1)]
    with pytest.raises(temper.TemperError, match="(?i)side|orient"):
        temper.SurfaceMesh(strip, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    with pytest.warns(temper.TemperWarning, match="1 triangle is reversed"):
        temper.SurfaceMesh(corners, [(0, 1, 2), (0, 1, 3), (0, 3, 2)])
    with pytest.raises(ValueError, match=r"points: expected shape \(n, 3\)"):
        temper.SurfaceMesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)])


def test_what_is_not_for_surfaces_says_so(torus, ring):
    for call, message in (
        (lambda: temper.quality(torus, gamma=0.5), "gamma is not for curved surfaces. Next: leave it out"),
        (lambda: temper.explain(torus, cures=3), "cures is not for curved surfaces"),
        (lambda: temper.draw_svg(torus, dual=False), "dual is not for curved surfaces"),
        (lambda: temper.draw_svg(torus, ring), "before: expected a SurfaceMesh, found a Mesh"),
        (lambda: temper.optimize(torus, tensor=[1, 0, 1]), "tensor is not for curved surfaces"),
        (lambda: temper.optimize(torus, hooks=temper.Hooks(tracer=print)), "tracer is not for curved surfaces"),
        (lambda: temper.optimize(torus, target="mpas"), "target 'mpas' is for triangles"),
        (lambda: temper.find_weights(torus, flips="all"), "flips: expected 'none' or 'intrinsic'"),
        (lambda: temper.find_weights(ring, flips="intrinsic"), "flips is for curved surfaces alone"),
        (lambda: temper.write("x.vtu", torus, cells="power"), "cells is not for curved surfaces"),
        (lambda: temper.plot(torus), "found a SurfaceMesh"),
        (lambda: temper.html_report(torus), "found a SurfaceMesh"),
        (lambda: temper.power_cells(torus), "found a SurfaceMesh"),
        (lambda: temper.Optimizer(torus), "found SurfaceMesh"),
        (lambda: setattr(torus, "cell_data_rules", "conserve"), "not conserved on curved surfaces"),
        (lambda: setattr(torus, "weights", [1.0]), "weights: expected 160, found 1"),
    ):
        with pytest.raises((TypeError, ValueError), match=message):
            call()


def test_errors_of_solvers_are_those_of_the_program(torus, better, in_scratch):
    frame = temper.field_frame(torus)
    assert len(frame.center) == 3
    before, after = temper.measure_errors(torus, condition=True), temper.measure_errors(better, frame=frame)
    assert [row.field.name for row in before.fields] == [f.name for f in temper.error_fields(tetrahedra=True) if f.group != "exact"]
    assert before.triangles == torus.n_triangles and before.frame == frame and before.matrices.poisson.condition > 1
    assert after.matrices.flux.m_matrix and not before.matrices.flux.m_matrix
    assert before.levels == before.orders == [] and all(len(errors) == 0 for errors in before.local)
    ratio = temper.geometric_mean(temper.error_ratios(after, before)).star[2].l2
    assert 0 < ratio < 1
    linear = temper.measure_errors(torus, fields="linear").fields[0].errors
    assert linear.poisson.max < 1e-12 and linear.flux.max < 1e-12 < linear.star[0].max
    with pytest.raises(TypeError, match="refine is not for curved surfaces"):
        temper.measure_errors(torus, refine=1)
    temper.write("torus.vtu", torus)
    run = subprocess.run(["temper", "errors", "torus.vtu", "--json"], capture_output=True, text=True, check=True)
    errors = json.loads(run.stdout)["errors"]["fields"]
    assert [row["flux"]["l2"] for row in errors] == [row.errors.flux.l2 for row in before.fields]
