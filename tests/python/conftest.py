"""What several tests of the Python module need."""

import os
import pathlib

import pytest

import temper

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PUBLIC_MESHES = pathlib.Path(os.environ.get("TEMPER_SHARED", ROOT.parent / "shared")) / "meshes"


@pytest.fixture
def ring():
    return temper.generate.annulus()


def optimized(mesh, *options, **keywords):
    """Another mesh, improved."""
    better = mesh.copy()
    temper.optimize(better, *options, **keywords)
    return better


@pytest.fixture
def in_scratch(tmp_path, monkeypatch):
    """A folder of its own, and the program on the path where it was built."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", os.environ.get("TEMPER_PROGRAM_DIR", "") + os.pathsep + os.environ["PATH"])
    return tmp_path
