"""VTKHDF both ways between temper and h5py, and VTK itself where it is there: what is in the files, to the last bit.

vtkhdf_test.py PROGRAM
"""

import os
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

from checks import check, checks_made

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None

PROGRAM = sys.argv[1]


def run(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True)


def convert(source, target):
    done = run("convert", source, "-o", target)
    check(done.returncode == 0, f"convert {source}: {done.stderr}")
    return done.stderr


def refused(path, *words):
    start = time.monotonic()
    done = run("check", path)
    check(done.returncode == 1, f"{path} is refused: {done.stderr}")
    for word in words:
        check(word in done.stderr, f"'{word}' is in: {done.stderr}")
    check(time.monotonic() - start < 5, f"{path} is refused soon")


# Weights, regions, a line, a marked point, names ("1 8 coast") and data of several types; arrays are in the order of
# their names, in which VTK writes them.
EVERYTHING = """# vtk DataFile Version 3.0
a square
ASCII
DATASET UNSTRUCTURED_GRID
FIELD fields 2
physical_names 1 10 unsigned_char
49 32 56 32 99 111 97 115 116 10
time 1 1 double
0.1
POINTS 4 double
0 0 0.5 1 0 0.5 1.1 1 0.5 0 0.3 0.5
CELLS 4 13
3 0 1 2 3 0 2 3 2 0 1 1 3
CELL_TYPES 4
5 5 3 1
POINT_DATA 4
SCALARS weight double 1
LOOKUP_TABLE default
0 0.01 -0.02 1e-30
FIELD more 2
count 1 4 long
1 -2 3 4000000000
pair 2 4 short
1 2 3 4 5 6 7 -8
VECTORS velocity float
1 2 3 4 5 6 7 8 9 10 11 12.5
CELL_DATA 4
FIELD more 2
region 1 4 int
3 -4 8 9
byte 1 4 unsigned_char
0 1 254 255
"""


def sample():
    """Pieces of a strip of squares, each with its points; the last column of one is the first of the next."""
    n = 40
    x, y = numpy.meshgrid(numpy.arange(n + 1) / 3, numpy.arange(n + 1) / 7)
    points = numpy.stack([x.ravel(), y.ravel(), numpy.full(x.size, 0.5)], axis=1)
    a = (numpy.arange(n)[:, None] * (n + 1) + numpy.arange(n)[None, :]).ravel()
    triangles = numpy.concatenate([numpy.stack([a, a + 1, a + n + 2], 1), numpy.stack([a, a + n + 2, a + n + 1], 1)])
    return [(points + [k * n / 3, 0, 0], triangles) for k in range(3)]


def write_pieces(path, pieces, version=(2, 2), options=None, spoil=None):
    options = options or {}
    points = numpy.concatenate([p for p, _ in pieces])
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = version
        root.attrs.create("Type", b"UnstructuredGrid", dtype="S16")
        root["NumberOfPoints"] = [len(p) for p, _ in pieces]
        root["NumberOfCells"] = [len(t) for _, t in pieces]
        root["NumberOfConnectivityIds"] = [t.size for _, t in pieces]
        root.create_dataset("Points", data=points, **options)
        root.create_dataset("Connectivity", data=numpy.concatenate([t.ravel() for _, t in pieces]), **options)
        offsets = [3 * numpy.arange(len(t) + 1) for _, t in pieces]
        root.create_dataset("Offsets", data=numpy.concatenate(offsets), **options)
        root["Types"] = numpy.full(sum(len(t) for _, t in pieces), 5, dtype=numpy.uint8)
        root.create_group("PointData")["height"] = points[:, 0] * points[:, 1]
        if spoil is not None:
            spoil(root)
    return points


def what_is_written(folder):
    """The spec of VTKHDF 1.0: types, shapes, one piece."""
    path = os.path.join(folder, "m.vtkhdf")
    done = run("example", "horseshoe", "-o", path)
    check(done.returncode == 0, done.stderr)
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        check(list(root.attrs["Version"]) == [1, 0], "the version is 1.0")
        kind = root.attrs.get_id("Type").get_type()
        check(kind.get_class() == h5py.h5t.STRING and not kind.is_variable_str(), "the type is text of a fixed length")
        check(kind.get_size() == 16 and kind.get_cset() == h5py.h5t.CSET_ASCII, "the type is text of 16 letters")
        check(root.attrs["Type"] == b"UnstructuredGrid", "the type is UnstructuredGrid")
        n_points, n_cells = root["NumberOfPoints"][0], root["NumberOfCells"][0]
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Connectivity", "Offsets"):
            check(root[name].dtype == numpy.dtype("<i8"), f"{name} has 64 bits")
        check(root["Points"].shape == (n_points, 3) and root["Points"].dtype == numpy.dtype("<f8"), "points")
        check(root["Offsets"].shape == (n_cells + 1,) and root["Offsets"][0] == 0, "offsets")
        check(root["Offsets"][-1] == root["NumberOfConnectivityIds"][0] == len(root["Connectivity"]), "connectivity")
        check(root["Types"].dtype == numpy.uint8 and len(root["Types"]) == n_cells, "types")
        check(all(len(d) == n_points for d in root["PointData"].values()), "point data")
        check(all(len(d) == n_cells for d in root["CellData"].values()), "cell data")
        check(root["CellData/well_centered"].dtype == numpy.uint8, "the quality of triangles")


