"""Datasets of xarray and xugrid with a mesh by the UGRID conventions, in the form of meshio, and back.

xugrid's objects become plain datasets by their own ``to_dataset``. Data with further dimensions, such as time, become
columns: one for each of their values.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ._cells import Block, Cells
from ._errors import TemperError


def is_ugrid(mesh: Any) -> bool:
    return any(hasattr(mesh, name) for name in ("face_node_connectivity", "ugrid", "data_vars"))


def dataset_of(mesh: Any) -> Any:
    """The object as an ``xarray.Dataset``."""
    if hasattr(mesh, "data_vars") and not hasattr(mesh, "ugrid"):
        return mesh
    return (mesh.ugrid if hasattr(mesh, "ugrid") else mesh).to_dataset()


@dataclasses.dataclass
class _Topology:
    """Names in the dataset."""

    name: str
    x: str
    y: str
    faces: str
    node: str
    face: str
    edge: str
    own: set[str]
    """Variables that the mesh itself makes."""


def _topology(dataset: Any) -> _Topology:
    variables = dataset.variables
    found = [
        str(name) for name, variable in variables.items()
        if variable.attrs.get("cf_role") == "mesh_topology" and int(variable.attrs.get("topology_dimension", 2)) == 2
    ]  # fmt: skip
    if len(found) != 1:
        which = f"{len(found)}: {', '.join(found)}. Next: keep one, with drop_vars" if found else "none"
        raise TemperError("empty_input", "", f"expected one variable with cf_role mesh_topology and topology_dimension 2 (UGRID), found {which}")
    attributes = variables[found[0]].attrs
    faces = attributes.get("face_node_connectivity", "")
    if faces not in variables:
        cure = "Next: write the dataset, and read the file with temper.read, which takes edges"
        raise TemperError("empty_input", "", f"{found[0]}: no face_node_connectivity. {cure}")
    coordinates = str(attributes.get("node_coordinates", "")).split()
    if len(coordinates) < 2 or any(name not in variables for name in coordinates):
        named = f"names '{' '.join(coordinates)}'" if coordinates else "is missing"
        raise TemperError("empty_input", "", f"{found[0]}: node_coordinates {named}; expected two variables of the dataset")
    x, y = coordinates[:2]
    kinds = [_words(variables[name]) for name in (x, y)]
    if any("degree" in kind or "longitude" in kind or "latitude" in kind for kind in kinds):
        cure = "Next: move it to a plane with xugrid's to_crs, or read its file with temper.read(path, projection=…)"
        raise TemperError("geographic", "", f"the grid is in longitude and latitude. {cure}")
    if "projection_y" in kinds[0]:
        x, y = y, x
    node = variables[x].dims[0]
    dims = variables[faces].dims
    face = attributes.get("face_dimension", dims[1] if node == dims[0] else dims[0])
    edges = variables.get(attributes.get("edge_node_connectivity", ""))
    edge = attributes.get("edge_dimension", "" if edges is None else edges.dims[0])
    own = {word for value in attributes.values() for word in str(value).split()} | {found[0]}
    return _Topology(found[0], x, y, faces, node, face, edge, own)


def _words(variable: Any) -> str:
    return " ".join(str(variable.attrs.get(name, "")) for name in ("standard_name", "units"))


def _corners(variable: Any, face: str) -> Any:
    """Nodes of each face, from 0, with −1 for none."""
    values = np.asarray(variable.values)
    if variable.dims[0] != face:
        values = values.T
    none = ~np.isfinite(values) if values.dtype.kind == "f" else np.zeros(values.shape, dtype=bool)
    fill = variable.attrs.get("_FillValue", variable.encoding.get("_FillValue"))
    if fill is not None and values.dtype.kind in "iu":
        none |= values == fill
    start = int(variable.attrs.get("start_index", 0))
    return np.where(none, -1, np.where(none, 0, values).astype(np.int64) - start)


def cells_of_ugrid(mesh: Any) -> Cells:
    """The mesh, with the variables on its nodes and faces."""
    dataset = dataset_of(mesh)
    names = _topology(dataset)
    variables = dataset.variables
    corners = _corners(variables[names.faces], names.face)
    sizes = (corners >= 0).sum(axis=1)
    if others := int((sizes > 4).sum() + (sizes < 3).sum()):
        cure = "Next: cut them into triangles, for example with xugrid's ugrid.triangulate()"
        raise TemperError("unsupported", "", f"{others} of {len(corners)} faces are neither triangles nor quadrilaterals. {cure}")
    chosen = [rows for n in (3, 4) if len(rows := np.flatnonzero(sizes == n))]
    result = Cells(
        np.column_stack([variables[names.x].values, variables[names.y].values]),
        [Block("triangle" if sizes[rows[0]] == 3 else "quad", corners[rows, : sizes[rows[0]]]) for rows in chosen],
    )
    for key, variable in variables.items():
        name, dims = str(key), variable.dims
        if name in names.own or name in dims:
            continue
        if names.node in dims:
            is_weight = name == f"{names.name}_node_weight"
            result.point_data["weight" if is_weight else name] = _columns(variable, names.node)
        elif names.face in dims:
            columns = _columns(variable, names.face)
            result.cell_data[name] = [columns[rows] for rows in chosen]
        elif names.edge in dims:
            result.left_out.append(f"variable '{name}' with dimensions {', '.join(dims)} is left out")
    return result


def _columns(variable: Any, dimension: str) -> Any:
    values = np.moveaxis(np.asarray(variable.values), variable.dims.index(dimension), 0)
    return values if values.ndim == 1 else values.reshape(len(values), -1)


# --- into a dataset ---------------------------------------------------------------------------------------------------


def dataset_from(form: Cells, orthocenters: Any, like: Any) -> Any:
    """The mesh as an ``xarray.Dataset``: see ``Mesh.to_xarray``. ``orthocenters``: one of each face if all faces are
    triangles, or None."""
    import xarray

    if like is None:
        attributes = {"cf_role": "mesh_topology", "topology_dimension": 2, "node_coordinates": "mesh2d_node_x mesh2d_node_y"}
        names = _Topology("mesh2d", "mesh2d_node_x", "mesh2d_node_y", "mesh2d_face_nodes", "mesh2d_nNodes", "mesh2d_nFaces", "mesh2d_nEdges", set())
        old, result = xarray.Dataset(), xarray.Dataset(attrs={"Conventions": "CF-1.8 UGRID-1.0"})
    else:
        old = dataset_of(like)
        names = _topology(old)
        gone = [d for d in (names.node, names.face, names.edge) if d in old.dims]
        result = old.drop_dims(gone)
        attributes = {
            key: value for key, value in old[names.name].attrs.items()
            if not key.endswith(("_connectivity", "_coordinates", "_dimension")) or key in ("node_coordinates", "topology_dimension")
        }  # fmt: skip
    edge = names.edge or f"{names.name}_nEdges"

    def put(name: str, dims: tuple[str, ...], values: Any, **attrs: Any) -> None:
        was = old.variables.get(name)
        kept = {} if was is None else {key: value for key, value in was.attrs.items() if key not in ("_FillValue", "start_index")}
        result[name] = xarray.Variable(dims, values, {**kept, **attrs})

    corner = next((d for d in old[names.faces].dims if d != names.face), "") if names.faces in old.variables else ""
    faces = _faces(form)
    edges = _edges(faces)
    fill = {"_FillValue": np.int32(-1)} if (faces < 0).any() else {}
    for column, (axis, name) in enumerate((("x", names.x), ("y", names.y))):
        put(name, (names.node,), form.points[:, column], **({} if name in old.variables else _usual(axis)))
    put(names.faces, (names.face, corner or f"{names.name}_nMax_face_nodes"), faces, cf_role="face_node_connectivity", start_index=0, **fill)
    edge_nodes = f"{names.name}_edge_nodes"
    put(edge_nodes, (edge, f"{names.name}_two"), edges, cf_role="edge_node_connectivity", start_index=0)
    attributes |= {"face_node_connectivity": names.faces, "edge_node_connectivity": edge_nodes}
    attributes |= {"node_dimension": names.node, "face_dimension": names.face, "edge_dimension": edge}
    if orthocenters is not None:
        attributes["face_coordinates"] = f"{names.name}_face_x {names.name}_face_y"
        for axis, values in zip("xy", orthocenters.T):
            name = f"{names.name}_face_{axis}"
            put(name, (names.face,), values, **({} if name in old.variables else _usual(axis)))
    result[names.name] = xarray.Variable((), np.int32(0), attributes)
    for dimension, size in ((names.node, len(form.points)), (names.face, len(faces)), (edge, len(edges))):
        if dimension in old.variables:
            put(dimension, (dimension,), np.arange(size))
    weight = f"{names.name}_node_weight"
    point_data = {weight if name == "weight" else name: values for name, values in form.point_data.items()}
    if weight not in old.variables and not np.any(point_data[weight]):
        del point_data[weight]
    of_faces = [i for i, block in enumerate(form.cells) if block.type in ("triangle", "quad")]
    cell_data = {name: np.concatenate([parts[i] for i in of_faces]) for name, parts in form.cell_data.items()}
    if "region" not in old.variables and not np.any(cell_data["region"]):
        del cell_data["region"]
    for data, dimension in ((point_data, names.node), (cell_data, names.face)):
        for name, values in data.items():
            put(name, *_uncolumned(values, dimension, name, old))
    coordinates = [name for name in result.variables if name in old.coords]
    return result.set_coords(coordinates)


def _usual(axis: str) -> dict[str, str]:
    """Attributes of coordinates in a plane."""
    return {"standard_name": f"projection_{axis}_coordinate", "units": "m"}


def _faces(form: Cells) -> Any:
    """Corners of triangles and quadrilaterals, with −1 for none."""
    blocks = [block.data for block in form.cells if block.type in ("triangle", "quad")]
    width = max(data.shape[1] for data in blocks)
    rows = [np.pad(data, ((0, 0), (0, width - data.shape[1])), constant_values=-1) for data in blocks]
    return np.concatenate(rows).astype(np.int32)


def _edges(faces: Any) -> Any:
    """Each edge once, as its two nodes."""
    following = np.roll(faces, -1, axis=1)
    following = np.where((faces >= 0) & (following < 0), faces[:, :1], following)
    ends = np.stack([faces, following], axis=2)[faces >= 0]
    return np.unique(np.sort(ends, axis=1), axis=0)


def _uncolumned(values: Any, dimension: str, name: str, old: Any) -> tuple[tuple[str, ...], Any]:
    """Dimensions and values as the variable had them."""
    was = old.variables.get(name)
    if was is None or dimension not in was.dims:
        return ((dimension,) if values.ndim == 1 else (dimension, f"{name}_columns")), values
    others = [d for d in was.dims if d != dimension]
    values = values.reshape(len(values), *(was.sizes[d] for d in others))
    values = np.moveaxis(values, 0, was.dims.index(dimension))
    return was.dims, values.astype(was.dtype) if was.dtype.kind in "biu" else values
