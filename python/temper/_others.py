"""Meshes of meshio, PyVista, Gmsh, xarray and xugrid, and the compiled module. The functions for users are in ``_mesh``.

Classes are told apart by their attributes, so none of these libraries is imported. ``cells_of`` brings each to the form
of meshio: blocks of cells of one type, with data for each block.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _temper
from ._cells import Block, Cells
from ._errors import TemperError
from ._gmsh import cells_of_model, is_model
from ._ugrid import cells_of_ugrid, is_ugrid

_WEIGHTS = ("weight", "weights")
_WRITTEN = ("region", "gmsh:physical")  # cell data that to_meshio makes from the tags
_REGIONS = ("region", "gmsh:physical", "medit:ref", "cell_tags")
_QUALITIES = (  # that VTU has of the former mesh
    ("well_centered", "min_h_over_l", "min_d_over_l", "min_angle_deg"), ("well_centered", "min_h_over_l", "min_dihedral_deg"),
)  # fmt: skip
_QUADRILATERAL = "temper:quadrilateral"  # cell data: the number of the quadrilateral that a triangle is half of, or 0
_NAMES = "physical_names"  # field data of VTU: a line "dimension tag name" for each name


def cells_of(mesh: Any) -> Any:
    """A mesh of another library in the form of meshio, or None."""
    if hasattr(mesh, "celltypes") and hasattr(mesh, "cell_connectivity"):
        offset = mesh.cell_offsets if hasattr(mesh, "cell_offsets") else mesh.offset
        return _vtk_cells(mesh, np.asarray(mesh.celltypes), np.asarray(offset), np.asarray(mesh.cell_connectivity))
    if all(hasattr(mesh, name) for name in ("points", "verts", "lines", "faces", "cell_data")):
        return _poly_data(mesh)
    if is_model(mesh):
        return cells_of_model(mesh)
    if is_ugrid(mesh):
        return cells_of_ugrid(mesh)
    return mesh if all(hasattr(mesh, name) for name in ("points", "cells", "point_data")) else None


# --- PyVista ----------------------------------------------------------------------------------------------------------

_POLY_VERTEX, _POLY_LINE, _TRIANGLE, _STRIP, _POLYGON = 2, 4, 5, 6, 7  # types of VTK
_QUAD, _TETRA = 9, 10
_WIDTHS = {
    1: ("vertex", 1), _POLY_VERTEX: ("vertex", 1), 3: ("line", 2), _POLY_LINE: ("line", 2), _TRIANGLE: ("triangle", 3),
    _QUAD: ("quad", 4), _TETRA: ("tetra", 4),
}  # fmt: skip
_TYPES_OF_VTK = {_STRIP: "triangle strip", _POLYGON: "polygon", 8: "pixel"}


def _poly_data(mesh: Any) -> Cells:
    """PolyData has four lists of cells, in this order: k, and the k points of a cell."""
    types, offset, connectivity = [], [0], []
    for kind, name in ((_POLY_VERTEX, "verts"), (_POLY_LINE, "lines"), (_POLYGON, "faces"), (_STRIP, "strips")):
        flat, at = np.asarray(getattr(mesh, name, ())), 0
        while at < len(flat):
            k = int(flat[at])
            connectivity.append(flat[at + 1 : at + 1 + k])
            types.append(kind)
            offset.append(offset[-1] + k)
            at += 1 + k
    joined = np.concatenate(connectivity) if connectivity else np.empty(0, dtype=np.int64)
    return _vtk_cells(mesh, np.array(types, dtype=np.uint8), np.array(offset), joined)


def _vtk_cells(mesh: Any, types: Any, offset: Any, connectivity: Any) -> Cells:
    """Cells by type: their points are ``connectivity[offset[i]:offset[i + 1]]``. A line of many points becomes lines of
    two."""
    sizes = np.diff(offset)
    rows: dict[str, list[Any]] = {}  # cells of each block, once for each of their parts
    parts: dict[str, list[Any]] = {}
    polygons = types == _POLYGON
    types = np.where(polygons & (sizes == 3), _TRIANGLE, np.where(polygons & (sizes == 4), _QUAD, types))
    for kind in np.unique(types):
        if kind not in _WIDTHS:
            continue
        of_kind = np.flatnonzero(types == kind)
        name, width = _WIDTHS[int(kind)]
        n_parts = sizes[of_kind] - width + 1 if width < 3 else np.ones(len(of_kind), dtype=np.int64)
        cell = np.repeat(of_kind, n_parts)
        part = np.arange(len(cell)) - np.repeat(np.cumsum(n_parts) - n_parts, n_parts)
        rows.setdefault(name, []).append(cell)
        parts.setdefault(name, []).append(connectivity[(offset[cell] + part)[:, None] + np.arange(width)])
    order = {name: np.argsort(np.concatenate(cells), kind="stable") for name, cells in rows.items()}
    chosen = {name: np.concatenate(cells)[order[name]] for name, cells in rows.items()}
    blocks = [Block(name, np.concatenate(parts[name])[order[name]].astype(np.int64)) for name in rows]
    cell_data = {
        name: [np.asarray(values)[chosen[block.type]] for block in blocks] for name, values in mesh.cell_data.items()
    }
    taken = np.unique(np.concatenate([*chosen.values(), np.empty(0, dtype=np.int64)]))
    others = np.setdiff1d(np.arange(len(types)), taken)
    kinds = [_TYPES_OF_VTK.get(int(kind), f"VTK {kind}") for kind in types[others]]
    lost = [f"{kinds.count(kind)} cells of type {kind} are left out" for kind in sorted(set(kinds))]
    field_data = {name: values for name, values in mesh.field_data.items() if _is_number(values)}
    return Cells(mesh.points, blocks, dict(mesh.point_data.items()), cell_data, field_data, lost)


def _is_number(values: Any) -> bool:
    """Whether it can be in a file. Texts stay in the mesh of PyVista, unless that becomes a mesh of temper."""
    return np.asarray(values).dtype.kind in "biuf"


# --- all --------------------------------------------------------------------------------------------------------------


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
    made_again = next((names for names in _QUALITIES if all(name in mesh.cell_data for name in names)), ())
    for name, values in mesh.cell_data.items():
        if name in made_again:
            continue
        parts = [np.asarray(values[i]) for i in blocks]
        if parts and (array := data_of(name, np.concatenate(parts), dropped)) is not None:
            result[name] = array
    return result


def _cut(points: Any, quads: Any) -> Any:
    """Cuts each quadrilateral into two triangles, along the diagonal whose smaller triangle is larger. If both are
    alike, the diagonal is from the first to the third corner."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))

    def area(p: Any, q: Any, r: Any) -> Any:
        return np.cross(np.pad(q - p, ((0, 0), (0, 3 - p.shape[1]))), np.pad(r - p, ((0, 0), (0, 3 - p.shape[1]))))

    normal = area(a, b, c) + area(a, c, d)
    least = [
        np.minimum((area(*t) * normal).sum(axis=1), (area(*u) * normal).sum(axis=1))
        for t, u in (((a, b, c), (a, c, d)), ((a, b, d), (b, c, d)))
    ]
    other = least[1] > least[0] + 1e-6 * np.abs(least[0])
    first = np.where(other[:, None], quads[:, [0, 1, 3]], quads[:, [0, 1, 2]])
    second = np.where(other[:, None], quads[:, [1, 2, 3]], quads[:, [0, 2, 3]])
    return np.stack([first, second], axis=1).reshape(-1, 3)


