"""Mesh files. The content of a file decides its format."""

from __future__ import annotations

import dataclasses
import os
import warnings
from typing import Literal

from . import _temper
from ._errors import TemperWarning
from ._mesh import Mesh, _warn
from ._records import Record
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_planes, expect_no_options_of_triangles


@dataclasses.dataclass(frozen=True)
class Format(Record):
    """A file format of temper: a row of ``formats()``."""

    name: str
    """Name of the format: ``"vtu"``, ``"gmsh41"``, …"""
    description: str
    suffixes: str
    """Suffixes ``".vtu"``, …, separated by spaces; files are written with the first one."""
    writes: bool
    holds_weights: bool
    """The format can hold weights; else weights go to ``PATH.weights.csv``, with a warning."""
    holds_planes: bool
    """The format can hold any mesh of the plane; else only meshes that were read in degrees."""
    holds_spheres: bool
    holds_tetrahedra: bool
    holds_surfaces: bool


def formats() -> list[Format]:
    """The file formats of ``read`` and ``write`` (docs/reference/formats/index.md describes the contents of each)."""
    return [Format(**row) for row in _temper.formats()]


def read(
    path: str | os.PathLike[str],
    *,
    fixed_tags: tuple[str | int, ...] = (),
    projection: str | None = None,
    flat: bool = False,
    positive: Literal["up", "down"] | None = None,
    merge: float | None = None,
    threads: int | None = None,
) -> Mesh | TetMesh | SurfaceMesh:
    """Reads a mesh file. Its content decides the format, never its name. A file with tetrahedra gives a ``TetMesh``, and
    a curved surface a ``SurfaceMesh``.

    Parameters
    ----------
    path : path
        VTU, legacy VTK, Gmsh, medit, Triangle, OBJ, MFEM, OFF, PLY, JIGSAW, ADCIRC, … (``formats()``). If a side file
        ``PATH.weights.csv`` exists, it gives the weights [length²].
    fixed_tags : sequence of str or int
        Tags or physical names whose points must not move.
    projection : str, optional
        Map from longitude and latitude to meters: ``"stereographic"``, ``"mercator:lon"`` or
        ``"transverse-mercator:lon,lat"`` (``temper.projection``). Without a center, the middle of the points is used.
        ``write`` returns to degrees, bit for bit if a point has not moved. Weights are squared meters of the map.
        ``"none"``: coordinates are in a plane, whatever their values.
    flat : bool
        Take the mesh as one of the plane of x and y, with z as point data ``z``, which follow the vertices. Formats
        with three coordinates get z back.
    positive : {"up", "down"}, optional
        Sign of the bed in the file: ``"up"`` for heights, ``"down"`` for depths. Only z needs it, since other data have
        a name that tells. In 2DM, z is a height unless you say ``"down"``. ``write`` gives the sign of its format.
        ``fixed_tags``, ``projection``, ``flat`` and ``positive`` are for triangles alone.
    merge : float, optional
        Distance up to which points become one, at least 0, in the units of the file; on a sphere along the chord. It
        closes cracks. The first point of each place stays. Triangles with two corners at exactly one place are dropped,
        with a warning.
    threads : int, optional
        Threads that unpack; None or 0: all of the machine. The result does not depend on them.

    Returns
    -------
    Mesh, TetMesh or SurfaceMesh
        The mesh, with all other contents of the file (data, tags, names) for ``write``. ``Mesh.warnings`` lists repairs
        and losses.

    Raises
    ------
    TemperError
        An error in the file. The message has file and line, the element in the file's numbering, and the value expected
        and found. With ``merge``: a triangle or tetrahedron that would lose a corner.

    Warns
    -----
    TemperWarning
        Each of ``Mesh.warnings``.
    """
    tags = [str(tag) for tag in fixed_tags]
    handle, messages = _temper.read(os.fspath(path), tags, projection or "", flat, positive or "", merge, threads)
    if isinstance(handle, _temper.TetMesh):
        return TetMesh._of(handle, messages, 2)
    if isinstance(handle, _temper.SurfaceMesh):
        return _warn(SurfaceMesh._of(handle), messages, 2)
    return _warn(Mesh._of(handle), messages, 2)


def write(
    path: str | os.PathLike[str],
    mesh: AnyMeshLike,
    *,
    format: str | None = None,
    encoding: Literal["ascii", "base64", "appended"] | None = None,
    triangle_quality: bool = True,
    cells: Literal["power", "triangles"] | None = None,
    threads: int | None = None,
) -> list[str]:
    """Writes a mesh, with all other contents of its original file.

    Parameters
    ----------
    path : path
        Path of the file. It is written under a temporary name first, so that an error leaves the old file unchanged. If
        a mesh needs several files, they are renamed one after the other when all are complete. If one cannot be
        renamed, the files before it are new, and the error names them.
    mesh : Mesh, TetMesh, or of another library
        Points of no tetrahedron, which a ``TetMesh`` has not, are written if they were in its file.
    format : str, optional
        A name of ``formats()``; by default the suffix of the path decides.
    encoding : {"ascii", "base64", "appended"}, optional
        Encoding, for formats that have several. VTU: the default is ``base64``, compressed; ``appended`` is the
        fastest.
    triangle_quality : bool
        Add the arrays of ``triangle_quality()`` or ``tetrahedron_quality()`` as cell data to VTU and VTKHDF, for
        ParaView to color. ``read`` leaves
        them out.
    cells : {"power", "triangles"}, optional
        Cells to write as polygons instead of a mesh of triangles: power cells within the domain, or triangles. Each has
        its region, area and center (docs/reference/formats/cells.md). The suffix is ``.geojson``, ``.gpkg``, ``.vtu``
        or ``.ugrid.nc``, or ``format`` names one of ``geojson``, ``gpkg``, ``vtu`` and ``ugrid``.
    threads : int, optional
        Threads that compress; the bytes written do not depend on them.

    Returns
    -------
    list of str
        Warnings: weights gone to a side file, data that the format cannot hold. Each is a ``TemperWarning`` too.

    Raises
    ------
    TemperError
        The code is ``not_writable``, or ``invalid_option`` for an unknown format.
    """
    any_mesh = as_any_mesh(mesh)
    how = os.fspath(path), any_mesh._handle, format or "", encoding or "", triangle_quality, threads
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(write, cells=cells)
        messages: list[str] = _temper.write_tets(*how)
    else:
        if isinstance(any_mesh, SurfaceMesh):
            expect_no_options_of_planes(write, cells=cells)
        messages = _temper.write(*how, cells or "")
    for message in messages:
        warnings.warn(message, TemperWarning, stacklevel=2)
    return messages
