"""Data of points and cells over changes of a mesh, and their rules."""

import math
import pickle
import subprocess

import numpy as np
import pytest
from test_optimizer import cube, inner, is_good, plane

import temper

STEPS = 4
CHANGE = 1e-13  # of a sum, over the sum of the absolute values: some hundred roundings


def sphere():
    mesh = temper.generate.random_sphere(400, seed=2)
    temper.optimize(mesh, progress=False)
    return mesh


def regions():
    """Two regions, whose line lies on constrained edges."""
    mesh = plane()
    right = np.asarray(mesh.points)[mesh.triangles][:, :, 0].mean(axis=1) > np.mean(mesh.points[:, 0])
    mesh = temper.Mesh(mesh.points, mesh.triangles, regions=right.astype(np.int32))
    temper.optimize(mesh, progress=False)
    return mesh


MESHES = {"plane": (plane, 0.05), "regions": (regions, 0.05), "sphere": (sphere, 0.02), "tetrahedra": (cube, 0.6)}


def cells_of(mesh):
    return mesh.tetrahedra if isinstance(mesh, temper.TetMesh) else mesh.triangles


def sizes(mesh, of):
    """Areas or volumes of the cells, or of the power cells. In a mesh that is well-centered, star0 are these."""
    operators = temper.dec_operators(mesh)
    if of == "points":
        return operators.star0
    return operators.volumes if isinstance(mesh, temper.TetMesh) else operators.areas


def middles(mesh, of):
    return mesh.points if of == "points" else mesh.points[cells_of(mesh)].mean(axis=1)


def bell(places):
    """1 on top, near the middle, and 0 far away."""
    far = np.ptp(places, axis=0).max() / 6
    return np.exp(-np.sum((places - np.mean(places, axis=0) - far) ** 2, axis=1) / far**2)


def data_of(mesh, of):
    return mesh.point_data if of == "points" else mesh.cell_data


def set_rules(mesh, of, words):
    setattr(mesh, "point_data_rules" if of == "points" else "cell_data_rules", words)


