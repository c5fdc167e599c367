"""Meshes that go to other processes: with all that a copy has."""

import copy
import multiprocessing
import pickle
import warnings

import numpy as np
import pytest

import temper
from temper import topology

TAGGED = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 8 "gauge"
1 3 "wall"
1 4 "fault"
2 5 "steel and more"
$EndPhysicalNames
$Nodes
7
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0.5 0.5 0
60 9 9 0
70 0.5 0 0
$EndNodes
$Elements
11
1 15 2 8 1 50
2 1 2 3 1 10 70
3 1 2 3 1 70 20
4 1 2 4 2 10 50
5 1 2 4 2 50 30
6 2 2 5 1 10 70 50
7 2 2 5 1 70 20 50
8 2 2 5 1 20 30 50
9 2 2 6 1 40 50 30
10 2 2 6 1 10 50 40
11 15 2 9 1 40
$EndElements
$NodeData
1
"depth"
1
0.0
3
0
1
6
10 1.5
20 2.5
30 2.5
40 4.5
50 5.5
70 7.5
$EndNodeData
"""
SEA = """a sea
4 5
1 -10 57 30
2 -9 57 35
3 -9 58 40
4 -10 58 45
5 -9.5 57.5 50
1 3 1 2 5
2 3 2 3 5
3 3 3 4 5
4 3 4 1 5
0
0
0
0
"""


def meshes_of_files(folder):
    (folder / "tagged.msh").write_text(TAGGED)
    (folder / "fort.14").write_text(SEA)
    globe = temper.generate.icosahedral(2, radius=6371000.0)
    globe.cell_data["number"] = np.arange(globe.n_triangles)
    temper.write(folder / "globe.vtu", globe)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", temper.TemperWarning)  # the point of no triangle
        return [
            (temper.read(folder / "tagged.msh", fixed_tags=("fault",)), ("gmsh22", "gmsh41", "vtu", "medit")),
            (temper.read(folder / "fort.14", projection="stereographic"), ("adcirc", "gmsh41")),
            (temper.read(folder / "globe.vtu"), ("vtu", "gmsh41")),
        ]


def inner_halfedge(mesh):
    """The first that is neither of the boundary nor constrained."""
    return next(h for h in range(mesh.n_halfedges) if topology.can_flip(mesh, h) in ("possible", "not_convex"))


def written(mesh, folder, format):
    """The bytes of the file, and the warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", temper.TemperWarning)
        messages = temper.write(folder / "out", mesh, format=format)
    return (folder / "out").read_bytes(), messages


def test_what_came_with_a_mesh_from_a_file_is_pickled_with_it(tmp_path):
    for mesh, formats in meshes_of_files(tmp_path):
        mesh.point_data_rules = "keep"
        others = mesh.copy(), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))
        for other in others:
            assert other == mesh and other.warnings == mesh.warnings and other.point_data_rules == ("keep",)
            assert other.reversed_triangles == mesh.reversed_triangles
        for format in formats:
            assert all(written(other, tmp_path, format) == written(mesh, tmp_path, format) for other in others), format
        if mesh.space == temper.Space():
            for one in (mesh, *others):  # what is behind a mesh follows it afterwards, too
                one.point_data_rules = "interpolate"
                topology.insert_vertex(one, topology.plan_split(one, inner_halfedge(one), 0.25))
                one.weights = np.full(one.n_vertices, 1e-6)
            others = *others, pickle.loads(pickle.dumps(mesh))  # with vertices that the file has not
            for format in formats:
                assert all(written(other, tmp_path, format) == written(mesh, tmp_path, format) for other in others), format


def test_names_and_tags_go_to_other_processes(tmp_path):
    mesh, _ = meshes_of_files(tmp_path)[0]
    expected, _ = written(mesh, tmp_path, "gmsh22")
    assert all(name in expected for name in (b'0 8 "gauge"', b'1 4 "fault"', b'2 5 "steel and more"', b'"depth"'))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        pool.apply(temper.write, (tmp_path / "there.msh", mesh), {"format": "gmsh22"})
        again = pool.apply(copy.copy, (mesh,))
    assert (tmp_path / "there.msh").read_bytes() == expected == written(again, tmp_path, "gmsh22")[0]


def test_a_pickle_whose_arrays_do_not_belong_together_is_refused(tmp_path):
    mesh, _ = meshes_of_files(tmp_path)[0]
    make, (vertices, triangles, (file, rules)), _ = mesh.__reduce__()
    assert make(vertices, triangles, (file, rules)) == mesh
    for wrong in (
        dict(kept=file["kept"][:-1]),
        dict(kept=np.ones_like(file["kept"])),
        dict(lines=file["lines"] + 7),
        dict(line_tags=file["line_tags"][:-1]),
        dict(points=file["points"][:-1]),
        dict(origin=np.full(mesh.n_vertices, mesh.n_vertices, dtype=np.int32)),
    ):
        with pytest.raises(temper.TemperError):
            make(vertices, triangles, ({**file, **wrong}, rules))
