"""A mesh that changes a little at a time, and stays good."""

from __future__ import annotations

import dataclasses
from typing import Any, Callable, Literal, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _temper
from ._errors import TemperError
from ._mesh import Mesh, _doubles, _ints
from ._options import EffortName, KeepName, OptimizeOptions, TargetName, _words, lists_presets, rows_set, settled
from ._optimize import _observer
from ._progress import Line
from ._records import Record, expect
from ._reports import OptimizeReport, Progress
from ._tets import TetMesh
from .size import SizeField


@dataclasses.dataclass(frozen=True, eq=False)
class Update(Record):
    """The result of ``Optimizer.update``: where the mesh differs from the mesh after the last update, the waiting
    changes included. Numbers are those of the present mesh, ascending."""

    report: OptimizeReport
    """Report of the run. Its input is the mesh with the changes that waited."""
    vertices: npt.NDArray[np.int32]
    """Former number of each vertex, (n,); −1: new. Empty if all have the same numbers."""
    moved: npt.NDArray[np.int32]
    """Vertices at another place."""
    weighed: npt.NDArray[np.int32]
    """Vertices with another weight."""
    cells: npt.NDArray[np.int32]
    """Triangles or tetrahedra that were not there, or of which a corner is among ``moved`` or ``weighed``."""
    rows: npt.NDArray[np.int32]
    """Corners of ``cells``: the rows of a matrix of vertices to compute again. All others have the same numbers in
    them."""


