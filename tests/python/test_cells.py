"""Cells as polygons: laws of the arrays, files by readers that know nothing of temper, and arguments of FloPy."""

import json
import pathlib
import pickle
import sqlite3
import struct
import subprocess

import numpy as np
import pytest

import temper


@pytest.fixture(scope="module")
def mesh():
    mesh = temper.generate.random_mesh(150)
    temper.optimize(mesh, target="cell")
    return mesh


def area_of(corners):
    x, y = (np.asarray(corners) - corners[0]).T
    return 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()


@pytest.fixture(params=[temper.power_cells, temper.triangle_cells])
def cells(request, mesh):
    return request.param(mesh)


def test_polygons_cover_the_domain_and_share_their_corners(mesh, cells):
    polygons = cells.polygons()
    assert len(polygons) == len(cells.area) == len(cells.center) == len(cells.name)
    assert np.allclose([area_of(p) for p in polygons], cells.polygon_area, rtol=1e-11)
    assert cells.area.sum() == pytest.approx(temper.dec_operators(mesh).areas.sum(), rel=1e-12)
    assert len(np.unique(cells.points, axis=0)) == len(cells.points)
    assert (cells.region_share == 1).all()


def test_faces_are_the_duals_of_the_operators(mesh, cells):
    complex = temper.dec_operators(mesh)
    if cells.cells == "power":
        assert (cells.faces == complex.edges.vertices).all()
        assert np.allclose(cells.face_width, complex.edges.dual_length, rtol=1e-9, atol=1e-13)
        assert np.allclose(cells.area, complex.star0, rtol=1e-11)
    else:
        inner = ~complex.edges.is_boundary
        assert np.allclose(np.sort(cells.face_distances.sum(axis=1)), np.sort(complex.edges.dual_length[inner]), atol=1e-13)
    along = cells.center[cells.faces[:, 1]] - cells.center[cells.faces[:, 0]]
    assert np.allclose(np.linalg.norm(along, axis=1), cells.face_distances.sum(axis=1), rtol=1e-9)


def test_gridprops_is_what_disv_says(mesh, cells, tmp_path):
    grid = cells.gridprops()
    assert grid["ncpl"] == len(grid["cell2d"]) == len(cells.area)
    assert grid["nvert"] == len(grid["vertices"]) == len(cells.points)
    for i, x, y, n, *corners in grid["cell2d"]:
        assert n == len(corners) and (x, y) == tuple(cells.center[i])
        assert area_of(cells.points[corners]) < 0, "clockwise"
    temper.columns(mesh, [1, 0], cells=cells.cells).write(tmp_path, formats=["disv"])
    rows = [line.split() for line in (tmp_path / "mesh.disv").read_text().splitlines()]
    rows = rows[rows.index(["BEGIN", "CELL2D"]) + 1 : rows.index(["END", "CELL2D"])]
    assert [[int(r[0]) - 1, float(r[1]), float(r[2]), int(r[3]), *(int(c) - 1 for c in r[4:])] for r in rows] == grid["cell2d"]


def test_files_have_the_numbers_of_the_arrays(mesh, cells, in_scratch):
    temper.write("cells.geojson", mesh, cells=cells.cells)
    temper.write("cells.gpkg", mesh, cells=cells.cells)
    features = json.loads(open("cells.geojson", encoding="utf-8").read())["features"]
    assert [f["properties"]["area"] for f in features] == cells.area.tolist()
    for feature, polygon in zip(features, cells.polygons()):
        assert feature["geometry"]["coordinates"][0] == [*polygon.tolist(), polygon[0].tolist()]
    database = sqlite3.connect("cells.gpkg")
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    assert database.execute("PRAGMA foreign_key_check").fetchall() == []
    assert database.execute("PRAGMA application_id").fetchone() == (0x47504B47,)
    assert database.execute("SELECT table_name, srs_id FROM gpkg_contents WHERE table_name = 'cells'").fetchall() == [("cells", -1)]
    rows = database.execute("SELECT fid, geom, region, area, center_x, center_y FROM cells ORDER BY fid").fetchall()
    assert [r[0] - 1 for r in rows] == list(range(len(cells.area)))
    assert [r[3] for r in rows] == cells.area.tolist() and [list(r[4:]) for r in rows] == cells.center.tolist()
    for (_, blob, *_), polygon in zip(rows, cells.polygons()):
        assert blob[:4] == b"GP\0\3" and struct.unpack("<i", blob[4:8]) == (-1,)
        assert np.allclose(struct.unpack("<4d", blob[8:40]), [polygon[:, 0].min(), polygon[:, 0].max(), polygon[:, 1].min(), polygon[:, 1].max()], rtol=0, atol=0)
        order, kind, n, inner, inner_kind, rings, corners = struct.unpack("<BIIBIII", blob[40:62])
        assert (order, kind, n, inner, inner_kind, rings, corners) == (1, 6, 1, 1, 3, 1, len(polygon) + 1)
        assert (np.frombuffer(blob[62:]).reshape(-1, 2)[:-1] == polygon).all()


