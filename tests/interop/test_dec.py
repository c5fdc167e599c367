"""What `temper operators` writes, read by NumPy, SciPy and meshio: the same numbers in every format, and the laws of operators.

test_dec.py TEMPER
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

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
    for name in ["d0", "d1", "star0", "star1", "star2"]:
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
        check_docs()
    print(f"{checks_made()} checks passed")


main()
