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
    assert np.array_equal(tables["points"], mesh.points)
    assert np.array_equal(tables["triangles"][:, :3], mesh.triangles + 1)
    assert np.array_equal(tables["triangles"][:, 3:], operators.orthocenters)
    assert np.array_equal(tables["edges"][:, :2], operators.edges.vertices + 1)
    assert np.array_equal(tables["edges"][:, 2:], np.column_stack([operators.edges.midpoint, operators.edges.dual_length]))
    assert (tables["edges"][:, 4] > 0).all()  # unsigned lengths are right


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
