"""The HTML report: one file in which a browser shows a mesh, before and after, with its numbers."""

from __future__ import annotations

import html
import json
import os
from typing import TYPE_CHECKING, Any

from . import _temper
from ._explain import explain
from ._io import write_text
from ._measure import quality
from ._mesh import Mesh, MeshLike, as_mesh

if TYPE_CHECKING:
    from ._optimize import OptimizeReport

_EXPLAINED = 500  # bad triangles: a second or so, as in the program


class Html(str):
    """A page that notebooks show in a frame."""

    def _repr_html_(self) -> str:
        return f'<iframe title="temper" style="width:100%;height:640px;border:1px solid #8886" srcdoc="{html.escape(self)}"></iframe>'

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file: on any error what was there is untouched."""
        write_text(path, self)


def _measures(mesh: Mesh) -> dict[str, Any]:
    q = quality(mesh)
    histograms = {name: getattr(q, name).as_dict() for name in ("angles", "h_over_l", "d_over_l")}
    return {**q.as_dict(), "histograms": histograms}


def _reasons(mesh: Mesh, measures: dict[str, Any]) -> list[dict[str, Any]]:
    bad = max(measures["orthocenters_outside"], measures["edges_not_crossed"])
    if bad == 0 or bad > _EXPLAINED or measures["inverted_triangles"]:
        return []
    return [
        {"kind": r.kind, "triangles": r.bad.tolist(), "text": r.text, "cures": [cure.text for cure in r.cures]}
        for r in explain(mesh).reasons
    ]


def html_report(
    mesh: MeshLike,
    before: MeshLike | None = None,
    report: OptimizeReport | None = None,
    *,
    title: str = "temper.Mesh",
    reasons: bool = True,
) -> Html:
    """The report that the program writes with ``--html``: a page that needs no network (docs/report.md).

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    before : Mesh or meshio.Mesh, optional
        To compare it with.
    report : OptimizeReport, optional
        Of the run that made the mesh: its history and notes are shown, too.
    reasons : bool
        Why triangles are not well-centered, by ``explain``, where they are not more than some hundreds.

    Returns
    -------
    Html
        A str; as the last value of a notebook's cell it is the page. ``save`` writes it.

    >>> import temper
    >>> ring = temper.generate.annulus()
    >>> page = temper.html_report(temper.optimized(ring), ring)
    >>> page.startswith("<!DOCTYPE html>")
    True
    """
    after = as_mesh(mesh)
    after._handle.require_plane("html_report()")
    old = None if before is None else as_mesh(before)
    measures = _measures(after)
    shown: dict[str, Any] = {"verb": "check" if report is None else "optimize", "version": _temper.__version__}
    if old is not None:
        shown["before"] = _measures(old)
    shown["after"] = measures
    if report is not None:
        run = report.as_dict()
        shown.update({key: run[key] for key in ("sweeps", "stopped", "notes", "history")})
        for record in shown["history"]:
            del record["seconds"]  # the same run makes the same page
    shown["reasons"] = _reasons(after, measures) if reasons else []
    page = _temper.html_report(after._handle, None if old is None else old._handle, title, json.dumps(shown))
    return Html(page)