def _joined_halves(triangles: Any, numbers: Any) -> tuple[Any, Any, Any]:
    """Joins pairs of triangles with the same number to quadrilaterals. Returns the triangles of no pair, the
    quadrilaterals, and the first triangle of each. A number counts only on two triangles with a common edge."""
    order = np.argsort(numbers, kind="stable")
    _, first, count = np.unique(numbers[order], return_index=True, return_counts=True)
    pairs = first[(count == 2) & (numbers[order[first]] > 0)]
    halves = np.column_stack([order[pairs], order[pairs + 1]])
    same = triangles[halves[:, 0]][:, :, None] == triangles[halves[:, 1]][:, None, :]
    halves = halves[same.sum(axis=(1, 2)) == 2]
    t, u = triangles[halves[:, 0]], triangles[halves[:, 1]]
    same = t[:, :, None] == u[:, None, :]
    k, row = np.argmin(same.any(axis=2), axis=1), np.arange(len(t))
    fourth = u[row, np.argmin(same.any(axis=1), axis=1)]
    quads = np.column_stack([t[row, (k + 2) % 3], t[row, k], t[row, (k + 1) % 3], fourth])
    return np.setdiff1d(np.arange(len(triangles)), halves), quads, halves[:, 0]


def tags_of_32_bits(name: str, values: Any) -> Any:
    """Whole numbers as int32. TemperError if one does not fit."""
    limits = np.iinfo(np.int32)
    if len(values) and not limits.min <= values.min() <= values.max() <= limits.max:
        at = int(np.flatnonzero((values > limits.max) | (values < limits.min))[0])
        found = f"{name}: row {at} has {values[at]}; expected {limits.min} to {limits.max}. Next: give it a smaller number"
        raise TemperError("index_out_of_range", "", found)
    return values.astype(np.int32)


