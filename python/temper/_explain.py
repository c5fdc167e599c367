"""For each triangle or tetrahedron that is not well-centered, the reason and a cure. Also the reasons of negative duals."""

from __future__ import annotations

from typing import Any, Callable, overload

from . import _temper
from ._mesh import MeshLike
from ._options import TargetName
from ._reports import DualExplanation, Explanation, SurfaceExplanation, TetExplanation
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_planes, expect_no_options_of_triangles


@overload
def explain(
    mesh: TetMesh, *, cures: int = ..., whole: int = ..., progress: Callable[[int, int], Any] | None = ...
) -> TetExplanation: ...
@overload
def explain(
    mesh: SurfaceMesh, *, cures: int = ..., whole: int = ..., progress: Callable[[int, int], Any] | None = ...
) -> SurfaceExplanation: ...
@overload
def explain(
    mesh: MeshLike, *, cures: int = ..., whole: int = ..., progress: Callable[[int, int], Any] | None = ...
) -> Explanation: ...
def explain(
    mesh: AnyMeshLike,
    *,
    cures: int = 20,
    whole: int = 1000,
    progress: Callable[[int, int], Any] | None = None,
) -> Explanation | TetExplanation | SurfaceExplanation:
    """Explains each triangle that is not well-centered by exactly one reason (docs/explanation/proofs.md). For each
    tetrahedron that is not well-centered, it gives the heights over its faces, and what may help. For a curved surface it
    lists the bad triangles, and says what weights alone can do.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    cures : int
        Largest number of reasons, the worst, for which cures are searched. For triangles of the plane or the sphere alone.
    whole : int
        Size limit of the search for weights of the whole mesh: at most this many triangles or tetrahedra, or this many
        bad ones.
    progress : callable, optional
        Function that is called now and then with the number of explained bad triangles, and the number of all. If it
        returns False, the call stops with TemperError. For triangles of the plane or the sphere alone.

    Returns
    -------
    Explanation, or TetExplanation for tetrahedra, or SurfaceExplanation for a curved surface

    Notes
    -----
    Verdicts rest on exact predicates and on ``check_certificate``. About 1 ms per bad triangle, and some 10 ms more per
    reason whose cures are searched. Ctrl-C stops the call.

    >>> import temper
    >>> why = temper.explain(temper.generate.sparse_horseshoe())
    >>> why.verdict, len(why.reasons) > 0
    ('infeasible', True)
    """
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(explain, cures=cures, progress=progress)
        return _temper.tet_explain(any_mesh._handle, whole)
    if isinstance(any_mesh, SurfaceMesh):
        expect_no_options_of_planes(explain, cures=cures, progress=progress)
    return _temper.explain(any_mesh._handle, cures, whole, progress)


def explain_duals(mesh: AnyMeshLike, target: TargetName, *, reasons: int = 20) -> DualExplanation | None:
    """Explains coefficients that are negative, or distances that are not positive: what the solver of a target cannot use.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    target : str
        As in ``optimize``: "vertex" for coefficients, "cell" for distances.
    reasons : int
        Largest number of reasons, the worst.

    Returns
    -------
    DualExplanation, or None for other targets
        Its ``violations`` is 0 if the solver can use the mesh as it is. Signs are exact. Other targets need well-centered
        meshes, which ``explain`` is for.

    Examples
    --------
    >>> import temper
    >>> square = temper.Mesh([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    >>> temper.explain_duals(square, "vertex").violations, temper.explain_duals(square, "cell").violations
    (0, 1)
    """
    any_mesh = as_any_mesh(mesh)
    function = _temper.tet_explain_duals if isinstance(any_mesh, TetMesh) else _temper.explain_duals
    return function(any_mesh._handle, target, reasons)
