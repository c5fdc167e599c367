"""Columns under layers, and files of MODFLOW 6 and TOUGH, by readers that know nothing of temper."""

import pathlib
import pickle
import subprocess
import xml.etree.ElementTree as xml

import numpy as np
import pytest
from conftest import ROOT

import temper

SURFACES = [10.0, 7.0, 7.0, 2.0, 1.0]


def good_mesh():
    mesh = temper.generate.random_mesh(150)
    temper.optimize(mesh)
    return mesh


@pytest.fixture(scope="module")
def columns():
    """Layers that dip; the second is pinched out but for some vertices, and one column is inactive at its foot."""
    mesh = good_mesh()
    x, y = np.asarray(mesh.points).T
    surfaces = np.add.outer(0.4 * x - 0.3 * y, SURFACES)
    surfaces[x > 0.5, 2] -= 0.25
    surfaces[7, 4] = np.nan
    return mesh, temper.columns(mesh, surfaces)


# --- independent readers -----------------------------------------------------------------------------------------


def blocks_of(path):
    """Blocks of a MODFLOW 6 file, as lists of lines of words."""
    blocks, name = {}, None
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["BEGIN"]:
            name = words[1]
            blocks[name] = []
        elif words[:1] == ["END"]:
            assert words[1] == name
            name = None
        elif words:
            blocks[name].append(words)
    assert name is None
    return blocks


def arrays_of(block):
    """Arrays of GRIDDATA or CONNECTIONDATA: of one that is LAYERED, all layers."""
    arrays, name = {}, None
    for words in block:
        if words[0].isalpha() and words[0] != "INTERNAL" or words[0] == "CL12":
            name = words[0]
            arrays[name] = []
        elif words[0] == "INTERNAL":
            assert words == ["INTERNAL", "FACTOR", "1"]
        else:
            arrays[name] += map(float, words)
    return {name: np.array(values) for name, values in arrays.items()}


def disv_of(path):
    blocks = blocks_of(path)
    sizes = {name: int(n) for name, n in blocks["DIMENSIONS"]}
    arrays = arrays_of(blocks["GRIDDATA"])
    layers, n = sizes["NLAY"], sizes["NCPL"]
    corners = np.array([[float(w) for w in words[1:]] for words in blocks["VERTICES"]])
    assert len(corners) == sizes["NVERT"] and len(blocks["CELL2D"]) == n
    centers = np.array([[float(w) for w in words[1:3]] for words in blocks["CELL2D"]])
    polygons = [[int(w) - 1 for w in words[4:]] for words in blocks["CELL2D"]]
    assert all(len(p) == int(words[3]) for p, words in zip(polygons, blocks["CELL2D"]))
    bottoms = arrays["BOTM"].reshape(layers, n)
    tops = np.vstack([arrays["TOP"], bottoms[:-1]])
    return corners, centers, polygons, tops, bottoms, arrays["IDOMAIN"].reshape(layers, n).astype(int)


def doubled_area(polygon):
    x, y = polygon.T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()


def connections_of_disv(path):
    """What MODFLOW makes of a DISV file: {(cell, cell): (distances, width or area)}."""
    corners, centers, polygons, tops, bottoms, idomain = disv_of(path)
    layers, n = idomain.shape
    sides = {}
    for cell, polygon in enumerate(polygons):
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            sides.setdefault((min(a, b), max(a, b)), []).append(cell)
    found = {}
    for (a, b), cells in sides.items():
        assert len(cells) <= 2
        if len(cells) == 1:
            continue
        width = np.hypot(*(corners[b] - corners[a]))
        normal = np.array([corners[b][1] - corners[a][1], corners[a][0] - corners[b][0]]) / width
        distances = [abs((corners[a] - centers[c]) @ normal) for c in cells]
        along = centers[cells[1]] - centers[cells[0]]
        assert width < 1e-6 or abs(along @ (corners[b] - corners[a])) < 1e-7 * np.hypot(*along), "right angles"
        order = np.argsort(cells)
        for layer in range(layers):
            if (idomain[layer, cells] == 1).all():
                pair = tuple(layer * n + cells[i] for i in order)
                assert pair not in found
                found[pair] = (np.array(distances)[order], width)
    areas = np.array([-doubled_area(corners[p]) / 2 for p in polygons])
    half = (tops - bottoms) / 2
    for cell in range(n):
        above = None
        for layer in range(layers):
            if idomain[layer, cell] == 1:
                if above is not None:
                    found[above * n + cell, layer * n + cell] = (half[[above, layer], cell], areas[cell])
                above = layer
            elif idomain[layer, cell] == 0:
                above = None
    return found


