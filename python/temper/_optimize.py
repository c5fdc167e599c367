"""Algorithm 1 of the paper: makes meshes well-centered, in place."""

from __future__ import annotations

import contextlib
import dataclasses
import warnings
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Literal, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._errors import TemperError, TemperWarning
from ._measure_errors import _plain_problem
from ._mesh import PICTURE, Mesh, MeshLike, as_mesh, put_back
from ._options import EffortName, KeepName, ObjectiveName, OptimizeOptions, TargetName, _words, lists_presets, rows_set, settled
from ._progress import Line, Progress, SweepRecord
from ._records import Record
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_triangles
from .size import SizeField, SizeReport, Spread, _size_report

if TYPE_CHECKING:
    from ._options import OptionsAndProblem


@dataclasses.dataclass(frozen=True, eq=False)
class TraceEvent:
    """An event of a run. Vertices are numbered as in the input, also after removals; new vertices get the next numbers.
    Coordinates and weights are in the user's units."""

    kind: Literal["move", "weight", "flip", "collapse", "removal", "insertion", "split", "hidden", "undo"]
    sweep: int
    """Sweep of the event; 0: the input is made regular and its boundary cut."""
    vertex: int
    """Vertex of the event; −1 for flip, and for undo of whole sweeps. For insertion and split, the new vertex."""
    before: float
    """Energy before the event, of the vertex's patch or of all edges that a flip changes; NaN if the event has none."""
    after: float
    point: tuple[float, float, float]
    """New x, y, w of the vertex for move, weight, insertion, split; on a sphere its weighted vector."""
    quad: tuple[int, int, int, int]
    """For flip: edge a→b, with c on its left and d on its right, becomes d→c. For split: a→b was cut (d is −1 on the
    boundary)."""
    link: npt.NDArray[np.int32]
    """Neighbors, counter-clockwise, for collapse and removal; corners of the triangle for insertion."""
    triangles: list[tuple[int, int, int]]
    """New triangles of the cavity, in slot order, for collapse and removal."""
    to_sweep: int
    """For undo without a vertex: the sweep at whose end the mesh was the same; −1: the input as given."""

    def _plain(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """The mesh at one moment of a run."""

    moment: Literal["start", "after_sweep", "before_flips", "after_flips"]
    sweep: int
    """Number of sweeps done."""
    outer: int
    """Number of rounds of deferred flips done."""
    energy: float
    """Energy of the mesh, at the γ of the sweep."""
    mesh: Mesh
    """A copy; it may hold inverted triangles if they are allowed."""
    vertices: npt.NDArray[np.int32]
    """Number of each vertex in the input; −1: inserted."""

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Snapshot:
        handle: _temper.Mesh = d.pop("mesh")
        return cls(**d, mesh=Mesh._of(handle))


@dataclasses.dataclass(frozen=True)
class DataReport(Record):
    """The fate of the data of points and triangles after the mesh has changed. All 0 without such data. For a
    ``TetMesh`` triangles are tetrahedra."""

    points: int
    """Original points that are still there."""
    points_moved: int
    """Points among these that have moved."""
    distance: Spread
    """Distances that these have moved [length]."""
    points_inserted: int
    interpolated: list[str]
    """Point data that belong to the place: linear on the original triangles."""
    kept: list[str]
    """Point data that stayed with their points."""
    dropped: list[str]
    """Integer point data that differ around an inserted point."""
    triangles: int
    triangles_changed: int
    """Triangles among these whose corners or places differ from the original triangle of the same number."""
    of_triangles: list[str]
    """Data of triangles: each triangle has the data of the original triangle that contains its middle."""

    @classmethod
    def _of(cls, report: dict[str, Any]) -> DataReport:
        return cls(**{**report, "distance": Spread(**report["distance"])})


@dataclasses.dataclass(frozen=True)
class SizeChange(Record):
    """The change of the sizes: both meshes compared with the size field."""

    before: SizeReport
    after: SizeReport


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(Record):
    """The result of ``optimize``."""

    stopped: Literal[
        "converged", "max_sweeps", "max_outer", "time_limit", "canceled", "tangled", "hidden", "sweep_limit"
    ]
    """Reason for the end of the run. ``tangled``: triangles are inverted (``inversion="allow"``) and no flips can make
    the mesh regular. ``hidden``: deferred flips hid a vertex against the policy, and the mesh is an earlier one.
    ``sweep_limit``: the second phase of the objective ``accuracy`` made all its sweeps, a normal end."""
    sweeps: int
    flips: int
    vertices_removed: int
    vertices_inserted: int
    vertices: npt.NDArray[np.int32]
    """Number of each vertex in the input; inserted vertices follow, with −1. Empty if none was removed or inserted."""
    hidden: npt.NDArray[np.int32]
    """Vertices without a power cell that ``hidden="keep"`` left."""
    objective: ObjectiveName
    """Objective that the run lowered."""
    seconds: float
    """Time of the optimization alone [s]."""
    objective_before: float
    """Objective of the input, at the final γ."""
    objective_after: float
    bad_before: int
    """Number of triangles or tetrahedra of the input that are not well-centered, before any flip."""
    bad_after: int
    """The same number of the result."""
    size: SizeChange | None
    """None for tetrahedra."""
    data: DataReport | None
    """Report on the data of the mesh; None without data."""
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """One record per sweep; ``history[0]`` is the input, with its edges flipped to be regular."""
    notes: list[str]
    """Notes for the user, in sentences."""
    _meshes: tuple[Mesh, Mesh] | None = dataclasses.field(default=None, repr=False, compare=False)
    """The mesh before and after, for notebooks."""

    def _rows(self) -> list[tuple[str, str]]:
        shown_below = ("vertices", "hidden", "bad_before", "bad_after", "size", "data", "notes")
        rows = [row for row in super()._rows() if row[0] not in shown_below]
        rows.insert(1, ("bad triangles" if self.size else "bad tetrahedra", f"{self.bad_before} → {self.bad_after}"))
        if self.size:
            rows.append(("sizes within", f"1/{self.size.after.band:.3g} to {self.size.after.band:.3g} of the field"))
        if self.data is not None and self.data.interpolated:
            moved = f"of {self.data.points_moved} moved points: {', '.join(self.data.interpolated)}"
            rows.append(("interpolated", moved))
        return rows + [("note", note) for note in self.notes]

    def as_dict(self) -> dict[str, Any]:
        """Adds the history to ``Record.as_dict``."""
        return {**super().as_dict(), "history": [record.as_dict() for record in self.history]}


def _report(
    d: dict[str, Any], data: DataReport | None = None, meshes: tuple[Mesh, Mesh] | None = None
) -> OptimizeReport:
    size = SizeChange(_size_report(d.pop("size_before")), _size_report(d.pop("size_after"))) if "size_before" in d else None
    history = [SweepRecord(**record) for record in d.pop("history")]
    if size is None:  # the mesh of tetrahedra is the best one of the history
        d.update(bad_before=history[0].bad, bad_after=min(record.bad for record in history))
    return OptimizeReport(**d, size=size, data=data, history=history, _meshes=meshes)


def _observer(line: Line, observer: Callable[[Progress], Any] | None) -> Callable[..., bool] | None:
    if not line.enabled and observer is None:
        return None

    def tell(
        last: dict[str, Any], fraction: float, max_sweeps: int, sweeps_left: float | None, *rest: Any
    ) -> bool:
        progress = Progress(SweepRecord(**last), fraction, max_sweeps, sweeps_left, *rest)
        line.show(progress)
        answer = None if observer is None else observer(progress)
        return not isinstance(answer, (bool, np.bool_)) or bool(answer)

    return tell


def _is_helper(communicator: Any) -> bool:
    """Says whether this process helps rank 0 with its run."""
    if communicator is None:
        return False
    if not all(callable(getattr(communicator, name, None)) for name in ("Get_size", "Get_rank", "bcast", "Bcast", "Abort")):
        raise TypeError(f"communicator: expected a communicator of mpi4py or None, found {communicator!r}")
    return communicator.Get_rank() != 0


@dataclasses.dataclass(frozen=True)
class Hooks:
    """Listeners and ranks of a run. The result does not depend on them, unless a listener raises an exception."""

    tracer: Callable[[TraceEvent], Any] | None = None
    """Function that gets each ``TraceEvent``. ``replay`` makes the mesh again from them."""
    snapshots: Callable[[Snapshot], Any] | None = None
    """Function that gets a ``Snapshot`` between sweeps, with a copy of the mesh each time."""
    communicator: Any = None
    """Communicator of mpi4py of the processes that make this run together, usually one per machine. All call
    ``optimize`` with the same mesh and options, and get the same result. Its bits do not depend on their number. The
    progress and time limit of rank 0 count."""

    def __post_init__(self) -> None:
        for name in ("tracer", "snapshots"):
            call = getattr(self, name)
            if call is not None and not callable(call):
                raise TypeError(f"{name}: expected a callable or None, found {call!r}")


@lists_presets
def optimize(
    mesh: AnyMeshLike,
    *,
    target: TargetName = "any",
    effort: EffortName = "normal",
    keep: KeepName | Sequence[KeepName] = (),
    boundary: Literal["keep", "slide", "split"] | None = None,
    size_field: SizeField | None = None,
    tensor: Sequence[float] | None = None,
    time_limit: float | None = None,
    threads: int | None = None,
    progress: bool | Callable[[Progress], Any] | None = None,
    hooks: Hooks | None = None,
    options: OptimizeOptions | OptionsAndProblem | None = None,
) -> OptimizeReport:
    """Improves a mesh in place: moves vertices, changes weights and flips edges until every triangle is well-centered.

    In a mesh of tetrahedra, orthocenters come inside their tetrahedra. ``size_field``, ``tensor``, ``hooks`` and many
    options are for triangles alone, and options that begin with ``tets_`` for tetrahedra: an error names them. Where
    tetrahedra stay bad, vertices are inserted and removed.

    A triangle is well-centered when its orthocenter is strictly inside and each of its edges is crossed by its dual:
    all h > 0 and all 0 < d < ℓ. Every triangle stays counter-clockwise. The domain boundary, fixed vertices and
    constrained edges stay, bit for bit, unless ``boundary`` and the option ``interfaces`` allow changes. For barriers
    (``BP``, ``BHs``, ``BH``) the result never has more triangles that are not well-centered than the input. For HOT
    energies (``F``, ``T``, ``dT``) it may have more. Equal inputs, options and seeds give equal bits for any number of
    threads. Data of points follow ``Mesh.point_data_rules``.

    Parameters
    ----------
    mesh : Mesh, TetMesh, or of another library
        The mesh, changed in place. To keep the original, optimize ``mesh.copy()``.
    target : str
        Use of the mesh.

        [target]
    effort : str
        Time that the run may take for repairs and lower errors.

        [effort]
    keep : str or sequence of str
        Parts of the mesh that stay.

        [keep]
    boundary : str, optional
        Treatment of the boundary. ``"keep"``: it stays bit for bit, the default. ``"slide"``: its vertices may move
        along straight pieces. ``"split"``: long edges next to short ones are cut.
    size_field : SizeField, optional
        Size field to compare sizes with. None: the input's own sizes.
    tensor : sequence of float, optional
        kxx, kxy, kyy of a constant diffusion tensor K, for −div(K ∇u). Triangles become well-centered in its metric.
        The report and the snapshots are in this metric too. Not with ``size_field`` and a tracer.
    time_limit : float, optional
        Time limit in seconds. The run then ends with the best mesh so far. None: no limit.
    threads : int, optional
        Number of threads; None or 0: as many as the machine has. The result does not depend on it.
    progress : bool or callable, optional
        Progress line. None: on a terminal and in notebooks, but not in a pipe. False: never. True: lines in a pipe too.
        A function gets a ``Progress`` at least once per sweep. If it returns False, the run stops. An exception stops
        the run too, and is raised again when the mesh has its best state.
    hooks : Hooks, optional
        Listeners and ranks.
    options : dict or OptimizeOptions, optional
        Further options by name, such as ``{"energy": "F", "max_sweeps": 20}``. They override the options that
        ``target``, ``effort`` and ``keep`` set. ``help(temper.OptimizeOptions)`` explains each. In a dict,
        ``"problem"`` is your own problem: a dict with ``dirichlet``, and perhaps ``neumann``, ``source`` and
        ``coefficient``, as in ``measure_diffusion_errors``. The run lowers its error. This needs the target ``vertex``
        or ``cell``.

    Returns
    -------
    OptimizeReport

    Raises
    ------
    TypeError
        An option of the wrong type, or an option for triangles with a mesh of tetrahedra. The mesh is unchanged.
    TemperError
        An option out of range, options that contradict each other, weights that hide a vertex, or a mesh outside the
        barrier of BH or BHs. With ranks: on all ranks, if their meshes or options differ (``rank_mismatch``). The mesh
        is unchanged.
    KeyboardInterrupt
        Ctrl-C stopped the run, and the mesh is the best valid one so far.

    Notes
    -----
    O(sweeps · n). The GIL is released. During the run the mesh shows its former state and must not be changed.

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
    if not (hooks is None or isinstance(hooks, Hooks)):
        raise TypeError(f"hooks: expected Hooks, found {hooks!r}")
    hooks = hooks or Hooks()
    if size_field is not None and not isinstance(size_field, SizeField):
        raise TypeError(f"size_field: expected a SizeField or None, found {type(size_field).__name__}")
    for name, given in (("progress", progress), ("tracer", hooks.tracer), ("snapshots", hooks.snapshots)):
        if not (given is None or callable(given) or (name == "progress" and isinstance(given, bool))):
            raise TypeError(f"{name}: expected a function, found {given!r}")
    if tensor is not None:
        for name, given in (("size_field", size_field), ("tracer", hooks.tracer)):
            if given is not None:
                raise ValueError(f"{name}: is of the mesh's plane, and does not go with tensor")
    observer = progress if callable(progress) else None
    own: Any = None
    if isinstance(options, Mapping):
        options = dict(options)  # type: ignore[assignment]
        own = options.pop("problem", None)  # type: ignore[union-attr]
    changes = {"boundary": boundary, "time_limit": time_limit}
    plain = settled(target, effort, keep, options, **changes)._plain()
    changed = as_any_mesh(mesh, in_place=True)
    is_silent = observer is not None or _is_helper(hooks.communicator)
    line = Line(False if is_silent else progress, "tetrahedra" if isinstance(changed, TetMesh) else "triangles")
    watch = _observer(line, observer)
    _temper.check_cells(plain, target, _words(keep), rows_set(options, changes), isinstance(changed, TetMesh))
    if isinstance(changed, TetMesh):
        expect_no_options_of_triangles(optimize, size_field=size_field, tensor=tensor, problem=own, **vars(hooks))
        with _put_back_at_end(mesh, changed, line):
            report, of_data, lost = _temper.tet_optimize(changed._handle, plain, threads, watch)
        for sentence in lost:
            warnings.warn(sentence, TemperWarning, stacklevel=2)
        data = None if of_data is None else DataReport._of(of_data)
        return _report({**report, "objective": report["history"][-1]["objective"], "hidden": np.empty(0, dtype=np.int32), "notes": []}, data)
    problem = None if own is None else _plain_problem(changed, **own)
    for sentence in () if problem is None else _temper.problem_warnings(changed._handle, problem):
        warnings.warn(sentence, TemperWarning, stacklevel=2)
    tracer, snapshots = hooks.tracer, hooks.snapshots
    trace = (lambda event: tracer(TraceEvent(**event))) if tracer is not None else None
    look = (lambda shot: snapshots(Snapshot._of(shot))) if snapshots is not None else None
    field = size_field._handle if size_field is not None else None
    original = changed.copy() if tensor is None and 0 < changed.n_triangles <= PICTURE else None
    with _put_back_at_end(mesh, changed, line):
        report = _temper.optimize(
            changed._handle, plain, field, threads, watch, trace, look, None if tensor is None else tuple(tensor), hooks.communicator,
            _depth(changed, plain), problem,
        )
    data = DataReport._of(_temper.data_report(changed._handle, threads)) if changed._handle.has_data() else None
    if data is not None and data.dropped:
        what = f"point data {', '.join(data.dropped)} are dropped: their whole numbers differ around an inserted vertex"
        warnings.warn(what, TemperWarning, stacklevel=2)
    return _report(report, data, None if original is None else (original, changed.copy()))


@contextlib.contextmanager
def _put_back_at_end(mesh: AnyMeshLike, changed: Mesh | TetMesh, line: Line) -> Iterator[None]:
    """Writes the changed mesh into the mesh of another library that it came from, also after an exception."""
    before = changed._handle.version()
    try:
        yield
    finally:
        line.clear()
        if changed is not mesh and changed._handle.version() != before:
            put_back(mesh, changed)


def _depth(mesh: Mesh, options: dict[str, Any]) -> npt.NDArray[np.float64] | None:
    """The depth of water that the guard takes, at each vertex: point data ``depth``, as in the program."""
    if not any(name.startswith("guard") for name in options):
        return None
    depth = mesh.point_data.get("depth")
    return None if depth is None or depth.ndim > 1 else depth.astype(np.float64)


@dataclasses.dataclass(frozen=True, eq=False)
class Replay(Record):
    """The result of ``replay``."""

    mesh: Mesh
    """Mesh that ``optimize`` returned: the same bits, the same slots."""
    vertices: npt.NDArray[np.int32]
    """Number of each vertex in the input, −1 for inserted ones; empty if none was removed or inserted."""


def replay(input: MeshLike, events: Iterable[TraceEvent]) -> Replay:
    """Applies the events of a run (``optimize(tracer=…)``) to its input, and returns a new mesh. TemperError
    ``trace_mismatch`` names the first event, counted from 0, that does not fit."""
    handle, vertices = _temper.replay(as_mesh(input)._handle, (event._plain() for event in events))
    return Replay(Mesh._of(handle), vertices)
