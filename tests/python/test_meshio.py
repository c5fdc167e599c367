"""meshio's meshes, wherever a mesh is taken."""

import pickle
import warnings

import numpy as np
import pytest

import temper

meshio = pytest.importorskip("meshio")


@pytest.fixture
def disc():
    """A mesh as meshio reads it: three coordinates, an unused point, lines, data."""
    ring = temper.generate.annulus()
    points = np.column_stack([ring.points, np.full(ring.n_vertices, 3.0)])
    points = np.vstack([points, [9, 9, 3]])
    lines = ring.boundary_edges.astype(np.int64)
    return meshio.Mesh(
        points, [("line", lines), ("triangle", ring.triangles.astype(np.int64))],
        point_data={"u": points[:, 0] + 2 * points[:, 1]},
        cell_data={"gmsh:physical": [np.full(len(lines), 7), np.full(ring.n_triangles, 4)]},
    )  # fmt: skip


def test_a_mesh_goes_in_and_comes_back(disc):
    with pytest.warns(temper.TemperWarning, match="1 point"):
        mesh = temper.from_meshio(disc)
    assert mesh.n_vertices == len(disc.points) - 1 and set(mesh.regions) == {4}
    again = mesh.to_meshio()
    assert np.array_equal(again.points, disc.points[:-1])
    assert np.array_equal(again.cells_dict["triangle"], disc.cells_dict["triangle"])
    assert np.array_equal(again.point_data["u"], disc.point_data["u"][:-1])
    assert np.array_equal(np.sort(again.cells_dict["line"], axis=0), np.sort(disc.cells_dict["line"], axis=0))
    assert set(again.cell_data_dict["gmsh:physical"]["line"]) == {7}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert temper.from_meshio(again) == mesh


def test_weights_survive_the_way_through_meshio(disc, in_scratch):
    with pytest.warns(temper.TemperWarning):
        mesh = temper.from_meshio(disc)
    temper.optimize(mesh)
    mesh.to_meshio().write("disc.vtu")
    assert temper.read("disc.vtu") == mesh
    assert temper.from_meshio(meshio.read("disc.vtu")) == mesh


@pytest.mark.filterwarnings("ignore::temper.TemperWarning")
def test_every_function_takes_them(disc):
    mesh = temper.from_meshio(disc)
    assert temper.quality(disc) == temper.quality(mesh)
    assert np.array_equal(temper.dec_operators(disc).star1, temper.dec_operators(mesh).star1)
    assert temper.draw_svg(disc) == temper.draw_svg(mesh)
    assert temper.find_weights(disc).verdict == temper.find_weights(mesh).verdict
    report = temper.optimize(disc)
    temper.optimize(mesh)
    assert report.stopped == "sweep_limit" and np.array_equal(disc.point_data["weight"], mesh.weights)
    assert np.array_equal(disc.points[:, :2], mesh.points) and (disc.points[:, 2] == 3).all()


def test_what_is_no_planar_triangle_mesh_is_refused():
    flat = [(0, 0, 0), (1, 0, 0), (0, 1, 0.5)]
    with pytest.raises(temper.TemperError, match="point 2 has z = 0.5") as caught:
        temper.from_meshio(meshio.Mesh(flat, [("triangle", [(0, 1, 2)])]))
    assert caught.value.code == "not_planar"
    with pytest.raises(temper.TemperError, match="expected cells of type triangle or quad; 1 cells of type line"):
        temper.from_meshio(meshio.Mesh(np.array(flat)[:, :2], [("line", [(0, 1)])]))
    with pytest.raises(temper.TemperError, match="triangle 0 uses point 9, but there are 3 points"):
        temper.from_meshio(meshio.Mesh(np.array(flat) * (1, 1, 0), [("triangle", [(0, 1, 9)])]))
    with pytest.raises(TypeError, match="expected a temper.Mesh"):
        temper.quality(flat)


def test_a_mesh_that_an_error_left_alone_is_the_same_object(disc):
    points = disc.points
    with pytest.warns(temper.TemperWarning), pytest.raises(temper.TemperError):
        temper.optimize(disc, options={"objective": "accuracy", "energy": "T"})
    assert disc.points is points and "weight" not in disc.point_data


