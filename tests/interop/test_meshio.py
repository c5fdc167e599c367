"""Files both ways between temper and meshio: points, cells and data equal to the last bit.

test_meshio.py CONVERT_TOOL
"""

import os
import shutil
import subprocess
import sys
import tempfile

import meshio
import numpy

from checks import check, checks_made

TOOL = sys.argv[1]


def sample():
    """Triangles and lines, data of several types, doubles that are hard on text."""
    points = numpy.array([[0, 0, 0.5], [1 / 3, -1e-17, 0.5], [2, 0, 0.5], [2, 1, 0.5], [0.1 + 0.2, 1, 0.5], [0, 1, 0.5]])
    return points, numpy.array([[0, 1, 5], [1, 4, 5], [1, 2, 4], [2, 3, 4]]), numpy.array([[0, 1], [2, 4]])


def vtk_mesh():
    points, triangles, lines = sample()
    return meshio.Mesh(
        points,
        [("triangle", triangles), ("line", lines)],
        point_data={
            "weight": numpy.array([0, -0.0, 1 / 3, 5e-324, -1e-300, 1e300]),
            "single": numpy.arange(6, dtype=numpy.float32) / 3,
            "vector": numpy.arange(18, dtype=float).reshape(6, 3) / 7,
            "count": numpy.arange(6, dtype=numpy.int64) - 3,
        },
        cell_data={
            "region": [numpy.array([1, 1, 2, -3], dtype=numpy.int32), numpy.array([8, 9], dtype=numpy.int32)],
            "value": [numpy.arange(4) / 3, numpy.array([0.1, 0.2])],
        },
    )


def gmsh_mesh():
    points, triangles, lines = sample()
    return meshio.Mesh(
        points,
        [("triangle", triangles), ("line", lines)],
        point_data={
            "weight": numpy.array([0, -0.0, 1 / 3, 5e-324, -1e-300, 1e300]),
            "t": numpy.arange(6) / 3,
            "gmsh:dim_tags": numpy.array([[2, 1]] * 6),
        },
        cell_data={
            "gmsh:physical": [numpy.array([1, 1, 1, 1]), numpy.array([8, 8])],
            "gmsh:geometrical": [numpy.array([1, 1, 1, 1]), numpy.array([2, 2])],
            "value": [numpy.arange(4) / 3, numpy.array([0.1, 0.2])],
        },
        field_data={"steel": numpy.array([1, 2]), "inflow": numpy.array([8, 1])},
    )


def plain_mesh():
    points, triangles, _ = sample()
    points[:, 2] = 0
    return meshio.Mesh(points, [("triangle", triangles)])


def medit_mesh():
    points, triangles, lines = sample()
    return meshio.Mesh(
        points,
        [("triangle", triangles), ("line", lines)],
        point_data={"medit:ref": numpy.array([0, 0, 5, 0, 0, 6])},
        cell_data={"medit:ref": [numpy.array([1, 1, 2, 3]), numpy.array([8, 9])]},
    )


def bits(array):
    return numpy.ascontiguousarray(array).tobytes()


def same(a, b, what, exact=True):
    good = bits(a.points.astype(float)) == bits(b.points.astype(float)) if exact else numpy.allclose(a.points, b.points, 1e-10, 1e-10)
    check(good, f"{what}: points {a.points} {b.points}")
    for kind in ("triangle", "line"):
        check(numpy.array_equal(a.get_cells_type(kind), b.get_cells_type(kind)), f"{what}: {kind}s")


def native(array):
    """The same numbers in the byte order of this machine."""
    return array.astype(array.dtype.newbyteorder("="))


def same_data(a, b, names, what, exact_type=True):
    for name in names:
        if name in a.point_data:
            check(name in b.point_data, f"{what}: point data {name} is missing")
            x, y = a.point_data[name], native(b.point_data[name])
            check(not exact_type or x.dtype == y.dtype, f"{what}: type of {name}: {x.dtype} {y.dtype}")
            check(bits(x) == bits(y.astype(x.dtype)), f"{what}: point data {name}")
        else:
            for kind in ("triangle", "line"):
                x, y = a.get_cell_data(name, kind), native(b.get_cell_data(name, kind))
                check(not exact_type or x.dtype == y.dtype, f"{what}: type of {name}: {x.dtype} {y.dtype}")
                check(numpy.array_equal(x, y), f"{what}: cell data {name} of {kind}: {x} {y}")


