"""temper inside of other programs: each plugin is called as its host calls it. Hosts that are not installed are skipped."""

import os
import re
import subprocess
import sys
import warnings

import numpy as np
import pytest
from conftest import ROOT

import temper


def test_the_page_has_the_versions_that_are_pinned():
    page = (ROOT / "docs/howto/plugins.md").read_text(encoding="utf-8")
    pins = (ROOT / "tests/clients/constraints.txt").read_text(encoding="utf-8").split()
    hosts = page.split("calls each plugin in its host:")[1].split("and QGIS")[0]
    versions = re.findall(r"(\w+) (\d[\d.]*\d)", hosts)
    assert len(versions) == 5 and all(f"{host}=={version}" in pins for host, version in versions)


# --- meshio -----------------------------------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore::temper.TemperWarning")
def test_meshio_reads_and_writes_every_format(ring, in_scratch):
    meshio = pytest.importorskip("meshio")
    import temper.meshio_plugin  # noqa: F401

    ring.weights = np.linspace(0, 1e-4, ring.n_vertices)
    ring.point_data["depth"] = 0.1 * ring.points[:, 0] + 0.2
    for name in ("ring.14", "ring.2dm", "ring.jigsaw.msh", "ring.vtkhdf"):
        ring.to_meshio().write(name) if "msh" not in name else ring.to_meshio().write(name, file_format="temper")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", temper.TemperWarning)
            expected = temper.read(name).to_meshio()
            found = meshio.read(name)
        assert np.array_equal(found.points, expected.points) and np.array_equal(found.cells_dict["triangle"], ring.triangles)
        assert np.array_equal(found.point_data["weight"], ring.weights)
    assert np.allclose(meshio.read("ring.14").point_data["depth"], ring.point_data["depth"])
    temper.write("ring.vtu", ring)
    assert temper.from_meshio(meshio.read("ring.vtu", file_format="temper")) == ring
    assert meshio.extension_to_filetypes[".vtu"][0] == "vtu"  # meshio's own come first


def test_meshio_shows_the_error_of_temper(in_scratch):
    meshio = pytest.importorskip("meshio")
    import temper.meshio_plugin  # noqa: F401

    (in_scratch / "bad.14").write_text("grid\n1 3\n1 0 0 1\n2 1 0 1\n3 0 x 1\n1 3 1 2 3\n")
    with pytest.raises(temper.TemperError, match=r"bad.14:5"):
        meshio.read("bad.14")


# --- PyVista ----------------------------------------------------------------------------------------------------------


@pytest.fixture
def pyvista():
    module = pytest.importorskip("pyvista")
    pytest.importorskip("temper.pyvista_plugin")
    return module


def test_the_accessor_of_pyvista_gives_another_mesh_with_margins(pyvista, ring, in_scratch):
    ring.point_data["u"] = 3 * ring.points[:, 0]
    temper.write("ring.vtu", ring, triangle_quality=False)
    grid = pyvista.read("ring.vtu")
    before = grid.copy()
    better = grid.temper.optimize(target="vertex")
    assert grid == before and isinstance(better, pyvista.UnstructuredGrid)
    expected = ring.copy()
    temper.optimize(expected, target="vertex")
    measured = temper.triangle_quality(expected)
    assert np.array_equal(better.cell_data["min_h_over_l"], measured.min_h_over_l) and better.cell_data["well_centered"].all()
    assert np.array_equal(better.point_data["weight"], expected.weights)
    assert np.allclose(better.point_data["u"], 3 * better.points[:, 0], atol=1e-12)
    grid.field_data["note"] = ["mine"]
    assert grid.temper.optimize().field_data["note"].tolist() == ["mine"]
    assert grid.temper.quality() == temper.quality(ring) and grid.temper.margins().cell_data["min_h_over_l"].min() < 0


