"""Meshes from arrays and back, views, files."""

import copy
import dataclasses
import itertools
import pickle
import re
import threading

import numpy as np
import pytest

import temper
from temper import geometry, topology

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
HALVES = [(0, 1, 2), (0, 2, 3)]


def test_arrays_go_in_and_out_unchanged(ring):
    again = temper.Mesh(ring.points, ring.triangles, ring.weights, regions=ring.regions)
    assert np.array_equal(again.points, ring.points) and again.points.dtype == np.float64
    assert np.array_equal(again.triangles, ring.triangles) and again.triangles.dtype == np.int32
    assert np.array_equal(again.weights, ring.weights)
    assert again == ring and not (again != ring)


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint16])
def test_triangles_may_have_any_whole_type(ring, dtype):
    assert temper.Mesh(ring.points, ring.triangles.astype(dtype)) == ring


def test_views_are_no_copies_and_cannot_be_written(ring):
    for name in ("points", "weights", "triangles", "twins"):
        array = getattr(ring, name)
        assert not array.flags.owndata and not array.flags.writeable
        with pytest.raises(ValueError):
            array[...] = 0
    assert np.shares_memory(ring.points, ring.weights) is False  # they interleave
    assert ring.points.strides == (32, 8) and ring.weights.strides == (32,)
    assert ring.points.__array_interface__["data"][0] == ring.points.__array_interface__["data"][0]


def test_a_view_keeps_what_it_showed_when_the_mesh_changes_or_goes(ring):
    points, weights = ring.points, ring.weights
    before = points.copy()
    temper.optimize(ring)
    assert np.array_equal(points, before) and not np.array_equal(ring.points, before)
    assert (weights == 0).all() and (ring.weights != 0).any()
    del ring
    assert np.array_equal(points, before)


def test_a_copy_is_a_mesh_of_its_own(ring):
    for other in (ring.copy(), copy.copy(ring), copy.deepcopy(ring), pickle.loads(pickle.dumps(ring))):
        assert other == ring
        other.weights = np.full(ring.n_vertices, 1e-4)
        assert other != ring and (ring.weights == 0).all()


def test_points_in_space_are_taken_when_they_have_one_z():
    flat = temper.Mesh([(x, y, 0) for x, y in SQUARE], HALVES)
    assert flat == temper.Mesh(SQUARE, HALVES)
    with pytest.warns(temper.TemperWarning, match=r"points: z = 2\.0 of all of them is dropped"):
        assert temper.Mesh([(x, y, 2) for x, y in SQUARE], HALVES) == flat
    with pytest.raises(temper.TemperError, match=r"point 1 has z = 1\.0, but point 0 has z = 0\.0; expected one z"):
        temper.Mesh([(x, y, x) for x, y in SQUARE], HALVES)
    flat.points = np.column_stack([flat.points, np.zeros(4)])


def test_data_are_assigned_and_travel_with_the_mesh(ring, tmp_path):
    depth, number = ring.points @ (3.0, -1.0), np.arange(ring.n_triangles)
    ring.point_data["depth"] = depth
    ring.cell_data["number"] = number
    ring.cell_data["gone"] = np.zeros((ring.n_triangles, 2))
    del ring.cell_data["gone"]
    assert list(ring.point_data) == ["depth"] and list(ring.cell_data) == ["number"]
    assert np.array_equal(ring.point_data["depth"], depth) and np.array_equal(ring.cell_data["number"], number)
    temper.optimize(ring, options={"max_sweeps": 5})
    assert np.allclose(ring.point_data["depth"], ring.points @ (3.0, -1.0), atol=1e-14)
    before = ring.point_data["depth"]
    ring.point_data["shallow"] = before < 1  # of the vertices as they are now
    assert np.array_equal(ring.point_data["depth"], before)
    temper.write(tmp_path / "ring.vtu", ring)
    for other in (temper.read(tmp_path / "ring.vtu"), pickle.loads(pickle.dumps(ring)), ring.copy()):
        assert list(other.point_data) == ["depth", "shallow"]
        assert all(np.array_equal(other.point_data[name], values) for name, values in ring.point_data.items())
    assert ring.point_data["shallow"].dtype == np.uint8


def test_data_that_fit_no_mesh_are_refused(ring):
    with pytest.raises(temper.TemperError, match=rf"point data 'u': expected {ring.n_vertices} values, found 3"):
        ring.point_data["u"] = [1.0, 2.0, 3.0]
    with pytest.raises(TypeError, match="expected a name and an array of numbers, found 'u' and list"):
        ring.point_data["u"] = ["a"] * ring.n_vertices
    assert len(ring.point_data) == 0
    ring.point_data["u"] = np.zeros(ring.n_vertices)
    with pytest.raises(ValueError, match="read-only"):
        ring.point_data["u"][0] = 1


