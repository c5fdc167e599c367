"""The current model of Gmsh: its mesh in the form of meshio, and back.

Elements stay on their entities of the geometry, so physical groups, embedded lines and sizes of the model stay valid.
Views with data of the model follow the mesh. Gmsh is never imported: the model brings it.
"""

from __future__ import annotations

import dataclasses
import sys
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np

from ._cells import Block, Cells
from ._errors import TemperError, TemperWarning

_ENTITY = "gmsh:geometrical"  # cell data: the entity of a cell, as meshio calls it
_KINDS = {15: ("vertex", 1), 1: ("line", 2), 2: ("triangle", 3), 3: ("quad", 4), 4: ("tetra", 4)}
_NUMBERS = {name: number for number, (name, _) in _KINDS.items()}
_DIMENSIONS = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2, "tetra": 3}


def is_model(mesh: Any) -> bool:
    """Tells ``gmsh.model``, which is a class, from meshes of other libraries."""
    return hasattr(mesh, "getEntities") and hasattr(getattr(mesh, "mesh", None), "getElements")


# --- from the model ---------------------------------------------------------------------------------------------------


def cells_of_model(model: Any) -> Cells:
    """The mesh of the current model. Nodes at points of the geometry are held."""
    tags, points, parts = _mesh(model)
    kinds = dict.fromkeys(part.kind for part in parts)
    blocks = {kind: [part for part in parts if part.kind == kind] for kind in kinds}

    def joined(values: Any) -> list[Any]:
        return [np.concatenate([values(part) for part in of_kind]) for of_kind in blocks.values()]

    result = Cells(points, [Block(kind, cells) for kind, cells in zip(kinds, joined(lambda part: part.corners))])
    result.cell_data[_ENTITY] = joined(lambda part: np.full(len(part.corners), part.entity[1]))
    result.cell_data["gmsh:physical"] = joined(lambda part: np.full(len(part.corners), _group(model, part.entity)))
    for dimension, tag in model.getPhysicalGroups():
        if name := model.getPhysicalName(dimension, tag):
            result.field_data[name] = np.array([tag, dimension])
    for view in _views(model):
        if view.kind == "NodeData":
            result.point_data[view.name] = view.rows_of(tags)
        elif view.kind == "ElementData":
            result.cell_data[view.name] = joined(lambda part, view=view: view.rows_of(part.elements))
    result.held = np.concatenate([block.data[:, 0] for block in result.cells if block.type == "vertex"] or [[]]).astype(np.int64)
    return result


@dataclasses.dataclass
class _Part:
    """Elements of one type on one entity, as rows of nodes."""

    kind: str
    entity: tuple[int, int]
    elements: Any
    corners: Any
    is_reversed: bool = False
    """The model has them clockwise, seen from above."""


def _mesh(model: Any) -> tuple[Any, Any, list[_Part]]:
    """Tags and places of the nodes of the triangles or tetrahedra, and the elements that these nodes make. All others,
    such as centers of circles, stay the model's alone."""
    tags, points = _nodes(model)
    parts = list(_parts(model))
    if {"tetra", "quad"} <= {part.kind for part in parts}:
        raise TemperError("unsupported", "", "the model has tetrahedra and quadrilaterals. Next: mesh its surfaces with triangles")
    top = max((_DIMENSIONS[part.kind] for part in parts), default=0)
    if top < 2:
        raise TemperError("empty_input", "", "the model has no triangles or tetrahedra. Next: gmsh.model.mesh.generate(2)")
    used = np.unique(np.concatenate([part.corners.ravel() for part in parts if _DIMENSIONS[part.kind] == top] or [[]])).astype(np.int64)
    for part in parts:
        inside = np.isin(part.corners, used).all(axis=1)
        part.elements, part.corners = part.elements[inside], np.searchsorted(used, part.corners[inside])
    parts, points = [part for part in parts if len(part.corners)], points[np.searchsorted(tags, used)]
    for part in parts if top == 2 and not np.ptp(points[:, 2]) else []:
        if _DIMENSIONS[part.kind] == 2:
            a, b, c = points[part.corners[0, :3]]
            part.is_reversed = bool(np.cross(b - a, c - a)[2] < 0)
            part.corners = part.corners[:, ::-1] if part.is_reversed else part.corners
    return used, points, parts


def _nodes(model: Any) -> tuple[Any, Any]:
    """Tags of all nodes, ascending, and their places."""
    tags, places, _ = model.mesh.getNodes()
    order = np.argsort(tags)
    return np.asarray(tags, dtype=np.int64)[order], np.asarray(places).reshape(-1, 3)[order]