def test_pyvista_finds_the_accessor_of_an_installed_temper(pyvista, tmp_path):
    """By the entry point of the wheel, without an import of temper."""
    group = re.search(r'^\[project.entry-points."(.*)"\]\n(\w+) = "(.*)"$', (ROOT / "pyproject.toml").read_text(encoding="utf-8"), re.M)
    assert group
    wheel = tmp_path / "temper_mesh-0.dist-info"
    wheel.mkdir()
    (wheel / "METADATA").write_text("Metadata-Version: 2.1\nName: temper-mesh\nVersion: 0\n")
    (wheel / "entry_points.txt").write_text(f"[{group[1]}]\n{group[2]} = {group[3]}\n")
    paths = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    script = "import pyvista; print(pyvista.Plane(i_resolution=2, j_resolution=2).triangulate().temper.quality().triangles)"
    run = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True)
    assert run.stdout.strip() == "8", run.stderr


def test_margins_are_on_the_cells_that_they_measure(pyvista):
    """Lines come before polygons, and quadrilaterals are between triangles."""
    points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (0, 1, 0), (3, 0.2, 0)]
    surface = pyvista.PolyData(points, faces=[3, 2, 6, 3, 4, 0, 1, 4, 5, 3, 1, 2, 3, 3, 1, 3, 4], lines=[2, 0, 1])
    surface.cell_data["number"] = np.arange(5)
    measured = surface.temper.margins()
    assert measured.cell_data["number"].tolist() == [0, 1, 2, 3, 4] and measured.n_cells == 5
    margins = measured.cell_data["min_h_over_l"]
    triangle = temper.triangle_quality(temper.Mesh([(2, 0), (3, 0.2), (2, 1)], [(0, 1, 2)])).min_h_over_l
    assert np.isnan(margins[0]) and margins[1] == pytest.approx(triangle[0], rel=1e-14) and margins[2] == pytest.approx(0.5)
    assert measured.cell_data["well_centered"].tolist()[0] == 0


def test_the_accessor_takes_tetrahedra_and_names_what_it_cannot_take(pyvista):
    block = pyvista.ImageData(dimensions=(3, 3, 3)).to_tetrahedra(5)
    assert block.temper.optimize().cell_data["min_dihedral_deg"].min() > 0
    with pytest.raises(TypeError, match="expected a temper.Mesh, or a mesh of meshio.*found ImageData"):
        pyvista.ImageData(dimensions=(3, 3, 1)).temper.optimize()
    with pytest.raises(temper.TemperError, match="expected cells of type triangle or quad; 8 cells of type VTK 11 are left out"):
        pyvista.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid().temper.quality()


def test_the_accessor_takes_curved_surfaces(pyvista):
    torus = pyvista.ParametricTorus(ringradius=1, crosssectionradius=0.4, u_res=24, v_res=12).triangulate().clean(tolerance=1e-6)
    torus.points[:] = torus.points.astype(float)
    measured = torus.temper.quality()
    assert isinstance(measured, temper.types.SurfaceQuality) and measured.boundary_edges == 0
    better = torus.temper.optimize()
    assert isinstance(better, pyvista.PolyData) and (better.cell_data["min_h_over_l"] > 0).all() and measured.orthocenters_outside > 0
    assert len(better.point_data["weight"]) == better.n_points
    cone = pyvista.Cone(resolution=24).triangulate()
    before = temper.quality(cone).orthocenters_outside
    temper.optimize(cone)
    assert temper.quality(cone).orthocenters_outside <= before


def test_pydec_has_the_same_stars_on_a_surface_of_acute_triangles():
    """Its circumcentric duals have no sign and no weights."""
    pydec = pytest.importorskip("pydec")
    globe = temper.generate.icosahedral(3)
    mesh = temper.SurfaceMesh(np.array(globe.points) * [1, 1, 0.9], globe.triangles)
    assert temper.quality(mesh).orthocenters_outside == 0
    dual = temper.dec_operators(mesh)
    rows_of = np.arange(mesh.n_vertices)[:, None], dual.edges.vertices, mesh.triangles
    for level, rows, star in zip(pydec.simplicial_complex((mesh.points, np.array(mesh.triangles))), rows_of, (dual.star0, dual.star1, dual.star2)):
        place = {tuple(sorted(row)): i for i, row in enumerate(rows.tolist())}
        order = [place[tuple(simplex)] for simplex in np.sort(level.simplices, axis=1).tolist()]
        assert np.allclose(level.star.diagonal(), star[order], rtol=1e-10)


# --- Gmsh -------------------------------------------------------------------------------------------------------------