def test_names_are_those_of_points(in_scratch):
    outline = {"type": "FeatureCollection", "crs": "EPSG:32632", "features": [
        {"type": "Feature", "properties": {"name": "sand"}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]}},
        {"type": "Feature", "properties": {"name": "well"}, "geometry": {"type": "Point", "coordinates": [4, 5]}}]}  # fmt: skip
    open("o.geojson", "w").write(json.dumps(outline))
    subprocess.run(["temper", "mesh", "o.geojson", "-o", "m.vtu", "--size", "3", "--quiet"], check=True)
    mesh = temper.read("m.vtu")
    cells = temper.power_cells(mesh)
    (well,) = np.flatnonzero(np.array(cells.name) == "well")
    assert cells.center[well].tolist() == [4, 5]
    temper.write("cells.geojson", mesh, cells="power")
    properties = json.load(open("cells.geojson"))["features"][well]["properties"]
    assert properties["name"] == "well" and properties["region_name"] == "sand"


def test_barriers_are_on_the_edges_of_lines(mesh, tmp_path):
    lines = temper.dec_operators(mesh).edges
    pair = next(i for i, inner in enumerate(~lines.is_boundary) if inner)
    columns = temper.columns(mesh, [2, 1, 0], active=[True, True], cells="triangles")
    first, second = sorted(lines.triangles[pair].tolist())
    barrier = temper.types.Barrier("fault", first, second, 1e-6)
    data = columns.hfb_data([barrier])
    assert data == [((layer, first), (layer, second), 1e-6) for layer in (0, 1)]
    columns.write(tmp_path, formats=["disv"], barriers=[barrier])
    rows = [line.split() for line in (tmp_path / "mesh.disv.hfb").read_text().splitlines()]
    rows = [r for r in rows[rows.index(["BEGIN", "PERIOD", "1"]) + 1 : rows.index(["END", "PERIOD"])] if r[0] != "#"]
    assert [((int(a) - 1, int(b) - 1), (int(c) - 1, int(d) - 1), float(e)) for a, b, c, d, e in rows] == data
    with pytest.raises(ValueError, match="have no common face"):
        columns.hfb_data([temper.types.Barrier("fault", first, first, 1.0)])
    with pytest.raises(temper.TemperError, match="have no common face"):
        columns.write(tmp_path, formats=["disv"], barriers=[temper.types.Barrier("fault", first, first, 1.0)])
    with pytest.raises(temper.TemperError, match="no line inside the domain has this name or tag"):
        temper.barriers_of_lines(mesh, {"fault": 1.0})


@pytest.fixture(scope="module")
def faulted():
    """A plate with a fault of one bend, which is faces, and a river, which is edges."""
    points = [(0, 0), (10, 0), (10, 6), (0, 6), (2, 2), (5, 2.5), (8, 4), (1, 5), (9, 5)]
    segments = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (7, 8)]
    groups = [(1, 7, "fault"), (1, 9, "river")]
    outline = temper.Outline(points, segments, [1, 1, 1, 1, 7, 7, 9], groups=groups, faces=[4, 5])
    return temper.mesh_outline(outline, 0.5, target="vertex").mesh


def test_faces_of_a_line_are_the_faces_of_its_cells(faulted, tmp_path):
    faces = faulted.faces_of("fault")
    assert faces.vertices.shape == (len(faces.length), 2) and faces.ends.shape == (len(faces.length), 2, 2)
    assert faces.length.sum() == pytest.approx(np.hypot(3, 0.5) + np.hypot(3, 1.5), rel=1e-12)
    way = faces.ends[:, 1] - faces.ends[:, 0]
    assert np.allclose(np.linalg.norm(way, axis=1), faces.length, rtol=1e-12)
    for k, sign in ((0, 1), (1, -1)):  # the first cell is on the left, and both have equal power at the ends
        to = faulted.points[faces.vertices[:, k]] - faces.ends[:, 0]
        assert (sign * (way[:, 0] * to[:, 1] - way[:, 1] * to[:, 0]) > 0).all()
    for end in (0, 1):
        away = ((faulted.points[faces.vertices] - faces.ends[:, [end]]) ** 2).sum(axis=2) - faulted.weights[faces.vertices]
        assert np.allclose(away[:, 0], away[:, 1], atol=1e-12)
    cells = temper.power_cells(faulted)
    widths = {tuple(pair): width for pair, width in zip(cells.faces.tolist(), cells.face_width)}
    assert np.allclose([widths[tuple(sorted(pair))] for pair in faces.vertices.tolist()], faces.length, rtol=1e-9)
    barriers = temper.barriers_of_lines(faulted, {"fault": 1.0}, "power")
    assert [[b.first, b.second] for b in barriers] == faces.vertices.tolist()
    assert (faulted.faces_of(7).vertices == faces.vertices).all()
    temper.write(tmp_path / "fault.vtu", faulted)
    assert (temper.read(tmp_path / "fault.vtu").faces_of("fault").vertices == faces.vertices).all()


