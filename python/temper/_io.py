"""Mesh files, by their content."""

from __future__ import annotations

import dataclasses
import os
import warnings
from typing import Literal

from . import _temper
from ._errors import TemperWarning
from ._mesh import Mesh, MeshLike, _warn, as_mesh
from ._records import Record


@dataclasses.dataclass(frozen=True)
class Format(Record):
    """A file format that temper knows: a row of ``formats()``."""

    name: str
    """``"vtu"``, ``"gmsh41"``, …"""
    description: str
    suffixes: str
    """``".vtu"``, …, separated by spaces; the first is the one written."""
    writes: bool
    holds_weights: bool
    """Else weights go to ``PATH.weights.csv``, with a warning."""
    holds_planes: bool
    """Meshes of the plane; else only such as were read in degrees."""
    holds_spheres: bool


def formats() -> list[Format]:
    """The file formats that ``read`` and ``write`` know (docs/formats.md says what each holds)."""
    return [Format(**row) for row in _temper.formats()]


def read(
    path: str | os.PathLike[str],
    *,
    fixed_tags: tuple[str | int, ...] = (),
    projection: str | None = None,
    threads: int | None = None,
) -> Mesh:
    """Reads a mesh file; its content tells the format, never its name.

    Parameters
    ----------
    path : path
        VTU, legacy VTK, Gmsh, medit, Triangle, OBJ, MFEM, OFF, PLY, JIGSAW, ADCIRC, … (``formats()``). A side file
        ``PATH.weights.csv``, when there, gives the weights [length²].
    fixed_tags : sequence of str or int
        Tags or physical names whose points must not move.
    projection : str, optional
        The map for points in longitude and latitude, to meters: ``"stereographic"``, ``"mercator:lon"``,
        ``"transverse-mercator:lon,lat"`` (``temper.projection``); about the middle of the points without a center.
        ``write`` gives degrees again, bit for bit where a point has not moved; weights are squared meters of the map.
        ``"none"``: coordinates are those of a plane, whatever they look like.
    threads : int, optional
        Threads that unpack; None or 0: all of the machine. What is read does not depend on them.

    Returns
    -------
    Mesh
        With all else that is in the file behind it, for ``write``: data, tags, names. ``Mesh.warnings`` has what was
        repaired or dropped.

    Raises
    ------
    TemperError
        What is wrong with the file: file and line, element in the file's numbering, expected and found.

    Warns
    -----
    TemperWarning
        Each of ``Mesh.warnings``.
    """
    handle, messages = _temper.read(os.fspath(path), [str(tag) for tag in fixed_tags], projection or "", threads)
    return _warn(Mesh._of(handle), messages, 2)


def write(
    path: str | os.PathLike[str],
    mesh: MeshLike,
    *,
    format: str | None = None,
    encoding: Literal["ascii", "base64", "appended"] | None = None,
    triangle_quality: bool = True,
    threads: int | None = None,
) -> list[str]:
    """Writes a mesh, with all else that was in the file it came from.

    Parameters
    ----------
    path : path
        Written under a temporary name beside it first: on any error what was there is untouched. Of several files none
        is renamed before all are whole; then they are, one after the other: where one cannot be, those before it are
        new, and the error names them.
    mesh : Mesh or meshio.Mesh
    format : str, optional
        A name of ``formats()``; by default the suffix of the path tells it.
    encoding : {"ascii", "base64", "appended"}, optional
        Of formats that have several. VTU: ``base64``, compressed, is its default; ``appended`` is the fastest.
    triangle_quality : bool
        VTU and VTKHDF have the arrays of ``triangle_quality()`` as cell data, for ParaView to color; ``read`` leaves
        them out.
    threads : int, optional
        Threads that compress; the bytes written do not depend on them.

    Returns
    -------
    list of str
        Warnings: weights gone to a side file, data that the format cannot hold. Each is a ``TemperWarning`` too.

    Raises
    ------
    TemperError
        ``not_writable``, or ``invalid_option`` for a format that is not known.
    """
    handle = as_mesh(mesh)._handle
    messages: list[str] = _temper.write(
        os.fspath(path), handle, format or "", encoding or "", triangle_quality, threads
    )
    for message in messages:
        warnings.warn(message, TemperWarning, stacklevel=2)
    return messages