@pytest.fixture
def gmsh():
    module = pytest.importorskip("gmsh")
    module.initialize()
    module.option.setNumber("General.Terminal", 0)
    yield module
    module.finalize()


def plate(gmsh):
    """A plate with a hole and a fault, and a point that has no elements."""
    occ = gmsh.model.occ
    sheet, hole = occ.addRectangle(0, 0, 0, 3, 2), occ.addDisk(0.7, 1.4, 0, 0.3, 0.3)
    sheet = occ.cut([(2, sheet)], [(2, hole)])[0]
    fault, _ = occ.addLine(occ.addPoint(1.2, 0.3, 0), occ.addPoint(2.5, 1.6, 0)), occ.addPoint(9, 9, 0)
    _, pieces = occ.fragment(sheet, [(1, fault)])
    occ.synchronize()
    gmsh.model.addPhysicalGroup(2, [tag for _, tag in pieces[0]], name="plate")
    gmsh.model.addPhysicalGroup(1, [tag for _, tag in pieces[1]], name="fault")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
    gmsh.model.mesh.generate(2)


def places(gmsh):
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    return dict(zip(map(int, tags), coordinates.reshape(-1, 3)))


def test_a_model_of_gmsh_is_changed_in_place(gmsh, in_scratch):
    plate(gmsh)
    gmsh.write("plate.msh")
    entities, groups, before = gmsh.model.getEntities(), gmsh.model.getPhysicalGroups(), places(gmsh)
    curves = {tag: gmsh.model.mesh.getElements(1, tag)[2][0].tolist() for _, tag in gmsh.model.getEntities(1)}
    assert temper.quality(gmsh.model).orthocenters_outside > 0
    report = temper.optimize(gmsh.model, target="cell")
    after = places(gmsh)
    assert report.history[-1].bad == 0 and temper.quality(gmsh.model).orthocenters_outside == 0
    assert gmsh.model.getEntities() == entities and gmsh.model.getPhysicalGroups() == groups
    assert {tag: gmsh.model.mesh.getElements(1, tag)[2][0].tolist() for _, tag in gmsh.model.getEntities(1)} == curves
    on_curves = {int(node) for nodes in curves.values() for node in nodes}
    assert all((before[node] == after[node]).all() for node in on_curves) and set(before) >= set(after)
    assert any((before[node] != after[node]).any() for node in set(after) - on_curves)
    gmsh.write("better.msh")  # as the program does, except for the numbers of nodes
    by_file = temper.read("plate.msh")
    temper.optimize(by_file, target="cell")
    by_model = temper.read("better.msh")
    assert by_model.names == {"fault": (1, 2), "plate": (2, 1)} == by_file.names and set(by_model.regions) == {1}
    assert by_model.n_triangles == by_file.n_triangles and (by_model.tags == 2).sum() == (by_file.tags == 2).sum()
    gmsh.model.mesh.setOrder(2)  # the new nodes know the geometry
    circle = next(tag for _, tag in gmsh.model.getEntities(1) if gmsh.model.getType(1, tag) in ("Circle", "Ellipse"))
    ends = np.reshape(gmsh.model.mesh.getNodes(1, circle)[1], (-1, 3))
    assert len(ends) > len(curves[circle]) // 2 and np.allclose(np.hypot(ends[:, 0] - 0.7, ends[:, 1] - 1.4), 0.3, atol=1e-12)


