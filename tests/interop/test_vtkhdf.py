"""VTKHDF both ways between temper and h5py: what is in the files, to the last bit.

test_vtkhdf.py PROGRAM
"""

import os
import resource
import tempfile

import h5py
import numpy

from checks import check, checks_made
from program import convert, run


def processor_seconds():
    """Of all processes that have been run."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return children.ru_utime + children.ru_stime


def refused(path, *words):
    start = processor_seconds()
    done = run("check", path)
    check(done.returncode == 1, f"{path} is refused: {done.stderr}")
    for word in words:
        check(word in done.stderr, f"'{word}' is in: {done.stderr}")
    check(processor_seconds() - start < 5, f"{path} is refused soon")


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


with tempfile.TemporaryDirectory() as temporary:
    what_is_written(temporary)
    what_is_read(temporary)
    what_is_left_out(temporary)
    what_is_refused(temporary)
print(f"{checks_made()} checks")
