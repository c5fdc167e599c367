"""Meshes of the sphere, compared with NumPy."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from conftest import PUBLIC_MESHES

import temper
from temper import Space, geometry, topology

EARTH = 6371220.0
OCTAHEDRON = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)], dtype=float)
FACES = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]


@pytest.fixture
def globe():
    return temper.generate.random_sphere(300, radius=EARTH)


@pytest.fixture
def tempered(globe):
    temper.optimize(globe)
    return globe


def faces_of(mesh):
    return np.moveaxis(mesh.weighted_vectors[mesh.triangles], 1, 0)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def angle(a, b):
    """Between vectors, good for small and large ones."""
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), np.sum(a * b, axis=-1))


# --- the space and the mesh ----------------------------------------------------------------------------------


def test_a_space_is_a_small_value():
    plane, earth = Space(), Space.sphere(EARTH)
    assert plane.is_plane and plane.kind == "plane" and plane.radius == 0 and repr(plane) == "Space()"
    assert not earth.is_plane and earth.kind == "sphere" and earth.radius == EARTH
    assert earth == Space(EARTH) == pickle.loads(pickle.dumps(earth)) != plane
    assert len({earth, Space(EARTH), plane}) == 2
    assert eval(repr(earth)) == earth
    with pytest.raises(AttributeError):
        earth.radius = 1.0
    for radius in (0, -1, float("nan"), float("inf")):
        with pytest.raises(temper.TemperError, match="expected a positive, finite number"):
            Space.sphere(radius)


def test_closed_meshes_go_in_and_out_unchanged():
    mesh = temper.Mesh(EARTH * OCTAHEDRON, FACES, space=Space.sphere(EARTH))
    assert mesh.space == Space.sphere(EARTH) and mesh.validate() is None
    assert np.array_equal(mesh.points, EARTH * OCTAHEDRON) and np.array_equal(mesh.triangles, FACES)
    assert (mesh.weights == 0).all() and len(mesh.boundary_edges) == 0 and mesh.n_edges == 12
    assert "Space.sphere(6371220.0)" in repr(mesh)
    with pytest.warns(temper.TemperWarning, match="8 clockwise triangles are reversed"):
        assert temper.Mesh(OCTAHEDRON, np.array(FACES)[:, ::-1], space=Space.sphere(1)).reversed_triangles == 8


def test_places_are_on_the_sphere_and_weighted_vectors_are_weights_too(tempered):
    places, vectors, weights = tempered.points, tempered.weighted_vectors, tempered.weights
    assert places.shape == vectors.shape == (300, 3) and np.ptp(weights) > 0
    assert np.allclose(np.linalg.norm(places, axis=1), EARTH, rtol=1e-15)
    assert np.allclose(np.sum(vectors**2, axis=1) - weights, EARTH**2, rtol=1e-15)
    assert np.allclose(places, EARTH * unit(vectors), rtol=1e-15)
    assert not any(array.flags.writeable for array in (places, vectors, weights))
    assert not vectors.flags.owndata and vectors.strides == (32, 8)


def test_a_view_keeps_what_it_showed(globe):
    vectors = globe.weighted_vectors
    before = vectors.copy()
    temper.optimize(globe, options={"max_sweeps": 2})
    assert np.array_equal(vectors, before) and not np.array_equal(globe.weighted_vectors, before)


def test_copies_are_meshes_of_their_own_bit_for_bit(tempered):
    for other in (tempered.copy(), copy.deepcopy(tempered), pickle.loads(pickle.dumps(tempered))):
        assert other == tempered and np.array_equal(other.weighted_vectors, tempered.weighted_vectors)
        other.weights = np.zeros(300)
        assert other != tempered
    again = temper.Mesh(tempered.points, tempered.triangles, tempered.weights, space=tempered.space)
    assert np.allclose(again.weighted_vectors, tempered.weighted_vectors, rtol=0, atol=1e-8)


def test_vertices_are_assigned_at_once_or_not_at_all(globe):
    places = np.array(globe.points)
    weights = 1e-3 * EARTH**2 * np.random.default_rng(1).random(300)
    globe.weights = weights
    assert np.allclose(globe.weights, weights, atol=1e-2) and np.allclose(globe.points, places, rtol=1e-15)
    turn = np.array([(0, -1, 0), (1, 0, 0), (0, 0, 1)], dtype=float)
    globe.points = places @ turn.T
    assert np.allclose(globe.weights, weights, atol=1e-2) and np.allclose(globe.points, places @ turn.T, rtol=1e-15)
    before = globe.copy()
    for values, code in ((-places, "zero_area"), (1.001 * places, "not_on_sphere"), (places[:9], "size_mismatch")):
        with pytest.raises(temper.TemperError) as caught:
            globe.points = values
        assert caught.value.code == code
    with pytest.raises(temper.TemperError, match="point 0: weight not above minus the square of the radius"):
        globe.weights = np.full(300, -(EARTH**2))
    with pytest.raises(ValueError, match=r"points: expected shape \(n, 3\), found \(300, 2\)"):
        globe.points = places[:, :2]
    assert globe == before


@pytest.mark.parametrize(
    "points, code, says",
    [
        (1.5 * OCTAHEDRON, "not_on_sphere", "point 0"),
        (np.where(np.arange(18).reshape(6, 3) == 7, np.nan, OCTAHEDRON), "not_finite", "point 2"),
    ],
)
def test_bad_points_are_refused_by_name(points, code, says):
    with pytest.raises(temper.TemperError) as caught:
        temper.Mesh(points, FACES, space=Space.sphere(1))
    assert caught.value.code == code and says in caught.value.message


def test_the_plane_has_no_weighted_vectors_and_no_third_coordinate(ring):
    assert ring.space == Space()
    with pytest.raises(temper.TemperError, match="the mesh is one of the plane"):
        ring.weighted_vectors
    with pytest.raises(ValueError, match=r"expected shape \(n, 3\), found \(6, 2\)"):
        temper.Mesh(OCTAHEDRON[:, :2], FACES, space=Space.sphere(1))


# --- examples and files --------------------------------------------------------------------------------------


def test_an_icosahedron_is_bisected():
    mesh = temper.generate.icosahedral(3, radius=2)
    assert mesh.n_vertices == 10 * 4**3 + 2 and mesh.n_triangles == 20 * 4**3 and mesh.space == Space.sphere(2)
    assert np.allclose(np.linalg.norm(mesh.points, axis=1), 2, rtol=1e-15) and topology.is_regular(mesh, 0)


def test_points_around_the_sphere_are_triangulated_by_their_hull():
    directions = np.random.default_rng(2).normal(size=(200, 3))
    mesh = temper.generate.spherical_delaunay(directions, radius=3)
    assert np.allclose(mesh.points, 3 * unit(directions)) and mesh.n_triangles == 2 * 200 - 4
    a, b, c = faces_of(mesh)
    normal = np.cross(b - a, c - a)
    heights = np.einsum("tk,vtk->vt", normal, mesh.points[:, None] - a)
    assert (heights < 1e-12).all()  # no point is above a face
    with pytest.raises(temper.TemperError):
        temper.generate.spherical_delaunay(np.abs(directions))
    with pytest.raises(ValueError, match=r"\(n, 3\)"):
        temper.generate.spherical_delaunay(directions[:, :2])


def test_optimized_random_points_have_no_bad_triangle_and_stay_on_the_sphere(globe):
    assert not temper.triangle_quality(globe).well_centered.all()
    report = temper.optimize(globe)
    quality = temper.quality(globe)
    assert temper.triangle_quality(globe).well_centered.all() and quality.well_centered_fraction == 1
    assert report.objective_after <= report.objective_before and quality.non_regular_edges == 0
    assert np.allclose(np.linalg.norm(globe.points, axis=1), EARTH, rtol=1e-15) and globe.validate() is None


def test_files_keep_all_bits_of_what_has_no_weights(globe, in_scratch):
    temper.write("globe.vtu", globe)
    again = temper.read("globe.vtu")
    assert again == globe and again.space == globe.space
    temper.optimize(again)
    temper.write("after.vtu", again)
    after = temper.read("after.vtu")
    assert np.array_equal(after.triangles, again.triangles)
    assert np.allclose(after.weighted_vectors, again.weighted_vectors, rtol=1e-15)


def test_data_are_assigned_on_a_sphere(globe):
    globe.cell_data["number"] = np.arange(globe.n_triangles)
    globe.point_data["depth"] = globe.points[:, 2]
    again = pickle.loads(pickle.dumps(globe))
    assert np.array_equal(again.cell_data["number"], np.arange(globe.n_triangles))
    assert np.array_equal(again.point_data["depth"], globe.points[:, 2])


def test_data_stay_where_they_were_measured(globe):
    def depth(points):
        return 3000 + 0.0002 * points @ (1.0, -2.0, 0.5)

    globe.point_data["depth"], globe.point_data["station"] = depth(globe.points), np.arange(300)
    globe.cell_data["number"] = np.arange(globe.n_triangles)
    before = globe.copy()
    report = temper.optimize(globe)
    assert report.data.interpolated == ["depth"] and report.data.kept == ["station"] and report.data.points_moved > 200
    off = np.abs(globe.point_data["depth"] - depth(globe.points))
    moved = np.abs(depth(before.points) - depth(globe.points))
    assert off.max() < moved.max() / 3 and off.mean() < moved.mean() / 5
    assert np.array_equal(globe.point_data["station"], np.arange(300))
    # Of the triangle that the middle of each is in.
    a, b, c = np.moveaxis(before.points[before.triangles[globe.cell_data["number"]]], 1, 0)
    middle = globe.points[globe.triangles].mean(axis=1)
    for p, q in ((a, b), (b, c), (c, a)):
        assert (geometry.orientation(p, q, middle, space=globe.space) >= 0).all()


# --- geometry ------------------------------------------------------------------------------------------------


def test_solid_angles_of_a_closed_mesh_sum_to_the_whole_sphere(tempered):
    for mesh in (temper.generate.icosahedral(3), tempered):
        a, b, c = faces_of(mesh)
        solid = geometry.solid_angle(a, b, c)
        assert (solid > 0).all() and np.sum(solid) == pytest.approx(4 * np.pi, rel=1e-13)
        corners = [geometry.corner_angle(*t, space=mesh.space) for t in ((a, b, c), (b, c, a), (c, a, b))]
        assert np.allclose(sum(corners) - np.pi, solid, atol=1e-12)  # Girard
        assert np.allclose(geometry.solid_angle(a, c, b), -solid, rtol=1e-13)


def test_arcs_crossings_and_heights_are_what_vectors_say(tempered):
    p, q, r = faces_of(tempered)
    space = tempered.space
    arc = geometry.arc_length(p, q)
    assert np.allclose(arc, angle(p, q), rtol=1e-13)
    n = np.cross(q - p, r - p)
    o = geometry.orthocenter(p, q, r, space=space)
    assert np.allclose(o, unit(n), atol=1e-13) and np.allclose(np.linalg.norm(o, axis=1), 1)
    for vertex in (q, r):  # equal power: the same P · o
        assert np.allclose(np.sum(p * o, axis=1), np.sum(vertex * o, axis=1), rtol=1e-14)
    split = geometry.dual_crossing(p, q, space=space)
    assert np.allclose(np.tan(split), np.sum(p * (p - q), axis=1) / np.linalg.norm(np.cross(p, q), axis=1), rtol=1e-12)
    assert np.allclose(split + geometry.dual_crossing(q, p, space=space), arc, atol=1e-13)
    height = geometry.signed_height(p, q, r, space=space)
    assert np.allclose(np.sin(height), np.sum(unit(np.cross(p, q)) * o, axis=1), atol=1e-13)
    assert np.array_equal(geometry.signed_height_sign(p, q, r, space=space), np.sign(height))
    assert np.array_equal(geometry.dual_crossing_sign(p, q, space=space), np.sign(split))
    assert (geometry.orientation(p, q, r, space=space) == np.sign(np.linalg.det(np.stack([p, q, r], axis=1)))).all()
    assert geometry.is_well_centered(p, q, r, space=space).all()


def test_power_tests_say_that_no_point_is_above_a_face(tempered):
    p, q, r = faces_of(tempered)
    vectors, space = tempered.weighted_vectors, tempered.space
    twins = tempered.twins.reshape(-1, 3)[:, 0]
    across = vectors[tempered.triangles.ravel()[3 * (twins // 3) + (twins + 2) % 3]]
    assert (geometry.power_test(p, q, r, across, space=space) == -1).all()
    assert (geometry.power_test(p, q, r, 1.5 * across, space=space) == 1).all()
    a, b, c, d = OCTAHEDRON[[0, 1, 3, 4]]  # on the equator
    index = (0, 1, 2, 3)
    assert geometry.power_test_perturbed(a, b, c, d, index, space=space) == 0
    square = unit(np.array([(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1)], dtype=float))
    assert geometry.power_test(*square, space=space) == 0
    assert abs(geometry.power_test_perturbed(*square, index, space=space)) == 1


def test_the_plane_and_the_sphere_do_not_mix(globe):
    a, b, c = OCTAHEDRON[:3]
    assert geometry.orientation(a, b, c, space=globe.space) == 1
    assert geometry.orientation(b, a, c, space=globe.space) == -1
    assert geometry.orientation((0, 0), (1, 0), (0, 1)) == 1
    with pytest.raises(ValueError, match=r"p: expected shape \(…, 3\), found \(2,\)"):
        geometry.orientation((0, 0), (1, 0), (0, 1), space=globe.space)
    with pytest.raises(ValueError, match=r"\(…, 3\)"):
        geometry.arc_length((0, 1), (1, 0))


def test_energies_are_those_of_the_flat_triangles(globe):
    model = temper.energy.EnergyModel("F")
    a, b, c = faces_of(globe)
    one = temper.energy.triangle_energy(model, (a[0], b[0], c[0]), space=globe.space)
    along, n = b[0] - a[0], np.cross(b[0] - a[0], c[0] - a[0])
    e1, e2 = unit(along), unit(np.cross(n, along))
    flat = [(p @ e1, p @ e2, p @ p) for p in (a[0], b[0], c[0])]
    assert one == pytest.approx(temper.energy.triangle_energy(model, flat), rel=1e-9)
    assert temper.energy.vertex_energy(globe, model, 0).value <= temper.energy.total_energy(globe, model)


def test_weights_alone_make_a_globe_well_centered_or_a_certificate_says_none_can():
    even = temper.generate.icosahedral(3)
    points = even.points + 0.012 * np.random.default_rng(1).normal(size=(642, 3))
    mesh = temper.Mesh(points / np.linalg.norm(points, axis=1, keepdims=True), even.triangles, space=even.space)
    assert not temper.triangle_quality(mesh).well_centered.all()
    report = temper.find_weights(mesh)
    assert report.verdict == "feasible" and report.solved and report.moved > 0
    assert np.isclose(temper.weight_change(mesh, np.zeros(642), report.weights), report.change)
    mesh.weights = report.weights
    assert temper.triangle_quality(mesh).well_centered.all()
    assert np.isclose(temper.weight_margin(mesh), report.attained)
    bare = temper.generate.random_sphere(100)
    best = temper.best_margin(bare)
    assert best.margin < 0 and temper.check_certificate(bare, best.certificate) == "proves"


def test_explain_gives_reasons_with_places_in_degrees():
    globe = temper.generate.random_sphere(60)
    why = temper.explain(globe, cures=2)
    assert why.verdict == "infeasible"
    bad = np.concatenate([reason.triangles for reason in why.reasons])
    assert sorted(bad) == list(np.flatnonzero(~temper.triangle_quality(globe).well_centered))
    worst = why.reasons[0]
    x, y, z = globe.weighted_vectors[globe.triangles[worst.triangles[0]]].sum(axis=0)
    assert np.allclose(worst.at, (np.degrees(np.arctan2(y, x)), np.degrees(np.arctan2(z, np.hypot(x, y)))))
    assert temper.check_certificate(globe, worst.certificate) == "proves"
    assert worst.cures and temper.edges_that_must_be_split(globe) == []
    assert temper.edge_conflict(globe, 0) is None


# --- what is for the plane alone -----------------------------------------------------------------------------


PLANE_ALONE = {
    "html_report": temper.html_report,
    "plot": temper.plot,
    "position_flip_threshold": lambda mesh: topology.position_flip_threshold(mesh, 0, (1, 0)),
    "grade_boundary": topology.grade_boundary,
    "interpolated_weight": lambda mesh: topology.interpolated_weight(mesh, 0, (0, 0)),
    "plan_boundary_grading": topology.plan_boundary_grading,
    "plan_center": lambda mesh: topology.plan_center(mesh, 0),
    "plan_insertion": lambda mesh: topology.plan_insertion(mesh, (0, 0, 0)),
    "plan_split": lambda mesh: topology.plan_split(mesh, 0, 0.5),
    "triangles_without_free_corner": topology.triangles_without_free_corner,
}


@pytest.mark.parametrize("name", PLANE_ALONE)
def test_what_is_for_the_plane_says_so(name, globe):
    before = globe.copy()
    with pytest.raises(temper.TemperError) as caught:
        PLANE_ALONE[name](globe)
    assert caught.value.code == "unsupported"
    assert caught.value.message == f"the mesh is on a sphere, but {name}() needs a mesh of the plane"
    assert globe == before


def test_a_size_field_is_linear_between_the_points(globe, ring):
    sizes = 1e5 + np.arange(300.0)
    field = temper.SizeField.from_values(globe, sizes)
    assert np.array_equal(field.at(globe.points), sizes) and np.array_equal(field.at(2 * globe.weighted_vectors), sizes)
    middles = globe.points[globe.triangles].mean(axis=1)
    assert np.allclose(field.at(middles), sizes[globe.triangles].mean(axis=1)) and not field.outside(middles).any()
    with pytest.raises(ValueError, match=r"expected shape \(n, 3\), found \(1, 2\)"):
        field.at([(0, 0)])
    with pytest.raises(temper.TemperError, match="no direction"):
        field.at([(0, 0, 0)])
    with pytest.raises(temper.TemperError, match="one of mesh and field is of the plane"):
        temper.size.measure_size(ring, field)
    with pytest.raises(temper.TemperError, match="is on a mesh of the sphere, but the mesh is one of the plane"):
        temper.optimize(ring, size_field=field)
    temper.optimize(globe, size_field=field)
    with pytest.raises(temper.TemperError, match="size_band"):
        temper.optimize(globe, size_field=field, options={"size_band": 2.0})


def test_sizes_are_those_of_the_areas(globe):
    a, b, c = faces_of(globe)
    areas = np.zeros(300)
    np.add.at(areas, globe.triangles, np.linalg.norm(np.cross(b - a, c - a), axis=1)[:, None] / 2)  # of flat triangles
    mean = areas / np.bincount(globe.triangles.ravel())
    assert np.allclose(temper.size.local_size(globe), np.sqrt(4 / np.sqrt(3) * mean), rtol=1e-12)
    field = temper.size.input_size_field(globe)
    assert temper.size.measure_size(globe, field).band == 1
    temper.optimize(globe)
    assert 1 < temper.size.measure_size(globe, field).band < 10


def test_a_trace_is_replayed_to_the_same_bits(globe):
    before, events = globe.copy(), []
    temper.optimize(globe, hooks=temper.Hooks(tracer=events.append))
    assert len(events) > 0 and temper.replay(before, events).mesh == globe


def test_insertions_are_replayed_wherever_they_are(globe):
    found = []
    temper.optimize(globe.copy(), hooks=temper.Hooks(tracer=found.append), options={"max_sweeps": 1})
    a, b, c = faces_of(globe)
    for t in (np.argmax(a[:, 2]), np.argmin(a[:, 2])):  # north and south
        corners = tuple(int(v) for v in globe.triangles[t])
        middle = tuple(((a + b + c) / 3)[t])
        new = dataclasses.replace(found[0], kind="insertion", vertex=300, link=np.array(corners), point=middle)
        after = temper.replay(globe, [new]).mesh
        assert after.n_vertices == 301 and after.validate() is None
        with pytest.raises(temper.TemperError, match="not inside the triangle"):
            temper.replay(globe, [dataclasses.replace(new, point=tuple(-x for x in middle))])


def test_a_weight_threshold_is_where_an_edge_flips(globe):
    up = topology.weight_flip_threshold(globe, 7, 1.0)
    weights = np.zeros(300)
    for factor, non_regular in ((0.999, False), (1.001, True)):
        weights[7] = factor * up
        globe.weights = weights
        assert (topology.count_non_regular_edges(globe) > 0) == non_regular


def test_connectivity_is_edited_on_a_sphere(globe):
    h = next(h for h in range(globe.n_halfedges) if topology.can_flip(globe, h) == "possible")
    topology.flip(globe, h)
    assert globe.validate() is None and not topology.is_regular(globe, h)
    assert topology.restore_regularity(globe).regular
    plan = topology.plan_removal(globe, 5)
    assert plan.status == "possible"
    topology.remove_vertex(globe, plan)
    globe.compact()
    assert globe.n_vertices == 299 and globe.n_triangles == 2 * 299 - 4 and globe.validate() is None


# --- pictures ------------------------------------------------------------------------------------------------


def test_a_sphere_is_drawn_from_where_one_looks(globe, ring):
    front = temper.draw_svg(globe)
    assert front.startswith("<svg") and 'class="limb"' in front and 'class="bad"' in front
    assert temper.draw_svg(globe, view=(0, 0)) == front != temper.draw_svg(globe, view=(180, 0))
    assert globe._repr_svg_() is not None
    before = globe.copy()
    temper.optimize(globe)
    both = temper.draw_svg(globe, before, view=(30, 40), weights=True)
    assert both.count('class="limb"') == 2 and 'class="weight-positive"' in both
    with pytest.raises(temper.TemperError, match="one mesh is of the plane and the other of a sphere"):
        temper.draw_svg(globe, ring)
    with pytest.raises(ValueError, match="view: expected longitude, latitude"):
        temper.draw_svg(globe, view=(1, 2, 3))
    for view in [(0, 95), (0, -90.5), (361, 0), (0, np.nan)]:
        with pytest.raises(ValueError, match="latitude from -90 to 90, found"):
            temper.draw_svg(globe, view=view)


# --- operators and errors --------------------------------------------------------------------------------------


def test_operators_are_those_of_arcs(tempered):
    complex = temper.dec_operators(tempered)
    whole = 4 * np.pi * EARTH**2
    for areas in (complex.star0, complex.areas):
        assert areas.sum() == pytest.approx(whole, rel=1e-12) and (areas > 0).all()
    assert (complex.star1 > 0).all()
    a, b, c = faces_of(tempered)
    assert np.allclose(complex.orthocenters, EARTH * unit(np.cross(b - a, c - a)), rtol=0, atol=1e-5)
    p, q = np.moveaxis(tempered.weighted_vectors[complex.edges.vertices], 1, 0)
    assert np.allclose(complex.edges.length, EARTH * angle(p, q), rtol=1e-12)
    middle = complex.edges.midpoint
    assert np.allclose(np.linalg.norm(middle, axis=1), EARTH, rtol=1e-14)
    assert np.allclose(complex.edges.crossing, EARTH * angle(p, middle), rtol=1e-9)
    left, right = np.moveaxis(complex.orthocenters[complex.edges.triangles], 1, 0)
    assert np.allclose(complex.edges.dual_length, EARTH * angle(left, right), rtol=1e-6)
    cells = complex.power_cells()
    assert cells.corners.shape[1] == 3 and np.allclose(cells.areas, complex.star0, rtol=1e-11)


def test_errors_of_solvers_on_a_closed_mesh(globe):
    before = temper.measure_errors(globe)
    temper.optimize(globe)
    after = temper.measure_errors(globe, fields=["all"])
    assert [row.field for row in after.fields] == temper.error_fields(sphere=True)
    assert after.frame.half_size == EARTH and after.matrices.poisson.positive_definite and after.matrices.flux.positive_definite
    ratios = temper.geometric_mean(temper.error_ratios(after, before))
    assert ratios.star[1].l2 < 0.65 and ratios.poisson.l2 < 0.9 and ratios.flux.l2 < 0.6
    with pytest.raises(temper.TemperError, match="no field 'bump'"):
        temper.measure_errors(globe, fields=["bump"])


def test_graded_globes_are_fine_where_one_says():
    mesh = temper.generate.graded_sphere(5000, ratio=10, at=(90, 0), radius=EARTH)
    assert mesh.space == temper.Space.sphere(EARTH)
    assert mesh == temper.generate.graded_sphere(5000, ratio=10, at=(90, 0), radius=EARTH)
    towards = mesh.weighted_vectors[:, 1] / EARTH
    assert np.count_nonzero(towards > 0.8) > 10 * np.count_nonzero(towards < -0.8)
    with pytest.raises(temper.TemperError, match="ratio"):
        temper.generate.graded_sphere(ratio=0.5)


def test_an_ocean_is_meshed_well_centered():
    island = temper.Outline([(170, -10), (-170, -12), (-175, -35)], [(0, 1), (1, 2), (2, 0)], segment_tags=[4, 4, 4])
    river = temper.Outline([(0, 10), (10, 12), (15, 20)], [(0, 1), (1, 2)])
    made = temper.mesh_sphere(8e5, coasts=island, lines=river, radius=EARTH)
    assert made.bad == 0 and set(made.line_tags) == {0, 4} and made.mesh.space == temper.Space.sphere(EARTH)
    places = temper.projection.lon_lat_of(made.mesh.weighted_vectors[made.vertex_of_point])
    assert np.allclose(places, [(170, -10), (-170, -12), (-175, -35), (0, 10), (10, 12), (15, 20)], rtol=0, atol=1e-9)
    assert temper.dec_operators(made.mesh).areas.sum() < 4 * np.pi * EARTH**2
    with pytest.raises(temper.TemperError, match="closed"):
        temper.mesh_sphere(8e5, coasts=river)


def test_sizes_of_a_mesh_are_those_of_its_field():
    rough = temper.generate.graded_sphere(3000, ratio=5, at=(20, 40))
    wanted = temper.generate.graded_sphere_size(rough.weighted_vectors, 3000, ratio=5, at=(20, 40))
    assert 4 < wanted.max() / wanted.min() <= 5
    field = temper.SizeField.from_values(rough, wanted)
    made = temper.mesh_sphere(field)
    assert made.bad == 0 and made.mesh.space.radius == 1
    assert temper.size.measure_size(made.mesh, field).over_field.median == pytest.approx(1, abs=0.1)


def test_degrees_are_directions_and_back():
    places = np.array([(0.0, 0.0), (90.0, 0.0), (-120.5, 33.25), (180.0, -45.0)])
    directions = temper.projection.direction_of(places)
    assert np.array_equal(directions[:2], [(1, 0, 0), (0, 1, 0)])
    assert np.allclose(temper.projection.lon_lat_of(3 * directions), places, rtol=0, atol=1e-12)


def test_mpas_qualities_are_those_that_mpas_tools_wrote_into_its_own_file():
    path = PUBLIC_MESHES / "sphere" / "mpas_QU1920km.nc"
    if not path.exists():
        pytest.skip("no public meshes")
    try:
        q = temper.quality(temper.read(path))
    except temper.TemperError as error:
        if "netcdf" not in str(error).lower():
            raise
        pytest.skip("no libnetcdf")
    # The least and largest of the variables in the file, which agree with its own places to seven digits.
    assert q.min_cell_quality == pytest.approx(0.6555184529580425, rel=1e-6)
    assert (q.min_grid_spacing, q.max_grid_spacing) == pytest.approx((0.2728388455878057, 0.30509546456976583), rel=1e-6)
    assert q.min_triangle_quality == pytest.approx(0.8576699202028616, rel=1e-6)
    assert q.min_triangle_angle_quality == pytest.approx(0.7619162935236375, rel=1e-6)
    assert q.obtuse_triangles == 0 and q.max_centroid_offset_over_size < 1e-3
