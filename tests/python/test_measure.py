"""What looks at meshes: quality, energies, operators, errors, weights, reasons."""

import dataclasses
import json
import pathlib
import pickle

import numpy as np
import pytest
from conftest import optimized

import temper
from temper import geometry, topology

EVERY = [
    temper.generate.sparse_horseshoe(), temper.generate.horseshoe(), temper.generate.annulus(), temper.generate.airfoil(),
    temper.generate.sheared_grid(), temper.generate.random_mesh(300), temper.generate.wedge(), temper.generate.letter_a(),
    temper.generate.regular_polygon(), temper.generate.graded_mesh(finest=0.1), temper.generate.single_triangle(),
    temper.generate.constrained_delaunay(np.random.default_rng(0).uniform(size=(50, 2))),
]  # fmt: skip


def weighted(mesh):
    """The mesh with weights that are not zero."""
    mesh = mesh.copy()
    mesh.weights = 1e-3 * np.sin(np.arange(mesh.n_vertices)) * temper.dec_operators(mesh).areas.mean()
    return mesh


@pytest.mark.parametrize("mesh", EVERY)
def test_counts_agree_with_the_predicates(mesh):
    q = temper.quality(mesh)
    corners = np.column_stack([mesh.points, mesh.weights])[mesh.triangles]
    good = geometry.is_well_centered(*corners.transpose(1, 0, 2))
    assert np.array_equal(good, temper.triangle_quality(mesh).well_centered)
    assert q.well_centered_fraction == pytest.approx(good.mean()) and q.triangles == mesh.n_triangles
    assert q.histograms.angles.counts.sum() == 3 * q.triangles and len(q.histograms.angles.edges) == len(q.histograms.angles.counts) + 1


@pytest.mark.parametrize("mesh", [temper.generate.annulus(), temper.generate.random_sphere(vertices=100)])
def test_the_least_of_all_triangles_is_that_of_the_mesh(mesh):
    each, whole = temper.triangle_quality(mesh), temper.quality(mesh)
    assert each.well_centered.mean() == whole.well_centered_fraction
    assert each.min_h_over_l.min() == whole.min_h_over_l
    assert each.min_d_over_l.min() == whole.min_d_over_l
    assert each.min_angle_deg.min() == whole.min_angle_deg


def test_energies_of_the_paper():
    q = temper.quality(temper.generate.horseshoe())
    assert q.energy["F"][1] == pytest.approx(2.836890825582, rel=1e-12)
    assert q.energy["T"][1] == pytest.approx(12.143904187128, rel=1e-12)
    assert q.energy["BP"][1] == pytest.approx(375.355882218659, rel=1e-12)
    assert q.energy["BH"] == (np.inf,) * 3 and q.as_dict()["energy"]["BH"] == [None] * 3
    model = temper.energy.EnergyModel("F")
    assert temper.energy.total_energy(temper.generate.horseshoe(), model) == q.energy["F"][1]
    assert [e.name for e in temper.energy.energies()] == list(q.energy)
    with pytest.raises(temper.TemperError, match="BHs"):
        temper.energy.total_energy(temper.generate.horseshoe(), temper.energy.EnergyModel("hot"))


def test_the_gradient_of_an_energy_is_its_derivative(ring):
    mesh, model = optimized(ring), temper.energy.EnergyModel("BP", gamma=0.1)
    vertex = int(np.setdiff1d(np.arange(mesh.n_vertices), mesh.boundary_edges)[3])
    derivatives = temper.energy.vertex_energy(mesh, model, vertex)
    step = 1e-6
    for axis in range(2):
        values = []
        for sign in (1, -1):
            points = np.array(mesh.points)
            points[vertex, axis] += sign * step
            moved = mesh.copy()
            moved.points = points
            values.append(temper.energy.total_energy(moved, model))
        assert (values[0] - values[1]) / (2 * step) == pytest.approx(derivatives.gradient[axis], rel=1e-4, abs=1e-4)


# --- operators ------------------------------------------------------------------------------------------------