def test_operators_can_be_pickled(ring):
    operators = temper.dec_operators(ring)
    again = pickle.loads(pickle.dumps(operators))
    assert again == operators and again.power_cells() == operators.power_cells()


def test_neighbors_and_twins_agree(ring):
    twins = ring.twins
    inner = np.flatnonzero(twins >= 0)
    assert (twins[twins[inner]] == inner).all()
    assert np.array_equal(ring.neighbors.ravel()[inner], twins[inner] // 3)
    assert (twins < 0).sum() == len(ring.boundary_edges)
    assert len(ring.edges) == ring.n_edges == (ring.n_halfedges + len(ring.boundary_edges)) / 2


def test_clockwise_triangles_are_reversed_and_counted():
    with pytest.warns(temper.TemperWarning, match="^1 clockwise triangle is reversed$") as caught:
        mesh = temper.Mesh(SQUARE, [(0, 2, 1), (0, 2, 3)])
    assert mesh.reversed_triangles == 1 and mesh.validate() is None
    assert caught[0].filename == __file__ and mesh.warnings == [str(caught[0].message)]


@pytest.mark.parametrize(
    "change, code, says",
    [
        (dict(triangles=[(0, 1, 2), (0, 2, 9)]), "index_out_of_range", "triangle 1"),
        (dict(triangles=[(0, 1, 2), (0, 2, 2**40)]), "index_out_of_range", "triangle 1"),
        (dict(points=[(0, 0), (1, 0), (1, 1), (0, np.nan)]), "not_finite", "point 3"),
        (dict(points=SQUARE + [(0, 1), (2, 2)], triangles=HALVES + [(4, 2, 5)]), "duplicate_point", "point 4"),
        (dict(weights=[0, 0, 0]), "size_mismatch", "3"),
        (dict(triangles=[(0, 1, 2)]), "unused_point", "point 3"),
        (dict(constrained_edges=[(1, 3)]), "missing_edge", "1"),
        (dict(regions=[1]), "size_mismatch", "1"),
        (dict(triangles=np.empty((0, 3), dtype=int)), "empty_input", ""),
    ],
)
def test_bad_arrays_are_refused_by_name(change, code, says):
    with pytest.raises(temper.TemperError) as caught:
        temper.Mesh(**{**dict(points=SQUARE, triangles=HALVES), **change})
    assert caught.value.code == code and says in caught.value.message and isinstance(caught.value, ValueError)
    assert str(caught.value) == caught.value.message and caught.value.where == ""


@pytest.mark.parametrize(
    "change, kind",
    [
        (dict(points=[(0, 0, 0)] * 4), ValueError),
        (dict(points=[0, 1, 2]), ValueError),
        (dict(triangles=[(0.0, 1.0, 2.0)]), TypeError),
        (dict(points=[("a", "b")]), TypeError),
        (dict(triangles=[(0, 1, 2, 3)]), ValueError),
    ],
)
def test_arrays_of_the_wrong_shape_or_type_are_refused(change, kind):
    with pytest.raises(kind):
        temper.Mesh(**{**dict(points=SQUARE, triangles=HALVES), **change})


def test_setting_points_keeps_the_mesh_when_a_triangle_would_turn_over(ring):
    before = ring.copy()
    moved = np.array(ring.points)
    ring.points = moved + (1, 0)
    assert np.allclose(np.array(ring.points) - moved, (1, 0))
    ring.points = moved
    assert ring == before
    with pytest.raises(temper.TemperError, match="triangle .* not counter-clockwise"):
        ring.points = -moved[:, ::-1] * (1, -1) * (-1, 1)
    with pytest.raises(temper.TemperError, match="expected"):
        ring.weights = [1.0]
    with pytest.raises(temper.TemperError, match="point 5.*not finite"):
        ring.weights = np.where(np.arange(ring.n_vertices) == 5, np.inf, 0)
    assert ring == before


def test_constraints_and_fixed_vertices_are_kept_by_an_optimization(ring):
    inner = np.setdiff1d(np.arange(ring.n_vertices), ring.boundary_edges)[:5]
    edge = next(e for e in ring.edges if e[0] in inner and e[1] in inner)
    ring.fixed = inner
    ring.set_constrained([edge])
    places = np.array(ring.points)[inner]
    temper.optimize(ring)
    assert np.array_equal(ring.points[inner], places)
    assert np.array_equal(ring.fixed, np.sort(inner))
    assert tuple(sorted(edge)) in {tuple(sorted(e)) for e in ring.constrained_edges}
    with pytest.raises(temper.TemperError, match="no edge"):
        ring.set_constrained([(0, 0)])


def test_interfaces_of_regions_are_constrained():
    mesh = temper.Mesh(SQUARE, HALVES, regions=[1, 2])
    assert mesh.constrained_edges.tolist() in ([[0, 2]], [[2, 0]]) and mesh.regions.tolist() == [1, 2]


# --- files ---------------------------------------------------------------------------------------------------


def test_files_keep_all_bits(ring, in_scratch):
    temper.optimize(ring)
    assert temper.write("ring.vtu", ring) == []
    again = temper.read("ring.vtu")
    assert again == ring and again.warnings == []


def test_the_quality_of_triangles_is_cell_data_for_others_and_none_of_the_mesh(ring, in_scratch):
    each = temper.triangle_quality(ring)
    temper.write("with.vtu", ring, encoding="ascii")
    text = (in_scratch / "with.vtu").read_text(encoding="utf-8")
    for name, values in dataclasses.asdict(each).items():
        written = re.search(rf'Name="{name}" format="ascii">(.*?)</DataArray>', text, re.S)[1].split()
        assert (np.array(written, dtype=np.float32)[: len(values)] == values.astype(np.float32)).all(), name
    assert not temper.read("with.vtu").cell_data
    temper.write("without.vtu", ring, encoding="ascii", triangle_quality=False)
    assert "min_angle_deg" not in (in_scratch / "without.vtu").read_text(encoding="utf-8")


def test_formats_without_weights_warn_and_use_a_side_file(ring, in_scratch):
    temper.optimize(ring)
    with pytest.warns(temper.TemperWarning, match="weights"):
        messages = temper.write("ring.obj", ring)
    assert len(messages) == 1
    assert np.array_equal(temper.read("ring.obj").weights, ring.weights)


def test_errors_of_files_name_the_place(in_scratch):
    (in_scratch / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    with pytest.raises(temper.TemperError) as caught:
        temper.read("bad.off")
    assert caught.value.where.startswith("bad.off") and "7" in caught.value.message
    with pytest.raises(temper.TemperError) as caught:
        temper.read("missing.vtu")
    assert caught.value.code == "not_found"
    with pytest.raises(temper.TemperError) as caught:
        temper.write("no/such/folder/x.vtu", temper.generate.annulus())
    assert caught.value.code == "not_writable"
    assert list(in_scratch.iterdir()) == [in_scratch / "bad.off"]


def test_all_that_was_in_a_file_is_written_again(ring, in_scratch):
    meshio = pytest.importorskip("meshio")
    temperature = np.asarray(ring.points)[:, 0] * 2 + 1
    group = np.arange(ring.n_triangles, dtype=np.int64)
    meshio.write(
        "in.vtu",
        meshio.Mesh(np.column_stack([ring.points, np.full(ring.n_vertices, 2.5)]), [("triangle", ring.triangles)],
                    point_data={"temperature": temperature}, cell_data={"group": [group]}),
    )  # fmt: skip
    mesh = temper.read("in.vtu")
    assert np.array_equal(mesh.point_data["temperature"], temperature)
    assert np.array_equal(mesh.cell_data["group"], group)
    temper.write("out.vtu", mesh)
    again = meshio.read("out.vtu")
    assert np.array_equal(again.point_data["temperature"], temperature) and (again.points[:, 2] == 2.5).all()


def test_data_follow_vertices_that_were_removed_and_inserted(ring, in_scratch):
    meshio = pytest.importorskip("meshio")
    linear = np.asarray(ring.points) @ (2.0, -1.0)
    source = meshio.Mesh(ring.points, [("triangle", ring.triangles)], point_data={"f": linear})
    mesh = temper.from_meshio(source)
    victim = np.setdiff1d(np.arange(mesh.n_vertices), mesh.boundary_edges)[0]
    topology.remove_vertex(mesh, topology.plan_removal(mesh, victim))
    with pytest.raises(temper.TemperError, match="compact"):
        temper.quality(mesh)
    with pytest.raises(temper.TemperError, match="compact"):
        mesh.fixed = [int(mesh.boundary_edges[0, 0])]
    with pytest.raises(temper.TemperError, match="compact"):
        mesh.set_constrained(mesh.boundary_edges[:1])
    mesh.compact()
    plan = topology.plan_split(mesh, int(np.flatnonzero(mesh.twins >= 0)[0]), 0.5)
    topology.insert_vertex(mesh, plan)
    assert mesh.validate() is None and mesh.n_vertices == ring.n_vertices
    values = mesh.point_data["f"]
    assert np.allclose(values, np.asarray(mesh.points) @ (2.0, -1.0))


def test_formats_are_those_of_the_program():
    names = [f.name for f in temper.formats()]
    assert {"vtu", "gmsh41", "medit"} <= set(names) and len(names) == len(set(names))


# --- topology and geometry ---------------------------------------------------------------------------------------


def test_flipping_four_times_changes_nothing(ring):
    before = ring.copy()
    h = next(h for h in range(ring.n_halfedges) if topology.can_flip(ring, h) == "possible")
    for _ in range(4):
        assert topology.can_flip(ring, h) == "possible"
        h = topology.flip(ring, h)
    assert ring == before and ring.validate() is None
    boundary = int(np.flatnonzero(ring.twins < 0)[0])
    with pytest.raises(temper.TemperError, match="boundary"):
        topology.flip(ring, boundary)


def test_a_plan_is_for_one_state_of_the_mesh(ring):
    inner = int(np.setdiff1d(np.arange(ring.n_vertices), ring.boundary_edges)[0])
    plan = topology.plan_removal(ring, inner)
    assert plan.status == "possible" and plan.vertex == inner and len(plan.triangles) == len(plan.link) - 2
    ring.weights = np.zeros(ring.n_vertices)
    with pytest.raises(temper.TemperError, match="another state"):
        topology.remove_vertex(ring, plan)
    on_boundary = topology.plan_removal(ring, int(ring.boundary_edges[0, 0]))
    with pytest.raises(temper.TemperError, match="cannot be committed"):
        topology.remove_vertex(ring, on_boundary)


def test_a_plan_is_of_one_mesh_and_of_copies_of_its_state():
    large, small = temper.generate.random_mesh(400, seed=1), temper.generate.random_mesh(40, seed=1)
    removal = topology.plan_removal(large, 399)
    insertions = (topology.plan_center(large, triangle) for triangle in reversed(range(large.n_triangles)))
    insertion = next(plan for plan in insertions if plan.status == "possible")
    assert removal.status == "possible" and min(insertion.cavity) >= small.n_triangles
    same, before = large.copy(), small.copy()
    for other in (small, temper.generate.random_mesh(400, seed=1)):  # an equal one is another one
        with pytest.raises(temper.TemperError, match="for another mesh"):
            topology.remove_vertex(other, removal)
        with pytest.raises(temper.TemperError, match="for another mesh"):
            topology.insert_vertex(other, insertion)
    assert small == before and small.validate() is None
    for mesh in (large, same):
        topology.remove_vertex(mesh, removal)
        mesh.compact()
    assert large == same and same.validate() is None
    with pytest.raises(temper.TemperError, match="another state"):
        topology.remove_vertex(same, removal)


@pytest.mark.parametrize("index", [-1, 10**6, 2**40])
def test_numbers_out_of_range_are_refused(ring, index):
    for call in (lambda: topology.can_flip(ring, index), lambda: ring.star(index), lambda: topology.plan_removal(ring, index),
                 lambda: ring.find_halfedge(0, index), lambda: topology.plan_insertion(ring, (0.5, 0.5, 0), index)):  # fmt: skip
        with pytest.raises(temper.TemperError) as caught:
            call()
        assert caught.value.code == "index_out_of_range"


def test_restoring_regularity_is_idempotent(ring):
    ring.weights = np.random.default_rng(3).uniform(0, 2e-3, ring.n_vertices)
    first = topology.restore_regularity(ring)
    assert first.flips > 0 and first.regular and topology.count_non_regular_edges(ring) == 0
    assert topology.restore_regularity(ring).flips == 0


def test_signs_follow_the_conventions():
    p, q, r = (0, 0), (1, 0), (0.5, 1)
    assert geometry.orientation(p, q, r) == 1 and geometry.orientation(p, r, q) == -1
    assert geometry.signed_height(p, q, r) > 0 and geometry.signed_height(p, q, (0.5, 0.1)) < 0
    heavy = (0, 0, 0.5)
    assert geometry.dual_crossing(heavy, q) == 0.75 and geometry.dual_crossing(q, heavy) == 0.25
    center = geometry.orthocenter(heavy, q, r)
    powers = [((center - np.array(v[:2])) ** 2).sum() - (v[2] if len(v) == 3 else 0) for v in (heavy, q, r)]
    assert np.ptp(powers) < 1e-14


def test_geometry_broadcasts():
    many = np.random.default_rng(1).uniform(size=(4, 5, 2))
    signs = geometry.orientation((0, 0), (1, 0), many)
    assert signs.shape == (4, 5) and (signs == 1).all()
    assert geometry.scaled_heights((0, 0), (1, 0), many).shape == (4, 5, 3)
    assert geometry.orthocenter((0, 0), (1, 0), many).shape == (4, 5, 2)
    assert np.allclose(geometry.scaled_heights((0, 0), (1, 0), many).sum(-1), geometry.doubled_area((0, 0), (1, 0), many))


def test_exactness_of_orientation_where_doubles_fail():
    x = 0.5 + np.arange(64) * 2.0**-53
    signs = geometry.orientation((12, 12), (24, 24), np.column_stack([x, np.full(64, 0.5)]))
    assert np.array_equal(signs, -np.sign(x - 0.5))


def test_projections_are_inverse_and_conformal():
    from temper import projection

    places = np.array([(8.0, 54.0), (9.5, 55.5), (7.0, 53.5)])
    p = projection.parse_projection("stereographic", places)
    there = projection.forward(p, places)
    assert np.allclose(projection.inverse(p, there), places)
    assert (projection.scale_factor(p, places) >= 1).all()


class Changing:
    """While it is open another thread changes the weights, all to one value, over and over."""

    def __init__(self, mesh):
        self.mesh, self.stop = mesh, threading.Event()
        self.thread = threading.Thread(target=self.change)

    def change(self):
        for k in itertools.count(1):
            if self.stop.is_set():
                return
            self.mesh.weights = np.full(self.mesh.n_vertices, k * 1e-9)

    def __enter__(self):
        self.thread.start()

    def __exit__(self, *error):
        self.stop.set()
        self.thread.join()


def test_what_is_written_while_a_thread_changes_the_mesh_is_one_state(tmp_path):
    temper.write(tmp_path / "in.vtu", temper.generate.random_mesh(2000))
    mesh = temper.read(tmp_path / "in.vtu")
    with Changing(mesh):
        for k in range(10):
            temper.write(tmp_path / f"{k}.vtu", mesh)
    written = [np.unique(temper.read(tmp_path / f"{k}.vtu").weights) for k in range(10)]
    assert all(len(weights) == 1 for weights in written) and written == sorted(written)


def test_data_of_a_mesh_that_a_thread_changes_meanwhile_are_refused():
    mesh = temper.generate.random_mesh(5000)
    with Changing(mesh), pytest.raises(temper.TemperError, match="data 'u' are as they were: another thread"):
        for _ in range(1000):  # the first, unless nobody lets the thread run
            mesh.point_data["u"] = np.zeros(mesh.n_vertices)
    mesh.point_data["u"] = np.ones(mesh.n_vertices)
    assert (mesh.point_data["u"] == 1).all()


def test_threads_of_python_may_read_while_a_mesh_is_optimized(ring):
    mesh = temper.generate.random_mesh(4000)
    before = mesh.copy()
    seen = []

    def look(progress):
        seen.append(np.array_equal(mesh.points, before.points))
        with pytest.raises(temper.TemperError, match="has not returned"):
            mesh.weights = mesh.weights

    temper.optimize(mesh, progress=look, options={"max_sweeps": 3})
    assert seen and all(seen) and mesh != before
    ticks = []
    stop = threading.Event()
    counter = threading.Thread(target=lambda: [ticks.append(1) for _ in iter(lambda: stop.wait(0.001), True)])
    counter.start()
    temper.optimize(before, options={"max_sweeps": 20})
    stop.set()
    counter.join()
    assert len(ticks) > 3  # the GIL was free


CRACKED = "OFF\n8 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 1e-9 0\n2 0 0\n2 1 0\n1 1 0\n3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n"


def test_points_that_are_near_each_other_become_one(tmp_path):
    path = tmp_path / "in.off"
    path.write_text(CRACKED, encoding="utf-8")
    with pytest.raises(temper.TemperError, match=r"point 2 and point 7 are both at \(1, 1\)"):
        temper.read(path)
    mesh = temper.read(path, merge=1e-8)
    assert mesh.n_vertices == 6 and mesh.n_triangles == 4 and len(mesh.boundary_edges) == 6
    assert mesh.points.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [2, 1]]
    with pytest.raises(temper.TemperError, match="makes two corners of triangle 0 one; expected less than its edges"):
        temper.read(path, merge=1)
    with pytest.raises(temper.TemperError, match="expected a radius of at least 0, found -1"):
        temper.read(path, merge=-1)