def _tags(data: dict[str, Any], size: int) -> Any:
    for name in _REGIONS:
        values = data.get(name)
        if values is not None and values.ndim == 1 and values.dtype.kind in "iu":
            return tags_of_32_bits(name, values)
    return np.zeros(size, dtype=np.int32)


def _names(mesh: Any, dropped: list[str]) -> tuple[list[tuple[int, int, str]], dict[str, Any]]:
    """Names as (dimension, tag, name), and the other field data. meshio has a name as field data [tag, dimension]."""
    names, field_data = [], {}
    for name, value in mesh.field_data.items():
        array = data_of(name, value, dropped)
        if array is None:
            continue
        if name == _NAMES and array.dtype == np.uint8:
            for line in array.tobytes().decode().splitlines():
                dimension, tag, text = line.split(" ", 2)
                names.append((int(dimension), int(tag), text))
        elif array.shape == (2,) and array.dtype.kind in "iu" and 0 <= array[1] <= 3:
            names.append((int(array[1]), int(array[0]), name))
        else:
            field_data[name] = array
    return names, field_data


def handle_of(mesh: Any, fixed_tags: tuple[str | int, ...] = (), *, curved: bool = True) -> tuple[Any, list[str]]:
    """A handle of a mesh in the form of meshio, and messages about omissions and changes. ``curved``: a curved surface is
    no error."""
    dropped: list[str] = list(getattr(mesh, "left_out", ()))
    for block in mesh.cells:
        if block.type not in ("triangle", "quad", "line", "vertex") and len(block.data):
            dropped.append(f"{len(block.data)} cells of type {block.type} are left out")
    points = _points(mesh.points)
    triangles, quads = _blocks(mesh, "triangle"), _blocks(mesh, "quad")
    if not triangles and not quads:
        cure = ". Next: temper.TetMesh.from_meshio takes tetrahedra" if _blocks(mesh, "tetra") else ""
        raise TemperError("empty_input", "", f"expected cells of type triangle or quad; {_found(mesh)}{cure}")
    weights, point_data = _point_data(mesh, len(points), dropped)
    cell_data = _cell_data(mesh, triangles + quads, dropped)
    corners = _joined(mesh, triangles, 3)
    if quads:
        of_quads = _joined(mesh, quads, 4)
        n, n_quads = len(corners), len(of_quads)
        if of_quads.size and (of_quads.min() < 0 or of_quads.max() >= len(points)):
            wrong = of_quads[(of_quads < 0) | (of_quads >= len(points))][0]
            message = f"a quadrilateral uses point {wrong}, but there are {len(points)} points, numbered from 0"
            raise TemperError("index_out_of_range", "", message)
        corners = np.concatenate([corners, _cut(points, of_quads)])
        row = np.concatenate([np.arange(n), n + np.repeat(np.arange(n_quads), 2)])
        cell_data = {name: np.ascontiguousarray(values[row]) for name, values in cell_data.items()}
        cell_data[_QUADRILATERAL] = np.maximum(row - n + 1, 0).astype(np.int32)
    regions = _tags(cell_data, 0)
    _drop_written(cell_data, regions)
    arrays = {
        "points": points, "weights": weights, "triangles": corners, "regions": regions, "point_data": point_data,
        "cell_data": cell_data, **_lines_and_points(mesh, dropped),
    }  # fmt: skip
    handle, messages = _temper.mesh_from_file_arrays(arrays, [str(tag) for tag in fixed_tags], curved)
    if len(held := getattr(mesh, "held", ())):
        vertices = _temper.vertices_of_points(handle)
        held = held if vertices is None else vertices[held]
        handle.set_fixed(np.union1d(handle.fixed(), held[held >= 0]).astype(np.int64))
    return handle, dropped + list(messages)


