"""Pictures of primal-dual meshes, as SVG text."""

from __future__ import annotations

from typing import Any, Sequence

from . import _temper
from ._mesh import MeshLike, as_mesh


class Svg(str):
    """SVG text that notebooks show as a picture."""

    def _repr_svg_(self) -> str:
        return str(self)


def draw_svg(
    mesh: MeshLike,
    *,
    primal: bool = True,
    dual: bool = True,
    weights: bool = True,
    weight_scale: float = 1.0,
    bad_triangles: bool = True,
    near_coincident: bool = True,
    regions: bool = True,
    vertex_numbers: bool = False,
    zoom: Sequence[float] | None = None,
    view: tuple[float, float] | None = None,
    width: float = 900.0,
    title: str = "",
) -> Svg:
    """Draws a mesh as an SVG document.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    primal, dual : bool
        Edges of the triangulation; edges of the power diagram, between orthocenters.
    weights : bool
        Circles of radius √\\|w\\| times ``weight_scale``: green positive, red negative.
    bad_triangles : bool
        Fill triangles that are not well-centered.
    near_coincident : bool
        Ring vertices that nearly coincide with a neighbour.
    regions : bool
        Tint regions, and draw constrained edges thicker.
    zoom : (x0, y0, x1, y1), optional
        Draw only what meets this box. Of a sphere it is in the picture: [length], from its middle to the right and up.
    view : (longitude, latitude), optional
        Of a sphere [degrees]: the middle of the picture, whose near half is drawn. None: the middle of a mesh that is a
        part of the sphere, else 0, 0.
    width : float
        In CSS pixels.

    Returns
    -------
    Svg
        A str; as the last value of a notebook's cell it is a picture.
    """
    options = _options(locals())
    return Svg(_temper.draw_svg(as_mesh(mesh)._handle, options))


def draw_before_after_svg(
    before: MeshLike,
    after: MeshLike,
    *,
    primal: bool = True,
    dual: bool = True,
    weights: bool = True,
    weight_scale: float = 1.0,
    bad_triangles: bool = True,
    near_coincident: bool = True,
    regions: bool = True,
    vertex_numbers: bool = False,
    zoom: Sequence[float] | None = None,
    view: tuple[float, float] | None = None,
    width: float = 900.0,
    title: str = "",
) -> Svg:
    """Two panels side by side, to one scale, one view and one zoom box; options as of ``draw_svg``, ``width`` is of one
    panel."""
    options = _options(locals())
    return Svg(_temper.draw_before_after_svg(as_mesh(before)._handle, as_mesh(after)._handle, options))


def _options(values: dict[str, Any]) -> dict[str, Any]:
    options = {k: v for k, v in values.items() if k not in ("mesh", "before", "after")}
    if options["zoom"] is not None:
        options["zoom"] = tuple(float(v) for v in options["zoom"])
        if len(options["zoom"]) != 4:
            raise ValueError("zoom: expected x0, y0, x1, y1")
    if options["view"] is not None:
        options["view"] = tuple(float(v) for v in options["view"])
        if len(options["view"]) != 2:
            raise ValueError("view: expected longitude, latitude")
        longitude, latitude = options["view"]
        if not (abs(longitude) <= 360 and abs(latitude) <= 90):
            raise ValueError(
                "view: expected a longitude from -360 to 360 and a latitude from -90 to 90, "
                f"found {longitude:g}, {latitude:g}"
            )
    return options


def grid_svg(svgs: Sequence[str], columns: int, *, title: str = "") -> Svg:
    """Puts SVG documents side by side in rows of ``columns``, under a title; each keeps its size."""
    return Svg(_temper.grid_svg([str(svg) for svg in svgs], columns, title))