def _group(model: Any, entity: tuple[int, int]) -> int:
    groups = model.getPhysicalGroupsForEntity(*entity)
    return int(groups[0]) if len(groups) else 0


def _parts(model: Any) -> Iterator[_Part]:
    """All elements, with tags of nodes. A point of the geometry is a vertex cell, also without an element."""
    for dimension, tag in model.getEntities():
        where = f"{('point', 'curve', 'surface', 'volume')[dimension]} {tag}"
        if dimension > 0 and model.mesh.getPeriodicNodes(dimension, tag)[0] != tag:
            cure = "Next: gmsh.write a file, and read it with temper.read, which forgets the period"
            raise TemperError("unsupported", "", f"{where} is periodic. {cure}")
        kinds, elements, nodes = model.mesh.getElements(dimension, tag)
        if dimension == 0:
            nodes = model.mesh.getNodes(0, tag)[0]
            elements = elements[0][: len(nodes)] if len(kinds) else np.zeros(len(nodes))
            kinds, elements, nodes = [15], [elements], [nodes]
        for kind, of_kind, corners in zip(kinds, elements, nodes):
            if kind not in _KINDS:
                name, _, order, *_ = model.mesh.getElementProperties(kind)
                message = f"{where} has elements of type {name}; expected triangles, quadrilaterals or tetrahedra"
                cure = "gmsh.model.mesh.setOrder(1), and raise the order afterwards" if order > 1 else "mesh the model with these"
                raise TemperError("unsupported", "", f"{message}. Next: {cure}")
            name, width = _KINDS[kind]
            yield _Part(name, (dimension, tag), np.asarray(of_kind, dtype=np.int64), np.asarray(corners, dtype=np.int64).reshape(-1, width))


@dataclasses.dataclass
class _View:
    """A view with data of the model: ``rows`` have the values of all steps of the nodes or elements ``tags``."""

    tag: int
    name: str
    """A name of its own, for data."""
    kind: str
    tags: Any
    rows: Any
    steps: list[tuple[float, int]]
    """Time and number of columns of each step."""

    def rows_of(self, tags: Any) -> Any:
        """One row for each tag. NaN if the view has none."""
        if not len(self.tags):
            return np.full(len(tags), np.nan)
        at = np.minimum(np.searchsorted(self.tags, tags), len(self.tags) - 1)
        found = np.where((self.tags[at] == tags)[:, None], self.rows[at], np.nan)
        return found[:, 0] if found.shape[1] == 1 else found


def _views(model: Any) -> list[_View]:
    """Views with data of the model. A view that is a list of places and values is no data of the mesh."""
    module, found = sys.modules[model.__module__].view, []
    names: dict[str, int] = {}
    has_list = False
    for tag in module.getTags():
        steps = range(int(module.option.getNumber(tag, "NbTimeStep")))
        try:
            parts = [module.getHomogeneousModelData(tag, step) for step in steps]
        except Exception:  # noqa: BLE001: nothing else in Gmsh tells that a view is a list
            has_list = True
            continue
        all_tags = np.unique(np.concatenate([part[1] for part in parts] or [[]])).astype(np.int64)
        columns = []
        for _, tags, values, _, width in parts:
            columns.append(np.full((len(all_tags), width), np.nan))
            columns[-1][np.searchsorted(all_tags, tags)] = np.reshape(values, (len(tags), -1))[:, :width]
        name = module.option.getString(tag, "Name")
        names[name] = names.get(name, 0) + 1
        name = name if names[name] == 1 else f"{name} ({names[name]})"
        rows = np.concatenate(columns, axis=1) if columns else np.empty((0, 1))
        found.append(_View(int(tag), name, parts[0][0] if parts else "", all_tags, rows, [part[3:] for part in parts]))
    if has_list:
        _forget_errors(model)
    return found


def _forget_errors(model: Any) -> None:
    """After an error Gmsh refuses to raise the order of a mesh, until something is meshed: an empty model."""
    current = model.getCurrent()
    model.add("temper: empty")
    model.mesh.generate(0)
    model.remove()
    model.setCurrent(current)


# --- into the model ---------------------------------------------------------------------------------------------------


