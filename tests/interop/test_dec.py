"""What `temper operators` writes, read by NumPy, SciPy and meshio: the same numbers in every format, and the laws of operators.

test_dec.py TEMPER
"""

import base64
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

import meshio
import numpy
import scipy.io
import scipy.sparse

from checks import check, checks_made

TEMPER = sys.argv[1]
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "reference" / "operators.md"


def run(*arguments):
    subprocess.run([TEMPER, *arguments], check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def check_formats_agree(folder, arrays):
    for name in ["d0", "d1", "star0", "star1", "star2"] + (["d2", "star3"] if "tetrahedra" in arrays else []):
        from_npz = scipy.sparse.load_npz(f"{folder}/{name}.npz")
        from_mtx = scipy.io.mmread(f"{folder}/{name}.mtx").tocsr()
        check(from_npz.shape == from_mtx.shape, f"{name}: shapes")
        check((from_npz.toarray() == from_mtx.toarray()).all(), f"{name}: .npz and .mtx to the last bit")
        if name.startswith("star"):
            check((from_npz.diagonal() == arrays[name]).all(), f"{name}: diagonal and array")
        else:
            parts = tuple(arrays[f"{name}_{part}"] for part in ("data", "indices", "indptr"))
            check((from_npz != scipy.sparse.csr_matrix(parts, shape=from_npz.shape)).nnz == 0, f"{name}: matrix and arrays")
    check((scipy.io.mmread(f"{folder}/orthocenters.mtx") == arrays["orthocenters"]).all(), "orthocenters.mtx")
    check((scipy.io.mmread(f"{folder}/edge_midpoints.mtx") == arrays["edge_midpoints"]).all(), "edge_midpoints.mtx")
    check((scipy.io.mmread(f"{folder}/transmissibility.mtx").diagonal() == arrays["transmissibility"]).all(), "transmissibility.mtx")


def check_laws(folder, a):
    d0, d1 = (scipy.sparse.load_npz(f"{folder}/{name}.npz") for name in ("d0", "d1"))
    check(abs(d1 @ d0).sum() == 0, "d1 d0 = 0")
    p, q, r = (a["vertices"][a["triangles"][:, k]] for k in range(3))
    areas = ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]) / 2
    check(numpy.allclose(areas, a["triangle_areas"], rtol=1e-12, atol=0), "triangle areas")
    check(numpy.isclose(a["star0"].sum(), areas.sum(), rtol=1e-12), "sum of star0")
    check(numpy.isclose(a["cell_areas"].sum(), areas.sum(), rtol=1e-12), "sum of cell areas")
    # Orthocenters have equal power to all corners.
    powers = [((a["orthocenters"] - a["vertices"][a["triangles"][:, k]]) ** 2).sum(axis=1) - a["weights"][a["triangles"][:, k]]
              for k in range(3)]
    check(numpy.allclose(powers[0], powers[1]) and numpy.allclose(powers[0], powers[2]), "orthocenters")
    # A linear function is harmonic where no boundary edge ends.
    boundary = (a["edge_triangles"] < 0).any(axis=1)
    inner = numpy.setdiff1d(numpy.arange(len(a["vertices"])), a["edges"][boundary])
    check(len(inner) > 0, "inner vertices")
    laplacian = d0.T @ scipy.sparse.diags(a["star1"]) @ d0
    check(abs((laplacian @ a["vertices"])[inner]).max() < 1e-10, "linear functions are harmonic")


def check_vtu(folder, a):
    edges = meshio.read(f"{folder}/dual_edges.vtu")
    lines = edges.cells_dict["line"]
    check((edges.points[: len(a["orthocenters"]), :2] == a["orthocenters"]).all(), "dual_edges.vtu: orthocenters")
    check((edges.points[len(a["orthocenters"]) :, :2] == a["edge_midpoints"]).all(), "dual_edges.vtu: midpoints")
    check(len(lines) == len(a["edges"]), "dual_edges.vtu: one line an edge")
    check((edges.cell_data_dict["star1"]["line"] == a["star1"]).all(), "dual_edges.vtu: star1")
    ends = edges.points[lines]
    check(numpy.allclose(numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), abs(a["dual_lengths"]), atol=1e-9),
          "dual_edges.vtu: lengths")
    polygons = meshio.read(f"{folder}/dual.vtu")
    check((polygons.points[:, :2] == a["cell_corners"]).all(), "dual.vtu: corners")
    count = sum(len(block.data) for block in polygons.cells)
    check(count == len(a["cell_vertices"]), "dual.vtu: one cell a polygon")
    total = sum(data.sum() for data in polygons.cell_data["polygon_area"])
    check(numpy.isclose(total, a["triangle_areas"].sum(), rtol=1e-12), "dual.vtu: areas sum to the domain's")