def tet_arrays(mesh: Any) -> tuple[dict[str, Any], list[str]]:
    """The arrays of a mesh of tetrahedra in the form of meshio, and messages about omissions."""
    dropped: list[str] = list(getattr(mesh, "left_out", ()))
    for block in mesh.cells:
        if block.type not in ("tetra", "triangle", "line", "vertex"):
            dropped.append(f"{len(block.data)} cells of type {block.type} are left out")
    points = _points(mesh.points)
    if points.shape[1] != 3:
        raise TemperError("size_mismatch", "", f"points: expected shape (n, 3), found {points.shape}")
    if not _blocks(mesh, "tetra"):
        raise TemperError("empty_input", "", f"expected cells of type tetra; {_found(mesh)}")
    weights, point_data = _point_data(mesh, len(points), dropped)
    tetrahedra, regions, cell_data = _tagged(mesh, "tetra", 4, dropped)
    faces, face_tags, face_data = _tagged(mesh, "triangle", 3, dropped)
    arrays = {
        "points": points, "weights": weights, "tetrahedra": tetrahedra, "regions": regions, "faces": faces,
        "face_tags": face_tags, "point_data": point_data, "cell_data": cell_data, "face_data": face_data,
        **_lines_and_points(mesh, dropped),
    }  # fmt: skip
    return arrays, dropped


def _found(mesh: Any) -> str:
    found = [f"{len(block.data)} cells of type {block.type}" for block in mesh.cells]
    return "; ".join(found + list(getattr(mesh, "left_out", ()))) or "there are none"


def _point_data(mesh: Any, n_points: int, dropped: list[str]) -> tuple[Any, dict[str, Any]]:
    """The weights, and the other data of points."""
    weights, point_data = np.empty(0), {}
    for name, values in mesh.point_data.items():
        if name in _WEIGHTS and weights.size == 0 and np.asarray(values).size == n_points:
            weights = np.ascontiguousarray(np.asarray(values, dtype=np.float64).reshape(-1))
        elif (array := data_of(name, values, dropped)) is not None:
            point_data[name] = array
    return weights, point_data


def _drop_written(data: dict[str, Any], tags: Any) -> None:
    """Drops the data that are the tags."""
    for name in _WRITTEN:
        if name in data and np.array_equal(data[name], tags):
            del data[name]


def _tagged(mesh: Any, kind: str, columns: int, dropped: list[str]) -> tuple[Any, Any, dict[str, Any]]:
    """Cells of one type, their tags and their other data."""
    blocks = _blocks(mesh, kind)
    cells, data = _joined(mesh, blocks, columns), _cell_data(mesh, blocks, dropped)
    tags = _tags(data, len(cells))
    _drop_written(data, tags)
    return cells, tags, data


def _lines_and_points(mesh: Any, dropped: list[str]) -> dict[str, Any]:
    """Lines, marked points, names and field data."""
    lines, line_tags, line_data = _tagged(mesh, "line", 2, dropped)
    vertices, vertex_tags, vertex_data = _tagged(mesh, "vertex", 1, dropped)
    names, field_data = _names(mesh, dropped)
    return {
        "lines": lines, "line_tags": line_tags, "line_data": line_data, "marked_points": vertices.reshape(-1),
        "point_tags": vertex_tags, "marked_point_data": vertex_data, "names": names, "field_data": field_data,
    }  # fmt: skip


def meshio_form(handle: Any) -> Cells:
    """The mesh in the form of meshio, with tags and names as in VTU."""
    file = _temper.file_as_dict(handle, True)
    triangles, of_triangles = file["triangles"].astype(np.int64), dict(file["cell_data"])
    regions = file["regions"] if len(file["regions"]) else np.zeros(len(triangles), dtype=np.int32)
    blocks, tags, data = [Block("triangle", triangles)], [regions], [of_triangles]
    if (numbers := of_triangles.pop(_QUADRILATERAL, None)) is not None:
        whole, quads, halves = _joined_halves(triangles, numbers)
        parts = [("triangle", triangles[whole], whole), ("quad", quads, halves)]
        parts = [part for part in parts if len(part[1])]
        blocks, tags = [Block(kind, cells) for kind, cells, _ in parts], [regions[rows] for _, _, rows in parts]
        data = [{name: values[rows] for name, values in of_triangles.items()} for _, _, rows in parts]
    return _with_tags(file, file["points"], blocks, tags, data)