def test_lines_without_faces_are_refused_by_name(faulted):
    with pytest.raises(temper.TemperError, match="faces of 'river': its line runs through the centers of power cells"):
        faulted.faces_of("river")
    with pytest.raises(temper.TemperError, match="faces of 'wall': no line inside the domain has this name or tag"):
        faulted.faces_of("wall")
    with pytest.raises(ValueError, match="plane"):
        temper.generate.random_sphere(vertices=100).faces_of("fault")


def test_spheres_have_cells_but_no_grid():
    sphere = temper.generate.random_sphere(vertices=100)
    cells = temper.power_cells(sphere)
    assert cells.points.shape[1] == 3 and cells.area.sum() == pytest.approx(4 * np.pi, rel=1e-12)
    with pytest.raises(ValueError, match="on a sphere"):
        cells.gridprops()


def test_geographic_programs_read_planes_and_spheres(mesh, in_scratch):
    geopandas = pytest.importorskip("geopandas")
    sphere = temper.generate.random_sphere(vertices=200)
    for suffix in ("geojson", "gpkg"):
        temper.write(f"plane.{suffix}", mesh, cells="power")
        temper.write(f"sphere.{suffix}", sphere, cells="power")
        plane, globe = (geopandas.read_file(f"{name}.{suffix}") for name in ("plane", "sphere"))
        assert not plane.crs.is_geographic and globe.crs.to_epsg() == 4326
        assert plane.is_valid.all() and globe.is_valid.all()
        assert np.allclose(plane.geometry.area, plane["area"], rtol=1e-11)
        assert sum(shape.area for shape in globe.geometry) == pytest.approx(360 * 180)


def test_cells_are_pickled(cells):
    again = pickle.loads(pickle.dumps(cells))
    assert (again.points == cells.points).all() and (again.connectivity == cells.connectivity).all()


def test_geodataframe_has_the_areas(cells):
    pytest.importorskip("geopandas")
    frame = cells.to_geodataframe(crs="EPSG:25832")
    assert np.allclose(frame.geometry.area, frame["area"], rtol=1e-11) and frame.crs.to_epsg() == 25832
    assert frame.geometry.is_valid.all() and len(frame) == len(cells.area)


def test_flopy_takes_grid_and_barriers(mesh, cells, in_scratch):
    flopy = pytest.importorskip("flopy")
    columns = temper.columns(mesh, [2, 1, 0], cells=cells.cells)
    barriers = [temper.types.Barrier("fault", *cells.faces[i].tolist(), 1e-6) for i in (3, 5)]
    simulation = flopy.mf6.MFSimulation(sim_ws="model")
    simulation.simulation_data.float_precision = 17
    flopy.mf6.ModflowTdis(simulation)
    flopy.mf6.ModflowIms(simulation)
    flow = flopy.mf6.ModflowGwf(simulation, modelname="m")
    flopy.mf6.ModflowGwfdisv(flow, nlay=2, top=2.0, botm=[1.0, 0.0], **cells.gridprops())
    flopy.mf6.ModflowGwfhfb(flow, maxhfb=4, stress_period_data=columns.hfb_data(barriers))
    grid = flow.modelgrid
    assert np.allclose(np.column_stack([grid.xcellcenters, grid.ycellcenters]), cells.center)
    simulation.write_simulation(silent=True)
    # temper's own files in the place of FloPy's, and FloPy reads them.
    columns.write("model", formats=["disv"], barriers=barriers)
    for name in ("disv", "hfb"):
        source = "mesh.disv" if name == "disv" else "mesh.disv.hfb"
        pathlib.Path("model", f"m.{name}").write_bytes(pathlib.Path("model", source).read_bytes())
    read = flopy.mf6.MFSimulation.load(sim_ws="model", verbosity_level=0).get_model("m")
    assert np.allclose(read.modelgrid.xcellcenters, cells.center[:, 0], rtol=0, atol=1e-12)
    assert read.disv.ncpl.get_data() == len(cells.area)
    rows = read.hfb.stress_period_data.get_data(0)
    assert [(tuple(r[0]), tuple(r[1]), r[2]) for r in rows] == columns.hfb_data(barriers)