@pytest.fixture
def marked(disc):
    """With vertex cells, and sets."""
    n = len(disc.points)
    cells = [*disc.cells, ("vertex", [[5], [n - 1], [9]])]
    data = {"gmsh:physical": [*disc.cell_data["gmsh:physical"], np.array([1, 2, 3])]}
    sets = {"probes": np.array([9, n - 1, 0])}
    return meshio.Mesh(disc.points, cells, point_data=disc.point_data, cell_data=data, point_sets=sets,
                       cell_sets={"inner": [np.array([0]), np.array([0]), np.array([], int)]})  # fmt: skip


def test_vertex_cells_and_point_sets_stay_with_their_points(marked):
    places = marked.points[[5, 9, 0]]
    marked.points = np.roll(marked.points, 1, axis=0)  # the unused point comes first: all others get new numbers
    marked.point_data = {}
    n = len(marked.points)
    for block in marked.cells:
        block.data = (block.data + 1) % n
    marked.point_sets["probes"] = (marked.point_sets["probes"] + 1) % n
    fixed = marked.cells_dict["line"].reshape(-1)
    assert {6, 10, 1} <= set(fixed)  # they are known by their places again
    with pytest.warns(temper.TemperWarning, match="cell_sets 'inner' are dropped"):
        temper.optimize(marked)
    assert len(marked.points) == n - 1 and marked.cell_sets == {}
    assert marked.cells_dict["vertex"].tolist() == [[5], [9]]
    assert marked.cell_data_dict["gmsh:physical"]["vertex"].tolist() == [1, 3]
    assert marked.point_sets["probes"].tolist() == [9, 0]
    assert np.array_equal(marked.points[[5, 9, 0]], places)


def test_what_a_mesh_cannot_hold_is_named(marked):
    with pytest.warns(temper.TemperWarning) as caught:
        again = temper.from_meshio(marked).to_meshio()
    said = [str(warning.message) for warning in caught]
    assert "point_sets 'probes' are left out" in said and "cell_sets 'inner' are left out" in said
    assert all(warning.filename == __file__ for warning in caught)
    assert again.cells_dict["vertex"].tolist() == [[5], [9]]
    with pytest.warns(temper.TemperWarning) as caught:
        temper.quality(marked)
    assert not any("sets" in str(warning.message) for warning in caught)


@pytest.mark.filterwarnings("ignore::temper.TemperWarning")
def test_a_mesh_is_written_back_when_and_only_when_it_has_changed(marked):
    points, cells, before = marked.points, marked.cells, temper.quality(marked).well_centered_fraction
    for wrong in (dict(options={"tolerance": "x"}), dict(threads="2"), dict(progress=3), dict(options={"max_sweeps": -1})):
        with pytest.raises((TypeError, temper.TemperError)):
            temper.optimize(marked, **wrong)
        assert marked.points is points and marked.cells is cells and marked.cell_sets
        assert "weight" not in marked.point_data

    def observe(progress):
        if progress.last.sweep == 2:
            temper.read("there-is-no-such-file.vtu")

    with pytest.raises(temper.TemperError, match="no-such-file"):
        temper.optimize(marked, progress=observe)
    assert marked.points is not points and temper.quality(marked).well_centered_fraction > before


def globe_of_meshio(radius=6371000.0):
    mesh = temper.generate.random_sphere(300, radius=radius)
    points, triangles = np.array(mesh.points), mesh.triangles.astype(np.int64)
    return mesh, meshio.Mesh(points, [("triangle", triangles)], point_data={"number": np.arange(300)})


def test_points_at_one_distance_from_the_origin_are_a_sphere(in_scratch):
    mesh, globe = globe_of_meshio()
    taken = temper.from_meshio(globe)
    assert taken == mesh and taken.space == temper.Space.sphere(6371000)
    again = taken.to_meshio()
    assert np.array_equal(again.points, globe.points) and np.array_equal(again.cells_dict["triangle"], mesh.triangles)
    globe.write("globe.vtu")
    assert temper.read("globe.vtu") == taken == temper.from_meshio(meshio.read("globe.vtu"))


