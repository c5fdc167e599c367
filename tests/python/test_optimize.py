"""Optimization: the same as the program's, observed, interrupted, replayed."""

import ast
import dataclasses
import inspect
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import threading
import warnings

import numpy as np
import pytest
from conftest import optimized

import temper
from temper import topology


def test_it_makes_a_mesh_well_centered_and_keeps_the_boundary(ring):
    boundary = np.unique(ring.boundary_edges)
    places = np.array(ring.points)[boundary]
    report = temper.optimize(ring)
    assert report.stopped in ("converged", "sweep_limit") and report.history[0].bad > 0 and report.history[-1].bad == 0
    assert temper.quality(ring).well_centered_fraction == 1
    assert np.array_equal(ring.points[boundary], places) and ring.validate() is None


def test_the_same_bits_for_any_number_of_threads():
    meshes = [temper.generate.random_mesh(3000) for _ in range(3)]
    for mesh, threads in zip(meshes, (1, 2, None)):
        temper.optimize(mesh, threads=threads, options={"max_sweeps": 8})
    assert meshes[0] == meshes[1] == meshes[2]


def test_the_guard_takes_depths_from_point_data():
    """The least time of a wave across a triangle is no worse, as in the program; without depths it is."""

    def least_time(mesh):
        corners = np.asarray(mesh.points)[np.asarray(mesh.triangles)]
        ends = np.roll(corners, -1, axis=1) - corners
        longest = np.sqrt((ends**2).sum(axis=2)).max(axis=1)
        areas = np.abs(ends[:, 0, 0] * ends[:, 1, 1] - ends[:, 0, 1] * ends[:, 1, 0])
        depths = np.maximum(mesh.point_data["depth"][np.asarray(mesh.triangles)].mean(axis=1), 1)
        return (areas / longest / np.sqrt(9.81 * depths)).min()

    least = []
    off = {"guard": "none", "guard_angle": 0, "guard_edge": 0, "guard_areas": None}
    for guard in (off, off | {"guard_step": 1e9}):
        mesh = temper.generate.annulus()
        x, y = np.asarray(mesh.points).T
        mesh.point_data["depth"] = 50 + 40 * x
        before = least_time(mesh)
        temper.optimize(mesh, target="fem", options=guard)
        least.append(least_time(mesh) / before)
    assert least[0] < 0.999 and least[1] >= 1 - 1e-9


