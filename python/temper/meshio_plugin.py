"""meshio reads and writes every format of temper: ``import temper.meshio_plugin``, then ``meshio.read("fort.14")``.

The format is called ``"temper"``. meshio uses it for suffixes that it does not know. For others, such as ``.msh``, it is
tried after meshio's own readers, and ``file_format="temper"`` chooses it.
"""

from __future__ import annotations

import os
from typing import Any

import meshio

from ._io import formats, read, write
from ._tets import as_any_mesh


def read_mesh(path: str | os.PathLike[str], **options: Any) -> meshio.Mesh:
    """The mesh of a file, in any format that ``temper.read`` recognizes, with the options of ``temper.read``."""
    return read(path, **options).to_meshio()


def write_mesh(path: str | os.PathLike[str], mesh: meshio.Mesh, **options: Any) -> None:
    """Writes the mesh in the format of the suffix, with the options of ``temper.write``."""
    write(path, as_any_mesh(mesh), **options)


_SUFFIXES = sorted({suffix for row in formats() for suffix in row.suffixes.split()})
meshio.deregister_format("temper")  # if the module is loaded again
meshio.register_format("temper", _SUFFIXES, read_mesh, {"temper": write_mesh})