def disu_of(path):
    blocks = blocks_of(path)
    sizes = {name: int(n) for name, n in blocks["DIMENSIONS"]}
    data = arrays_of(blocks["GRIDDATA"]) | arrays_of(blocks["CONNECTIONDATA"])
    assert len(data["TOP"]) == sizes["NODES"] and len(data["JA"]) == sizes["NJA"] == data["IAC"].sum()
    return data


def tough_of(path):
    elements, connections, block = {}, [], None
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        if line in ("ELEME", "CONNE"):
            block = line
        elif not line:
            block = None
        elif block == "ELEME":
            assert line[:5] not in elements and len(line) == 80
            elements[line[:5]] = (int(line[15:20]), float(line[20:30]), [float(line[i : i + 10]) for i in (50, 60, 70)])
        elif block == "CONNE":
            numbers = [float(line[i : i + 10]) for i in (30, 40, 50, 60)]
            connections.append((line[:5], line[5:10], int(line[25:30]), *numbers))
    return elements, connections


# --- laws ----------------------------------------------------------------------------------------------------------


def test_arrays_have_their_shapes_and_add_up(columns):
    mesh, c = columns
    assert c.states.shape == c.tops.shape == c.volumes.shape == (4, mesh.n_vertices)
    active = c.states == 1
    assert active.any(axis=1).all() and (c.states == -1).sum() > 20 and (c.states == 0).sum() == 1
    assert np.allclose(c.volumes, np.where(active, (c.tops - c.bottoms) * c.areas, 0))
    assert np.isclose(c.areas.sum(), temper.dec_operators(mesh).areas.sum())
    assert (c.cells[:, 0] < c.cells[:, 1]).all() and len(np.unique(c.cells, axis=0)) == len(c.cells)
    assert active.ravel()[c.cells].all() and (c.distances > 0).all() and (c.face_areas > 0).all()
    assert not c.tops.flags.writeable and c == pickle.loads(pickle.dumps(c))
    assert "4" in str(c) and c.as_dict()["n_layers"] == 4


def test_disv_read_back_has_the_volumes_and_connections(columns, tmp_path):
    mesh, c = columns
    (path,) = c.write(tmp_path, formats=["disv"])
    corners, centers, polygons, tops, bottoms, idomain = disv_of(path)
    assert np.array_equal(idomain, c.states) and np.array_equal(centers, mesh.points)
    areas = np.array([-doubled_area(corners[p]) / 2 for p in polygons])
    assert (areas > 0).all(), "clockwise"
    assert np.allclose((areas * (tops - bottoms))[idomain == 1], c.volumes[idomain == 1], rtol=1e-9)
    found = connections_of_disv(path)
    assert set(found) == set(map(tuple, c.cells.tolist())), "each once, and no other"
    for pair, distances, vertical, width, area in zip(c.cells.tolist(), c.distances, c.is_vertical, c.widths, c.face_areas):
        theirs = found[tuple(pair)]
        assert np.allclose(theirs[0], distances, rtol=1e-6, atol=1e-12)
        assert np.isclose(theirs[1], area if vertical else width, rtol=1e-6, atol=1e-9)