def check_tetrahedra(folder, a):
    check((scipy.io.mmread(f"{folder}/face_orthocenters.mtx") == a["face_orthocenters"]).all(), "face_orthocenters.mtx")
    edges = meshio.read(f"{folder}/dual_edges.vtu")
    ends = edges.points[edges.cells_dict["line"]]
    check(numpy.allclose(numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), abs(a["dual_lengths"]), atol=1e-9), "dual_edges.vtu: lengths")
    # The signed volume of each dual cell, from its faces as seen from outside, is its star.
    points, faces, ends, stars = (vtu_array(f"{folder}/dual.vtu", name) for name in ("Points", "faces", "faceoffsets", "star0"))
    points = points.reshape(-1, 3)
    check(len(ends) == len(a["star0"]) and (stars == a["star0"]).all(), "dual.vtu: one cell a vertex")
    for stream, star in zip(numpy.split(faces, ends[:-1]), stars):
        volume, at = 0.0, 1
        for _ in range(stream[0]):
            face = points[stream[at + 1 : at + 1 + stream[at]]]
            volume += sum(numpy.cross(face[i], face[i + 1]) @ face[0] for i in range(1, len(face) - 1)) / 6
            at += 1 + stream[at]
        check(at == len(stream) and abs(volume - star) < 1e-10, f"dual.vtu: a cell of volume {volume} with star0 {star}")


def vtu_array(path, name):
    """An array of a VTU file with blocks of zlib in base64. (meshio does not read data of polyhedra.)"""
    text = pathlib.Path(path).read_text(encoding="ascii")
    kind, data = re.search(rf'<DataArray type="(\w+)" Name="{name}"[^>]*>\n(.*?)\n</DataArray>', text, re.S).groups()
    n = int.from_bytes(base64.b64decode(data[:12])[:8], "little")
    head = 4 * ((8 * (3 + n) + 2) // 3)
    sizes = numpy.frombuffer(base64.b64decode(data[:head]), "<u8")[3:].astype(int)
    body = base64.b64decode(data[head:])
    blocks = [zlib.decompress(body[end - size : end]) for size, end in zip(sizes, sizes.cumsum())]
    return numpy.frombuffer(b"".join(blocks), kind.lower())


def check_docs():
    """The commands and the script of docs/reference/operators.md."""
    text = DOCS.read_text()
    commands = re.search(r"```sh\n(.*?)```", text, re.S)[1].splitlines()
    check(len(commands) == 3 and all(line.startswith("temper ") for line in commands), "docs: three commands")
    for line in commands:
        run(*line.split()[1:])
    names = {}
    exec(re.search(r"```python\n(.*?)```", text, re.S)[1], names)
    check((names["a"]["star1"] > 0).all(), "docs: every star is positive once optimized")
    u, inner, boundary = names["u"], names["inner"], names["boundary"]
    check(len(inner) > 0 and (u[inner] > 0).all() and (u[boundary] == 0).all(), "docs: the solution obeys the maximum principle")


def shaken_cubes(n=3):
    """Cubes in six tetrahedra each, with points moved at random."""
    line = numpy.arange(n + 1)
    points = numpy.stack(numpy.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    number = numpy.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    corners = numpy.stack([number[i : i + n, j : j + n, k : k + n].ravel() for k in (0, 1) for j in (0, 1) for i in (0, 1)], axis=1)
    points += numpy.random.default_rng(1).uniform(-0.1, 0.1, points.shape)
    around = [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]]
    return points, corners[:, around].reshape(-1, 4)


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for example in ["horseshoe", "airfoil", "random"]:
            run("example", example, "-o", f"{example}.vtu")
            run("operators", f"{example}.vtu", "-o", example)
            arrays = numpy.load(f"{example}/operators.npz", allow_pickle=False)
            arrays = {name: arrays[name] for name in arrays.files}
            check_formats_agree(example, arrays)
            check_laws(example, arrays)
            check_vtu(example, arrays)
        points, tetrahedra = shaken_cubes()
        meshio.write("cubes.vtu", meshio.Mesh(points, [("tetra", tetrahedra)]))
        run("operators", "cubes.vtu", "-o", "cubes")
        arrays = dict(numpy.load("cubes/operators.npz", allow_pickle=False))
        check((arrays["star2"] < 0).any(), "cubes: some dual edges are negative")
        check_formats_agree("cubes", arrays)
        check_tetrahedra("cubes", arrays)
        check_docs()
    print(f"{checks_made()} checks passed")


main()