def test_a_coefficient_has_one_value_for_each_triangle_or_region():
    mesh = temper.generate.sheared_grid()
    by_region = temper.dec_operators(mesh, coefficient={0: 2.0})
    assert by_region.transmissibility == pytest.approx(2 * temper.dec_operators(mesh).transmissibility)
    for wrong, message in (([1.0], "shape \\(800,\\)"), ({5: 1.0}, "none for \\[0\\]"), ({0: 1.0, 7: 1.0}, "no region")):
        with pytest.raises(ValueError, match=message):
            temper.dec_operators(mesh, coefficient=wrong)


def test_a_coefficient_names_regions_of_triangles_and_of_tetrahedra(tmp_path):
    def mesh_of(name, cells, apex):
        nodes = f"$Nodes\n{len(apex) + 4}\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n{''.join(apex)}$EndNodes\n"
        names = '$PhysicalNames\n4\n3 7 "rock"\n3 8 "sand"\n2 7 "rock"\n2 8 "sand"\n$EndPhysicalNames\n'
        (tmp_path / name).write_text(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{names}{nodes}$Elements\n2\n{cells}\n$EndElements\n")
        return temper.read(tmp_path / name)

    plane = mesh_of("plane.msh", "1 2 2 7 1 1 2 3\n2 2 2 8 1 2 4 3", [])
    for mesh in plane, mesh_of("space.msh", "1 4 2 7 1 1 2 3 5\n2 4 2 8 1 2 4 3 5", ["5 0 0 1\n"]):
        values = temper.dec_operators(mesh, coefficient={7: 1.0, 8: 10.0}).coefficient
        for named in {"rock": 1.0, "sand": 10.0}, {7: 1.0, "sand": 10.0}:
            assert (temper.dec_operators(mesh, coefficient=named).coefficient == values).all()
        for wrong, message in (
            ({"rock": 1.0}, "regions 7 \\('rock'\\), 8 \\('sand'\\); there is none for \\[8\\]"),
            ({7: 1.0, 8: 2.0, "clay": 1.0}, "no region \\['clay'\\]"),
            ({7: 1.0, "rock": 1.0, 8: 2.0}, "region 7 has two values"),
        ):
            with pytest.raises(ValueError, match=message):
                temper.dec_operators(mesh, coefficient=wrong)


def test_a_problem_of_the_user_is_measured_by_the_names_of_its_boundary():
    outline = temper.Outline(
        [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)],
        [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (1, 4)],
        [1, 1, 2, 1, 1, 3, 0],
        parts=[(7, [0, 6, 4, 5], None), (8, [1, 2, 3, 6], None)],
    )
    mesh = temper.mesh_outline(outline, 0.3).mesh
    errors = temper.measure_diffusion_errors(mesh, dirichlet={3: 0.0, 2: 1.1}, coefficient={7: 1.0, 8: 10.0})
    assert max(errors.vertex.max, errors.cell.max, errors.reference.max) < 1e-10, "linear on both sides"
    flux = temper.measure_diffusion_errors(mesh, dirichlet={3: 0.0}, neumann={2: 2.0}, coefficient={7: 1.0, 8: 10.0})
    assert flux.largest == pytest.approx(2.2) and flux.cell.max < 1e-10
    problem = {"dirichlet": {3: 0.0, 2: 1.1}, "coefficient": {7: 1.0, 8: 10.0}, "source": 3.0}
    general, special = mesh.copy(), mesh.copy()
    temper.optimize(general, target="cell")
    report = temper.optimize(special, target="cell", options={"problem": problem})
    assert report.objective == "solver_error" and report.objective_after < report.objective_before
    errors = [temper.measure_diffusion_errors(m, **problem).cell.l2 for m in (mesh, general, special)]
    assert errors[2] < 0.5 * min(errors[:2])
    with pytest.raises(temper.TemperError, match="expected the target vertex or cell"):
        temper.optimize(special, options={"problem": problem})
    with pytest.warns(temper.TemperWarning, match="the coefficient changes across"):
        uneven = {**problem, "coefficient": 1.0 + np.arange(mesh.n_triangles) % 2}
        temper.optimize(mesh.copy(), target="cell", options={"problem": uneven, "solver_error_steps": 1})
    with pytest.raises(ValueError, match="no boundary edge has the name or tag 'sea'"):
        temper.measure_diffusion_errors(mesh, dirichlet={"sea": 0.0})
    with pytest.raises(ValueError, match="has two values: by 3 and by 3"):
        temper.measure_diffusion_errors(mesh, dirichlet={3: 0.0, "boundary": 1.0}, neumann={3: 1.0})
    with pytest.raises(temper.TemperError, match="known up to a constant"):
        temper.measure_diffusion_errors(mesh, dirichlet={}, neumann={3: 1.0})