def test_disu_read_back_is_reciprocal_and_the_same_as_disv(columns, tmp_path):
    mesh, c = columns
    disv, disu = c.write(tmp_path, formats=["disv", "disu"])
    u = disu_of(disu)
    assert np.array_equal(u["IDOMAIN"] == 1, (c.states == 1).ravel())
    assert np.allclose((u["AREA"] * (u["TOP"] - u["BOT"]))[u["IDOMAIN"] == 1].sum(), c.volumes.sum())
    starts = np.concatenate([[0], np.cumsum(u["IAC"])]).astype(int)
    ja = u["JA"].astype(int) - 1
    entries = {}
    for row in range(len(u["TOP"])):
        assert ja[starts[row]] == row and (np.diff(ja[starts[row] + 1 : starts[row + 1]]) > 0).all()
        for i in range(starts[row] + 1, starts[row + 1]):
            entries[row, ja[i]] = (u["IHC"][i], u["CL12"][i], u["HWVA"][i], u["ANGLDEGX"][i])
    expected = connections_of_disv(disv)
    assert len(entries) == 2 * len(expected)
    n = mesh.n_vertices
    for (a, b), (distances, size) in expected.items():
        here, there = entries[a, b], entries[b, a]
        assert here[0] == there[0] == (0 if a % n == b % n else 1)
        assert here[2] == there[2] and np.isclose(here[2], size, rtol=1e-6, atol=1e-9)
        assert np.allclose([here[1], there[1]], distances, rtol=1e-6, atol=1e-12)
        if here[0] == 1:
            along = np.asarray(mesh.points)[b % n] - np.asarray(mesh.points)[a % n]
            angle = np.radians(here[3])
            assert np.allclose(along / np.hypot(*along), [np.cos(angle), np.sin(angle)])
            assert np.isclose(abs(here[3] - there[3]), 180) and 0 <= here[3] < 360
        else:
            assert u["TOP"][b] <= u["BOT"][a] + 1e-12, "MODFLOW's rule: the higher number is below"


def test_tough_read_back_keeps_water_at_rest(columns, tmp_path):
    mesh, c = columns
    (path,) = c.write(tmp_path, formats=["tough"])
    assert pathlib.Path(path).name == "MESH"
    elements, connections = tough_of(path)
    active = np.flatnonzero((c.states == 1).ravel())
    assert len(elements) == len(active) and len(connections) == len(c.cells)
    names = dict(zip(elements, active))  # in the order of cells
    for (name, cell) in names.items():
        rock, volume, center = elements[name]
        layer, vertex = divmod(cell, mesh.n_vertices)
        assert rock == layer + 1 and np.isclose(volume, c.volumes[layer, vertex], rtol=1e-6)
        assert np.allclose(center[:2], mesh.points[vertex], atol=1e-6)
        assert int(name[3:]) == 10 + cell % 90 and "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789".index(name[2]) == cell // 90 % 36
    for (a, b, direction, d1, d2, area, beta), k in zip(connections, range(len(c.cells))):
        assert [names[a], names[b]] == c.cells[k].tolist() and direction == (3 if c.is_vertical[k] else 1)
        assert np.allclose([d1, d2, area], [*c.distances[k], c.face_areas[k]], rtol=1e-6, atol=1e-8)
        drop = elements[a][2][2] - elements[b][2][2]
        assert np.isclose(beta * (d1 + d2), drop, atol=1e-5), "pressures of water at rest balance gravity"
        assert (beta == 1) == bool(c.is_vertical[k])


def test_prisms_have_the_volumes(columns, tmp_path):
    _, c = columns
    paths = c.write(tmp_path, formats=["vtu"])
    assert [pathlib.Path(p).name for p in paths] == ["dual.vtu", "dual_edges.vtu", "columns.vtu"]
    piece = xml.parse(paths[2]).getroot().find("UnstructuredGrid/Piece")
    assert int(piece.get("NumberOfCells")) == (c.states == 1).sum()
    assert [a.get("Name") for a in piece.find("CellData")] == ["vertex", "layer", "thickness", "volume"]
    assert [a.get("Name") for a in piece.find("Cells")] == ["connectivity", "offsets", "types", "faces", "faceoffsets"]


