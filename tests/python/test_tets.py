"""Meshes of tetrahedra: from arrays, from other libraries and from files, and the report on them."""

import dataclasses
import json
import os
import pickle
import signal
import subprocess
import threading
import time
import warnings

import numpy as np
import pytest

import temper

LATTICE = [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]]  # of a cube's corners


def cubes(n, seed=None):
    """Points and tetrahedra of n³ cubes in six tetrahedra each; with a seed the inner points are shaken."""
    line = np.arange(n + 1)
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    number = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    corners = np.stack([number[i : i + n, j : j + n, k : k + n].ravel() for k in (0, 1) for j in (0, 1) for i in (0, 1)], axis=1)
    if seed is not None:
        inside = ((points > 0) & (points < n)).all(axis=1)
        points[inside] += np.random.default_rng(seed).uniform(-0.15, 0.15, (inside.sum(), 3))
    return points, corners[:, LATTICE].reshape(-1, 4)


def volumes(points, tetrahedra):
    a, b, c, d = (points[tetrahedra[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


@pytest.fixture
def shaken():
    points, tetrahedra = cubes(3, seed=1)
    weights = np.random.default_rng(2).uniform(0, 0.05, len(points))
    return temper.TetMesh(
        points, tetrahedra, weights, regions=np.arange(len(tetrahedra)) % 2, tagged_faces=[(0, 1, 5), (0, 21, 5)], face_tags=[7, 8],
        lines=[(0, 1)], line_tags=[3], marked_points=[21], point_tags=[9],
    )  # fmt: skip


def test_the_arrays_of_a_mesh_are_those_it_was_made_from(shaken):
    points, tetrahedra = cubes(3, seed=1)
    assert np.array_equal(shaken.points, points) and np.array_equal(shaken.tetrahedra, tetrahedra)
    assert (shaken.n_vertices, shaken.n_tetrahedra, shaken.n_faces) == (64, 162, (4 * 162 + 108) // 2)
    assert shaken.regions.tolist() == [0, 1] * 81 and shaken.validate() is None
    assert shaken.tagged_faces.tolist() == [[0, 1, 5], [0, 21, 5]] and shaken.face_tags.tolist() == [7, 8]
    assert shaken.lines.tolist() == [[0, 1]] and shaken.line_tags.tolist() == [3]
    assert shaken.marked_points.tolist() == [21] and shaken.point_tags.tolist() == [9]
    assert repr(shaken) == "<temper.TetMesh: 64 vertices, 162 tetrahedra>"
    assert pickle.loads(pickle.dumps(shaken)) == shaken
    for view in (shaken.weights, shaken.tetrahedra):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 1


def test_neighbors_share_three_corners_and_the_boundary_faces_enclose_the_volume(shaken):
    tetrahedra, neighbors = shaken.tetrahedra, shaken.neighbors
    for t, k in zip(*np.nonzero(neighbors >= 0)):
        assert set(np.delete(tetrahedra[t], k)) <= set(tetrahedra[neighbors[t, k]])
        assert t in neighbors[neighbors[t, k]]
    a, b, c = (shaken.points[shaken.boundary_faces[:, k]] for k in range(3))
    assert len(a) == 108
    assert np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6 == pytest.approx(27)  # Gauss: outward


def test_the_report_has_the_laws_of_the_mesh(shaken):
    q = temper.quality(shaken, worst=3)
    each = volumes(shaken.points, shaken.tetrahedra)
    assert q.volume == pytest.approx(27) and q.volume == pytest.approx(each.sum())
    assert (q.min_volume, q.max_volume) == (pytest.approx(each.min()), pytest.approx(each.max()))
    assert q.vertices + q.faces == q.edges + q.tetrahedra + 1  # Euler
    assert q.regions == 2 and q.inner_vertices == 8 and q.histograms.dihedrals.counts.sum() == 6 * q.tetrahedra
    assert len(q.worst) == 3 and q.worst[0].h_over_l == q.min_h_over_l and "face " in q.worst[0].why
    worst = shaken.tetrahedra[q.worst[0].tetrahedron]
    assert q.worst[0].vertices == tuple(worst) and q.worst[0].at == pytest.approx(shaken.points[worst].mean(axis=0))
    moved = temper.TetMesh(4 * shaken.points + [1, 2, 3], shaken.tetrahedra, 16 * np.asarray(shaken.weights) + 5)
    assert temper.quality(moved).min_h_over_l == pytest.approx(q.min_h_over_l)
    assert temper.quality(moved).orthocenters_outside == q.orthocenters_outside > 0
    assert temper.quality(shaken, worst=3, threads=1) == q
    single = temper.tetrahedron_quality(shaken)
    assert single.min_h_over_l.min() == q.min_h_over_l and single.min_dihedral_deg.min() == q.min_dihedral_deg
    assert single.well_centered.dtype == bool and (~single.well_centered).sum() == q.orthocenters_outside
    assert "worst tetrahedra" in q._repr_html_() and "min_h_over_l" in str(q)


def test_pictures_and_pages_show_cuts(shaken):
    picture = temper.draw_svg(shaken, cut=("x", 1.5), title="a & b")
    assert "tetrahedra bad at x = 1.5<" in picture and "a &amp; b" in picture
    assert temper.draw_svg(shaken, cut="z") == temper.draw_svg(shaken) != temper.draw_svg(shaken, cut="y")
    assert temper.draw_svg(shaken, shaken).count("tetrahedra bad at z = 1.5<") == 2
    with pytest.raises(ValueError, match="cut: expected 'x', 'y' or 'z'"):
        temper.draw_svg(shaken, cut="w")
    for at in (0, 99, float("nan")):
        with pytest.raises(ValueError, match=f"the plane y={at} misses the mesh, which has y from 0 to 3. Next: y=1.5"):
            temper.draw_svg(shaken, cut=("y", at))
    with pytest.raises(TypeError, match="dual is for triangles alone"):
        temper.draw_svg(shaken, dual=False)
    ring = temper.generate.annulus()
    with pytest.raises(TypeError, match="cut is for tetrahedra alone"):
        temper.draw_svg(ring, cut="x")
    with pytest.raises(TypeError, match="before: expected a TetMesh"):
        temper.draw_svg(shaken, ring)
    better = shaken.copy()
    report = temper.optimize(better)
    page = temper.html_report(better, shaken, report)
    assert 'id="before.tetrahedra"' in page and "<title>temper.TetMesh</title>" in page

    def strictly(name):
        raise AssertionError(f"{name} is not JSON")

    shown = json.loads(page.split('id="report">')[1].split("</script>")[0], parse_constant=strictly)
    assert shown["before"]["orthocenters_outside"] == temper.quality(shaken).orthocenters_outside
    assert sum(shown["after"]["histograms"]["dihedrals"]["counts"]) == 6 * better.n_tetrahedra


def test_python_has_the_numbers_of_the_program(shaken, in_scratch):
    assert temper.write("m.vtu", shaken) == []
    report = json.loads(subprocess.run(["temper", "check", "m.vtu", "--json"], check=True, capture_output=True, text=True).stdout)
    mine = temper.quality(temper.read("m.vtu")).as_dict()
    rows = temper.quality_measures(tetrahedra=True)
    assert len(rows) > 20 and {row.key for row in rows} <= set(mine)
    assert {row.key: mine[row.key] for row in rows} == {row.key: report[row.key] for row in rows}
    assert mine["worst"] == report["worst"]


@pytest.mark.parametrize("name", ["m.vtu", "m.msh", "m.mesh", "m.vtk", "m.node"])
def test_a_mesh_comes_back_from_a_file(shaken, in_scratch, name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", temper.TemperWarning)
        temper.write(name, shaken)
    again = temper.read(name)
    assert isinstance(again, temper.TetMesh) and again == shaken and again.warnings == []
    assert again.tagged_faces.tolist() == shaken.tagged_faces.tolist()
    with pytest.raises(temper.TemperError, match="flat is for triangles alone. Next: leave it out"):
        temper.read(name, flat=True)


def test_what_is_repaired_is_said_and_written_without_the_fault(in_scratch):
    points, tetrahedra = cubes(1)
    tetrahedra = tetrahedra.copy()
    tetrahedra[2] = tetrahedra[2, [1, 0, 2, 3]]
    with pytest.warns(temper.TemperWarning) as said:
        mesh = temper.TetMesh(points, tetrahedra, tagged_faces=[(1, 2, 4)])
    assert [str(w.message) for w in said] == mesh.warnings == [
        "1 negative tetrahedron is reversed: two corners are exchanged, the shape stays",
        "1 face is no face of the mesh and tags nothing: face 0",
    ]  # fmt: skip
    assert (volumes(mesh.points, mesh.tetrahedra) > 0).all() and said[0].filename == __file__
    assert mesh.lines.shape == (0, 2) and mesh.marked_points.shape == (0,) and mesh.names == {}
    temper.write("m.vtu", mesh)
    with pytest.warns(temper.TemperWarning, match="is no face of the mesh") as said:
        assert temper.read("m.vtu") == mesh
    assert len(said) == 1


def test_errors_have_the_numbers_of_the_arrays_and_a_next_step():
    points, tetrahedra = cubes(1)

    def error_of(points=points, tetrahedra=tetrahedra, **others):
        with pytest.raises(temper.TemperError) as error:
            temper.TetMesh(points, tetrahedra, **others)
        assert ". Next: " in str(error.value)
        return error.value

    changed = tetrahedra.copy()
    changed[4, 1] = 8
    assert str(error_of(tetrahedra=changed)).startswith("tetrahedron 4 uses point 8, but there are 8 points")
    spare = np.vstack([points, [9, 9, 9], [8, 8, 8]])  # points of no tetrahedron are dropped, but not before
    assert str(error_of(spare, [(0, 1, 2, 10)])).startswith("tetrahedron 0 uses point 10, but there are 10 points")
    assert "face 0 uses point -1" in str(error_of(tagged_faces=[(0, 1, -1)]))
    assert "line 0 uses point 44" in str(error_of(lines=[(0, 44)]))
    changed[4] = [0, 1, 2, 3]
    assert error_of(tetrahedra=changed).code == "zero_volume"
    assert "point 8 belongs to no tetrahedron" in str(error_of(points=np.vstack([points, [9, 9, 9]])))
    assert "point 4 and point 8 are both at (1, 0, 0)" in str(error_of(np.vstack([points, [1, 0, 0]]), [*tetrahedra, [0, 4, 8, 7]]))
    assert "point 2 has coordinates (0, nan, 0)" in str(error_of(points=np.where(np.arange(8)[:, None] == 2, [0, np.nan, 0], points)))
    assert error_of(weights=[1.0]).code == "size_mismatch"
    assert str(error_of(regions=[0, 0, 2**31, 0, 0, 0])).startswith("regions: row 2 has 2147483648; expected -2147483648 to 2147483647")
    assert "line_tags: row 0 has 18446744073709551615" in str(error_of(lines=[(0, 1)], line_tags=np.array([2**64 - 1], dtype=np.uint64)))
    assert error_of(lines=[(0, 1)], line_tags=[1, 2]).code == "size_mismatch"
    with pytest.raises(ValueError, match=r"tetrahedra: expected shape \(n, 4\), found \(6, 3\)"):
        temper.TetMesh(points, tetrahedra[:, :3])
    with pytest.raises(ValueError, match=r"points: expected shape \(n, 3\)"):
        temper.TetMesh(points[:, :2], tetrahedra)


def test_functions_for_triangles_say_so(shaken):
    with pytest.raises(TypeError, match="expected a mesh of triangles, found a TetMesh. Next: "):
        temper.best_margin(shaken)
    with pytest.raises(TypeError, match="cures is for triangles alone"):
        temper.explain(shaken, cures=1)
    with pytest.raises(TypeError, match="gamma is for triangles alone"):
        temper.quality(shaken, gamma=0.5)


def test_a_run_is_that_of_the_program_and_the_boundary_stays(shaken, in_scratch):
    temper.write("m.vtu", shaken)
    former, view, boundary = shaken.copy(), shaken.weights, np.unique(shaken.boundary_faces)
    report = temper.optimize(shaken, effort="quick")
    assert report.stopped == "converged" and report.history[0].bad > min(each.bad for each in report.history)
    assert temper.quality(shaken).orthocenters_outside == min(each.bad for each in report.history)
    assert np.array_equal(shaken.points[boundary], former.points[boundary]) and shaken.validate() is None
    assert np.array_equal(view, former.weights) and not np.array_equal(view, shaken.weights)  # views keep the former state
    assert "bad tetrahedra" in str(report) and report.data is None is report.size and report.vertices.size == 0
    subprocess.run(["temper", "optimize", "m.vtu", "-o", "out.vtu", "--effort", "quick", "--quiet"], check=True)
    assert temper.read("out.vtu") == shaken != former
    temper.optimize(former, keep=["positions"], effort="quick", options={"max_sweeps": 3})
    assert np.array_equal(former.points, cubes(3, seed=1)[0]) and temper.optimize(former, progress=lambda _: False).stopped == "canceled"


def test_words_for_triangles_are_refused_by_name(shaken):
    before = shaken.copy()
    for given, refused in (
        ({"target": "mpas"}, "target 'mpas'"), ({"hooks": temper.Hooks(tracer=print)}, "tracer"),
        ({"options": {"problem": {}}}, "problem"), ({"keep": "sizes"}, "keep 'sizes'"),
        ({"options": {"energy": "T"}}, 'energy="T"'), ({"options": {"energy": "F", "star": "all"}}, 'star="all"'), ({"options": temper.OptimizeOptions(seed=5)}, "seed=5"),
    ):  # fmt: skip
        with pytest.raises((TypeError, temper.TemperError), match=f"^{refused} is for triangles alone. Next: leave it out"):
            temper.optimize(shaken, **given)
    for given, message in (({"options": {"star": 2}}, "star needs "), ({"target": "cell", "options": {"energy": "F"}}, "lower different things")):
        with pytest.raises(temper.TemperError, match=f"{message}.*Next: "):
            temper.optimize(shaken, **given)
    with pytest.raises(temper.TemperError, match='^tets_patches="each" is for tetrahedra alone. Next: leave it out'):
        temper.optimize(temper.generate.annulus(), options={"tets_patches": "each"})
    thorough = temper.options_for("any", "high", max_sweeps=1)
    for mesh in (shaken.copy(), temper.generate.annulus()):
        assert temper.optimize(mesh, options=thorough).sweeps == 1
    with pytest.raises(TypeError, match="edges is for triangles alone"):
        temper.find_weights(shaken, edges=[(0, 1)])
    assert shaken == before


def test_ctrl_c_ends_a_run_within_a_second_and_keeps_the_best_mesh():
    mesh = temper.TetMesh(*cubes(12, seed=1))
    before, pressed = temper.quality(mesh).orthocenters_outside, []
    timer = threading.Timer(0.3, lambda: (pressed.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT)))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        temper.optimize(mesh)
    assert time.monotonic() - pressed[0] < 1 and mesh.validate() is None and temper.quality(mesh).orthocenters_outside < before


def test_each_bad_tetrahedron_is_explained_worst_first(shaken):
    why = temper.explain(shaken)
    quality = temper.quality(shaken, worst=len(why.reasons))
    assert why.bad == len(why.reasons) == quality.orthocenters_outside > 0 and why.tetrahedra == quality.tetrahedra
    assert [r.text for r in why.reasons] == [w.why for w in quality.worst]
    assert why.verdict == "infeasible" and why.weights_changed is None
    assert temper.check_certificate(shaken, why.certificate) == "proves"
    assert why.all_on_boundary == sum(r.all_on_boundary for r in why.reasons)
    for reason in why.reasons:
        assert min(face.h_over_l for face in reason.faces) == pytest.approx(reason.h_over_l)
        assert any(face.outside for face in reason.faces) and sorted(sum((f.vertices for f in reason.faces), ())) == sorted(3 * reason.vertices)
        assert reason.cure == ("split_boundary" if reason.all_on_boundary else "optimize")
    assert temper.explain(shaken, whole=0).verdict == "undecided" and str(why).count("tetrahedron ") >= why.bad


def test_weights_are_found_or_a_certificate_proves_that_there_are_none(shaken):
    found = temper.find_weights(shaken, constraints="regular")
    assert found.verdict == "feasible" and temper.quality(shaken).non_regular_faces > 0
    shaken.weights = found.weights
    assert temper.quality(shaken).non_regular_faces == 0
    assert temper.weight_margin(shaken, constraints="regular") == pytest.approx(found.attained)
    none = temper.find_weights(shaken, goal="margin")
    assert none.verdict == "infeasible" and none.certificate.terms[0][0].kind == "height_over_face"
    assert temper.check_certificate(shaken, none.certificate) == "proves"
    easy = temper.TetMesh(shaken.points * [1, 1, 3], shaken.tetrahedra)
    assert temper.check_certificate(easy, none.certificate) != "proves"
    assert [row.name for row in temper.constraints_table(tetrahedra=True)] == [
        "well_centered", "completely_well_centered", "regular", "coefficients", "distances"]
    for wrong in ([1.0], np.full(shaken.n_vertices, np.nan)):
        with pytest.raises(temper.TemperError, match="weights: expected"):
            shaken.weights = wrong
    assert np.array_equal(shaken.weights, found.weights)


class Bare:
    """An object with these attributes: what temper needs of a class that the tests do not have."""

    def __init__(self, **attributes):
        vars(self).update(attributes)


def test_grids_of_pyvista_are_taken():
    points, tetrahedra = cubes(1)
    cells = [*tetrahedra, [0, 1, 3], [0, 8], [0, 1], [7]]  # the point 8 is of no tetrahedron
    grid = Bare(
        points=np.vstack([points, [9, 9, 9]]), celltypes=np.array([10] * 6 + [5, 3, 3, 1]),
        offset=np.cumsum([0, *map(len, cells)]), cell_connectivity=np.concatenate(cells),
        point_data={"u": np.arange(9.0), "weight": np.full(9, 0.25)}, cell_data={"region": np.arange(10), "c": np.arange(10.0)},
        field_data={},
    )  # fmt: skip
    with pytest.warns(temper.TemperWarning, match="1 point of no tetrahedron is dropped: point 8") as said:
        mesh = temper.TetMesh.from_meshio(grid)
    assert said[0].filename == __file__
    assert mesh.regions.tolist() == list(range(6)) and np.array_equal(mesh.points, points) and (mesh.weights == 0.25).all()
    assert mesh.tagged_faces.tolist() == [[0, 1, 3]] and mesh.face_tags.tolist() == [6]
    assert mesh.lines.tolist() == [[0, 1]] and mesh.line_tags.tolist() == [8]
    assert mesh.marked_points.tolist() == [7] and mesh.point_tags.tolist() == [9]
    assert mesh.point_data["u"].tolist() == list(range(8)) and mesh.cell_data["c"].tolist() == list(range(6))
    with pytest.warns(temper.TemperWarning):
        assert temper.quality(grid) == temper.quality(mesh)
    with pytest.raises(temper.TemperError, match="expected cells of type tetra; 1 cells of type triangle"):
        temper.TetMesh.from_meshio(Bare(points=points, cells=[Bare(type="triangle", data=[[0, 1, 2]])], point_data={}, cell_data={}, field_data={}))
    cells = [Bare(type="tetra", data=np.empty((0, 4), dtype=int)), Bare(type="triangle", data=[[0, 1, 2]])]
    assert temper.quality(Bare(points=[(0, 0), (1, 0), (0, 1)], cells=cells, point_data={}, cell_data={}, field_data={})).triangles == 1
    with pytest.raises(TypeError, match="expected a mesh of meshio, PyVista or Gmsh, found ndarray"):
        temper.TetMesh.from_meshio(points)


def test_a_mesh_goes_through_meshio(shaken):
    meshio = pytest.importorskip("meshio")
    again = shaken.to_meshio()
    assert isinstance(again, meshio.Mesh) and set(again.cells_dict) == {"tetra", "triangle", "line", "vertex"}
    assert again.cell_data_dict["gmsh:physical"]["triangle"].tolist() == [7, 8]
    assert temper.TetMesh.from_meshio(again) == shaken and temper.quality(again) == temper.quality(shaken)
    again.point_sets, again.cell_sets = {"wells": np.array([21, 63])}, {"all": []}
    with pytest.warns(temper.TemperWarning, match="cell_sets 'all' are dropped"):
        temper.optimize(again, effort="quick")
    temper.optimize(shaken, effort="quick")
    assert temper.TetMesh.from_meshio(again) == shaken and again.point_sets["wells"].tolist() == [21, 63]


def test_operators_have_the_laws_of_a_complex(shaken, tmp_path):
    dual = temper.dec_operators(shaken)
    edges, faces, n, m = dual.edges, dual.faces, shaken.n_vertices, shaken.n_tetrahedra
    assert dual.d0.shape == (len(edges), n) and dual.d1.shape == (len(faces), len(edges)) and dual.d2.shape == (m, len(faces))
    d0, d1, d2 = (each.toarray() for each in (dual.d0, dual.d1, dual.d2))
    assert not (d1 @ d0).any() and not (d2 @ d1).any()
    assert np.allclose(dual.volumes, volumes(shaken.points, shaken.tetrahedra)) and np.allclose(dual.star3, 1 / dual.volumes)
    assert np.isclose(dual.star0.sum(), 27) and np.isclose((edges.length * edges.dual_area).sum(), 81)
    assert np.allclose(dual.star1, edges.dual_area / edges.length) and np.allclose(dual.star2 * dual.transmissibility, 1)
    assert faces.is_boundary.sum() == 108 and edges.is_boundary.sum() == 162
    slope = np.array([1.0, -2, 0.5])
    laplacian = d0.T @ (dual.star1 * (d0 @ (shaken.points @ slope)))
    assert np.allclose(laplacian[(shaken.points > 0).all(axis=1) & (shaken.points < 3).all(axis=1)], 0)
    behind, ahead = (np.where(side[:, None] < 0, faces.orthocenter, dual.orthocenters[side]) for side in faces.tetrahedra.T)
    p, q, r = (shaken.points[corner] for corner in faces.vertices.T)
    assert np.allclose(dual.transmissibility * ((ahead - behind) @ slope), np.cross(q - p, r - p) @ slope / 2)
    assert pickle.loads(pickle.dumps(dual)) == dual and dual.summarize().star0_sum == pytest.approx(27)
    with pytest.raises(ValueError, match="read-only"):
        dual.star1[0] = 1
    files = dual.write(tmp_path / "out", formats=["npz"])
    assert len(files) == 8 and np.array_equal(np.load(files[0])["star2"], dual.star2)


def test_errors_of_tetrahedra(shaken):
    if not hasattr(temper._temper, "measure_errors"):
        pytest.skip("built without Eigen")
    frame = temper.field_frame(shaken)
    assert frame.center == (1.5, 1.5, 1.5) and frame.half_size == 1.5
    report = temper.measure_errors(shaken, condition=True)
    assert [row.field for row in report.fields] == [field for field in temper.error_fields(tetrahedra=True) if field.group != "exact"]
    assert report.tetrahedra == 162 and report.matrices.flux.unknowns == 162 and report.matrices.poisson.condition >= 1
    exact = temper.measure_errors(shaken, fields=["linear"], frame=frame).fields[0].errors
    assert max(exact.poisson.max, exact.flux.max, exact.star[1].max) < 1e-9 and exact.star[0].max > 0.01
    points, tetrahedra = cubes(3)
    regular = temper.measure_errors(temper.TetMesh(points, tetrahedra), frame=frame)
    ratios = temper.error_ratios(report, regular)
    assert [row.field.name for row in ratios] == [row.field.name for row in report.fields]
    assert temper.geometric_mean(ratios, "held-back").star[1].l2 > 1
    assert "two-point flux, L2" in str(report)
    with pytest.raises(temper.TemperError, match="other fields, or of another frame"):
        temper.error_ratios(report, temper.measure_errors(shaken, frame=dataclasses.replace(frame, half_size=2.0)))
    with pytest.raises(TypeError, match="refine and local are for triangles alone"):
        temper.measure_errors(shaken, refine=1)


def test_operators_take_a_coefficient_and_know_named_parts():
    points, tetrahedra = cubes(2, seed=3)
    cells = Bare(
        points=points, point_data={}, cell_data={"gmsh:physical": [np.ones(48, int), np.array([7])]}, field_data={"inflow": [7, 2]},
        cells=[Bare(type="tetra", data=tetrahedra), Bare(type="triangle", data=np.array([[0, 1, 4]]))],
    )  # fmt: skip
    mesh = temper.TetMesh.from_meshio(cells)
    plain, scaled = temper.dec_operators(mesh), temper.dec_operators(mesh, coefficient={1: 2.5})
    assert plain.faces.vertices[plain.faces.named["inflow"]].tolist() == [[0, 1, 4]] and plain.edges.named == {}
    assert np.allclose(scaled.star1, 2.5 * plain.star1) and np.allclose(scaled.transmissibility, 2.5 * plain.transmissibility)
    assert np.array_equal(scaled.star2, plain.star2) and np.isclose(scaled.capacity.sum(), 2.5 * 8)
    for wrong, message in (([1.0, 2.0], "expected one value per tetrahedron"), ({2: 1.0}, "there is none for \\[1\\]")):
        with pytest.raises(ValueError, match=message):
            temper.dec_operators(mesh, coefficient=wrong)
    with pytest.raises(ValueError, match="tensor: expected kxx, kxy, kxz, kyy, kyz, kzz, found 3 numbers"):
        temper.dec_operators(mesh, tensor=(1, 0, 1))