@pytest.mark.parametrize("mesh", EVERY)
def test_laws_of_the_operators_hold_for_any_weights(mesh):
    mesh = weighted(mesh)
    c = temper.dec_operators(mesh)
    d0, d1 = c.d0.toarray(), c.d1.toarray()
    assert d0.shape == (mesh.n_edges, mesh.n_vertices) and d1.shape == (mesh.n_triangles, mesh.n_edges)
    assert (d1 @ d0 == 0).all()
    assert c.star0.sum() == pytest.approx(c.areas.sum(), rel=1e-12)
    assert c.star2 == pytest.approx(1 / c.areas)
    boundary = np.unique(mesh.boundary_edges)
    laplacian = d0.T @ (c.star1[:, None] * d0)
    scale = np.abs(laplacian).sum(axis=1)
    for linear in np.asarray(mesh.points).T:
        residual = np.abs(np.delete(laplacian @ linear, boundary))
        assert (residual <= 1e-10 * np.delete(scale, boundary) * np.abs(linear).max() + 1e-13).all()
    k = np.where(np.arange(mesh.n_triangles) % 2, 3.0, 0.5)
    of_k = pickle.loads(pickle.dumps(temper.dec_operators(mesh, coefficient=k)))
    assert of_k.capacity.sum() == pytest.approx((k * c.areas).sum(), rel=1e-12)
    assert (of_k.coefficient == k).all() and (of_k.star0 == c.star0).all() and not len(c.capacity)
    sides = np.where(c.edges.triangles < 0, 0, k[c.edges.triangles])
    assert of_k.star1 * c.edges.length == pytest.approx(
        sides[:, 0] * c.edges.left_height + sides[:, 1] * c.edges.right_height, abs=1e-10
    )
    cells = c.power_cells()
    assert cells.areas.sum() == pytest.approx(c.areas.sum(), rel=1e-10)
    assert len(cells.polygons()) == len(cells.vertices) == len(cells.polygon_areas)


def test_star1_is_the_cotangent_formula_without_weights(ring):
    c = temper.dec_operators(ring)
    p, t = np.asarray(ring.points), np.asarray(ring.triangles)
    cotangents = np.zeros((ring.n_vertices,) * 2)
    for k in range(3):
        a, b, apex = t[:, k], t[:, (k + 1) % 3], t[:, (k + 2) % 3]
        u, v = p[a] - p[apex], p[b] - p[apex]
        values = (u * v).sum(1) / np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
        np.add.at(cotangents, (a, b), values)
        np.add.at(cotangents, (b, a), values)
    i, j = c.edges.vertices.T
    assert c.star1 == pytest.approx(cotangents[i, j], abs=1e-12)


def test_operators_are_views_on_one_value(ring):
    c = temper.dec_operators(ring)
    arrays = [c.star0, c.star1, c.transmissibility, c.orthocenters, c.edges.length, c.edges.midpoint, c.d0.columns]
    assert not any(a.flags.owndata or a.flags.writeable for a in arrays)
    kept = c.star1
    copy = kept.copy()
    del c, arrays
    assert np.array_equal(kept, copy)


def test_scipy_gets_the_same_matrices(ring):
    pytest.importorskip("scipy")
    c = temper.dec_operators(optimized(ring))
    assert np.array_equal(c.d0.tocsr().toarray(), c.d0.toarray())
    laplacian = c.laplacian()
    assert (laplacian - laplacian.T).nnz == 0 or abs(laplacian - laplacian.T).max() < 1e-12
    off = laplacian - __import__("scipy.sparse").sparse.diags(laplacian.diagonal())
    assert off.max() <= 0  # an M-matrix: the mesh is well-centered
    assert c.summarize().not_well_centered == 0 and c.star(2).shape == (ring.n_triangles,) * 2