def test_one_row_is_for_all_vertices_and_flags_switch_layers_off():
    mesh = good_mesh()
    c = temper.columns(mesh, SURFACES, active=[True, True, False, True])
    assert (c.states == np.array([1, -1, 0, 1])[:, None]).all() and not c.is_vertical.any()
    assert np.isclose(c.volumes.sum(), 4 * c.areas.sum())
    assert (temper.columns(mesh, SURFACES, pinch_out=1.0).states[3] == -1).all()


def test_bad_input_is_told():
    mesh = good_mesh()
    with pytest.raises(ValueError, match=r"surfaces: expected \(150, 2\) or \(2,\) numbers, found \(3, 2\)"):
        temper.columns(mesh, np.zeros((3, 2)))
    with pytest.raises(ValueError, match="surfaces: expected"):
        temper.columns(mesh, [1.0])
    with pytest.raises(ValueError, match="active: expected"):
        temper.columns(mesh, [1.0, 0.0], active=[True, False])
    with pytest.raises(temper.TemperError, match="bottom 1 is 2, higher than the top, which is 1"):
        temper.columns(mesh, [1.0, 2.0])
    with pytest.raises(temper.TemperError, match="sphere"):
        temper.columns(temper.generate.random_sphere(vertices=50), [1.0, 0.0])
    with pytest.raises(temper.TemperError, match="need layers"):
        temper.dec_operators(mesh).write("nowhere", formats=["disv"])


def test_the_program_writes_what_python_writes(in_scratch):
    mesh = good_mesh()
    temper.write("a.vtu", mesh)
    rows = [f"{v},,{7 + 0.1 * v!r},,," for v in range(mesh.n_vertices) if v % 3]
    pathlib.Path("layers.csv").write_text("\n".join(["vertex,top,bottom 1,bottom 2,bottom 3,bottom 4", "*,30,7,7,2,1", *rows]))
    subprocess.run(["temper", "operators", "a.vtu", "-o", "program", "--layers", "layers.csv", "--format", "disv,disu,tough"],
                   check=True, capture_output=True)  # fmt: skip
    surfaces = np.tile([30.0, 7, 7, 2, 1], (mesh.n_vertices, 1))
    for v in range(mesh.n_vertices):
        if v % 3:
            surfaces[v, 1] = 7 + 0.1 * v
    for path in temper.columns(temper.read("a.vtu"), surfaces).write("python", formats=["disv", "disu", "tough"]):
        name = pathlib.Path(path).name
        assert pathlib.Path("program", name).read_bytes() == pathlib.Path("python", name).read_bytes()


def test_the_cells_of_names_are_those_of_the_program(in_scratch):
    subprocess.run(["temper", "mesh", ROOT / "examples" / "aquifer.geojson", "-o", "a.vtu", "--size", "300", "--quiet"], check=True)
    pathlib.Path("layers.csv").write_text("vertex,top,bottom\n*,1,0\n")
    subprocess.run(["temper", "operators", "a.vtu", "-o", "program", "--layers", "layers.csv", "--format", "disv,tough"],
                   check=True, capture_output=True)  # fmt: skip
    mesh = temper.read("a.vtu")
    columns = temper.columns(mesh, [1, 0])
    names = [pathlib.Path(path).name for path in columns.write("python", formats=["disv", "tough"])]
    assert names == ["mesh.disv", "mesh.disv.csv", "MESH", "MESH.csv"]
    assert all(pathlib.Path("program", name).read_bytes() == pathlib.Path("python", name).read_bytes() for name in names)
    wells = {name: mesh.points[vertex].tolist() for name, kind, vertex, _ in columns.groups if kind == "point"}
    assert wells == {"west well": [681300, 5241200], "south well": [682100, 5240600], "east well": [682900, 5241600]}
