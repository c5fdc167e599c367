"""QGIS and ParaView run their scripts of examples/, without a screen. scripts/clients.sh installs both from Debian."""

import json
import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

import temper

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LAYERS = ROOT / "examples" / "layers.geojson"


def run(*command, **variables):
    """Exit code, and all that was printed."""
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", **variables}
    result = subprocess.run([str(word) for word in command], env=environment, capture_output=True, text=True, timeout=300)
    return result.returncode, result.stdout + result.stderr


# --- QGIS -------------------------------------------------------------------------------------------------------------

LAYER = """
import json, sys
from qgis.core import QgsApplication, QgsMeshLayer
application = QgsApplication([], False)
application.initQgis()
layer = QgsMeshLayer(sys.argv[1], "mesh", "mdal")
mesh = layer.dataProvider()
groups = [mesh.datasetGroupMetadata(i) for i in range(mesh.datasetGroupCount())]
print(json.dumps([mesh.vertexCount(), mesh.faceCount(), {group.name(): [group.minimum(), group.maximum()] for group in groups}]))
application.exitQgis()
"""


@pytest.fixture(scope="module")
def qgis(tmp_path_factory):
    """A profile of its own, with the script."""
    if not shutil.which("qgis_process"):
        pytest.skip("QGIS is not installed")
    profile = tmp_path_factory.mktemp("qgis")
    scripts = profile / "profiles" / "default" / "processing" / "scripts"
    scripts.mkdir(parents=True)
    shutil.copy(ROOT / "examples" / "qgis" / "mesh_polygons.py", scripts)
    variables = {"QGIS_CUSTOM_CONFIG_PATH": str(profile), "QGIS_OPTS": "", "XDG_RUNTIME_DIR": str(profile)}
    profile.chmod(0o700)
    # Debian's script puts an option in front that only QGIS itself knows.
    program = shutil.which("qgis_process.bin") or "qgis_process"
    assert run(program, "plugins", "enable", "processing", **variables)[0] == 0

    def mesh(output, layer=f"{LAYERS}|geometrytype=Polygon", **more):
        inputs = [f"{name}={value}" for name, value in {"INPUT": layer, "OUTPUT": output, **more}.items()]
        return run(program, "run", "script:temper_mesh_polygons", "--", *inputs, **variables)

    return mesh


def layer_of(file):
    """Vertices, faces and groups of data, as MDAL reads the file."""
    code, said = run("/usr/bin/python3", "-c", LAYER, file)
    assert code == 0, said
    return json.loads(next(line for line in said.splitlines() if line.startswith("[")))


def test_qgis_meshes_polygons_into_ugrid(qgis, tmp_path):
    code, said = qgis(tmp_path / "mesh.nc", SIZE=100, KEEP=f"{LAYERS}|geometrytype=LineString")
    assert code == 0 and "0 of them bad" in said, said
    mesh = temper.read(tmp_path / "mesh.nc")
    margin = temper.triangle_quality(mesh).min_h_over_l
    assert f"TRIANGLES:\t{mesh.n_triangles}" in said and "BAD:\t0" in said and margin.min() > 0 and not mesh.weights.any()
    assert {name: dimension for name, (dimension, _) in mesh.names.items()} == {"sand": 2, "clay": 2, "river": 1, "drain": 1}
    vertices, faces, groups = layer_of(tmp_path / "mesh.nc")
    assert (vertices, faces) == (mesh.n_vertices, mesh.n_triangles)
    assert np.allclose(groups["margin"], [margin.min(), margin.max()]) and groups["region"] == [1, 2]


def test_qgis_meshes_polygons_into_2dm(qgis, tmp_path):
    code, said = qgis(tmp_path / "mesh.2dm", SIZE=100)
    assert code == 0, said
    mesh = temper.read(tmp_path / "mesh.2dm")
    assert layer_of(tmp_path / "mesh.2dm")[:2] == [mesh.n_vertices, mesh.n_triangles] and set(mesh.regions) == {1, 2}