def test_operators_are_written_as_the_program_writes_them(ring, in_scratch):
    c = temper.dec_operators(ring)
    paths = c.write("operators", formats=["npz"])
    assert sorted(p.split("/")[-1] for p in paths)[-1] == "star2.npz"
    arrays = np.load("operators/operators.npz")
    assert np.array_equal(arrays["star1"], c.star1) and np.array_equal(arrays["edges"], c.edges.vertices)
    assert np.array_equal(arrays["cell_areas"], c.power_cells().areas)
    with pytest.raises(temper.TemperError, match="npz, mtx, vtu"):
        c.write("operators", formats=["xml"])


# --- errors of solvers --------------------------------------------------------------------------------------------

needs_errors = pytest.mark.skipif(not hasattr(temper._temper, "measure_errors"), reason="built without Eigen")


@needs_errors
def test_linear_fields_are_exact_on_any_mesh(ring):
    report = temper.measure_errors(weighted(ring), fields="exact")
    assert all(row.field.group == "exact" for row in report.fields)
    assert max(row.errors.poisson.max for row in report.fields) < 1e-9
    assert max(row.errors.flux.max for row in report.fields) < 1e-9


@needs_errors
def test_errors_fall_with_refinement_and_ratios_of_a_mesh_to_itself_are_one(ring):
    mesh = optimized(ring, options={"objective": "energy"})
    report = temper.measure_errors(mesh, fields=["held-back"], refine=2, condition=True, local=True)
    assert len(report.levels) == 3 and report.levels[2].triangles == 16 * mesh.n_triangles
    assert temper.arithmetic_mean(report.orders).poisson.l2 > 1.5
    assert [len(values) for values in report.local] == [mesh.n_vertices, mesh.n_edges, mesh.n_triangles]
    assert report.matrices.poisson.m_matrix and report.matrices.poisson.condition > 1 and report.frame == temper.field_frame(mesh)
    ratios = temper.error_ratios(report, report)
    assert temper.geometric_mean(ratios)._row() == [1.0] * 10
    keys = [key for key, _ in temper.error_measures()]
    assert keys == temper._measure_errors._KEYS
    other = temper.measure_errors(mesh, fields=["chosen"])
    with pytest.raises(temper.TemperError):
        temper.error_ratios(report, other)
    with pytest.raises(temper.TemperError, match="held"):
        temper.measure_errors(mesh, fields=["no such field"])
    assert {f.group for f in temper.error_fields()} == {"chosen", "held-back", "exact"}


# --- weights, certificates, reasons ----------------------------------------------------------------------------------


def test_weights_that_exist_are_found_and_others_refuted():
    mesh = temper.generate.annulus(jitter=0.1)
    temper.optimize(mesh)
    known = np.array(mesh.weights)
    mesh.weights = np.zeros(mesh.n_vertices)
    report = temper.find_weights(mesh)
    assert report.verdict == "feasible" and report.solved and len(report.weights) == len(known)
    mesh.weights = report.weights
    assert temper.quality(mesh).well_centered_fraction == 1
    assert temper.weight_margin(mesh) == pytest.approx(report.attained, abs=1e-9) and report.attained >= 0.0099

    hard = temper.generate.sparse_horseshoe()
    best = temper.best_margin(hard)
    assert best.margin == pytest.approx(-8 / 135, abs=1e-10)
    assert temper.best_margin(hard, constraints="heights_only").margin == pytest.approx(0.05, abs=1e-9)
    assert temper.check_certificate(hard, best.certificate) == "proves"
    nothing = temper.types.Certificate(0.0, [(c, 1.0) for c, _ in best.certificate.terms[:1]])
    assert temper.check_certificate(hard, nothing) != "proves"
    assert temper.check_certificate(mesh, best.certificate) != "proves"
    text = best.certificate.to_json()
    assert temper.types.Certificate.from_json(text) == best.certificate and '"temper_certificate": 1' in text
    with pytest.raises(temper.TemperError, match='^term 1: expected "multiplier" to be a number, found "x"'):
        broken = json.loads(text)
        broken["terms"][1]["multiplier"] = "x"
        temper.types.Certificate.from_json(json.dumps(broken))
    for bad, message in (("[", "not JSON: byte 2"), ("[" * 20, "nested more than 16 deep"), ("{}", "expected a certificate of temper weights")):
        with pytest.raises(temper.TemperError, match=message):
            temper.types.Certificate.from_json(bad)
    with pytest.raises(temper.TemperError, match="margin"):
        temper.find_weights(hard, margin=0.7)