def test_views_of_gmsh_follow_the_mesh(gmsh):
    plate(gmsh)
    view, name = gmsh.view, gmsh.model.getCurrent()
    tags = np.array(list(places(gmsh)))
    x = np.array([place[0] for place in places(gmsh).values()])
    heads, lists, codes = view.add("head"), view.add("wells"), view.add("code")
    for step in (0, 1):
        view.addHomogeneousModelData(heads, step, name, "NodeData", tags, (step + 1) * x, 0.5 * step, 1)
    view.option.setNumber(heads, "IntervalsType", 3)
    view.addListData(lists, "SP", 1, [0, 0, 0, 1])
    triangles = gmsh.model.mesh.getElementsByType(2)[0]
    view.addHomogeneousModelData(codes, 0, name, "ElementData", triangles, np.full(len(triangles), 7.0), 0, 1)
    temper.optimize(gmsh.model, target="cell")
    now = places(gmsh)
    for step in (0, 1):
        kind, nodes, values, time, width = view.getHomogeneousModelData(heads, step)
        assert (kind, time, width) == ("NodeData", 0.5 * step, 1) and set(map(int, nodes)) == set(now)
        assert np.allclose(values, [(step + 1) * now[int(node)][0] for node in nodes], atol=1e-12)
    kind, elements, values, _, _ = view.getHomogeneousModelData(codes, 0)
    assert set(elements) == set(gmsh.model.mesh.getElementsByType(2)[0]) and set(values) == {7.0}
    assert view.option.getNumber(heads, "IntervalsType") == 3 and view.getListData(lists)[2][0].tolist() == [0, 0, 0, 1]
    names = {view.option.getString(tag, "Name"): tag for tag in view.getTags()}
    assert set(names) == {"head", "wells", "code", "weight"}
    weights = view.getHomogeneousModelData(names["weight"], 0)
    mesh = temper.as_mesh(gmsh.model)
    assert np.array_equal(np.sort(mesh.weights), np.sort(weights[2][np.isin(weights[1], gmsh.model.mesh.getElementsByType(2)[1])]))
    temper.optimize(gmsh.model, target="cell", boundary="split")
    gmsh.model.mesh.setOrder(2)
    assert gmsh.model.mesh.getElementTypes(2).tolist() == [9]


def test_clockwise_surfaces_and_tetrahedra_of_gmsh_stay_what_they_are(gmsh):
    geo = gmsh.model.geo
    for place in ((0, 0), (1, 0), (1, 1), (0, 1)):
        geo.addPoint(*place, 0, 0.2)
    lines = [geo.addLine(a, b) for a, b in ((1, 4), (4, 3), (3, 2), (2, 1))]
    geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    gmsh.model.mesh.generate(2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        temper.optimize(gmsh.model)
    now = places(gmsh)
    for corners in gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3):
        a, b, c = (now[int(node)] for node in corners)
        assert np.cross(b - a, c - a)[2] < 0
    gmsh.clear()
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(2, [3], name="inflow")
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
    gmsh.model.mesh.generate(3)
    assert temper.optimize(gmsh.model).history[-1].bad == 0 and temper.TetMesh.from_meshio(gmsh.model).names == {"inflow": (2, 1)}