@lists_presets
class Optimizer:
    """A mesh that a simulation changes a little at a time, and that stays good.

    Changes wait for ``update``, which makes them together. Then it makes good what they have spoiled, by the least
    change: flips, weights, and moves of the vertices there. All else keeps its bits. ``Update`` says what is new, so
    that a solver can keep the rest of its matrices.

    The mesh is the caller's, and changes in place. The caller may change it between updates in other ways, too.

    Parameters
    ----------
    mesh : Mesh or TetMesh
        The mesh. If it is not good yet, the first update makes it good: with many bad places, by a run over the whole
        mesh, as ``optimize`` does.
    target : str
        Use of the mesh, which sets the criterion.

        [target]
    effort : str
        Time that an update may take for repairs.

        [effort]
    keep : str or sequence of str
        Parts of the mesh that stay. ``"positions"``: an update changes weights and edges alone.

        [keep]
    boundary : str, optional
        As in ``optimize``.
    options : dict or OptimizeOptions, optional
        Further options by name, as in ``optimize``. ``change`` is ``least``.
    threads : int, optional
        Number of threads; None or 0: as many as the machine has. The result does not depend on it.

    Raises
    ------
    TypeError
        Another kind of mesh, or an option of the wrong type.
    TemperError
        Options that contradict each other, or that least changes do not allow.

    Examples
    --------
    A vertex follows a point, and the mesh stays good around it:

    >>> import temper
    >>> optimizer = temper.Optimizer(temper.generate.annulus())
    >>> update = optimizer.update()
    >>> x, y = optimizer.mesh.points[100]
    >>> optimizer.move([100], [(x + 0.01, y)])
    >>> update = optimizer.update()
    >>> update.report.bad_after, 100 in update.rows
    (0, True)
    """

    def __init__(
        self,
        mesh: Mesh | TetMesh,
        *,
        target: TargetName = "any",
        effort: EffortName = "normal",
        keep: KeepName | Sequence[KeepName] = (),
        boundary: Literal["keep", "slide", "split"] | None = None,
        options: OptimizeOptions | dict[str, Any] | None = None,
        threads: int | None = None,
    ) -> None:
        if not isinstance(mesh, TetMesh):
            expect("mesh", mesh, Mesh)
        self.mesh = mesh
        """The mesh, without the changes that wait."""
        changes = {"boundary": boundary}
        self._options = settled(target, effort, keep, options, **changes)._plain()
        self._threads = threads
        is_of_tets = isinstance(mesh, TetMesh)
        _temper.check_cells(self._options, target, _words(keep), rows_set(options, changes), mesh._handle)
        _temper.check_optimizer(self._options, is_of_tets)
        self._waiting: dict[str, list[npt.NDArray[Any]]] = {}
        self._size_field: SizeField | None = None
        self.forget()

    def move(self, vertices: npt.ArrayLike, points: npt.ArrayLike) -> None:
        """Moves vertices (k,) to points (k, d) [length]. d is 2 in the plane, 3 on a sphere and for tetrahedra. In a
        mesh of triangles, the distance may be any. In one of tetrahedra, no tetrahedron may turn over. All vertices
        move at once, so that a flow may carry all points. If a vertex lies on the boundary or on a line, the boundary
        or the line moves with it. If a vertex is given several times, its last point counts."""
        self._add_values("moved", "places", self._numbers(vertices), self._places(points), "points")

    def set_weights(self, vertices: npt.ArrayLike, weights: npt.ArrayLike) -> None:
        """Gives vertices (k,) weights (k,) [length²]."""
        self._add_values("weighed", "weights", self._numbers(vertices), _doubles(weights, 0, "weights"), "weights")

    def remove(self, vertices: npt.ArrayLike) -> None:
        """Removes vertices (k,)."""
        self._waiting["removed"].append(self._numbers(vertices))

    def insert(self, points: npt.ArrayLike) -> None:
        """Inserts vertices at points (k, d) [length]. After the update they are the last ones, in this order."""
        self._waiting["inserted"].append(self._places(points))

    def resize(self, size_field: SizeField) -> None:
        """Gives a mesh of triangles the sizes of a field, by the least change. Where vertices are more than twice as
        dense as the field says, some are removed. Where they are less than half as dense, vertices are inserted, after
        those of ``insert``. Elsewhere nothing changes. Lines and the boundary keep their shape, and fixed vertices
        stay. ``temper.SizeField.from_values(mesh, sizes)`` makes a field from lengths at the vertices.

        Raises
        ------
        TypeError
            A mesh of tetrahedra, or no ``SizeField``.
        """
        if isinstance(self.mesh, TetMesh):
            raise TypeError("resize is for triangles alone. Next: insert and remove vertices")
        self._size_field = expect("size_field", size_field, SizeField)

    def forget(self) -> None:
        """Forgets the changes that wait."""
        self._size_field = None
        empty = {"moved": 0, "places": 3, "weighed": 0, "weights": 0, "removed": 0, "inserted": 3}
        self._waiting = {
            name: [np.empty((0, columns) if columns else 0, dtype=np.int64 if name in ("moved", "weighed", "removed") else np.float64)]
            for name, columns in empty.items()
        }

    def update(self, *, progress: Union[bool, Callable[[Progress], Any], None] = False) -> Update:
        """Makes the changes that wait: moves, then weights, then removals, then insertions, then sizes. Then makes the
        mesh good by the least change. A mesh that needs nothing costs one check.

        Weights that would hide a vertex change. Data follow ``Mesh.point_data_rules`` and
        ``Mesh.cell_data_rules``.

        Parameters
        ----------
        progress : bool or callable, optional
            As in ``optimize``, but False by default.

        Raises
        ------
        TemperError
            A vertex is not in the mesh, or cannot be removed. A place is not finite, is outside the mesh, or is behind
            its boundary or a line. A tetrahedron would turn over. A size field lies in another space. The mesh stays as
            it was, and all changes still wait. ``forget`` drops them.
        KeyboardInterrupt
            Ctrl-C stopped the update. The mesh has its changes, and is as good as it was by then.

        Notes
        -----
        O(n) for a few passes over the mesh, and time for each place that is bad. The GIL is released.
        """
        waiting = {name: np.concatenate(parts) for name, parts in self._waiting.items()}
        observer = progress if callable(progress) else None
        line = Line(False if observer is not None else progress, "tetrahedra" if isinstance(self.mesh, TetMesh) else "triangles")
        rest = (self._options, waiting, self._threads, _observer(line, observer))
        try:
            if isinstance(self.mesh, TetMesh):
                report, difference = _temper.tet_update(self.mesh._handle, *rest)
            else:
                field = None if self._size_field is None else self._size_field._handle
                report, difference = _temper.update(self.mesh._handle, *rest, field)
        finally:
            line.clear()
        self.forget()
        return Update(report, **difference)

    def _numbers(self, vertices: npt.ArrayLike) -> npt.NDArray[np.int64]:
        numbers = _ints(vertices, 0, "vertices").astype(np.int64)
        n = self.mesh.n_vertices
        if (off := np.flatnonzero((numbers < 0) | (numbers >= n))).size:
            raise TemperError("index_out_of_range", "", f"vertex {numbers[off[0]]} is not in the mesh; expected 0 to {n - 1}")
        return numbers

    def _places(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        columns = 2 if isinstance(self.mesh, Mesh) and self.mesh.space.is_plane else 3
        places = _doubles(points, columns, "points")
        return np.pad(places, ((0, 0), (0, 3 - columns)))

    def _add_values(self, what: str, values_name: str, numbers: npt.NDArray[Any], values: npt.NDArray[Any], shown: str) -> None:
        if len(numbers) != len(values):
            raise TemperError("size_mismatch", "", f"{shown}: expected {len(numbers)}, one for each vertex, found {len(values)}")
        self._waiting[what].append(numbers)
        self._waiting[values_name].append(values)