@pytest.mark.parametrize("constraints", [row.name for row in temper.constraints_table()])
def test_verdicts_under_all_conditions_are_what_the_checker_and_the_margin_say(constraints):
    verdicts = set()
    for mesh in (temper.generate.sparse_horseshoe(), temper.generate.horseshoe(), temper.generate.annulus()):
        report = temper.find_weights(mesh, constraints=constraints)
        verdicts.add(report.verdict)
        if report.verdict == "infeasible":
            assert report.certificate.constraints == constraints
            assert temper.check_certificate(mesh, report.certificate) == "proves"
        else:
            weighted = mesh.copy()
            weighted.weights = report.weights
            assert report.attained > 0
            assert temper.weight_margin(weighted, constraints=constraints) == pytest.approx(report.attained)
    assert "feasible" in verdicts


def test_edges_are_prescribed_by_their_vertices():
    mesh = temper.generate.annulus(jitter=0.3)
    inner = np.array([e for e in mesh.edges if tuple(e) not in {tuple(sorted(b)) for b in mesh.boundary_edges.tolist()}])
    every = temper.find_weights(mesh, constraints="regular")
    assert np.array_equal(temper.find_weights(mesh, constraints="regular", edges=inner[:, ::-1]).weights, every.weights)
    assert temper.best_margin(mesh, constraints="regular", edges=inner[:3]).margin == pytest.approx(0.5)
    with pytest.raises(temper.TemperError, match="row 1: there is no edge between vertices 0 and 0"):
        temper.find_weights(mesh, constraints="regular", edges=[inner[0], (0, 0)])
    with pytest.raises(temper.TemperError, match="only constraints regular"):
        temper.find_weights(mesh, edges=inner)


def test_the_search_over_connectivities_loses_nothing():
    mesh = temper.generate.random_mesh(40)
    before = mesh.copy()
    report = temper.best_connectivity(mesh, constraints="heights_only")
    assert mesh == before and np.array_equal(report.mesh.points, mesh.points)
    assert np.array_equal(np.sort(report.mesh.boundary_edges, axis=None), np.sort(mesh.boundary_edges, axis=None))
    margins = [report.before] + [step.margin for step in report.steps]
    assert margins == sorted(set(margins)) and report.margin == margins[-1] > report.before
    assert temper.best_margin(report.mesh, constraints="heights_only").margin == pytest.approx(report.margin, abs=1e-7)
    with pytest.raises(temper.TemperError, match="regular triangulation"):
        temper.best_connectivity(mesh, constraints="regular")


def test_a_proof_over_connectivities_is_checked():
    mesh = temper.generate.sparse_horseshoe()
    report = temper.best_connectivity(mesh)
    assert report.end == "none_exists" and report.bound == 0 and report.proof is not None
    assert temper.check_certificate(mesh, report.proof) == "proves"
    assert temper.types.ConnectivityProof.from_json(report.proof.to_json()) == report.proof
    with pytest.raises(TypeError, match="expected a certificate with terms. Next: temper.types.ConnectivityProof reads it"):
        temper.types.Certificate.from_json(report.proof.to_json())
    (lemma,) = report.proof.lemmas
    empty = dataclasses.replace(report.proof, lemmas=[dataclasses.replace(lemma, terms=lemma.terms[1:])])
    assert temper.check_certificate(mesh, empty) == "proves_nothing"
    with pytest.raises(temper.TemperError, match="plane"):
        temper.check_certificate(temper.generate.icosahedral(level=1), report.proof)