def put_back_model(model: Any, form: Cells, vertex_of_node: Any) -> None:
    """Replaces the mesh of those entities that the form has cells of. Nodes that are still there keep their tags."""
    used, _, parts = _mesh(model)
    views = _views(model)
    point_elements = {part.entity[1]: part.elements[0] for part in parts if part.kind == "vertex"}
    is_reversed = {part.entity: part.is_reversed for part in parts}
    nodes = np.zeros(len(form.points), dtype=np.int64)
    there = vertex_of_node >= 0
    nodes[vertex_of_node[there]] = used[there]
    nodes[nodes == 0] = model.mesh.getMaxNodeTag() + 1 + np.arange((nodes == 0).sum())

    entities = [np.asarray(of_block) for of_block in form.cell_data[_ENTITY]]
    new = [
        (i, (_DIMENSIONS[block.type], int(tag)), np.flatnonzero(entities[i] == tag))
        for i, block in enumerate(form.cells) for tag in np.unique(entities[i])
    ]  # fmt: skip
    new.sort(key=lambda found: found[1], reverse=True)
    owner = np.zeros((len(nodes), 2), dtype=np.int64)  # of each node: the entity of least dimension
    for i, entity, rows in new:
        owner[form.cells[i].data[rows].ravel()] = entity
    for _, entity, _ in new:
        if entity[0] > 0:
            model.mesh.clear([entity])
    for _, (dimension, tag), _ in reversed(new):
        own = np.flatnonzero((owner == (dimension, tag)).all(axis=1))
        if dimension == 0:
            model.mesh.setNode(nodes[own[0]], form.points[own[0]], [])
        elif len(own) and nodes[own[0]] not in model.mesh.getNodes(dimension, tag)[0]:
            model.mesh.addNodes(dimension, tag, nodes[own], form.points[own].ravel(), _parameters(model, dimension, tag, form.points[own]))
    numbers = [np.zeros(len(block.data), dtype=np.int64) for block in form.cells]
    for i, (dimension, tag), rows in new:
        if dimension == 0:
            numbers[i][rows] = point_elements[tag]
            continue
        numbers[i][rows] = model.mesh.getMaxElementTag() + 1 + np.arange(len(rows))
        corners = nodes[form.cells[i].data[rows]]
        corners = corners[:, ::-1] if is_reversed[dimension, tag] else corners
        model.mesh.addElementsByType(tag, _NUMBERS[form.cells[i].type], numbers[i][rows], corners.ravel())
    _put_back_views(model, form, views, (used, nodes), (np.concatenate([part.elements for part in parts]), np.concatenate(numbers)))


def _parameters(model: Any, dimension: int, tag: int, places: Any) -> Any:
    """Parameters of places on the geometry, with which Gmsh raises the order; none where there is only a mesh."""
    if dimension == 3 or model.getType(dimension, tag).startswith("Discrete"):
        return []
    return model.getParametrization(dimension, tag, places.ravel())


def _put_back_views(model: Any, form: Cells, views: list[_View], nodes: tuple[Any, Any], elements: tuple[Any, Any]) -> None:
    """Views get the data of the form. Nodes and elements have two lists of tags: the former ones, and those now."""
    module = sys.modules[model.__module__].view
    if np.any(form.point_data["weight"]) and "weight" not in [view.name for view in views]:
        views = [*views, _View(module.add("weight"), "weight", "NodeData", np.empty(0, np.int64), np.empty((0, 1)), [(0.0, 1)])]
    for view in views:
        if view.kind == "NodeData":
            (gone, tags), values = nodes, form.point_data[view.name]
        elif view.kind == "ElementData":
            (gone, tags), values = elements, np.concatenate(form.cell_data[view.name])
        else:
            warnings.warn(f"view '{view.name}' has {view.kind} of the former elements, and is removed", TemperWarning, stacklevel=6)
            module.remove(view.tag)
            continue
        stays = ~np.isin(view.tags, gone)
        rows = np.concatenate([view.rows[stays], values.reshape(len(tags), -1)])
        _replace(module, model, view, np.concatenate([view.tags[stays], tags]), rows)


def _replace(module: Any, model: Any, view: _View, tags: Any, rows: Any) -> None:
    """Gives the view other data, and leaves its name and options."""
    name, options = module.option.getString(view.tag, "Name"), module.add("")
    module.option.copy(view.tag, options)
    module.remove(view.tag)
    module.add(name, view.tag)
    at = 0
    for step, (time, width) in enumerate(view.steps):
        columns = rows[:, at : at + width]
        known = ~np.isnan(columns).any(axis=1) & (tags > 0)
        module.addHomogeneousModelData(view.tag, step, model.getCurrent(), view.kind, tags[known], columns[known].ravel(), time, width)
        at += width
    module.option.copy(options, view.tag)
    module.option.setString(view.tag, "Name", name)
    module.remove(options)