def test_qgis_shows_the_errors_of_temper(qgis, tmp_path):
    code, said = qgis(tmp_path / "mesh.nc", layer=ROOT / "examples" / "islands.geojson", SIZE=1)
    assert code != 0 and "the polygons are in degrees (EPSG:4326). Next: reproject" in said and not (tmp_path / "mesh.nc").exists()
    crossing = tmp_path / "bow.geojson"
    ring = [[0, 0], [100, 100], [100, 0], [0, 100], [0, 0]]
    crossing.write_text(json.dumps({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}]}))  # fmt: skip
    code, said = qgis(tmp_path / "mesh.nc", layer=crossing, SIZE=10)
    assert code != 0 and "bow:1: segment 2 of ring 0 of feature 0" in said and "crosses segment 0" in said, said
    code, said = qgis(tmp_path / "mesh.nc", layer=crossing, SIZE=10, SPLIT="true")
    assert code == 0 and temper.quality(temper.read(tmp_path / "mesh.nc")).orthocenters_outside == 0, said


# --- ParaView ---------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def paraview():
    """pvpython on an X server without a screen."""
    for program in ("pvpython", "Xvfb"):
        if not shutil.which(program):
            pytest.skip(f"{program} is not installed")
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-noreset"],
                              pass_fds=[writing], stderr=subprocess.DEVNULL)  # fmt: skip
    os.close(writing)
    display = ":" + os.read(reading, 16).decode().strip()
    # The module of temper is not needed there, and NumPy of this environment is not ParaView's.
    yield lambda *words: run("pvpython", ROOT / "examples" / "paraview" / "margins.py", *words, DISPLAY=display, PYTHONPATH="")
    server.terminate()
    server.wait()
    os.close(reading)  # not before: the server writes there again


def colors(file):
    """Shares of red and of blue among the pixels that are not white."""
    from matplotlib.image import imread

    picture = imread(file)[..., :3]
    drawn = picture[picture.min(axis=2) < 0.97]
    return [float((drawn[:, a] > drawn[:, b] + 0.2).mean()) for a, b in ((0, 2), (2, 0))]


@pytest.mark.parametrize("kind", ["triangles", "tetrahedra"])
def test_paraview_colors_margins(paraview, kind, tmp_path):
    if kind == "triangles":
        mesh = temper.generate.annulus()
    else:
        around = np.array([(0, 9, 12, 13), (0, 12, 3, 13), (0, 3, 4, 13), (0, 4, 1, 13), (0, 1, 10, 13), (0, 10, 9, 13)])
        lower = [9 * x + 3 * y + z for x in range(2) for y in range(2) for z in range(2)]
        points = np.indices((3, 3, 3)).reshape(3, -1).T + 0.0
        points[13] += 0.15
        mesh = temper.TetMesh(points, np.add.outer(lower, around).reshape(-1, 4))
    shares, least = {}, {}
    for name in ("before", "after"):
        if name == "after":
            temper.optimize(mesh)
        temper.write(tmp_path / f"{name}.vtu", mesh)
        least[name] = temper.quality(mesh).min_h_over_l
        code, said = paraview(tmp_path / f"{name}.vtu", tmp_path / f"{name}.png")
        assert code == 0 and f"least margin {least[name]:.4g}" in said, said
        shares[name] = colors(tmp_path / f"{name}.png")
    assert least["before"] < 0 < least["after"]
    assert shares["before"][0] > 0.02 > shares["after"][0] and shares["after"][1] > 0.3, shares


def test_paraview_names_what_is_missing(paraview, tmp_path):
    temper.write(tmp_path / "bare.vtu", temper.generate.annulus(), triangle_quality=False)
    code, said = paraview(tmp_path / "bare.vtu")
    assert code != 0 and "expected cell data min_h_over_l, found none. Next: temper convert IN -o OUT.vtu adds them" in said
    code, said = paraview()
    assert code != 0 and "no file, and no active source" in said