@pytest.mark.filterwarnings("ignore::temper.TemperWarning")
def test_a_sphere_is_optimized_in_place():
    mesh, globe = globe_of_meshio()
    temper.optimize(mesh)
    temper.optimize(globe)
    assert np.array_equal(globe.points, mesh.points) and np.array_equal(globe.point_data["weight"], mesh.weights)
    assert np.array_equal(globe.cells_dict["triangle"], mesh.triangles)
    assert np.array_equal(globe.point_data["number"], np.arange(300))
    assert temper.quality(globe).well_centered_fraction == 1


def test_points_in_space_on_no_sphere_are_refused_as_in_files():
    _, globe = globe_of_meshio()
    globe.points[7] *= 1.00001
    expected = "point 7 is .* from the origin, but most points are .*; expected all on one sphere around the origin"
    with pytest.raises(temper.TemperError, match=expected) as caught:
        temper.from_meshio(globe)
    assert caught.value.code == "not_planar"
    globe.points[7, 2] = np.nan
    with pytest.raises(temper.TemperError, match="point 7 has z = nan, expected a finite number"):
        temper.from_meshio(globe)


# --- tags and names ---------------------------------------------------------------------------------------------------


def gmsh_strip():
    """What meshio reads of a Gmsh file: two regions, a named inflow, and a well."""
    points = np.array([(0, 0), (1, 0), (9, 0), (9, 1), (0, 1)], dtype=float)
    cells = [("vertex", [[4]]), ("line", [[0, 1], [1, 2], [2, 3]]), ("triangle", [[0, 1, 4], [1, 2, 3], [1, 3, 4]])]
    tags = [np.array([40]), np.array([31, 31, 32]), np.array([10, 20, 20])]
    names = {"well": [40, 0], "inflow": [31, 1], "wall": [32, 1], "sand": [20, 2]}
    return meshio.Mesh(
        points, cells, cell_data={"gmsh:physical": tags}, field_data={k: np.array(v) for k, v in names.items()}
    )


def test_tags_and_names_come_from_meshio_and_go_back(in_scratch):
    given = gmsh_strip()
    mesh = temper.from_meshio(given)
    assert mesh.names == {"well": (0, 40), "inflow": (1, 31), "wall": (1, 32), "sand": (2, 20)}
    assert mesh.lines.tolist() == [[0, 1], [1, 2], [2, 3]] and mesh.tags.tolist() == [31, 31, 32]
    assert mesh.marked_points.tolist() == [4] and mesh.point_tags.tolist() == [40]
    assert mesh.lines.dtype == mesh.tags.dtype == np.int32 and "gmsh:physical" not in mesh.cell_data
    again = mesh.to_meshio()
    assert {k: v.tolist() for k, v in again.field_data.items()} == {k: v.tolist() for k, v in given.field_data.items()}
    for kind in ("vertex", "line", "triangle"):
        assert np.array_equal(again.cell_data_dict["gmsh:physical"][kind], given.cell_data_dict["gmsh:physical"][kind])
    temper.write("square.msh", mesh)
    assert temper.read("square.msh").names == mesh.names
    again.write("square22.msh", file_format="gmsh22")
    assert temper.read("square22.msh").names == mesh.names


def test_edges_are_known_by_name_also_after_an_optimization():
    mesh = temper.from_meshio(gmsh_strip())
    for _ in range(2):
        dual = temper.dec_operators(mesh)
        named = dual.edges.named
        assert set(named) == {"inflow", "wall"} and named["inflow"].dtype == np.int32
        ends = dual.edges.vertices[named["inflow"]]
        assert dual.edges.is_boundary[named["inflow"]].all()
        assert sorted(map(tuple, np.sort(mesh.lines[mesh.tags == 31], axis=1).tolist())) == [tuple(e) for e in ends.tolist()]
        assert set(mesh.points[ends.ravel(), 1]) == {0.0} and dual.edges.length[named["inflow"]].sum() == 9
        assert pickle.loads(pickle.dumps(dual)) == dual
        temper.optimize(mesh, boundary="split")
    assert (mesh.tags == 31).sum() > 4


