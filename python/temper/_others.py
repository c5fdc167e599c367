"""Conversion between ``meshio.Mesh`` and the compiled module. The functions for users are in ``_mesh``."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _temper
from ._errors import TemperError

_WEIGHTS = ("weight", "weights")
_REGIONS = ("region", "gmsh:physical", "medit:ref", "cell_tags")


def _points(values: Any) -> Any:
    """Two or three coordinates per point. The library decides whether three are in a plane or on a sphere."""
    points = np.asarray(values, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise TemperError("size_mismatch", "", f"points: expected shape (n, 2) or (n, 3), found {points.shape}")
    return np.ascontiguousarray(points)


_TYPES = {np.dtype(t) for t in ("f8", "f4", "i8", "i4", "u1", "i1", "i2", "u2", "u4", "u8")}


def data_of(name: str, values: Any, dropped: list[str]) -> Any:
    """The array in one of the types of files, or None."""
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
        if parts and (array := data_of(name, np.concatenate(parts), dropped)) is not None:
            result[name] = array
    return result


def _tags(data: dict[str, Any], size: int) -> tuple[Any, str | None]:
    for name in _REGIONS:
        values = data.get(name)
        if values is not None and values.ndim == 1 and values.dtype.kind in "iu":
            return values.astype(np.int32), name
    return np.zeros(0 if size < 0 else size, dtype=np.int32), None


def handle_of(mesh: Any, fixed_tags: tuple[str | int, ...] = ()) -> tuple[Any, list[str]]:
    """A handle of the ``meshio.Mesh``, and messages about omissions and changes."""
    dropped: list[str] = []
    for block in mesh.cells:
        if block.type not in ("triangle", "line", "vertex"):
            dropped.append(f"{len(block.data)} cells of type {block.type} are left out")
    points = _points(mesh.points)
    triangles, lines = _blocks(mesh, "triangle"), _blocks(mesh, "line")
    if not triangles:
        raise TemperError("empty_input", "", "expected cells of type triangle; found " +
                          (", ".join(sorted({b.type for b in mesh.cells})) or "none"))
    point_data = {}
    weights = np.empty(0)
    for name, values in mesh.point_data.items():
        if name in _WEIGHTS and weights.size == 0 and np.asarray(values).size == len(points):
            weights = np.ascontiguousarray(np.asarray(values, dtype=np.float64).reshape(-1))
        elif (array := data_of(name, values, dropped)) is not None:
            point_data[name] = array
    cell_data = _cell_data(mesh, triangles, dropped)
    corners, ends = _joined(mesh, triangles, 3), _joined(mesh, lines, 2)
    regions, source = _tags(cell_data, -1)
    line_data = _cell_data(mesh, lines, dropped)
    vertices = _blocks(mesh, "vertex")
    vertex_data = _cell_data(mesh, vertices, dropped)
    vertex_cells = _joined(mesh, vertices, 1).reshape(-1)
    vertex_tags, vertex_source = _tags(vertex_data, len(vertex_cells))
    line_tags, line_source = _tags(line_data, len(ends))
    if source == "region":
        del cell_data["region"]
    if line_source == "region":
        del line_data["region"]
    if vertex_source == "region":
        del vertex_data["region"]
    arrays = {
        "points": points, "weights": weights, "triangles": corners, "regions": regions, "lines": ends,
        "line_tags": line_tags, "point_data": point_data, "cell_data": cell_data, "line_data": line_data,
        "marked_points": vertex_cells, "point_tags": vertex_tags, "marked_point_data": vertex_data,
    }  # fmt: skip
    handle, messages = _temper.mesh_from_file_arrays(arrays, [str(tag) for tag in fixed_tags])
    return handle, dropped + list(messages)


def meshio_of(handle: Any) -> Any:
    """The mesh as a ``meshio.Mesh``: see ``Mesh.to_meshio``."""
    import meshio

    handle.require_no_period("to_meshio()")
    file = _temper.file_as_dict(handle)
    n, m = len(file["points"]), len(file["triangles"])
    cells = [("triangle", file["triangles"].astype(np.int64))]
    regions = file["regions"] if len(file["regions"]) else np.zeros(m, dtype=np.int32)
    blocks = [(m, file["cell_data"], regions)]
    if len(file["lines"]):
        cells.append(("line", file["lines"].astype(np.int64)))
        blocks.append((len(file["lines"]), file["line_data"], file["line_tags"]))
    if len(file["marked_points"]):
        cells.append(("vertex", file["marked_points"].astype(np.int64).reshape(-1, 1)))
        blocks.append((len(file["marked_points"]), file["marked_point_data"], file["point_tags"]))
    # meshio needs each array on every block: zeros if a block has none.
    cell_data: dict[str, list[Any]] = {"region": [tags for _, _, tags in blocks]}
    for name in dict.fromkeys(name for _, data, _ in blocks for name in data):
        like = next(data[name] for _, data, _ in blocks if name in data)
        cell_data[name] = [
            data[name] if name in data else np.zeros((size, *like.shape[1:]), dtype=like.dtype)
            for size, data, _ in blocks
        ]
    point_data = {"weight": file["weights"] if len(file["weights"]) else np.zeros(n), **file["point_data"]}
    return meshio.Mesh(file["points"], cells, point_data=point_data, cell_data=cell_data)
