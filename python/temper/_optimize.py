"""Algorithm 1 of the paper: meshes made well-centered, in place."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, Callable, Iterable, Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._errors import TemperError, TemperWarning
from ._mesh import DataRules, Mesh, MeshLike, as_mesh, data_rules, put_back
from ._options import OptimizeOptions, changed, shows_options
from ._progress import Line, Progress, SweepRecord
from ._records import Record
from .size import SizeField, SizeReport, Spread, _size_report

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._options import OptionChanges


PAGE = 20_000  # triangles of a mesh whose HTML report notebooks show, and keep


@dataclasses.dataclass(frozen=True, eq=False)
class TraceEvent:
    """Vertices are numbered as in the input, also after removals; new ones get the numbers after those of the input.
    Coordinates and weights are in the user's units."""

    kind: Literal["move", "weight", "flip", "collapse", "removal", "insertion", "split", "hidden", "undo"]
    sweep: int
    """0: making the input regular, and cutting its boundary."""
    vertex: int
    """−1 for flip, and for undo of whole sweeps; insertion, split: the new one."""
    before: float
    """Energy of the vertex's patch, or of all edges that a flip changes, before the event; NaN where none belongs."""
    after: float
    point: tuple[float, float, float]
    """move, weight, insertion, split: x, y, w of the vertex now; on a sphere its weighted vector."""
    quad: tuple[int, int, int, int]
    """flip: edge a→b, with c on its left and d on its right, becomes d→c; split: a→b was cut (d −1 on the boundary)."""
    link: npt.NDArray[np.int32]
    """collapse, removal: neighbors, counter-clockwise; insertion: corners of the triangle."""
    triangles: list[tuple[int, int, int]]
    """collapse, removal: that fill the cavity, in slot order."""
    to_sweep: int
    """undo without a vertex: the sweep at whose end the mesh was so; −1: the input as given."""

    def _plain(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """The mesh as it is at one moment of a run."""

    moment: Literal["start", "after_sweep", "before_flips", "after_flips"]
    sweep: int
    """Sweeps done."""
    outer: int
    """Rounds of deferred flips done."""
    energy: float
    """Of the mesh, at the γ of the sweep."""
    mesh: Mesh
    """A copy; may hold inverted triangles when those are allowed."""
    vertices: npt.NDArray[np.int32]
    """Number in the input of each vertex; −1: inserted."""

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Snapshot:
        handle: _temper.Mesh = d.pop("mesh")
        return cls(**d, mesh=Mesh._of(handle))


@dataclasses.dataclass(frozen=True)
class DataReport(Record):
    """Data of the points and triangles that came with a mesh, where it is another now. All 0 without such data."""

    points: int
    """Of those that the mesh came with, that are left."""
    points_moved: int
    """Of those, elsewhere than they were."""
    distance: Spread
    """By which the moved ones are [length]."""
    points_inserted: int
    interpolated: list[str]
    """Point data that are of the place: linear on the triangles that the mesh came with."""
    kept: list[str]
    """Point data that went with their points."""
    dropped: list[str]
    """Integer point data that differ around an inserted point."""
    triangles: int
    triangles_changed: int
    """Of those, with other corners or at other places than the mesh came with at this number."""
    of_triangles: list[str]
    """Data of triangles: those of the triangle that the mesh came with where the middle of each is now."""

    @classmethod
    def _of(cls, mesh: Mesh, threads: int | None) -> DataReport:
        report: dict[str, Any] = _temper.data_report(mesh._handle, threads)
        return cls(**{**report, "distance": Spread(**report["distance"])})


@dataclasses.dataclass(frozen=True)
class SizeChange(Record):
    """What a run did to the sizes: both compared with the size field."""

    before: SizeReport
    after: SizeReport


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(Record):
    """What ``optimize`` did."""

    stopped: Literal[
        "converged", "max_sweeps", "max_outer", "time_limit", "canceled", "tangled", "hidden", "sweep_limit"
    ]
    """Why the run ended. ``tangled``: triangles are inverted (``inversion="allow"``) and no flips can make the mesh
    regular; ``hidden``: deferred flips hid a vertex that may not be, and the mesh is one of before;
    ``sweep_limit``: the second phase of the objective ``accuracy`` made all its sweeps, a normal end."""
    sweeps: int
    flips: int
    vertices_removed: int
    vertices_inserted: int
    vertices: npt.NDArray[np.int32]
    """Number in the input of each vertex; inserted ones follow, with −1. Empty when none was removed or inserted."""
    hidden: npt.NDArray[np.int32]
    """Vertices that ``hidden="keep"`` left without a power cell."""
    objective: Literal["energy", "accuracy", "solver_error"]
    """That the run lowered."""
    seconds: float
    """The optimization alone."""
    objective_before: float
    """Of the input, at the final γ."""
    objective_after: float
    size: SizeChange
    data: DataReport | None
    """Of the data that came with the mesh; None without."""
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """``history[0]`` is the input."""
    notes: list[str]
    """What the user should know, in sentences."""
    _meshes: tuple[Mesh, Mesh] | None = dataclasses.field(default=None, repr=False, compare=False)
    """Before and after, of meshes that notebooks show."""

    def _rows(self) -> list[tuple[str, str]]:
        bad = [str(record.bad) for record in (self.history[:1] + self.history[-1:])]
        rows = [row for row in super()._rows() if row[0] not in ("vertices", "hidden", "size", "data", "notes")]
        rows.insert(1, ("bad triangles", " → ".join(bad)))
        rows.append(("sizes within", f"1/{self.size.after.band:.3g} to {self.size.after.band:.3g} of the field"))
        if self.data is not None and self.data.interpolated:
            moved = f"of {self.data.points_moved} moved points: {', '.join(self.data.interpolated)}"
            rows.append(("interpolated", moved))
        return rows + [("note", note) for note in self.notes]

    def as_dict(self) -> dict[str, Any]:
        """As ``Record.as_dict``, with the history."""
        return {**super().as_dict(), "history": [record.as_dict() for record in self.history]}


def _report(
    d: dict[str, Any], data: DataReport | None = None, meshes: tuple[Mesh, Mesh] | None = None
) -> OptimizeReport:
    size = SizeChange(_size_report(d.pop("size_before")), _size_report(d.pop("size_after")))
    history = [SweepRecord(**record) for record in d.pop("history")]
    return OptimizeReport(**d, size=size, data=data, history=history, _meshes=meshes)


def _observer(line: Line, observer: Callable[[Progress], Any] | None) -> Callable[..., bool] | None:
    if not line.enabled and observer is None:
        return None

    def tell(last: dict[str, Any], fraction: float, max_sweeps: int, sweeps_left: float | None) -> bool:
        progress = Progress(SweepRecord(**last), fraction, max_sweeps, sweeps_left)
        line.show(progress)
        return observer is None or observer(progress) is not False

    return tell


def _is_helper(communicator: Any) -> bool:
    """Whether this process helps rank 0 with its run."""
    if communicator is None:
        return False
    if not all(callable(getattr(communicator, name, None)) for name in ("Get_size", "Get_rank", "bcast", "Bcast", "Abort")):
        raise TypeError(f"communicator: expected a communicator of mpi4py or None, found {communicator!r}")
    return communicator.Get_rank() != 0


@shows_options
def optimize(
    mesh: MeshLike,
    options: OptimizeOptions | None = None,
    *,
    size_field: SizeField | None = None,
    tensor: Sequence[float] | None = None,
    point_data: DataRules | None = None,
    threads: int | None = None,
    observer: Callable[[Progress], Any] | None = None,
    progress: bool | None = None,
    tracer: Callable[[TraceEvent], Any] | None = None,
    snapshots: Callable[[Snapshot], Any] | None = None,
    communicator: Any = None,
    **changes: Unpack[OptionChanges],
) -> OptimizeReport:
    """Improves a mesh in place: moves vertices, changes weights and flips edges until every triangle is well-centered.

    A triangle is well-centered when its orthocenter is strictly inside and each of its edges is crossed by its dual:
    all h > 0 and all 0 < d < ℓ (docs/concepts.md). The domain boundary, fixed vertices and constrained edges stay, bit
    for bit, unless ``boundary`` and ``interfaces`` say otherwise; every triangle stays counter-clockwise.
    For barriers (``BP``, ``BHs``, ``BH``) the result never has more triangles that are not well-centered than the input.
    HOT energies (``F``, ``T``, ``dT``) are lowered, whatever that does to them (docs/concepts.md). The same input,
    options and seed give the same bits for any number of threads.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        Changed in place. To keep the mesh as it is, optimize ``mesh.copy()``.
    options : OptimizeOptions, optional
        All options in one value, such as ``paper_method()``.
    **changes
        Options by their names, ``energy="F", max_sweeps=20``, which win over those in ``options``.
        ``help(temper.OptimizeOptions)`` says what each is for.
    size_field : SizeField, optional
        That sizes are compared with. None: the input's own.
    tensor : sequence of float, optional
        kxx, kxy, kyy of a constant diffusion tensor K, for −div(K ∇u): triangles become well-centered in its metric, and
        so is all that is reported, and what snapshots show (docs/tensor.md). Not with ``size_field`` and ``tracer``.
    point_data : str or sequence of str, optional
        What floating point data of points do where vertices move: ``Mesh.point_data_rules``, which this sets.
    threads : int, optional
        None or 0: as many as the machine has. The result does not depend on it.
    observer : callable, optional
        Called with a ``Progress`` at least once a sweep; returning False stops the run. An exception that it raises
        stops the run too, and is raised again once the mesh has its best state.
    progress : bool, optional
        None: one line on a terminal, and in notebooks; nothing in a pipe. False: never. True: lines in a pipe, too.
    tracer : callable, optional
        Called with each ``TraceEvent``; ``replay`` makes the mesh again from them.
    snapshots : callable, optional
        Called with a ``Snapshot`` between sweeps; a copy of the mesh each time.
    communicator : mpi4py.MPI.Comm, optional
        Of the processes that make this run together, one on each machine (docs/ranks.md). All of them call with the
        same mesh and options, and get the result. Its bits do not depend on their number. Progress, observer and time
        limit are those of rank 0.

    Returns
    -------
    OptimizeReport

    Raises
    ------
    TypeError
        An option of the wrong type. The mesh is then as it was.
    TemperError
        An option out of range, options that contradict each other, weights that hide a vertex, a mesh outside the
        barrier of BH or BHs; on all ranks, when one was given another mesh or other options (``rank_mismatch``). The
        mesh is then as it was.
    KeyboardInterrupt
        After Ctrl-C: the run has stopped, and the mesh is the best valid one so far.

    Notes
    -----
    O(sweeps · n). The GIL is released. While the run lasts, the mesh shows its former state, and must not be changed.

    References
    ----------
    S. A. Mitchell, P. Knupp, S. Mackay, M. F. Deakin, "Not so HOT Triangulations", Computer-Aided Design 158, 2023:
    Algorithm 1; the energies are its eqs. 2 to 7.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.annulus()
    >>> temper.quality(mesh).well_centered_fraction < 1
    True
    >>> report = temper.optimize(mesh)
    >>> report.history[-1].objective, temper.quality(mesh).well_centered_fraction
    ('accuracy', 1.0)
    """
    for name, call in (("observer", observer), ("tracer", tracer), ("snapshots", snapshots)):
        if call is not None and not callable(call):
            raise TypeError(f"{name}: expected a callable or None, found {call!r}")
    if size_field is not None and not isinstance(size_field, SizeField):
        raise TypeError(f"size_field: expected a SizeField or None, found {type(size_field).__name__}")
    if tensor is not None:
        for name, given in (("size_field", size_field), ("tracer", tracer)):
            if given is not None:
                raise ValueError(f"{name}: is of the mesh's plane, and does not go with tensor")
    if _is_helper(communicator):
        progress, observer = False, None
    target = as_mesh(mesh)
    rules = target.point_data_rules if point_data is None else data_rules(point_data)
    _temper.check_data_rules(target._handle, rules)
    plain = changed(options, changes)._plain()
    line = Line(progress)
    trace = (lambda event: tracer(TraceEvent(**event))) if tracer is not None else None
    look = (lambda shot: snapshots(Snapshot._of(shot))) if snapshots is not None else None
    field = size_field._handle if size_field is not None else None
    original = target.copy() if tensor is None and 0 < target.n_triangles <= PAGE else None
    before = target._handle.version()
    try:
        watch = _observer(line, observer)
        report = _temper.optimize(
            target._handle, plain, field, threads, watch, trace, look, None if tensor is None else tuple(tensor), communicator
        )
    finally:
        line.clear()
        if target._handle.version() != before:
            target.point_data_rules = rules
            if target is not mesh:
                put_back(mesh, target)
    data = DataReport._of(target, threads) if target._handle.has_data() else None
    return _report(report, data, None if original is None else (original, target.copy()))


@dataclasses.dataclass(frozen=True, eq=False)
class Replay(Record):
    """What ``replay`` made."""

    mesh: Mesh
    """What ``optimize`` gave: the same bits, the same slots."""
    vertices: npt.NDArray[np.int32]
    """Number in the input of each vertex, −1 for inserted ones; empty when none was removed or inserted."""


def replay(input: MeshLike, events: Iterable[TraceEvent]) -> Replay:
    """Applies the events of a run (``optimize(tracer=…)``) to its input, of which it makes another mesh. TemperError
    ``trace_mismatch`` names the event, counted from 0, that does not fit."""
    handle, vertices = _temper.replay(as_mesh(input)._handle, (event._plain() for event in events))
    return Replay(Mesh._of(handle), vertices)