def test_quadrilaterals_are_pairs_that_stay():
    places = [(x, y) for y in range(4) for x in range(4)]
    points = np.array(places, dtype=float)
    points[10] = (2.3, 2.2)  # inside, of triangles alone
    quads = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6)]
    corners = [(i, i + 1, i + 5, i + 4) for i in (4, 5, 6, 8, 9, 10)]
    triangles = [t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]
    data = {"gmsh:physical": [np.full(12, 4), np.array([7, 8, 9])], "k": [np.arange(12.0), np.arange(3.0)]}
    given = meshio.Mesh(points, [("triangle", triangles), ("quad", quads)], cell_data=data)
    mesh = temper.from_meshio(given)
    assert mesh.n_triangles == 18 and mesh.regions.tolist()[12:] == [7, 7, 8, 8, 9, 9]
    temper.optimize(mesh)
    again = mesh.to_meshio()
    assert [sorted(q) for q in again.cells_dict["quad"]] == [sorted(q) for q in quads]
    assert again.cell_data_dict["gmsh:physical"]["quad"].tolist() == [7, 8, 9]
    assert again.cell_data_dict["k"]["quad"].tolist() == [0, 1, 2] and not mesh.weights.any()
    held = np.unique(quads)
    assert np.array_equal(again.points[held, :2], points[held]) and not np.array_equal(again.points[10, :2], points[10])
    assert temper.from_meshio(again) == mesh
    arrow = [(0, 0), (2, 0), (1, 2), (1, 0.5)]  # the last corner turns inward: only one diagonal is inside
    cut = temper.from_meshio(meshio.Mesh(arrow, [("quad", [(3, 1, 2, 0)])]))
    assert all(3 in t for t in cut.triangles.tolist()) and cut.reversed_triangles == 0
    with pytest.raises(temper.TemperError, match="a quadrilateral uses point 99, but there are 16 points"):
        temper.from_meshio(meshio.Mesh(points, [("quad", [(0, 1, 5, 99)])]))


class Bare:
    """An object with these attributes: what temper needs of a class that the tests do not have."""

    def __init__(self, **attributes):
        vars(self).update(attributes)


def poly_data(lines=(2, 0, 1, 3, 1, 2, 3), faces=(3, 0, 1, 4, 3, 1, 2, 3, 3, 1, 3, 4)):
    given = gmsh_strip()
    n = 1 + 2 + 3
    points = np.column_stack([given.points, np.zeros(5)])
    return Bare(
        points=points, verts=np.array([1, 4]), lines=np.array(lines), faces=np.array(faces), point_data={"u": points[:, 0]},
        cell_data={"region": np.array([40, 31, 32, 10, 20, 20]), "c": np.arange(n)}, field_data={},
    )  # fmt: skip


def test_meshes_of_pyvista_are_taken():
    mesh = temper.as_mesh(poly_data())
    assert mesh.regions.tolist() == [10, 20, 20] and mesh.cell_data["c"].tolist() == [3, 4, 5]
    assert mesh.lines.tolist() == [[0, 1], [1, 2], [2, 3]] and mesh.tags.tolist() == [31, 32, 32]
    assert mesh.marked_points.tolist() == [4] and mesh.point_tags.tolist() == [40]
    data = poly_data()
    grid = Bare(
        points=data.points, celltypes=np.array([5, 1, 7, 3, 5, 10]), offset=np.array([0, 3, 4, 7, 9, 12, 16]),
        cell_connectivity=np.array([0, 1, 4, 4, 1, 2, 3, 0, 1, 1, 3, 4, 0, 1, 2, 3]), point_data=data.point_data,
        cell_data={"region": np.array([10, 40, 20, 31, 20, 9])},
        field_data={"physical_names": np.frombuffer(b"1 31 inflow\n2 20 clean sand\n", dtype=np.uint8)},
    )  # fmt: skip
    with pytest.warns(temper.TemperWarning, match="1 cells of type tetra are left out"):
        other = temper.as_mesh(grid)
    assert other == mesh and other.names == {"inflow": (1, 31), "clean sand": (2, 20)}
    assert other.lines.tolist() == [[0, 1]] and temper.quality(poly_data()) == temper.quality(mesh)


def variable(dims, values, **attrs):
    return Bare(dims=dims, values=np.asarray(values), attrs=attrs, encoding={})