def convert(source, target, name, encoding):
    result = subprocess.run([TOOL, source, target, name, encoding], capture_output=True, text=True)
    check(result.returncode == 0, f"{source} to {target}: {result.stderr}")


def groups_of_all():
    """Triangles without a region, beside lines with a tag and without: meshio and Gmsh keep all of them."""
    points, triangles, lines = sample()
    region = [numpy.zeros(4, dtype=numpy.int32), numpy.array([8, 0], dtype=numpy.int32)]
    meshio.vtu.write("tags", meshio.Mesh(points, [("triangle", triangles), ("line", lines)], cell_data={"region": region}))
    for name in ("gmsh22", "gmsh41"):
        for encoding in ("ascii", "appended"):
            convert("tags", "groups.msh", name, encoding)
            files = ["groups.msh"]
            if shutil.which("gmsh"):
                words = ["gmsh", "-0", "-v", "0", "-format", "msh22", "-o", "saved.msh", "groups.msh"]
                saved = subprocess.run(words, capture_output=True, text=True)
                check(saved.returncode == 0, f"Gmsh reads groups in {name} {encoding}: {saved.stderr}")
                files.append("saved.msh")
            for file in files:
                label = f"{file} of {name} {encoding}"
                back = meshio.read(file)
                check(len(back.get_cells_type("triangle")) == 4 and len(back.get_cells_type("line")) == 2, f"{label}: cells")
                check(all((tags > 0).all() for tags in back.cell_data["gmsh:physical"]), f"{label}: each element has a group")
                check("temper_ungrouped_faces" in back.field_data, f"{label}: names {back.field_data}")
                convert(file, "again.vtu", "vtu", "ascii")
                again = meshio.read("again.vtu")
                check(not again.get_cell_data("region", "triangle").any(), f"{label}: no region")
                check(sorted(again.get_cell_data("region", "line")) == [0, 8], f"{label}: tags of lines")