def test_reasons_name_every_bad_triangle_once():
    mesh = temper.generate.horseshoe()
    seen = []
    why = temper.explain(mesh, progress=lambda done, all: seen.append((done, all)))
    bad = np.flatnonzero(~temper.triangle_quality(mesh).well_centered)
    assert np.array_equal(np.sort(np.concatenate([r.triangles for r in why.reasons])), bad) and why.bad == len(bad)
    assert why.verdict == "infeasible" and all(r.text for r in why.reasons) and "Explanation" in why._repr_html_()
    for reason in why.reasons:
        if reason.certificate.terms:
            assert temper.check_certificate(mesh, reason.certificate) == "proves"
    with pytest.raises(temper.TemperError):
        temper.explain(mesh, progress=lambda done, all: False)
    with pytest.raises(ZeroDivisionError):
        temper.explain(mesh, progress=lambda done, all: 1 / 0)


def test_a_polygon_without_inner_vertices_must_split_its_edges():
    mesh = temper.generate.regular_polygon(60)
    conflicts = temper.edges_that_must_be_split(mesh)
    for conflict in conflicts:
        assert conflict.sum <= 1 and temper.edge_conflict(mesh, conflict.halfedge) == conflict
    grading = topology.grade_boundary(mesh)
    assert grading.inside > 0 and mesh.validate() is None


# --- pictures ------------------------------------------------------------------------------------------------------


def test_svg_is_text_that_notebooks_show(ring):
    import xml.etree.ElementTree as xml

    picture = temper.draw_svg(ring, title="a & b", zoom=(0, 0, 1, 1))
    xml.fromstring(picture)
    assert isinstance(picture, str) and picture._repr_svg_() == picture
    both = temper.draw_svg(optimized(ring), ring)
    xml.fromstring(both)
    xml.fromstring(temper.grid_svg([picture, both], 1, title="two"))
    with pytest.raises(ValueError, match="zoom"):
        temper.draw_svg(ring, zoom=(0, 1))


def test_html_report_is_a_page_that_notebooks_show(ring, in_scratch):
    after = ring.copy()
    report = temper.optimize(after)
    page = temper.html_report(after, ring, report)
    assert page == temper.html_report(after, ring, report) and 'id="before.points"' in page
    shown = json.loads(page.split('id="report">')[1].split("</script>")[0])
    assert shown["before"]["orthocenters_outside"] > 0 == shown["after"]["orthocenters_outside"]
    assert len(shown["history"]) == len(report.history) and shown["after"]["histograms"]["angles"]["high"] == 180
    page.save("page.html")
    assert pathlib.Path("page.html").read_text(encoding="utf-8") == page
    assert 'srcdoc="&lt;!DOCTYPE html&gt;' in page._repr_html_()
    for shows_itself in (after, report):
        assert "<svg" in shows_itself._repr_html_() and "srcdoc" not in shows_itself._repr_html_()
        assert len(shows_itself._repr_html_()) < 120 * after.n_triangles
    bad = json.loads(temper.html_report(ring).split('id="report">')[1].split("</script>")[0])
    assert sum(len(reason["triangles"]) for reason in bad["reasons"]) == bad["after"]["orthocenters_outside"]


@pytest.mark.parametrize("color", [None, "quality", "angle", "region", "array"])
def test_matplotlib_draws_every_kind(ring, in_scratch, color):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    values = np.arange(ring.n_triangles) if color == "array" else color
    axes = temper.plot(weighted(ring), color=values, orthocenters=True, weights=True, title="ring")
    axes.figure.savefig("ring.png")
    shown = pyplot.imread("ring.png")
    assert shown.shape[0] > 100 and (shown[..., :3] < 0.9).any(axis=2).mean() > 0.02
    pyplot.close(axes.figure)


def test_plots_refuse_what_they_cannot_color(ring):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    with pytest.raises(ValueError, match="quality, angle, region"):
        temper.plot(ring, color="beauty")
    with pytest.raises(ValueError, match=str(ring.n_triangles)):
        temper.plot(ring, color=[1, 2])
    temper.plot_history(temper.optimize(ring))
    pyplot.close("all")


def test_every_row_of_quality_measures_is_a_number_of_quality_in_its_order():
    rows = temper.quality_measures()
    names = [f.name for f in dataclasses.fields(temper.types.Quality)]
    assert names[: len(rows)] == [row.key for row in rows]
    measured = temper.quality(temper.generate.horseshoe())
    for row in rows:
        assert isinstance(getattr(measured, row.key), int if row.count else float), row.key
        assert row.better in ("equal", "larger", "less") and row.definition