def test_meshes_of_xarray_and_xugrid_are_taken_and_not_changed():
    given = gmsh_strip()
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "x y", "face_node_connectivity": "nodes"}
    corners = [[0.0, 1, 4, np.nan], [1, 2, 3, np.nan], [1, 3, 4, np.nan]]  # as xarray reads them with a fill value
    variables = {
        "mesh": variable((), 0, **topology, edge_node_connectivity="edges"), "edges": variable(("e", "two"), [[0, 1]]),
        "nodes": variable(("f", "four"), np.add(corners, 1), start_index=1), "x": variable(("n",), given.points[:, 0]),
        "y": variable(("n",), given.points[:, 1]), "n": variable(("n",), np.arange(5)), "depth": variable(("n",), np.arange(5.0)),
        "k": variable(("f",), np.arange(3)), "mesh_node_weight": variable(("n",), np.full(5, 0.25)), "crs": variable((), 0),
        "series": variable(("time", "n"), np.arange(10.0).reshape(2, 5)), "flux": variable(("e",), [1.0]),
    }  # fmt: skip
    dataset = Bare(data_vars=variables, variables=variables)
    wrapped = Bare(ugrid=Bare(to_dataset=lambda: dataset), data_vars=variables)
    grid = Bare(face_node_connectivity=None, to_dataset=lambda: dataset)
    for each in (dataset, wrapped, grid):
        with pytest.warns(temper.TemperWarning, match="variable 'flux' with dimensions e is left out") as caught:
            mesh = temper.as_mesh(each)
        assert len(caught) == 1 and np.array_equal(mesh.triangles, given.cells_dict["triangle"])
        assert mesh.point_data["depth"].tolist() == [0, 1, 2, 3, 4] and mesh.cell_data["k"].tolist() == [0, 1, 2]
        assert mesh.point_data["series"].tolist() == [[0, 5], [1, 6], [2, 7], [3, 8], [4, 9]]
        assert list(mesh.point_data) == ["depth", "series"] and set(mesh.weights) == {0.25}
        with pytest.raises(TypeError, match=r"cannot change in place. Next: change temper.as_mesh\(grid\)"):
            temper.optimize(each)

    def refused(**changes):
        others = {**variables, **changes}
        with pytest.raises(temper.TemperError) as caught:
            temper.as_mesh(Bare(data_vars=others, variables=others))
        return f"{caught.value.code}: {caught.value}"

    assert refused(x=variable(("n",), np.arange(5.0), units="degrees_east")).startswith("geographic: the grid is in longitude and")
    assert "found none" in refused(mesh=variable((), 0)) and "found 2: mesh, net" in refused(net=variables["mesh"])
    assert "no face_node_connectivity" in refused(mesh=variable((), 0, **{**topology, "face_node_connectivity": "faces"}))
    assert "node_coordinates names 'lon lat'" in refused(mesh=variable((), 0, **{**topology, "node_coordinates": "lon lat"}))
    five = variable(("f", "five"), [[0, 1, 2, 3, 4]])
    assert "1 of 1 faces are neither triangles nor quadrilaterals" in refused(nodes=five)


class Poly(Bare):
    """As PyVista's PolyData."""

    def __init__(self, points, verts, lines, faces):
        super().__init__(points=points, verts=verts, lines=lines, faces=faces, point_data={}, cell_data={}, field_data={})

    def copy_from(self, other):
        vars(self).update(vars(other))


def test_a_mesh_of_pyvista_is_changed_in_place():
    like = poly_data()
    mesh = Poly(like.points, like.verts, like.lines, like.faces)
    mesh.cell_data, mesh.point_data = like.cell_data, like.point_data
    mesh.field_data = {"physical_names": np.frombuffer(b"1 31 inflow\n", dtype=np.uint8)}
    copy = temper.as_mesh(mesh)
    temper.optimize(mesh, boundary="split")
    temper.optimize(copy, boundary="split")
    assert copy.n_triangles > 4 and temper.as_mesh(mesh) == copy and temper.as_mesh(mesh).names == {"inflow": (1, 31)}
    assert np.array_equal(temper.as_mesh(mesh).tags, copy.tags) and np.array_equal(temper.as_mesh(mesh).lines, copy.lines)
    assert mesh.cell_data["region"][0] == 40 and len(mesh.cell_data["region"]) == 1 + len(copy.lines) + copy.n_triangles
