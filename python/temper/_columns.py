"""Columns of cells under layers, for codes of groundwater and reservoirs: MODFLOW 6, TOUGH."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, as_mesh
from ._records import Record


@dataclasses.dataclass(frozen=True, eq=False)
class Columns(Record):
    """Power cells under layers. Arrays of cells are (layers, vertices); the number of a cell is
    ``layer * n_vertices + vertex``. All are read-only views on one value, without copies."""

    n_vertices: int
    n_layers: int
    states: npt.NDArray[np.int8]
    """With the numbers of MODFLOW's IDOMAIN: 1 active, 0 inactive, −1 pinched out."""
    tops: npt.NDArray[np.float64]
    """Numbers, also where a surface is not there [length]."""
    bottoms: npt.NDArray[np.float64]
    volumes: npt.NDArray[np.float64]
    """Of active cells; 0 of others [length³]."""
    areas: npt.NDArray[np.float64]
    """Of the power cells, (n_vertices,) [length²]."""
    cells: npt.NDArray[np.uint32]
    """(c, 2): the cells of each connection, the lower number first; ascending."""
    is_vertical: npt.NDArray[np.bool_]
    """(c,)"""
    distances: npt.NDArray[np.float64]
    """(c, 2): from the centers of the two cells to the face, > 0 [length]."""
    widths: npt.NDArray[np.float64]
    """(c,) of the face seen from above; 0 of vertical ones [length]."""
    face_areas: npt.NDArray[np.float64]
    """(c,) [length²]. Of cells beside each other the thickness is linear between their centers."""
    _handle: Any = dataclasses.field(repr=False, compare=False)
    _arguments: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return columns, self._arguments

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        formats: Sequence[Literal["npz", "mtx", "vtu", "disv", "disu", "tough"]] = ("disv", "disu", "tough", "vtu"),
        threads: int | None = None,
    ) -> list[str]:
        """Writes ``mesh.disv`` and ``mesh.disu`` (MODFLOW 6), ``MESH`` (TOUGH), and for ParaView ``columns.vtu`` with
        the dual, into a folder (docs/layers.md), all or none of the files. Returns their paths."""
        return self._handle.write(os.fspath(folder), list(formats), threads)


def columns(
    mesh: MeshLike, surfaces: npt.ArrayLike, active: npt.ArrayLike | None = None, pinch_out: float = 0.0
) -> Columns:
    """The columns of a mesh: its power cells between the surfaces of layers, and which are neighbours.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        In the plane, and regular.
    surfaces : array_like
        (n_vertices, layers + 1): the top and then the bottom of each layer, going down [length]; or (layers + 1,), the
        same at all vertices. NaN: a surface that is not there; the layers above and below it are inactive.
    active : array_like, optional
        (n_vertices, layers) or (layers,) of bool: where layers are active. By default everywhere.
    pinch_out : float
        A layer is pinched out where it is not thicker: it has no cell, and what is above and what is below it are
        neighbours [length].

    Raises
    ------
    TemperError
        Surfaces that are not one above the other; edges that are not regular, or a face that is not between its two
        vertices; a mesh of the sphere; no active cell.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.regular_polygon()
    >>> report = temper.optimize(mesh)
    >>> columns = temper.columns(mesh, [10, 8, 8, 0])
    >>> columns.states[:, 0]
    array([ 1, -1,  1], dtype=int8)
    >>> bool(abs(columns.volumes.sum() - 10 * columns.areas.sum()) < 1e-9)
    True
    """
    given = as_mesh(mesh)
    heights = np.asarray(surfaces, dtype=np.float64)
    if heights.ndim not in (1, 2) or heights.shape[-1] < 2:
        raise ValueError(f"surfaces: expected (n_vertices, layers + 1) or (layers + 1,) numbers, found {heights.shape}")
    n, n_layers = given.n_vertices, heights.shape[-1] - 1
    heights = _for_all(heights, (n, n_layers + 1), "surfaces")
    flags = np.zeros((0, n_layers), dtype=np.int32)
    if active is not None:
        flags = _for_all(np.asarray(active, dtype=bool).astype(np.int32), (n, n_layers), "active")
    handle = _temper.columns(given._handle, n_layers, heights, flags, float(pinch_out))
    arguments = (given.copy(), heights, None if active is None else flags, float(pinch_out))
    return Columns(**handle.arrays(), _handle=handle, _arguments=arguments)


def _for_all(values: npt.NDArray[Any], shape: tuple[int, int], name: str) -> npt.NDArray[Any]:
    """The values of each vertex, of an array that may be of one for all."""
    if values.shape not in (shape, shape[1:]):
        raise ValueError(f"{name}: expected {shape} or {shape[1:]} numbers, found {values.shape}")
    return np.ascontiguousarray(np.broadcast_to(values, shape))