def test_models_of_gmsh_that_temper_cannot_take_are_refused(gmsh):
    def refusal():
        with pytest.raises(temper.TemperError) as caught:
            temper.optimize(gmsh.model)
        return str(caught.value)

    assert "the model has no triangles or tetrahedra. Next: gmsh.model.mesh.generate(2)" in refusal()
    gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    assert "curve 1 has elements of type Line 3" in refusal() and "setOrder(1)" in refusal()
    gmsh.model.mesh.setPeriodic(1, [2], [4], [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.model.mesh.generate(2)
    assert "curve 2 is periodic" in refusal()
    gmsh.clear()
    gmsh.model.occ.addTorus(0, 0, 0, 1, 0.3)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(2)
    assert "has z = " in refusal()
    gmsh.clear()
    gmsh.model.occ.extrude([(2, gmsh.model.occ.addRectangle(0, 0, 0, 1, 1))], 0, 0, 1, [2], recombine=True)
    gmsh.model.occ.synchronize()
    gmsh.model.mesh.generate(3)
    assert "has elements of type Prism 6" in refusal()


# --- xarray and xugrid ------------------------------------------------------------------------------------------------


def dataset(ring):
    """A mesh with data of all kinds, as a user has it."""
    ring.point_data["depth"] = 2 * ring.points[:, 0]
    ring.cell_data["code"] = np.full(ring.n_triangles, 3, dtype=np.int16)
    given, time = ring.to_xarray(), np.arange(3.0)
    given["level"] = (("time", "mesh2d_nNodes"), time[:, None] * ring.points[:, 1], {"units": "m", "long_name": "water level"})
    given["flow"] = (("time", "mesh2d_nFaces", "layer"), np.ones((3, ring.n_triangles, 2), dtype=np.float32))
    given["wet"] = ("mesh2d_nFaces", np.ones(ring.n_triangles, dtype=bool))
    given = given.assign_coords(time=time)
    given["crs"] = ((), 0, {"epsg": 28992})
    given["discharge"] = ("time", time)
    given.attrs["title"] = "mine"
    return given


@pytest.mark.filterwarnings("ignore:numba")
@pytest.mark.parametrize("library", ["xarray", "xugrid"])
def test_a_dataset_goes_in_and_comes_back(library, ring):
    pytest.importorskip("xarray")
    given = dataset(ring)
    expected = ring.copy()
    temper.optimize(expected, target="vertex")
    if library == "xugrid":
        given = pytest.importorskip("xugrid").UgridDataset(given)
    mesh = temper.as_mesh(given)
    assert set(mesh.point_data) == {"depth", "level"} and set(mesh.cell_data) == {"code", "flow", "wet"}
    temper.optimize(mesh, target="vertex")
    better = mesh.to_xarray(like=given)
    assert np.array_equal(better["mesh2d_node_x"], expected.points[:, 0]) and np.array_equal(better["mesh2d_node_weight"], expected.weights)
    y = better["mesh2d_node_y"].values
    assert better["level"].dims == ("time", "mesh2d_nNodes") and np.allclose(better["level"], np.arange(3.0)[:, None] * y, atol=1e-12)
    assert better["level"].attrs == {"units": "m", "long_name": "water level"} and better["flow"].dims == ("time", "mesh2d_nFaces", "layer")
    assert better["flow"].dtype == np.float32 and (better["flow"] == 1).all() and better["wet"].dtype == bool and better["code"].dtype == np.int16
    assert better["crs"].attrs == {"epsg": 28992} and better["discharge"].values.tolist() == [0, 1, 2] and "time" in better.coords
    assert better.attrs["title"] == "mine" and temper.as_mesh(better) == mesh and temper.quality(better).orthocenters_outside == 0
    corners = np.column_stack([mesh.points, mesh.weights])[mesh.triangles].swapaxes(0, 1)
    assert np.array_equal(better["mesh2d_face_x"], temper.geometry.orthocenter(*corners)[:, 0])
    assert np.array_equal(better["mesh2d_edge_nodes"], temper.dec_operators(mesh).edges.vertices)


@pytest.mark.filterwarnings("ignore:numba")
def test_xugrid_takes_the_mesh_and_names_what_it_loses(ring):
    pytest.importorskip("xarray")
    xugrid = pytest.importorskip("xugrid")
    grid = ring.to_xugrid().ugrid.grid
    assert isinstance(grid, xugrid.Ugrid2d) and grid.n_face == ring.n_triangles and grid.n_edge == len(ring.edges)
    assert temper.as_mesh(grid) == ring
    square = temper.Outline([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    with pytest.warns(temper.TemperWarning, match="lines are left out. Next: temper.write keeps them"):
        temper.mesh_outline(square, 0.4).mesh.to_xarray()
    with pytest.raises(temper.TemperError, match="the mesh is on a sphere"):
        temper.generate.random_sphere(100).to_xarray()


def test_quadrilaterals_of_a_dataset_stay():
    xarray = pytest.importorskip("xarray")
    topology = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "x y", "face_node_connectivity": "corners"}
    x, y = np.array([0.0, 1, 2, 0, 1, 2, 3]), np.array([0.0, 0, 0, 1, 1, 1, 0.5])
    corners = np.array([[2, 6, 5, -1], [0, 1, 4, 3], [1, 2, 5, 4]])
    given = xarray.Dataset({"mesh": ((), 0, topology), "x": ("n", x), "y": ("n", y), "k": ("f", [5, 6, 7]),
                            "corners": (("f", "c"), corners, {"start_index": 0, "_FillValue": -1})})  # fmt: skip
    back = temper.as_mesh(given).to_xarray(like=given)
    assert [sorted(row) for row in back["corners"].values.tolist()] == [sorted(row) for row in corners.tolist()]
    assert back["k"].values.tolist() == [5, 6, 7] and "face_coordinates" not in back["mesh"].attrs
    assert len(back["mesh_edge_nodes"]) == 9