def what_is_read(folder):
    """Pieces in one piece of memory, in chunks and compressed."""
    pieces = sample()
    for options in ({}, {"chunks": True, "compression": "gzip", "shuffle": True}):
        path, back = os.path.join(folder, "p.hdf"), os.path.join(folder, "back.vtkhdf")
        points = write_pieces(path, pieces, options=options)
        check("points of other pieces" in convert(path, back), "a warning of points that are joined")
        with h5py.File(back) as file:
            root = file["VTKHDF"]
            once = numpy.unique(points, axis=0)
            check(numpy.array_equal(numpy.unique(root["Points"][:], axis=0), once), "points are the same bits")
            check(len(root["Points"]) == len(once), "each point is there once")
            mine = root["Points"][:][root["Connectivity"][:]]
            theirs = numpy.concatenate([p[t.ravel()] for p, t in pieces])
            check(numpy.array_equal(mine, theirs), "triangles are the same bits, in their order")
            check(numpy.array_equal(root["PointData/height"][:], root["Points"][:, 0] * root["Points"][:, 1]), "data")


def what_is_left_out(folder):
    def odd(root):
        root["PointData"].create_dataset("words", data=[b"a"] * 1681)
        root["PointData"].create_dataset("flags", data=numpy.zeros(1681, dtype=bool))
        root.create_group("FieldData")["who"] = "somebody"

    path = os.path.join(folder, "o.hdf")
    write_pieces(path, sample()[:1], spoil=odd)
    said = convert(path, os.path.join(folder, "o.vtu"))
    for kind, name in (("point data", "words"), ("point data", "flags"), ("field data", "who")):
        check(f"{kind} '{name}' holds no numbers and is dropped" in said, f"a warning of {name}: {said}")


def what_is_refused(folder):
    path, other = os.path.join(folder, "r.hdf"), os.path.join(folder, "other.hdf")
    write_pieces(other, sample()[:1])

    def linked(root):
        del root["Points"]
        root["Points"] = h5py.ExternalLink(other, "/VTKHDF/Points")

    def virtual(root):
        del root["Points"]
        layout = h5py.VirtualLayout(shape=(1681, 3), dtype=float)
        layout[:] = h5py.VirtualSource(other, "VTKHDF/Points", shape=(1681, 3))
        root.create_virtual_dataset("Points", layout)

    def outside(root):
        del root["Points"]
        root.create_dataset("Points", shape=(1681, 3), dtype=float, external=[(other, 0, 1681 * 24)])

    def enormous(root):
        del root["Points"], root["NumberOfPoints"]
        root["NumberOfPoints"] = [2000000000]
        root.create_dataset("Points", shape=(2000000000, 3), chunks=(1000, 3), dtype=float)

    def endless(root):
        del root["Points"]
        root["Points"] = h5py.SoftLink("/VTKHDF/Points")

    def worded(root):
        del root["Points"]
        root["Points"] = [b"a"] * 1681

    write_pieces(path, sample()[:1], spoil=linked)
    refused(path, "HDF5 cannot open 'Points' in this file")
    for spoil in (virtual, outside):
        write_pieces(path, sample()[:1], spoil=spoil)
        refused(path, "the numbers of the dataset 'Points' are in other files")
    write_pieces(path, sample()[:1], spoil=enormous)
    refused(path, "becomes more than")
    write_pieces(path, sample()[:1], spoil=endless)
    refused(path, "HDF5 cannot open 'Points'")
    write_pieces(path, sample()[:1], spoil=worded)
    refused(path, "the dataset 'Points' has 1681 values, expected 1681 times 3")


def what_vtk_says(folder):
    """VTK reads what temper writes, and the other way round."""
    start, path, vtu, back = (os.path.join(folder, name) for name in ("s.vtk", "v.vtkhdf", "v.vtu", "w.vtkhdf"))
    with open(start, "w") as file:
        file.write(EVERYTHING)
    convert(start, path)
    convert(path, vtu)
    grids = []
    for reader, name in ((vtk.vtkHDFReader(), path), (vtk.vtkXMLUnstructuredGridReader(), vtu)):
        reader.SetFileName(name)
        reader.Update()
        grids.append(reader.GetOutput())
    mine, other = grids
    same = lambda a, b: numpy.array_equal(vtk_to_numpy(a), vtk_to_numpy(b))
    check(mine.GetNumberOfCells() == 4, "VTK reads triangles, a line and a point")
    check(same(mine.GetPoints().GetData(), other.GetPoints().GetData()), "VTK reads the points of the VTU")
    check(same(mine.GetCells().GetConnectivityArray(), other.GetCells().GetConnectivityArray()), "and its cells")
    for data in ("GetPointData", "GetCellData", "GetFieldData"):
        a, b = getattr(mine, data)(), getattr(other, data)()
        names = sorted(a.GetArrayName(i) for i in range(a.GetNumberOfArrays()))
        check(names == sorted(b.GetArrayName(i) for i in range(b.GetNumberOfArrays())), f"arrays of {data}: {names}")
        check(all(same(a.GetArray(name), b.GetArray(name)) for name in names), f"numbers of {data}")
    if hasattr(vtk, "vtkHDFWriter"):
        writer = vtk.vtkHDFWriter()
        writer.SetFileName(back)
        writer.SetInputData(mine)
        writer.Write()
        again = os.path.join(folder, "again.vtu")
        convert(back, again)
        with open(vtu, "rb") as a, open(again, "rb") as b:
            check(a.read() == b.read(), "through VTK's own file the VTU is the same")


with tempfile.TemporaryDirectory() as temporary:
    what_is_written(temporary)
    what_is_read(temporary)
    what_is_left_out(temporary)
    what_is_refused(temporary)
    if vtk is not None:
        what_vtk_says(temporary)
print(f"{checks_made()} checks" + ("" if vtk else ", without VTK"))
