"""meshio's meshes, in and out."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from . import _temper
from ._errors import TemperError, TemperWarning
from ._mesh import Mesh, MeshLike, as_mesh

_WEIGHTS = ("weight", "weights")
_REGIONS = ("region", "gmsh:physical", "medit:ref", "cell_tags")


def _warn(mesh: Mesh, messages: list[str], level: int = 3) -> Mesh:
    mesh.warnings = messages
    for message in messages:
        warnings.warn(message, TemperWarning, stacklevel=level + 1)
    return mesh


def _columns(points: Any) -> tuple[Any, float]:
    """Points in the plane, and the z that all of them have."""
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise TemperError("size_mismatch", "", f"points: expected shape (n, 2) or (n, 3), found {points.shape}")
    if points.shape[1] == 2 or len(points) == 0:
        return np.ascontiguousarray(points[:, :2]), 0.0
    z = points[:, 2]
    off = np.flatnonzero(~(z == z[0]))
    if off.size:
        where = int(off[0])
        found = f"point {where} has z = {z[where]}, but point 0 has z = {z[0]}; expected one z"
        raise TemperError("not_planar", "", found)
    return np.ascontiguousarray(points[:, :2]), float(z[0])


_TYPES = {np.dtype(t) for t in ("f8", "f4", "i8", "i4", "u1", "i1", "i2", "u2", "u4", "u8")}


def _data(name: str, values: Any, dropped: list[str]) -> Any:
    """The array as one of the types that files have, or None."""
    array = np.asarray(values)
    if array.dtype == bool:
        array = array.astype(np.uint8)
    array = array.astype(array.dtype.newbyteorder("="), copy=False)
    if array.ndim > 2:
        array = array.reshape(len(array), -1)
    if array.dtype not in _TYPES or array.ndim == 0:
        dropped.append(f"data '{name}' of type {array.dtype} is dropped")
        return None
    return np.ascontiguousarray(array)


def _blocks(mesh: Any, kind: str) -> list[int]:
    return [i for i, block in enumerate(mesh.cells) if block.type == kind]


def _joined(mesh: Any, blocks: list[int], columns: int) -> Any:
    parts = [np.asarray(mesh.cells[i].data, dtype=np.int64).reshape(-1, columns) for i in blocks]
    return np.concatenate(parts) if parts else np.empty((0, columns), dtype=np.int64)


def _cell_data(mesh: Any, blocks: list[int], dropped: list[str]) -> dict[str, Any]:
    result = {}
    for name, values in mesh.cell_data.items():
        parts = [np.asarray(values[i]) for i in blocks]
        if parts and (array := _data(name, np.concatenate(parts), dropped)) is not None:
            result[name] = array
    return result


def _tags(data: dict[str, Any], size: int) -> tuple[Any, str | None]:
    for name in _REGIONS:
        values = data.get(name)
        if values is not None and values.ndim == 1 and values.dtype.kind in "iu":
            return values.astype(np.int32), name
    return np.zeros(0 if size < 0 else size, dtype=np.int32), None


def from_meshio(mesh: Any, *, fixed_tags: tuple[str | int, ...] = ()) -> Mesh:
    """A ``meshio.Mesh`` as a ``temper.Mesh``.

    Parameters
    ----------
    mesh : meshio.Mesh
        Its triangles become the mesh; lines inside the domain become constrained edges; other cells are left out, with
        a warning. Points may have a third coordinate when it is the same for all. Point data ``weight`` are the
        weights [length²]; integer cell data ``region``, ``gmsh:physical``, ``medit:ref`` or ``cell_tags`` (the first
        that is there) are the regions. All point and cell data are kept: ``to_meshio`` and ``write`` give them back.
    fixed_tags : sequence of str or int
        Lines with these tags: their points must not move.

    Raises
    ------
    TemperError
        As ``Mesh`` does; also without triangles, and for points of different z.

    Warns
    -----
    TemperWarning
        Points of no triangle that are dropped; clockwise triangles that are reversed; data and cells left out.
    """
    dropped: list[str] = []
    for block in mesh.cells:
        if block.type not in ("triangle", "line", "vertex"):
            dropped.append(f"{len(block.data)} cells of type {block.type} are left out")
    points, z = _columns(mesh.points)
    triangles, lines = _blocks(mesh, "triangle"), _blocks(mesh, "line")
    if not triangles:
        raise TemperError("empty_input", "", "expected cells of type triangle; found " +
                          (", ".join(sorted({b.type for b in mesh.cells})) or "none"))
    point_data = {}
    weights = np.empty(0)
    for name, values in mesh.point_data.items():
        if name in _WEIGHTS and weights.size == 0 and np.asarray(values).size == len(points):
            weights = np.ascontiguousarray(np.asarray(values, dtype=np.float64).reshape(-1))
        elif (array := _data(name, values, dropped)) is not None:
            point_data[name] = array
    cell_data = _cell_data(mesh, triangles, dropped)
    corners, ends = _joined(mesh, triangles, 3), _joined(mesh, lines, 2)
    regions, source = _tags(cell_data, -1)
    line_data = _cell_data(mesh, lines, dropped)
    line_tags, line_source = _tags(line_data, len(ends))
    if source == "region":
        del cell_data["region"]
    if line_source == "region":
        del line_data["region"]
    arrays = {
        "points": points, "z": z, "weights": weights, "triangles": corners, "regions": regions, "lines": ends,
        "line_tags": line_tags, "point_data": point_data, "cell_data": cell_data, "line_data": line_data,
    }  # fmt: skip
    handle, messages = _temper.mesh_from_file_arrays(arrays, [str(tag) for tag in fixed_tags])
    result = Mesh._of(handle)
    return _warn(result, dropped + list(messages))


def to_meshio(mesh: MeshLike) -> Any:
    """The mesh as a ``meshio.Mesh``, which meshio writes to any of its formats.

    Points are (n, 3) float64 (z as it was, or 0), with point data ``weight`` (float64, [length²]), triangles with cell
    data ``region``, and what else came with the mesh; lines of the file, and constrained edges, are cells of type
    ``line``, whose ``region`` is their tag. Needs meshio.
    """
    import meshio

    file = _temper.file_as_dict(as_mesh(mesh)._handle)
    n, m, k = len(file["points"]), len(file["triangles"]), len(file["lines"])
    points = np.column_stack([file["points"], np.full(n, file["z"])])
    cells = [("triangle", file["triangles"].astype(np.int64))]
    regions = file["regions"] if len(file["regions"]) else np.zeros(m, dtype=np.int32)
    cell_data: dict[str, list[Any]] = {"region": [regions]}
    for name, values in file["cell_data"].items():
        cell_data[name] = [values]
    if k:
        cells.append(("line", file["lines"].astype(np.int64)))
        cell_data["region"].append(file["line_tags"])
        for name, values in file["cell_data"].items():
            line = file["line_data"].get(name)
            shape = (k, *values.shape[1:])
            cell_data[name].append(line if line is not None else np.zeros(shape, dtype=values.dtype))
        for name, values in file["line_data"].items():
            if name not in cell_data:
                cell_data[name] = [np.zeros((m, *values.shape[1:]), dtype=values.dtype), values]
    point_data = {"weight": file["weights"] if len(file["weights"]) else np.zeros(n), **file["point_data"]}
    return meshio.Mesh(points, cells, point_data=point_data, cell_data=cell_data)


def put_back(mesh: Any, changed: Mesh) -> None:
    """Writes a mesh that was changed in place into the ``meshio.Mesh`` that it was made of."""
    new = to_meshio(changed)
    mesh.points, mesh.cells = new.points, new.cells
    mesh.point_data, mesh.cell_data = new.point_data, new.cell_data
    mesh.cell_sets = {}
    mesh.point_sets = {}
