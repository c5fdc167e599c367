"""Algorithm 1 of the paper: meshes made well-centered, in place."""

from __future__ import annotations

import dataclasses
import math
import numbers
import os
import warnings
from typing import TYPE_CHECKING, Any, Callable, Iterable, Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._data import DataReport
from ._errors import TemperError, TemperWarning
from ._mesh import PAGE, DataRules, Mesh, MeshLike, as_mesh, data_rules, put_back
from ._optimize_options import OptimizeOptions, changed, shows_options
from ._progress import Line, Progress, SweepRecord
from ._records import Record, table
from ._size import SizeField, SizeReport, _size_report
from ._trace import Snapshot, TraceEvent

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._optimize_options import OptionChanges


@dataclasses.dataclass(frozen=True)
class SizeChange(Record):
    """What a run did to the sizes: both compared with the size field."""

    before: SizeReport
    after: SizeReport


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(Record):
    """What ``optimize`` did."""

    stopped: Literal[
        "converged", "max_sweeps", "max_outer", "time_limit", "cancelled", "tangled", "hidden", "accuracy_sweeps"
    ]
    """Why the run ended. ``tangled``: triangles are inverted (``inversion="allow"``) and no flips can make the mesh
    regular; ``hidden``: deferred flips hid a vertex that may not be, and the mesh is one of before;
    ``accuracy_sweeps``: the second phase of the objective ``accuracy`` made all its sweeps, a normal end."""
    sweeps: int
    flips: int
    vertices_removed: int
    vertices_inserted: int
    vertices: npt.NDArray[np.int32]
    """Number in the input of each vertex; inserted ones follow, with −1. Empty when none was removed or inserted."""
    hidden: npt.NDArray[np.int32]
    """Vertices that ``hidden="keep"`` left without a power cell."""
    seconds: float
    """The optimisation alone."""
    initial_energy: float
    """Of the input, at the final γ."""
    final_energy: float
    size: SizeChange
    data: DataReport | None
    """Of the data that came with the mesh; None without."""
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """``history[0]`` is the input."""
    notes: list[str]
    """What the user should know, in sentences."""
    _meshes: tuple[Mesh, Mesh] | None = dataclasses.field(default=None, repr=False, compare=False)
    """Before and after, of meshes that notebooks show."""

    def _repr_html_(self) -> str:
        if self._meshes is None:
            return super()._repr_html_()
        from ._html import html_report

        before, after = self._meshes
        page = html_report(after, before, self, title="temper.optimize", reasons=False)
        return table("OptimizeReport", self._rows(), page._repr_html_())

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


_EVERY = 600.0  # seconds between checkpoints


def _path(name: str, path: str | os.PathLike[str] | None) -> str | None:
    if path is not None and not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"{name}: expected a path or None, found {path!r}")
    return None if path is None else os.fspath(path)


def _is_helper(communicator: Any) -> bool:
    """Whether this process helps rank 0 with its run."""
    if communicator is None:
        return False
    if not all(callable(getattr(communicator, name, None)) for name in ("Get_size", "Get_rank", "bcast", "Bcast", "Abort")):
        raise TypeError(f"communicator: expected a communicator of mpi4py or None, found {communicator!r}")
    return communicator.Get_rank() != 0