def disturb(mesh, optimizer, amount, seed):
    """Moves some vertices inside regions: interfaces stay, and so do the sizes of regions."""
    rng = np.random.default_rng(seed)
    free = inner(mesh)
    if isinstance(mesh, temper.Mesh):
        free = np.setdiff1d(free, mesh.constrained_edges)
    some = rng.choice(free, max(1, len(free) // 20), replace=False)
    optimizer.move(some, mesh.points[some] + rng.uniform(-amount, amount, (len(some), mesh.points.shape[1])))


def total(mesh, of, values):
    return math.fsum(sizes(mesh, of) * values)


@pytest.mark.parametrize("assigns", [False, True], ids=["once", "each_step"])
@pytest.mark.parametrize("of", ["points", "cells"])
@pytest.mark.parametrize("kind", MESHES)
def test_sums_of_conserved_data_stay_and_bounds_hold(kind, of, assigns):
    make, amount = MESHES[kind]
    mesh = make()
    assert is_good(mesh)
    first = bell(middles(mesh, of))
    data_of(mesh, of)["bell"] = first
    data_of(mesh, of)["one"] = np.ones(len(first))
    set_rules(mesh, of, "conserve")
    expected = total(mesh, of, first)
    optimizer = temper.Optimizer(mesh)
    changed = 0
    for step in range(STEPS):
        disturb(mesh, optimizer, amount, step)
        changed += len(optimizer.update().cells)
        now = data_of(mesh, of)
        assert is_good(mesh)
        assert abs(total(mesh, of, now["bell"]) - expected) <= CHANGE * expected
        assert first.min() <= now["bell"].min() and now["bell"].max() <= first.max()
        assert np.array_equal(now["one"], np.ones(len(now["one"])))
        if assigns:
            data_of(mesh, of)["bell"] = now["bell"]
    assert changed > 0 and not np.array_equal(now["bell"], first)


@pytest.mark.parametrize("of", ["points", "cells"])
def test_each_region_keeps_its_sum(of):
    mesh = regions()
    first = bell(middles(mesh, "cells"))
    data_of(mesh, "cells")["u"] = first
    mesh.cell_data_rules = "conserve=u"
    sums = [math.fsum((sizes(mesh, "cells") * first)[mesh.regions == r]) for r in (0, 1)]
    optimizer = temper.Optimizer(mesh)
    for step in range(STEPS):
        disturb(mesh, optimizer, 0.05, step)
        optimizer.update()
        now = sizes(mesh, "cells") * mesh.cell_data["u"]
        for r in (0, 1):
            assert abs(math.fsum(now[mesh.regions == r]) - sums[r]) <= CHANGE * sums[r]


@pytest.mark.parametrize("kind", MESHES)
def test_the_report_says_what_was_conserved(kind):
    mesh = MESHES[kind][0]()
    data_of(mesh, "cells")["u"] = bell(middles(mesh, "cells"))
    data_of(mesh, "cells")["n"] = np.arange(len(cells_of(mesh)))
    data_of(mesh, "points")["p"] = bell(middles(mesh, "points"))
    mesh.cell_data_rules, mesh.point_data_rules = "conserve", ["conserve=p"]
    report = temper.optimize(mesh, progress=False).data
    assert report.conserved == ["p"]
    of_cells = report.as_dict()
    cells = "tetrahedra" if kind == "tetrahedra" else "triangles"
    assert of_cells[f"conserved_of_{cells}"] == ["u"] and of_cells[f"of_{cells}"] == ["n"]
    assert report.integral_change <= CHANGE and report.out_of_range == 0


@pytest.mark.parametrize("kind", ["plane", "tetrahedra"])
def test_wrong_rules_name_what_there_is_and_change_nothing(kind):
    mesh = MESHES[kind][0]()
    mesh.point_data["depth"], mesh.cell_data["u"] = np.zeros(mesh.n_vertices), np.zeros(len(cells_of(mesh)))
    mesh.cell_data["n"] = np.arange(len(cells_of(mesh)))
    mesh.point_data_rules, mesh.cell_data_rules = "keep=depth", "conserve=u"
    wrong = {
        "cell_data_rules": {
            "keep": "'keep' is not sample, conserve, or one of these with =NAME", "conserve=v": "no cell data 'v'; there are: u, n",
            "conserve=n": "integers", "sample=": "sample=", ("sample", "conserve"): "contradicts",
        },
        "point_data_rules": {
            "sample": "'sample' is not interpolate, keep, conserve, or one", "keep=u": "no point data 'u'; there are: depth",
        },
    }  # fmt: skip
    for name, cases in wrong.items():
        for rules, words in cases.items():
            with pytest.raises(temper.TemperError, match=words) as raised:
                setattr(mesh, name, rules)
            assert raised.value.code == "invalid_option"
        with pytest.raises(TypeError, match=f"{name}: expected a word"):
            setattr(mesh, name, [1])
    assert mesh.point_data_rules == ("interpolate", "keep=depth") and mesh.cell_data_rules == ("sample", "conserve=u")
    with pytest.raises(temper.TemperError, match="row 3, counted from 0, that is not finite"):
        mesh.cell_data["u"] = np.where(np.arange(len(cells_of(mesh))) == 3, np.nan, 0)
    assert mesh.cell_data["u"].max() == 0
    for same in (mesh.copy(), pickle.loads(pickle.dumps(mesh))):
        assert same.point_data_rules == mesh.point_data_rules and same.cell_data_rules == mesh.cell_data_rules
    del mesh.cell_data["u"]  # its rule goes with it
    assert mesh.cell_data_rules == ("sample",) and list(mesh.cell_data) == ["n"]
    mesh.point_data_rules = ()
    assert mesh.point_data_rules == ("interpolate",)
    assert pickle.loads(pickle.dumps(mesh)) == mesh


@pytest.mark.parametrize("kind", ["plane", "tetrahedra"])
def test_data_are_assigned_and_deleted_and_go_to_files(kind, tmp_path):
    mesh = MESHES[kind][0]()
    n = len(cells_of(mesh))
    before = mesh.cell_data
    mesh.cell_data["u"], mesh.point_data["k"] = np.arange(n) / 3, np.arange(mesh.n_vertices, dtype=np.int32)
    mesh.cell_data["pair"] = np.zeros((n, 2), np.float32)
    mesh.cell_data["u"] = np.arange(n) / 7  # in its place
    assert list(mesh.cell_data) == ["u", "pair"] and list(before) == []
    with pytest.raises(ValueError, match="read-only"):
        mesh.cell_data["u"][0] = 1
    with pytest.raises(temper.TemperError, match=f"expected {n} values, found 1"):
        mesh.cell_data["u"] = [1.0]
    with pytest.raises(KeyError, match="v"):
        del mesh.cell_data["v"]
    temper.write(tmp_path / "out.vtu", mesh)
    again = temper.read(tmp_path / "out.vtu")
    assert np.array_equal(again.cell_data["u"], np.arange(n) / 7) and again.cell_data["pair"].dtype == np.float32
    assert np.array_equal(again.point_data["k"], np.arange(mesh.n_vertices))
    del mesh.cell_data["u"], mesh.point_data["k"]
    assert list(mesh.cell_data) == ["pair"] and list(mesh.point_data) == []


def test_points_of_no_tetrahedron_have_no_data():
    points = np.array([(9, 9, 9), (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    meshio = pytest.importorskip("meshio")
    with pytest.warns(temper.TemperWarning):
        mesh = temper.TetMesh.from_meshio(meshio.Mesh(points, [("tetra", [(1, 2, 3, 4)])], point_data={"p": np.arange(5.0)}))
    mesh.point_data["q"] = np.arange(4.0)
    assert mesh.point_data["p"].tolist() == [1, 2, 3, 4] and mesh.point_data["q"].tolist() == [0, 1, 2, 3]


@pytest.mark.parametrize("kind", ["plane", "tetrahedra"])
def test_conserved_data_are_the_same_as_the_programs(kind, in_scratch):
    mesh = temper.generate.random_mesh(300, seed=1) if kind == "plane" else cube(3)
    mesh.cell_data["u"], mesh.point_data["p"] = bell(middles(mesh, "cells")), bell(middles(mesh, "points"))
    temper.write("in.vtu", mesh)
    options = ["--cell-data", "conserve=u", "--point-data", "conserve"]
    try:
        subprocess.run(["temper", "optimize", "in.vtu", "-o", "out.vtu", "--quiet", *options], check=True)
    except FileNotFoundError:
        pytest.skip("the program was not built")
    mesh = temper.read("in.vtu")
    mesh.cell_data_rules, mesh.point_data_rules = "conserve=u", "conserve"
    temper.optimize(mesh, progress=False)
    program = temper.read("out.vtu")
    assert np.array_equal(program.cell_data["u"], mesh.cell_data["u"])
    assert np.array_equal(program.point_data["p"], mesh.point_data["p"])
