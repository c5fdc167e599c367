"""Every script of examples/python and every example in a docstring runs. scripts/docs/pages.py runs the pages of docs/."""

import doctest
import importlib.util
import os
import re
import subprocess
import sys

import pytest
from conftest import PUBLIC_MESHES, ROOT, optimized

import temper


def run(arguments, **options):
    result = subprocess.run(arguments, capture_output=True, text=True, timeout=300, **options)
    assert result.returncode == 0, f"{result.stdout}\n{result.stderr}"
    return result


@pytest.mark.parametrize("example", sorted((ROOT / "examples" / "python").glob("*.py")), ids=lambda path: path.stem)
def test_an_example_runs(example, in_scratch):
    """With the checks of its client. Without the client the rest is run, and must hold; but the test has not passed."""
    environment = {**os.environ, "MPLBACKEND": "agg", "DEVSIM_MATH_LIBS": "liblapack.so.3:libblas.so.3"}
    assert run([sys.executable, "-W", "error::temper.TemperWarning", example], env=environment).stdout
    for client in re.findall(r'find_spec\("(\w+)"\)', example.read_text(encoding="utf-8")):
        if not importlib.util.find_spec(client):
            pytest.skip(f"{client} is not installed")


def test_what_the_example_for_julia_writes_is_the_dual(in_scratch):
    import numpy as np

    run([sys.executable, ROOT / "examples" / "python" / "combinatorial_spaces.py"])
    mesh = optimized(temper.generate.annulus())
    operators = temper.dec_operators(mesh)
    tables = {name: np.loadtxt(f"dual/{name}.csv", delimiter=",", skiprows=1) for name in ("points", "edges", "triangles")}
    assert np.array_equal(tables["points"][:, :2], mesh.points) and not tables["points"][:, 2].any()
    assert np.array_equal(tables["triangles"][:, :3], mesh.triangles + 1)
    assert np.array_equal(tables["triangles"][:, 3:5], operators.orthocenters)
    assert np.array_equal(tables["edges"][:, :2], operators.edges.vertices + 1)
    assert np.array_equal(tables["edges"][:, [2, 3, 5]], np.column_stack([operators.edges.midpoint, operators.edges.dual_length]))
    assert (tables["edges"][:, 5] > 0).all()  # unsigned lengths are right


def test_the_dual_for_julia_of_a_surface_has_the_laplacian_of_a_known_function(in_scratch):
    """By the formulas of CombinatorialSpaces.jl: each triangle has six dual triangles, from a vertex over the center of
    an edge to the center of the triangle. ⋆1 is the length of a dual edge over that of its edge, ⋆0 the area of a dual
    cell. On the torus the integral of |∇z|² is 2π² r R."""
    import numpy as np

    run([sys.executable, ROOT / "examples" / "tutorial" / "torus.py"])
    mesh = temper.read("torus.obj")
    temper.optimize(mesh)
    temper.write("better.vtu", mesh)
    run([sys.executable, ROOT / "examples" / "python" / "combinatorial_spaces.py", "better.vtu"])
    points, edges, triangles = (np.loadtxt(f"dual/{name}.csv", delimiter=",", skiprows=1) for name in ("points", "edges", "triangles"))
    ends = edges[:, :2].astype(int) - 1
    number = {tuple(sorted(pair)): i for i, pair in enumerate(ends.tolist())}
    dual, area = np.zeros(len(edges)), np.zeros(len(points))
    for corners, center in zip(triangles[:, :3].astype(int) - 1, triangles[:, 3:]):
        for a, b in zip(corners, np.roll(corners, 1)):
            edge = number[tuple(sorted((a, b)))]
            middle = edges[edge, 2:5]
            dual[edge] += np.linalg.norm(center - middle)
            for v in (a, b):
                area[v] += np.linalg.norm(np.cross(middle - points[v], center - points[v])) / 2
    lengths = np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1)
    operators = temper.dec_operators(mesh)
    assert np.allclose(dual / lengths, operators.star1) and np.allclose(area, operators.star0) and np.allclose(dual, edges[:, 5])
    z = points[:, 2]
    laplacian = np.bincount(ends.ravel(), np.outer(dual / lengths * (z[ends[:, 0]] - z[ends[:, 1]]), [1, -1]).ravel()) / area
    assert np.allclose(area * laplacian, operators.laplacian() @ z, atol=1e-12)
    assert abs((area * z * laplacian).sum() / (2 * np.pi**2 * 0.4) - 1) < 0.03


@pytest.mark.parametrize("mesh", ["skfem_annulus.msh", "sfepy_its2D.mesh"])
def test_the_first_example_takes_public_meshes(mesh, in_scratch):
    if not (PUBLIC_MESHES / mesh).exists():
        pytest.skip("no such mesh here")
    run([sys.executable, ROOT / "examples" / "python" / "optimize_meshio.py", PUBLIC_MESHES / mesh, "out.png"])
    assert (in_scratch / "out.png").stat().st_size > 10000


MODULES = ["", ".geometry", "._mesh", "._optimize", "._options", "._measure", "._draw", ".energy", "._dec", "._measure_errors", "._weights",
           "._explain", ".size", "._space", "._outline", "._tensor", "._surfaces"]  # fmt: skip


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_are_right(name, in_scratch):
    if name == "._measure_errors" and not hasattr(temper._temper, "measure_errors"):
        pytest.skip("built without Eigen")
    result = doctest.testmod(importlib.import_module("temper" + name))
    assert result.attempted > 0 and result.failed == 0
