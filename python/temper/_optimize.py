"""Algorithm 1 of the paper: makes meshes well-centered, in place."""

from __future__ import annotations

import contextlib
import dataclasses
import warnings
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Literal, Mapping, Sequence, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._errors import TemperError, TemperWarning
from ._measure_errors import _plain_problem
from ._mesh import PICTURE, Mesh, MeshLike, as_mesh, put_back
from ._options import EffortName, KeepName, OptimizeOptions, TargetName, _words, lists_presets, rows_set, settled
from ._progress import Line
from ._records import Record
from ._reports import OptimizeReport, Progress, SurfaceOptimizeReport, TraceEvent
from ._tensor import CORNER_WEIGHTS, TensorLike, plain_tensor
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_planes, expect_no_options_of_triangles
from .size import SizeField

if TYPE_CHECKING:
    from ._options import OptionsAndProblem


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


def _observer(line: Line, observer: Callable[[Progress], Any] | None) -> Callable[..., bool] | None:
    if not line.enabled and observer is None:
        return None

    def tell(progress: Progress) -> bool:
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


@overload
def optimize(
    mesh: SurfaceMesh, *, target: TargetName = ..., effort: EffortName = ..., keep: KeepName | Sequence[KeepName] = ...,
    time_limit: float | None = ..., threads: int | None = ..., progress: bool | Callable[[Progress], Any] | None = ...,
    options: OptimizeOptions | OptionsAndProblem | None = ...,
) -> SurfaceOptimizeReport: ...  # fmt: skip
@overload
def optimize(
    mesh: TetMesh | MeshLike, *, target: TargetName = ..., effort: EffortName = ..., keep: KeepName | Sequence[KeepName] = ...,
    boundary: Literal["keep", "slide", "split"] | None = ..., size_field: SizeField | None = ..., tensor: TensorLike | None = ...,
    time_limit: float | None = ..., threads: int | None = ..., progress: bool | Callable[[Progress], Any] | None = ...,
    hooks: Hooks | None = ..., options: OptimizeOptions | OptionsAndProblem | None = ...,
) -> OptimizeReport: ...  # fmt: skip
@lists_presets
def optimize(
    mesh: AnyMeshLike,
    *,
    target: TargetName = "any",
    effort: EffortName = "normal",
    keep: KeepName | Sequence[KeepName] = (),
    boundary: Literal["keep", "slide", "split"] | None = None,
    size_field: SizeField | None = None,
    tensor: TensorLike | None = None,
    time_limit: float | None = None,
    threads: int | None = None,
    progress: bool | Callable[[Progress], Any] | None = None,
    hooks: Hooks | None = None,
    options: OptimizeOptions | OptionsAndProblem | None = None,
) -> OptimizeReport | SurfaceOptimizeReport:
    """Improves a mesh in place: moves vertices, changes weights and flips edges until every triangle is well-centered.

    In a mesh of tetrahedra, orthocenters come inside their tetrahedra. ``size_field``, ``hooks`` and many
    options are for triangles alone, and options that begin with ``tets_`` for tetrahedra: an error names them. Where
    tetrahedra stay bad, vertices are inserted and removed. Vertices of a curved surface stay near it, within the option
    ``surface_distance`` (docs/howto/surfaces.md); ``tensor``, ``size_field`` and ``hooks`` are not for surfaces.

    A triangle is well-centered when its orthocenter is strictly inside and each of its edges is crossed by its dual:
    all h > 0 and all 0 < d < ℓ. Every triangle stays counter-clockwise. The domain boundary, fixed vertices and
    constrained edges stay, bit for bit, unless ``boundary`` and the option ``interfaces`` allow changes. For barriers
    (``BP``, ``BHs``, ``BH``) the result never has more triangles that are not well-centered than the input. For HOT
    energies (``F``, ``T``, ``dT``) it may have more. Equal inputs, options and seeds give equal bits for any number of
    threads. Data follow ``Mesh.point_data_rules`` and ``Mesh.cell_data_rules``.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
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
        along straight pieces, and on curved surfaces along boundary, creases and lines. ``"split"``: long edges next to short ones are cut.
    size_field : SizeField, optional
        Size field to compare sizes with. None: the input's own sizes.
    tensor : sequence of float, (m, 3) array, or dict of region to sequence, optional
        kxx, kxy, kyy of a diffusion tensor K, for −div(K ∇u): of the mesh, of each triangle, or of each region by its
        tag or name. Triangles become well-centered in the metric of their tensor. The report and the snapshots are in
        this metric too. For tetrahedra kxx, kxy, kxz, kyy, kyz, kzz, and (m, 6). Where tensors differ, vertices stay,
        and they get a weight for each region, which
        ``mesh.cell_data["corner_weights"]`` holds. Not with ``size_field`` and a tracer.
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
    OptimizeReport, or SurfaceOptimizeReport for a curved surface

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
    _temper.check_cells(plain, target, _words(keep), rows_set(options, changes), changed._handle)
    if not isinstance(changed, Mesh):
        refuse = expect_no_options_of_triangles if isinstance(changed, TetMesh) else expect_no_options_of_planes
        refuse(optimize, size_field=size_field, problem=own, **vars(hooks))
        with _put_back_at_end(mesh, changed, line):
            report, data, lost = _temper.optimize_in_space(
                changed._handle, plain, threads, watch, plain_tensor(changed, tensor)
            )
        for sentence in lost:
            warnings.warn(sentence, TemperWarning, stacklevel=2)
        return dataclasses.replace(report, data=data)
    problem = None if own is None else _plain_problem(changed, **own)
    for sentence in () if problem is None else _temper.problem_warnings(changed._handle, problem):
        warnings.warn(sentence, TemperWarning, stacklevel=2)
    snapshots = hooks.snapshots
    look = (lambda shot: snapshots(Snapshot._of(shot))) if snapshots is not None else None
    field = size_field._handle if size_field is not None else None
    original = changed.copy() if tensor is None and 0 < changed.n_triangles <= PICTURE else None
    with _put_back_at_end(mesh, changed, line):
        report, corner_weights = _temper.optimize(
            changed._handle, plain, field, threads, watch, hooks.tracer, look, plain_tensor(changed, tensor), hooks.communicator,
            _depth(changed, plain), problem,
        )
        if corner_weights is not None:
            changed.cell_data[CORNER_WEIGHTS] = corner_weights
    data = _temper.data_report(changed._handle, threads) if changed._handle.has_data() else None
    if data is not None and data.dropped:
        what = f"point data {', '.join(data.dropped)} are dropped: their whole numbers differ around an inserted vertex"
        warnings.warn(what, TemperWarning, stacklevel=2)
    return dataclasses.replace(report, data=data, _meshes=None if original is None else (original, changed.copy()))


@contextlib.contextmanager
def _put_back_at_end(mesh: AnyMeshLike, changed: Mesh | TetMesh | SurfaceMesh, line: Line) -> Iterator[None]:
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
    handle, vertices = _temper.replay(as_mesh(input)._handle, (vars(event) for event in events))
    return Replay(Mesh._of(handle), vertices)
