"""Pictures of meshes and runs as SVG, reports as HTML, and their display in notebooks."""

from __future__ import annotations

import html
import json
import os
from numbers import Real
from typing import Any, Sequence

from . import _temper
from ._explain import explain
from ._measure import quality
from ._mesh import PICTURE_WIDTH, Mesh, as_mesh
from ._reports import OptimizeReport
from ._records import Record, expect, table
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, as_flat_mesh, expect_no_options_of_planes, expect_no_options_of_triangles

_EXPLAINED = 500  # bad triangles: about one second, as in the program


class _Text(str):
    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the text to a file. An error leaves the old file unchanged."""
        _temper.write_text(os.fspath(path), self)


class Svg(_Text):
    """SVG text that notebooks show as a picture."""

    def _repr_svg_(self) -> str:
        return str(self)


class Html(_Text):
    """A page that notebooks show in a frame."""

    def _repr_html_(self) -> str:
        return f'<iframe title="temper" style="width:100%;height:640px;border:1px solid #8886" srcdoc="{html.escape(self)}"></iframe>'


def draw_svg(
    mesh: AnyMeshLike,
    before: AnyMeshLike | None = None,
    *,
    cut: str | tuple[str, float] | None = None,
    primal: bool = True,
    dual: bool = True,
    fill: bool = True,
    weights: bool = False,
    weight_scale: float = 1.0,
    near_coincident: bool = True,
    vertex_numbers: bool = False,
    zoom: Sequence[float] | None = None,
    view: tuple[float, float] | None = None,
    width: float = 900.0,
    title: str = "",
) -> Svg:
    """Draws a mesh, or the cut of a mesh of tetrahedra by a plane, as an SVG document.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    before : of the same kind, optional
        A mesh to draw on the left, with the same scale, view and zoom box.
    cut : "x", "y", "z", or with the coordinate, such as ("x", 0.5), optional
        Plane that cuts tetrahedra. Without a coordinate: through the middle of the mesh. None: across its shortest side.
        For tetrahedra there are also ``primal``, ``fill``, ``zoom``, ``width`` and ``title``, and for curved surfaces
        ``view``, too.
    primal, dual : bool
        Draw the edges of the triangulation, and the edges of the power diagram between orthocenters. Dual edges of
        negative length are dashed.
    fill : bool
        Hatch triangles that are not well-centered, and tint the others by their margin, the least of h/ℓ, d/ℓ and
        1 − d/ℓ.
    weights : bool
        Draw circles of radius √\\|w\\| times ``weight_scale``: solid for positive, dashed for negative weights.
    near_coincident : bool
        Draw rings around vertices that nearly coincide with a neighbor.
    zoom : (x0, y0, x1, y1), optional
        Box that the picture shows. For a sphere it is in the plane of the picture [length], from its middle to the
        right and up.
    view : (longitude, latitude), optional
        Middle of the picture for a sphere [degrees]; its near half is drawn. None: the middle of a mesh that is a part
        of the sphere, else 0, 0. A curved surface is seen from this direction, by default from -60, 30.
    width : float
        Width of each mesh [CSS pixels].

    Returns
    -------
    Svg
        A str that notebooks show as a picture. ``save`` writes it.
    """
    options = _options(locals())
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(
            draw_svg, dual=dual, weights=weights, weight_scale=weight_scale, near_coincident=near_coincident,
            vertex_numbers=vertex_numbers, view=view,
        )  # fmt: skip
        axis, at = (cut, None) if cut is None or isinstance(cut, str) else cut
        if axis not in (None, "x", "y", "z"):
            raise ValueError(f"cut: expected 'x', 'y' or 'z', perhaps with a number, found {cut!r}")
        return Svg(_temper.tet_draw_svg(any_mesh._handle, _tets(before), -1 if axis is None else "xyz".index(axis), at, options))
    if cut is not None:
        raise TypeError("cut is for tetrahedra alone. Next: leave it out")
    after = any_mesh._handle
    if isinstance(any_mesh, SurfaceMesh):
        expect_no_options_of_planes(
            draw_svg, dual=dual, weights=weights, weight_scale=weight_scale, near_coincident=near_coincident,
            vertex_numbers=vertex_numbers,
        )  # fmt: skip
    if before is None:
        return Svg(_temper.draw_svg(after, options))
    old = as_any_mesh(before)
    if type(old) is not type(any_mesh):
        raise TypeError(f"before: expected a {type(any_mesh).__name__}, found a {type(old).__name__}")
    return Svg(_temper.draw_before_after_svg(old._handle, after, options))


def _tets(before: AnyMeshLike | None) -> Any:
    old = None if before is None else as_any_mesh(before)
    if not (old is None or isinstance(old, TetMesh)):
        raise TypeError(f"before: expected a TetMesh, found a {type(old).__name__}")
    return None if old is None else old._handle


def _options(values: dict[str, Any]) -> dict[str, Any]:
    options = {k: v for k, v in values.items() if k not in ("mesh", "before", "cut")}
    for name, value in options.items():
        kind: Any = str if name == "title" else Real if name in ("width", "weight_scale") else (bool, int)
        if name not in ("zoom", "view") and not isinstance(value, kind):
            wanted = "text" if kind is str else "a number" if kind is Real else "True or False"
            raise TypeError(f"{name}: expected {wanted}, found {value!r}")
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
    """Puts SVG documents next to each other in rows of ``columns``, under a title. Each keeps its size."""
    return Svg(_temper.grid_svg([str(svg) for svg in svgs], columns, title))


# --- the HTML report: one file in which a browser shows a mesh, before and after, with its numbers ---------------


def _measures(mesh: Mesh | TetMesh) -> dict[str, Any]:
    q = quality(mesh)
    return {**q.as_dict(), "histograms": q.histograms.as_dict()}


def _reasons(mesh: Mesh, measures: dict[str, Any]) -> list[dict[str, Any]]:
    bad = max(measures["orthocenters_outside"], measures["edges_not_crossed"])
    if bad == 0 or bad > _EXPLAINED or measures["inverted_triangles"]:
        return []
    return [
        {"kind": r.kind, "triangles": r.triangles.tolist(), "text": r.text, "cures": [cure.text for cure in r.cures]}
        for r in explain(mesh).reasons
    ]


def html_report(
    mesh: AnyMeshLike,
    before: AnyMeshLike | None = None,
    report: OptimizeReport | None = None,
    *,
    title: str | None = None,
    reasons: bool = True,
) -> Html:
    """The report that the program writes with ``--write``: a page that needs no network (docs/reference/formats/report.md).

    Parameters
    ----------
    mesh : Mesh, TetMesh, or of another library
    before : of the same kind, optional
        A mesh for comparison.
    report : OptimizeReport, optional
        Report of the run that made the mesh; its history and notes are shown too.
    reasons : bool
        Show why triangles are not well-centered, by ``explain``, if there are at most some hundreds.

    Returns
    -------
    Html
        A str that notebooks show as a page. ``save`` writes it.

    >>> import temper
    >>> ring = temper.generate.annulus()
    >>> better = ring.copy()
    >>> report = temper.optimize(better)
    >>> page = temper.html_report(better, ring, report)
    >>> page.startswith("<!DOCTYPE html>")
    True
    """
    after = as_flat_mesh(mesh)
    if isinstance(after, Mesh):
        after._handle.require_plane("html_report()")
    old = None if before is None else as_mesh(before) if isinstance(after, Mesh) else as_flat_mesh(before)
    measures = _measures(after)
    shown: dict[str, Any] = {"verb": "check" if report is None else "optimize", "version": _temper.__version__}
    if old is not None:
        shown["before"] = _measures(old)
    shown["after"] = measures
    if report is not None:
        run = expect("report", report, OptimizeReport).as_dict()
        shown.update({key: run[key] for key in ("sweeps", "stopped", "notes", "history")})
        for record in shown["history"]:
            del record["seconds"]  # the same run makes the same page
    title = title or f"temper.{type(after).__name__}"
    if isinstance(after, TetMesh):
        return Html(_temper.tet_html_report(after._handle, _tets(old), title, json.dumps(shown)))
    shown["reasons"] = _reasons(after, measures) if reasons else []
    page = _temper.html_report(after._handle, None if old is None else old._handle, title, json.dumps(shown))
    return Html(page)


# --- in notebooks: set here, above the modules of the two classes, so that none of them imports this one ------------


def _mesh_html(mesh: Mesh | SurfaceMesh) -> str:
    q = quality(mesh, worst=0, threads=1)
    rows = [
        ("vertices", f"{q.vertices}"),
        ("triangles", f"{q.triangles}"),
        ("edges", f"{q.edges}, {q.boundary_edges} on the boundary"),
        ("regions", f"{q.regions}"),
        ("well-centered", f"{100 * q.well_centered_fraction:.4g} %"),
        ("edges not regular", f"{q.non_regular_edges}"),
        ("least h/ℓ", f"{q.min_h_over_l:.4g}"),
        ("angles", f"{q.min_angle_deg:.4g}° to {q.max_angle_deg:.4g}°"),
    ]
    return table(f"temper.{type(mesh).__name__}", rows, mesh._repr_svg_() or "")


def _report_html(report: OptimizeReport) -> str:
    if report._meshes is None:
        return Record._repr_html_(report)
    before, after = report._meshes
    picture = draw_svg(after, before=before, dual=False, near_coincident=False, width=PICTURE_WIDTH)
    return table("OptimizeReport", report._rows(), picture)


Mesh._repr_html_ = SurfaceMesh._repr_html_ = _mesh_html  # type: ignore[attr-defined]
OptimizeReport._repr_html_ = _report_html  # type: ignore[method-assign]