def main():
    os.chdir(tempfile.mkdtemp())
    vtk_names = ["weight", "single", "vector", "count", "region", "value"]

    # What meshio writes, read by us and handed back as VTU.
    mesh = vtk_mesh()
    for label, write in {
        "vtu ascii": lambda: meshio.vtu.write("in", mesh, binary=False),
        "vtu binary": lambda: meshio.vtu.write("in", mesh, binary=True, compression=None),
        "vtu zlib": lambda: meshio.vtu.write("in", mesh, binary=True, compression="zlib"),
        "vtk 4.2 ascii": lambda: meshio.write("in", mesh, file_format="vtk42", binary=False),
        "vtk 4.2 binary": lambda: meshio.write("in", mesh, file_format="vtk42", binary=True),
        "vtk 5.1 ascii": lambda: meshio.write("in", mesh, file_format="vtk51", binary=False),
        "vtk 5.1 binary": lambda: meshio.write("in", mesh, file_format="vtk51", binary=True),
    }.items():
        write()
        convert("in", "out.vtu", "vtu", "base64")
        back = meshio.read("out.vtu")
        # Digits that meshio's ASCII VTU leaves out are not ours to mend: it rounds to 11.
        rounded = label == "vtu ascii"
        same(mesh, back, label, exact=not rounded)
        same_data(mesh, back, ["count", "region"] if rounded else vtk_names, label)

    mesh = gmsh_mesh()
    for name in ("gmsh22", "gmsh"):
        for binary in (False, True):
            meshio.write("in", mesh, file_format=name, binary=binary)
            convert("in", "out.vtu", "vtu", "base64")
            back = meshio.read("out.vtu")
            label = f"{name} {'binary' if binary else 'ascii'}"
            same(mesh, back, label)
            same_data(mesh, back, ["weight", "t", "value"], label)
            # meshio writes no 4.1 entity that has no node of its own, so there the lines lose their tag.
            for kind, tag in (("triangle", 1), ("line", 8))[: 2 if name == "gmsh22" else 1]:
                check((back.get_cell_data("region", kind) == tag).all(), f"{label}: regions of {kind}")

    mesh = medit_mesh()
    meshio.write("in", mesh, file_format="medit")
    convert("in", "out.vtu", "vtu", "base64")
    back = meshio.read("out.vtu")
    same(mesh, back, "medit")
    check(numpy.array_equal(back.get_cell_data("region", "triangle"), [1, 1, 2, 3]), "medit: regions")

    mesh = plain_mesh()
    meshio.write("in.obj", mesh)
    convert("in.obj", "out.vtu", "vtu", "base64")
    same(mesh, meshio.read("out.vtu"), "obj")

    mesh = plain_mesh()
    mesh.point_data = {"weight": vtk_mesh().point_data["weight"], "single": numpy.arange(6, dtype=numpy.float32) / 3}
    for binary in (False, True):
        meshio.write("in.ply", mesh, binary=binary)
        convert("in.ply", "out.vtu", "vtu", "base64")
        back = meshio.read("out.vtu")
        label = f"ply {'binary' if binary else 'ascii'}"
        same(mesh, back, label)
        same_data(mesh, back, ["weight", "single"], label)
    meshio.write("in.off", mesh)
    convert("in.off", "out.vtu", "vtu", "base64")
    back = meshio.read("out.vtu")
    # meshio's OFF has fewer digits than a double.
    same(mesh, back, "off", exact=False)

    # What we write, read by meshio.
    mesh = vtk_mesh()
    meshio.vtu.write("in", mesh, binary=True, compression="zlib")
    for encoding in ("ascii", "base64", "appended"):
        convert("in", "out.vtu", "vtu", encoding)
        back = meshio.read("out.vtu")
        same(mesh, back, f"our vtu {encoding}")
        same_data(mesh, back, vtk_names, f"our vtu {encoding}")

    for encoding in ("ascii", "appended"):
        convert("in", "out.vtk", "vtk", encoding)
        back = meshio.read("out.vtk")
        same(mesh, back, f"our vtk {encoding}")
        same_data(mesh, back, vtk_names, f"our vtk {encoding}")

    for name in ("gmsh22", "gmsh41"):
        for encoding in ("ascii", "appended"):
            convert("in", "out.msh", name, encoding)
            back = meshio.read("out.msh")
            label = f"our {name} {encoding}"
            check(bits(mesh.points) == bits(back.points), f"{label}: points")
            check(bits(mesh.point_data["weight"]) == bits(back.point_data["weight"].ravel()), f"{label}: weights")
            check(len(back.get_cells_type("triangle")) == 4 and len(back.get_cells_type("line")) == 2, f"{label}: cells")
            tags = {}
            for block, physical in zip(back.cells, back.cell_data["gmsh:physical"]):
                for nodes, tag in zip(block.data, physical):
                    tags[tuple(nodes)] = tag
            expected = dict(zip(map(tuple, sample()[1]), [1, 1, 2, -3])) | dict(zip(map(tuple, sample()[2]), [8, 9]))
            check(tags == expected, f"{label}: regions and tags {tags}")

    groups_of_all()

    convert("in", "out.mesh", "medit", "ascii")
    back = meshio.read("out.mesh", file_format="medit")
    same(mesh, back, "our medit")
    check(numpy.array_equal(back.get_cell_data("medit:ref", "triangle"), [1, 1, 2, -3]), "our medit: regions")
    check(numpy.array_equal(back.get_cell_data("medit:ref", "line"), [8, 9]), "our medit: tags")

    convert("in.obj", "out.obj", "obj", "ascii")
    same(plain_mesh(), meshio.read("out.obj"), "our obj")

    # meshio knows no edges in PLY, so a mesh without.
    mesh = plain_mesh()
    mesh.point_data = {"weight": vtk_mesh().point_data["weight"]}
    meshio.vtu.write("triangles", mesh, binary=True, compression="zlib")
    for encoding in ("ascii", "appended"):
        convert("triangles", "out.ply", "ply", encoding)
        back = meshio.read("out.ply")
        same(mesh, back, f"our ply {encoding}")
        same_data(mesh, back, ["weight"], f"our ply {encoding}")
        # In version 5.1 meshio takes int for 64-bit integers, which regions are not: so a mesh without.
        convert("triangles", "out.vtk", "vtk51", encoding)
        back = meshio.read("out.vtk")
        same(mesh, back, f"our vtk51 {encoding}")
        same_data(mesh, back, ["weight"], f"our vtk51 {encoding}")
    convert("triangles", "out.off", "off", "ascii")
    same(plain_mesh(), meshio.read("out.off"), "our off")

    check(checks_made() > 300, f"only {checks_made()} checks")
    print(f"{checks_made()} checks passed with meshio {meshio.__version__}")


main()