def _checkpoint(path: str | os.PathLike[str] | None, every: float) -> tuple[str, float, Callable[[str], None]] | None:
    """As the compiled half takes it: the file, seconds between, who is told that it could not be written."""
    if not isinstance(every, numbers.Real) or isinstance(every, bool):
        raise TypeError(f"every: expected a number, found {every!r}")
    if not 0 <= every < math.inf:
        raise TemperError("invalid_option", "", f"every is {every}; expected a number of seconds, 0 or more")
    file = _path("checkpoint", path)
    if file is None:
        if every != _EVERY:
            warnings.warn("every has no effect without checkpoint", TemperWarning, stacklevel=3)
        return None
    return file, float(every), lambda message: warnings.warn(message, TemperWarning, stacklevel=3)


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
    checkpoint: str | os.PathLike[str] | None = None,
    every: float = _EVERY,
    resume: str | os.PathLike[str] | None = None,
    communicator: Any = None,
    **changes: Unpack[OptionChanges],
) -> OptimizeReport:
    """Improves a mesh in place: moves vertices, weighs them and flips edges until every triangle is well-centered.

    A triangle is well-centered when its orthocenter is strictly inside and each of its edges is crossed by its dual:
    all h > 0 and all 0 < d < ℓ (docs/concepts.md). The domain boundary, fixed vertices and constrained edges stay, bit
    for bit, unless ``boundary`` and ``interfaces`` say otherwise; every triangle stays counter-clockwise.
    For barriers (``BP``, ``BHs``, ``BH``) the result never has more triangles that are not well-centered than the input.
    HOT energies (``F``, ``T``, ``dT``) are lowered, whatever that does to them (docs/concepts.md). The same input,
    options and seed give the same bits for any number of threads.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        Changed in place. (``optimized`` leaves it alone and gives another one.)
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
    checkpoint : path, optional
        A file for the state of the run: written at its beginning, now and then, and when it is stopped early, by
        ``time_limit``, ``observer`` or Ctrl-C. When it cannot be written at first that is an error, later a
        ``TemperWarning``.
    every : float, optional
        Seconds between checkpoints; 0: as many as there can be.
    resume : path, optional
        A checkpoint to go on from: the run ends with the bits that it would have ended with. The mesh is what it was
        when that run began (``optimized`` leaves it so), and options and size field are the same, but for
        ``time_limit``, which is of each run alone. Observers, tracers and snapshots see what is left of the run.
    communicator : mpi4py.MPI.Comm, optional
        Of the processes that make this run together, one on each machine (docs/ranks.md). All of them call with the
        same mesh and options, and get the result. Its bits do not depend on their number. Progress, observer, time
        limit and checkpoints are those of rank 0.

    Returns
    -------
    OptimizeReport

    Raises
    ------
    TypeError
        An option of the wrong type. The mesh is then as it was.
    TemperError
        An option out of range, options that contradict each other, weights that hide a vertex, a mesh outside the
        barrier of BH or BHs, a checkpoint that cannot be written, or is of another mesh, options or version
        (``checkpoint_mismatch``); on all ranks, when one was given another mesh or other options (``rank_mismatch``),
        or rank 0 cannot write its checkpoint. The mesh is then as it was.
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
        progress, observer, checkpoint = False, None, None
    target = as_mesh(mesh)
    rules = target.point_data_rules if point_data is None else data_rules(point_data)
    _temper.check_data_rules(target._handle, rules)
    plain = changed(options, changes)._plain()
    line = Line(progress)
    trace = (lambda event: tracer(TraceEvent(**event))) if tracer is not None else None
    kept, resumed = _checkpoint(checkpoint, every), _path("resume", resume)
    look = (lambda shot: snapshots(Snapshot._of(shot))) if snapshots is not None else None
    field = size_field._handle if size_field is not None else None
    original = target.copy() if tensor is None and 0 < target.n_triangles <= PAGE else None
    before = target._handle.version()
    try:
        watch = _observer(line, observer)
        report = _temper.optimize(
            target._handle, plain, field, threads, watch, trace, look, kept, resumed, None if tensor is None else tuple(tensor), communicator
        )
    finally:
        line.clear()
        if target._handle.version() != before:
            target.point_data_rules = rules
            if target is not mesh:
                put_back(mesh, target)
    data = DataReport._of(target, threads) if target._handle.has_data() else None
    return _report(report, data, None if original is None else (original, target.copy()))


def optimized(mesh: MeshLike, options: OptimizeOptions | None = None, **keywords: Any) -> Mesh:
    """Another mesh, improved; the given one stays as it is. Options and keywords are those of ``optimize``.

    >>> import temper
    >>> ring = temper.generate.annulus()
    >>> temper.quality(temper.optimized(ring)).well_centered_fraction
    1.0
    """
    result = as_mesh(mesh).copy()
    optimize(result, options, **keywords)
    return result


def replay(input: MeshLike, events: Iterable[TraceEvent]) -> Mesh:
    """Applies the events of a run (``optimize(tracer=…)``) to its input. What ``optimize`` gave comes out: the same
    bits, the same slots. TemperError ``trace_mismatch`` names the event, counted from 0, that does not fit."""
    return replay_with_vertices(input, events)[0]


def replay_with_vertices(input: MeshLike, events: Iterable[TraceEvent]) -> tuple[Mesh, npt.NDArray[np.int32]]:
    """The same, and the number in the input of each vertex: −1 for inserted ones; empty when none was removed or
    inserted."""
    handle, vertices = _temper.replay(as_mesh(input)._handle, (event._plain() for event in events))
    return Mesh._of(handle), vertices