_TAGGED = (
    ("triangle", 3, "faces", "face_tags", "face_data"), ("line", 2, "lines", "line_tags", "line_data"),
    ("vertex", 1, "marked_points", "point_tags", "marked_point_data"),
)  # fmt: skip


def _with_tags(file: dict[str, Any], points: Any, blocks: list[Block], tags: list[Any], data: list[dict[str, Any]]) -> Cells:
    """The cells with their tags and data, and blocks of everything in the file that carries a tag."""
    for kind, columns, cells, its_tags, its_data in _TAGGED:
        if len(file.get(cells, ())):
            blocks.append(Block(kind, file[cells].astype(np.int64).reshape(-1, columns)))
            tags.append(file[its_tags])
            data.append(file[its_data])
    # Each array is on every block: zeros if a block has none.
    cell_data: dict[str, list[Any]] = {"region": tags}
    for name in dict.fromkeys(name for arrays in data for name in arrays):
        like = next(arrays[name] for arrays in data if name in arrays)
        cell_data[name] = [
            arrays[name] if name in arrays else np.zeros((len(block.data), *like.shape[1:]), dtype=like.dtype)
            for block, arrays in zip(blocks, data)
        ]
    weights = file["weights"] if len(file["weights"]) else np.zeros(len(points))
    field_data = dict(file["field_data"])
    if lines := "".join(f"{dimension} {tag} {name}\n" for dimension, tag, name in file["names"]):
        field_data[_NAMES] = np.frombuffer(lines.encode(), dtype=np.uint8)
    return Cells(points, blocks, {"weight": weights, **file["point_data"]}, cell_data, field_data)


def meshio_form_of_tets(points: Any, weights: Any, tetrahedra: Any, regions: Any, file: dict[str, Any]) -> Cells:
    """The mesh in the form of meshio, with tags and names as in VTU."""
    blocks = [Block("tetra", tetrahedra.astype(np.int64))]
    return _with_tags({**file, "weights": weights}, points, blocks, [regions], [file["cell_data"]])


def meshio_of(form: Cells) -> Any:
    """The mesh as a ``meshio.Mesh``: see ``Mesh.to_meshio`` and ``TetMesh.to_meshio``."""
    import meshio

    names, field_data = _names(form, [])
    field_data.update((name, np.array([tag, dimension])) for dimension, tag, name in sorted(names))
    cell_data = form.cell_data
    if any(map(np.any, cell_data["region"])):
        cell_data = {"region": cell_data["region"], "gmsh:physical": list(cell_data["region"]), **cell_data}
    cells = [(block.type, block.data) for block in form.cells]
    return meshio.Mesh(form.points, cells, point_data=form.point_data, cell_data=cell_data, field_data=field_data)


def put_back_vtk(mesh: Any, cells: Cells) -> None:
    """Replaces a ``PolyData`` or ``UnstructuredGrid`` by the mesh, with its data."""
    blocks = {block.type: np.asarray(block.data) for block in cells.cells}
    order = [kind for kind in ("vertex", "line", "triangle", "quad", "tetra") if kind in blocks]
    if hasattr(mesh, "celltypes"):
        types = {"vertex": 1, "line": 3, "triangle": _TRIANGLE, "quad": _QUAD, "tetra": _TETRA}
        new = type(mesh)({types[kind]: blocks[kind] for kind in order}, cells.points)
    else:
        flat: dict[str, Any] = {}
        for kind in order:
            cell = np.column_stack([np.full(len(blocks[kind]), blocks[kind].shape[1]), blocks[kind]]).ravel()
            name = {"vertex": "verts", "line": "lines"}.get(kind, "faces")
            flat[name] = np.concatenate([flat[name], cell]) if name in flat else cell
        new = type(mesh)(cells.points, **flat)
    of_kind = [block.type for block in cells.cells]
    for name, values in cells.point_data.items():
        new.point_data[name] = values
    for name, parts in cells.cell_data.items():
        new.cell_data[name] = np.concatenate([parts[of_kind.index(kind)] for kind in order])
    texts = {name: values for name, values in mesh.field_data.items() if not _is_number(values)}
    for name, values in {**cells.field_data, **texts}.items():
        new.field_data[name] = values
    mesh.copy_from(new)