def at_once(*works):
    """What the works return, each called in a thread of its own."""
    results = [None] * len(works)

    def run(i):
        try:
            results[i] = works[i]()
        except Exception as error:
            results[i] = error

    threads = [threading.Thread(target=run, args=(i,)) for i in range(len(works))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results


def test_two_threads_of_python_optimize_two_meshes_at_once():
    alone = [temper.generate.random_mesh(3000, seed=seed) for seed in (1, 2)]
    together = [mesh.copy() for mesh in alone]
    for mesh in alone:
        temper.optimize(mesh, threads=1, options={"max_sweeps": 5})
    both_run = threading.Barrier(2)  # breaks where one run waits for the end of the other: the GIL is not released

    def optimized(mesh):
        waited = []

        def observer(_):
            if not waited:
                waited.append(both_run.wait(60))

        temper.optimize(mesh, threads=1, progress=observer, options={"max_sweeps": 5})
        return mesh

    assert at_once(*[lambda mesh=mesh: optimized(mesh) for mesh in together]) == alone


def test_two_threads_of_python_look_at_one_mesh():
    mesh = temper.generate.random_mesh(5000)
    quality, energy = repr(temper.quality(mesh)), temper.energy.total_energy(mesh)

    def look():
        for _ in range(5):
            assert repr(temper.quality(mesh)) == quality and temper.energy.total_energy(mesh) == energy
        return optimized(mesh, threads=1, options={"max_sweeps": 2})

    first, second = at_once(look, look)
    assert first == second and first != mesh


def test_a_mesh_that_another_thread_optimizes_shows_its_old_state_and_refuses_changes():
    mesh = temper.generate.random_mesh(3000)
    before, seen, begun, looked = mesh.copy(), [], threading.Event(), threading.Event()

    def observer(_):
        begun.set()
        return looked.wait(60)

    def look():
        assert begun.wait(60)
        seen.append(mesh == before)
        try:
            temper.optimize(mesh, options={"max_sweeps": 1})
        except Exception as error:
            seen.append(error)
        looked.set()

    report, _ = at_once(lambda: temper.optimize(mesh, progress=observer, options={"max_sweeps": 2}), look)
    assert report.sweeps == 2 and seen[0] and mesh != before
    assert isinstance(seen[1], temper.TemperError) and "a call that has not returned" in str(seen[1])


def test_the_same_bits_as_the_program(ring, in_scratch):
    program = in_scratch  # the program is on the path, where it was built
    temper.write("in.vtu", ring)
    try:
        subprocess.run(["temper", "optimize", "in.vtu", "-o", "out.vtu", "--quiet"], check=True, cwd=program)
    except FileNotFoundError:
        pytest.skip("the program was not built")
    temper.optimize(ring)
    assert temper.read("out.vtu") == ring


def test_a_copy_is_optimized_and_its_mesh_left_alone(ring):
    before = ring.copy()
    better = optimized(ring)
    assert ring == before and temper.quality(better).well_centered_fraction == 1


def test_options_are_the_rows_of_the_table(ring):
    rows = temper._temper.option_table()
    options = temper.OptimizeOptions()
    assert [f.name for f in dataclasses.fields(options)] == [row["name"] for row in rows] and len(rows) > 40
    for row in rows:
        name, default = row["name"], getattr(options, row["name"])
        assert re.search(rf"^{name} : ", temper.OptimizeOptions.__doc__, re.M) and row["sentence"]
        assert default in row["choices"] or not row["choices"] or default is None
    temper.optimize(ring, threads=1, options={row["name"]: getattr(options, row["name"]) for row in rows})


def test_every_choice_is_taken_and_every_range_is_checked(ring):
    choices = refused = 0
    for row in temper._temper.option_table():
        for choice in row["choices"]:
            assert temper._temper.idle_options({row["name"]: choice}, []) == []
            choices += 1
        wrong = {"int": -1, "float": -1.0, "LengthParameterLike": -1.0}.get(row["type"].removesuffix(" | None"))
        if wrong is None:
            continue
        with pytest.raises(temper.TemperError, match=f"^{row['name']} is -1; expected {row['range']}") as caught:
            temper.optimize(ring, options={row["name"]: wrong})
        assert caught.value.code == "invalid_option"
        refused += 1
    assert choices > 50 and refused > 20


def test_stubs_have_every_option():
    stub = (pathlib.Path(temper.__file__).parent / "_options.pyi").read_text(encoding="utf-8")
    classes = {node.name: node for node in ast.parse(stub).body if isinstance(node, ast.ClassDef)}
    for name in ("OptimizeOptions", "OptionChanges"):
        fields = {n.target.id: ast.unparse(n.annotation) for n in classes[name].body if isinstance(n, ast.AnnAssign)}
        types = {row["name"]: ast.unparse(ast.parse(row["type"])) for row in temper._temper.option_table()}
        assert fields == types


def test_options_win_over_the_target_even_when_they_say_the_default(ring):
    options = dataclasses.replace(temper.options_for("paper"), max_sweeps=1)
    assert options.solver == "golden" and options.gamma == temper.LengthParameter(1.0, "absolute")
    a, b = ring.copy(), ring.copy()
    changes = dict(max_sweeps=2, solver="newton", weight_updates="immediate", inversion="refuse", flips="immediate")
    temper.optimize(a, target="paper", options=changes)
    temper.optimize(b, options=dataclasses.replace(options, **changes))
    assert a == b
    with pytest.raises(TypeError, match="target, effort and keep have no effect"):
        temper.optimize(b, target="paper", options=options)


def sorted_into_arguments(words):
    """Words that are no parameters of optimize are hooks or options."""
    parameters = inspect.signature(temper.optimize).parameters
    hooks = {name: words[name] for name in ("tracer", "snapshots") if name in words}
    options = {name: value for name, value in words.items() if name not in parameters and name not in hooks}
    given = {name: words[name] for name in parameters if name in words}
    return {"hooks": temper.Hooks(**hooks), "options": options, **given}


@pytest.mark.parametrize(
    "options, says",
    [
        (dict(target="mpass"), "mpas"),
        (dict(keep=("positions", "weights")), "nothing can change"),
        (dict(keep="edges", flips="immediate"), "keep 'edges' contradicts flips=\"immediate\""),
        (dict(keep="boundary", boundary="slide"), "keep 'boundary' contradicts"),
        (dict(energy="HOT"), "BP"),
        (dict(solver="nwton"), "solver is nwton; expected newton, golden or alternating"),
        (dict(star=3), "star"),
        (dict(gamma=-1.0), "gamma|γ"),
        (dict(max_sweeps=-1), "sweeps"),
        (dict(anchor=-2), "anchor"),
        (dict(threads=-1), "threads"),
        (dict(size_band=0.5), "band"),
        (dict(gamma=temper.LengthParameter(1.0, "meters")), "scale"),
    ],
)
def test_options_that_make_no_sense_leave_the_mesh_alone(ring, options, says):
    before = ring.copy()
    with pytest.raises(temper.TemperError, match=says) as caught:
        temper.optimize(ring, **sorted_into_arguments(options))
    assert caught.value.code == "invalid_option" and ring == before


@pytest.mark.parametrize(
    "name, value",
    [
        ("max_sweeps", "many"),
        ("threads", "2"),
        ("threads", 2**70),
        ("gamma", "x"),
        ("h0", temper.LengthParameter("x")),
        ("solver", 3.0),
        ("progress", 3),
        ("target", None),
        ("keep", ["edges", 3]),
        ("hooks", 3),
        ("options", [1]),
        ("tracer", "print"),
        ("snapshots", []),
        ("size_field", 0.1),
        ("seed", 2**70),
    ],
)
def test_options_of_the_wrong_type_are_named(ring, name, value):
    before = ring.copy()
    with pytest.raises(TypeError, match=f"^{name}: "):
        temper.optimize(ring, **sorted_into_arguments({name: value}))
    assert ring == before


def test_unknown_options_are_refused(ring):
    for name in ("sweeps", "target", 1):
        with pytest.raises(TypeError, match=f"there is no option {name!r}"):
            temper.optimize(ring, options={name: 3})


@pytest.mark.parametrize("wrong, right", [
    (dict(options={"max_sweep": 3}), "max_sweeps"), (dict(options={"solver": "newtn"}), "newton"), (dict(target="vertx"), "vertex"),
    (dict(keep="weight"), "weights"), (dict(boundary="slid"), "slide"), (dict(effort="hihg"), "high"),
])  # fmt: skip
def test_misspelled_words_are_told_what_is_near(ring, wrong, right):
    with pytest.raises((TypeError, temper.TemperError), match=f"; did you mean '{right}'\\?$"):
        temper.optimize(ring, **wrong)
    with pytest.raises(temper.TemperError, match="did you mean 'gmsh41'"):
        temper.write("ring.msh", ring, format="gmsh4")


def test_words_that_contradict_each_other_are_refused(ring):
    for wrong, says in (
        (dict(target="cell", options={"scheme": "vertex"}), "target 'cell', which stands for scheme=\"cell\", contradicts"),
        (dict(target="mpas", options={"unknowns": "weights"}), "contradicts unknowns"),
        (dict(keep="positions", boundary="slide"), "keep 'positions' contradicts boundary=\"slide\""),
    ):
        with pytest.raises(temper.TemperError, match=says):
            temper.optimize(ring, **wrong)


def test_threads_of_the_wrong_type_are_named_everywhere(ring):
    for call in (temper.quality, topology.count_non_regular_edges, temper.measure_errors):
        with pytest.raises(TypeError, match="^threads: "):
            call(ring, threads="2")


def test_options_without_effect_are_a_warning(ring):
    with pytest.warns(temper.TemperWarning, match='^margin has no effect without objective="accuracy"$'):
        temper.optimize(ring.copy(), options={"margin": 0.1, "max_sweeps": 1, "objective": "energy"})
    with pytest.warns(temper.TemperWarning, match='^overshoot has no effect without flip_limit="after"$'):
        temper.optimize(ring.copy(), options={"overshoot": 1.2, "max_sweeps": 1})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        temper.optimize(ring.copy(), options=temper.OptimizeOptions(margin=0.1, max_sweeps=1))
        temper.optimize(ring.copy(), options={"energy": "F", "overshoot": 1.2, "max_sweeps": 1})


def test_an_observer_sees_sweeps_and_may_stop(ring):
    seen = []

    def observe(progress):
        seen.append(progress)
        return np.bool_(progress.last.sweep < 2)

    report = temper.optimize(ring, progress=observe)
    assert report.stopped == "canceled" and seen[-1].last.sweep == 2 and seen[0].max_sweeps == 1000


def test_an_exception_of_an_observer_comes_out_when_the_mesh_is_in_place(ring):
    before = ring.copy()

    def observe(progress):
        if progress.last.sweep == 2:
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        temper.optimize(ring, progress=observe)
    assert ring != before and ring.validate() is None
    assert temper.quality(ring).well_centered_fraction > temper.quality(before).well_centered_fraction
    ring.weights = ring.weights  # the run is over


def test_ctrl_c_stops_a_run_and_keeps_the_best_mesh():
    mesh = temper.generate.random_mesh(30000)
    before = temper.quality(mesh).well_centered_fraction
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        temper.optimize(mesh, options={"tolerance": 0, "stopping": "paper", "max_sweeps": 10**6, "relaxation": 0.01})
    timer.join()
    assert mesh.validate() is None and temper.quality(mesh).well_centered_fraction > before


def test_a_trace_makes_the_mesh_again():
    events = []
    mesh = temper.generate.random_mesh(300)
    before = mesh.copy()
    report = temper.optimize(mesh, hooks=temper.Hooks(tracer=events.append), options={"removal": "patch", "removal_from": 1, "max_sweeps": 20})
    assert {e.kind for e in events} >= {"move", "flip"}
    again = temper.replay(before, events)
    assert again.mesh == mesh and np.array_equal(again.vertices, report.vertices)
    with pytest.raises(temper.TemperError) as caught:
        temper.replay(before, [dataclasses.replace(events[0], vertex=10**6)])
    assert caught.value.code == "trace_mismatch"


def test_watching_gives_the_mesh_of_each_sweep(ring):
    shots = []
    before = ring.copy()
    temper.optimize(ring, hooks=temper.Hooks(snapshots=shots.append), options={"max_sweeps": 3})
    assert shots[0].moment == "start" and shots[-1].sweep == 3
    assert np.array_equal(shots[0].mesh.points, before.points)
    assert all(shot.mesh.validate() is None for shot in shots)


def test_weights_alone_leave_positions(ring):
    points = np.array(ring.points)
    temper.optimize(ring, keep="positions")
    assert np.array_equal(ring.points, points) and (ring.weights != 0).any()


def test_the_accuracy_objective_lowers_the_error_of_the_star_and_keeps_its_margin(ring):
    star1 = lambda mesh: temper.geometric_mean(temper.measure_errors(mesh, fields=["held-back"], frame=frame).fields).star[1].l2
    frame = temper.field_frame(ring)
    margin = lambda quality: min(quality.min_h_over_l, quality.min_d_over_l)
    plain = optimized(ring)
    accurate = ring.copy()
    report = temper.optimize(accurate, options={"objective": "accuracy", "accuracy_sweeps": 15, "margin": 0.03})
    assert {record.objective for record in report.history} == {"energy", "accuracy"}
    assert margin(temper.quality(accurate)) >= 0.03 and star1(accurate) < star1(plain)
    with pytest.raises(temper.TemperError, match="margin"):
        temper.optimize(accurate, options={"objective": "accuracy", "margin": 0.5})


def test_edges_and_duals_become_as_long_as_is_asked_for(ring):
    def least(mesh):
        lengths = temper.size.relative_lengths(mesh)
        assert lengths.shape == (mesh.n_edges, 2) and np.isnan(lengths[:, 0]).sum() == len(mesh.boundary_edges)
        return np.nanmin(lengths, axis=0)

    a = 0.5 * np.sqrt(3)
    hexagon = temper.Mesh([[1, 0], [0.5, a], [-0.5, a], [-1, 0], [-0.5, -a], [0.5, -a], [0, 0]], [[6, k, (k + 1) % 6] for k in range(6)])
    assert least(hexagon) == pytest.approx([1, 1 / np.sqrt(3)], rel=1e-12)
    mesh = optimized(ring, options={"min_edge": 0.6, "min_dual": 0.25})
    assert (least(mesh) >= [0.6, 0.25]).all()
    with pytest.raises(temper.TemperError, match="min_dual"):
        temper.optimize(mesh, options={"min_dual": 0.6})


def test_sizes_are_reported_and_can_be_held(ring):
    field = temper.size.input_size_field(ring)
    assert temper.size.measure_size(ring, field).band == pytest.approx(1)
    report = temper.optimize(ring, size_field=field, options={"size_band": 1.3})
    assert report.size.after.band == pytest.approx(temper.size.measure_size(ring, field).band)
    sizes = temper.size.local_size(ring)
    own = temper.SizeField.from_values(ring, sizes)
    assert np.array_equal(own.at(ring.points), sizes) and not own.outside(ring.points).any()
    with pytest.raises(temper.TemperError, match="point 7|vertex 7"):
        temper.SizeField.from_values(ring, np.where(np.arange(ring.n_vertices) == 7, -1, 1))


def test_a_mesh_that_does_not_fit_in_the_memory_is_refused():
    square = temper.Outline([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    with pytest.raises(temper.TemperError, match="about 637 MB of memory, but 100 MB are free. Next: a size of "):
        temper.mesh_outline(square, 0.001, memory=100_000_000)
    for size in (1e-9, 1e-300):
        with pytest.raises(temper.TemperError, match="triangles.* Next: a size of "):
            temper.mesh_outline(square, size)
    with pytest.raises(temper.TemperError, match="Next: a size of "):
        temper.mesh_sphere(1.0)
    phases = []
    temper.mesh_outline(square, 0.004, optimize=False, observer=lambda now: phases.append(now.phase))
    assert "placing points" in phases


def test_an_outline_is_meshed_well_centered():
    points = [(0, 0), (4, 0), (4, 3), (0, 3), (1, 1), (2, 1), (2, 2), (1, 2)]
    segments = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
    outline = temper.Outline(points, segments, segment_tags=[1] * 4 + [2] * 4, holes=[(1.5, 1.5)])
    made = temper.mesh_outline(outline, 0.4)
    assert made.bad == 0 and set(made.line_tags) == {1, 2}
    assert temper.dec_operators(made.mesh).areas.sum() == pytest.approx(11)
    assert np.array_equal(made.mesh.points[made.vertex_of_point], np.array(points, dtype=float))
    assert temper.mesh_outline(outline, 0.4, optimize=False).bad >= 0
    assert np.array_equal(made.mesh.lines, made.lines) and np.array_equal(made.mesh.tags, made.line_tags)
    assert not temper.mesh_outline(outline, 0.4, target="mpas").mesh.weights.any() and made.mesh.weights.any()
    few = temper.mesh_outline(outline, None)
    assert few.bad == 0 and set(few.line_tags) == {1, 2} and len(few.mesh.points) < 20
    with pytest.raises(ValueError, match="target or optimize"):
        temper.mesh_outline(outline, 0.4, target="mpas", optimize=temper.OptimizeOptions())
    with pytest.raises(temper.TemperError, match="segment"):
        temper.mesh_outline(temper.Outline(points, [(0, 99)]), 0.4)
    with pytest.raises(temper.TemperError):
        temper.mesh_outline(outline, -1)


LAKE = """{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "lake"}, "geometry": {"type": "Polygon", "coordinates": [[[7, 50], [7.02, 50], [7.02, 50.01], [7, 50.01], [7, 50]]]}},
{"type": "Feature", "properties": {"name": "inflow", "tag": 4}, "geometry": {"type": "LineString", "coordinates": [[7, 50], [7.02, 50]]}},
{"type": "Feature", "properties": {"name": "gauge", "tag": 9}, "geometry": {"type": "Point", "coordinates": [7.01, 50.005]}}]}"""


def test_the_mesh_of_an_outline_is_written_as_the_program_writes_it(in_scratch):
    pathlib.Path("lake.geojson").write_text(LAKE, encoding="utf-8")
    subprocess.run(
        ["temper", "mesh", "lake.geojson", "-o", "program.vtu", "--size", "400", "--projection", "stereographic", "--quiet"], check=True
    )
    outline = temper.read_outline("lake.geojson").outline
    made = temper.mesh_outline(
        temper.projection.project(outline, temper.projection.parse_projection("stereographic", outline.points)), 400
    )
    temper.write("python.vtu", made.mesh)
    assert pathlib.Path("python.vtu").read_bytes() == pathlib.Path("program.vtu").read_bytes()
    assert made.mesh.names["inflow"] == (1, 4) and made.mesh.names["gauge"] == (0, 9)
    assert 9 in made.mesh.point_tags and (made.mesh.tags == 4).sum() > 2
    assert len(temper.dec_operators(made.mesh).edges.named["inflow"]) == (made.mesh.tags == 4).sum()
    again = pickle.loads(pickle.dumps(made.mesh))
    assert again.names == made.mesh.names and np.array_equal(again.lines, made.mesh.lines)


# --- progress --------------------------------------------------------------------------------------------------

PROGRAM = textwrap.dedent(
    """
    import temper
    temper.optimize(temper.generate.random_mesh(2000), options={"max_sweeps": 10})
    """
)


def test_progress_is_a_line_on_a_terminal_and_nothing_in_a_pipe():
    environment = {**os.environ}
    silent = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, env=environment, check=True)
    assert silent.stdout == b"" and silent.stderr == b""
    import pty

    ours, theirs = pty.openpty()
    subprocess.run([sys.executable, "-c", PROGRAM], stderr=theirs, env=environment, check=True)
    os.close(theirs)
    shown = os.read(ours, 1 << 16)
    os.close(ours)
    assert b"\rcentering phase: sweep 0, " in shown
    assert shown.endswith(b"\r\x1b[K") and b"\n" not in shown


def test_progress_in_a_notebook_updates_one_display(monkeypatch, ring):
    shown = []

    class Handle:
        def update(self, data, raw):
            shown.append(data["text/plain"])

    def display(data, raw, display_id):
        shown.append(data["text/plain"])
        return Handle()

    import types

    package = types.ModuleType("IPython")
    package.get_ipython = lambda: types.SimpleNamespace(kernel=object())
    package.display = types.ModuleType("IPython.display")
    package.display.display = display
    monkeypatch.setitem(sys.modules, "IPython", package)
    monkeypatch.setitem(sys.modules, "IPython.display", package.display)
    monkeypatch.setattr(temper._progress, "_INTERVAL", 0)
    temper.optimize(ring, options={"max_sweeps": 5})
    assert shown[0].startswith("centering phase: sweep 0") and "triangles bad" in shown[-2] and shown[-1] == ""


def test_reports_read_well(ring):
    report = temper.optimize(ring)
    assert "bad triangles" in str(report) and "→ 0" in str(report)
    assert "<table>" in report._repr_html_() and "<table>" in temper.quality(ring)._repr_html_()
    assert "svg" in ring._repr_html_() and repr(ring).startswith("<temper.Mesh: ")
    import json

    assert json.loads(json.dumps(report.as_dict()))["history"][0]["sweep"] == 0
    json.dumps(temper.quality(ring).as_dict())


# --- data ------------------------------------------------------------------------------------------------------


@pytest.fixture
def sea(ring):
    """A mesh with depths, numbers and cell data, as a file gives them."""
    meshio = pytest.importorskip("meshio")
    points = np.asarray(ring.points)
    data = {"depth": points @ (3.0, -1.0) + 2, "load": points[:, 0] ** 2, "node": np.arange(len(points))}
    cells = [("triangle", np.asarray(ring.triangles))]
    return meshio.Mesh(points, cells, point_data=data, cell_data={"cell": [np.arange(ring.n_triangles)]})


def test_data_follow_the_vertices(sea):
    before = np.array(sea.points)
    mesh = temper.from_meshio(sea)
    mesh.point_data_rules = ("interpolate", "keep=load")
    report = temper.optimize(mesh)
    points, data = np.asarray(mesh.points), mesh.point_data
    assert np.allclose(data["depth"], points @ (3.0, -1.0) + 2, atol=1e-14)
    assert np.array_equal(data["load"], sea.point_data["load"]) and np.array_equal(data["node"], np.arange(len(points)))
    moved = (points != before).any(axis=1)
    assert report.data.points_moved == moved.sum() > 10 and report.data.interpolated == ["depth"]
    assert report.data.distance.max == pytest.approx(np.linalg.norm(points - before, axis=1).max())
    assert report.data.kept == ["load", "node"] and report.data.of_triangles == ["cell"]
    assert "depth" in str(report) and report.as_dict()["data"]["points"] == len(points)
    assert mesh.point_data_rules == ("interpolate", "keep=load") == mesh.copy().point_data_rules
    mesh.point_data_rules = "keep"
    assert np.array_equal(mesh.point_data["depth"], sea.point_data["depth"])


def test_data_follow_the_vertices_of_a_meshio_mesh_in_place(sea):
    temper.optimize(sea)
    assert np.allclose(sea.point_data["depth"], sea.points[:, :2] @ (3.0, -1.0) + 2, atol=1e-14)
    middles = sea.points[sea.cells[0].data, :2].mean(axis=1)
    assert len(sea.cell_data["cell"][0]) == len(middles)


def test_data_are_the_same_as_the_programs(sea, in_scratch):
    temper.write("in.vtu", sea)
    try:
        subprocess.run(["temper", "optimize", "in.vtu", "-o", "out.vtu", "--quiet", "--point-data", "keep=load"], check=True)
    except FileNotFoundError:
        pytest.skip("the program was not built")
    mesh = temper.read("in.vtu")
    mesh.point_data_rules = ["keep=load"]
    temper.optimize(mesh)
    program = temper.read("out.vtu")
    for name, values in mesh.point_data.items():
        assert np.array_equal(program.point_data[name], values), name
    assert np.array_equal(program.cell_data["cell"], mesh.cell_data["cell"])


def test_rules_of_data_that_make_no_sense_leave_the_mesh_as_it_was(sea):
    mesh = temper.from_meshio(sea)
    before = mesh.copy()
    for rules, words in (("keep=dept", "there are: depth"), ("interpolate=node", "integers"), (["keep", "drop"], "drop")):
        with pytest.raises(temper.TemperError, match=words):
            mesh.point_data_rules = rules
    with pytest.raises(TypeError, match="point_data"):
        mesh.point_data_rules = [1]
    assert mesh == before and mesh.point_data_rules == ("interpolate",)
    assert temper.optimize(temper.generate.annulus()).data is None


# --- longitude and latitude -----------------------------------------------------------------------------------


def test_a_mesh_in_degrees_is_optimized_on_a_map_and_written_in_degrees(in_scratch):
    mesh = temper.generate.random_mesh(200)
    places = np.asarray(mesh.points) * (2, 1) + (-14, 55)
    nodes = [f"{i + 1} {x!r} {y!r} {3000.0 + y!r}" for i, (x, y) in enumerate(places.tolist())]
    triangles = [f"{i + 1} 3 {a + 1} {b + 1} {c + 1}" for i, (a, b, c) in enumerate(mesh.triangles.tolist())]
    head = ["sea", f"{len(triangles)} {len(nodes)}"]
    (in_scratch / "fort.14").write_text("\n".join(head + nodes + triangles + ["0", "0", "0", "0"]) + "\n")
    with pytest.raises(temper.TemperError, match="longitude and latitude") as refused:
        temper.read("fort.14")
    assert refused.value.code == "geographic"
    sea = temper.read("fort.14", projection="stereographic:-10,57")
    assert np.ptp(np.asarray(sea.points)) > 1e5  # meters
    temper.optimize(sea)
    with pytest.warns(temper.TemperWarning, match="stereographic:-10,57, in meters"):
        temper.write("out.14", sea)
    rows = [line.split() for line in (in_scratch / "out.14").read_text().splitlines()[2 : 2 + len(nodes)]]
    written = np.array([[float(x), float(y)] for _, x, y, _ in rows])
    coast = np.unique(sea.boundary_edges)
    assert np.array_equal(written[coast], places[coast]) and np.abs(written - places).max() < 2
    assert np.array_equal(np.asarray(temper.read("fort.14", projection="none").points), places)


def test_the_user_says_whether_z_of_2dm_is_height_or_depth(in_scratch):
    (in_scratch / "m.2dm").write_text("MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 9.66\nND 2 900 0 2\nND 3 0 900 1\n")
    with pytest.warns(temper.TemperWarning, match="z is taken as heights, positive up"):
        temper.write("up.gr3", temper.read("m.2dm"))
    down = pickle.loads(pickle.dumps(temper.read("m.2dm", positive="down")))
    with pytest.warns(temper.TemperWarning, match="regions are not written"):
        temper.write("down.gr3", down)
    assert np.array_equal(temper.read("up.gr3").point_data["depth"], [-9.66, -2, -1])
    assert np.array_equal(temper.read("down.gr3").point_data["depth"], [9.66, 2, 1])
    with pytest.raises(temper.TemperError, match="positive"):
        temper.read("m.2dm", positive="sideways")


def test_bad_triangles_before_are_those_of_the_input_as_it_was_given():
    mesh = temper.generate.sheared_grid(6, 6, 0.4)  # its edges are not regular, and flips alone cure some triangles
    bad = int((~temper.triangle_quality(mesh).well_centered).sum())
    report = temper.optimize(mesh)
    assert (report.bad_before, report.bad_after) == (bad, 0)
    assert report.history[0].bad != bad
    assert f"{bad} → 0" in str(report)


def test_names_of_solvers_stand_for_their_targets():
    assert temper.options_for("porepy") == temper.options_for("cell")
    assert "``porepy`` (cell)" in temper.options_for.__doc__
    with pytest.raises(temper.TemperError, match="target cell with triangles as cells"):
        temper.options_for("modflow")


def test_threads_are_at_most_a_few_times_the_processors():
    with pytest.raises(temper.TemperError, match="threads: expected at most .*found 20000. Next: leave it out"):
        temper.optimize(temper.generate.sheared_grid(3, 3), threads=20000)
