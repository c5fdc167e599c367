"""Algorithm 1 of the paper: meshes made well-centered, in place."""

from __future__ import annotations

import dataclasses
from typing import Any, Callable, Iterable, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh, put_back
from ._options import (
    OPTION_NAMES,
    AccuracyOptions,
    EnergyName,
    OptimizeOptions,
    SofteningLike,
    knows_given,
    merge,
)
from ._progress import Line, Progress, SweepRecord
from ._records import Record
from ._size import SizeField, SizeReport, _size_report
from ._trace import Snapshot, TraceEvent


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
    regular; ``hidden``: deferred flips hid a vertex that ``hidden="undo"`` keeps; ``accuracy_sweeps``: the second phase
    of the objective ``accuracy`` made all its sweeps, a normal end."""
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
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """``history[0]`` is the input."""
    notes: list[str]
    """What the user should know, in sentences."""

    def _rows(self) -> list[tuple[str, str]]:
        bad = [str(record.bad) for record in (self.history[:1] + self.history[-1:])]
        rows = [row for row in super()._rows() if row[0] not in ("vertices", "hidden", "size", "notes")]
        rows.insert(1, ("bad triangles", " → ".join(bad)))
        rows.append(("sizes within", f"1/{self.size.after.band:.3g} to {self.size.after.band:.3g} of the field"))
        return rows + [("note", note) for note in self.notes]

    def as_dict(self) -> dict[str, Any]:
        """As ``Record.as_dict``, with the history."""
        return {**super().as_dict(), "history": [record.as_dict() for record in self.history]}


def _report(d: dict[str, Any]) -> OptimizeReport:
    size = SizeChange(_size_report(d.pop("size_before")), _size_report(d.pop("size_after")))
    history = [SweepRecord(**record) for record in d.pop("history")]
    return OptimizeReport(**d, size=size, history=history)


def _observer(line: Line, observer: Callable[[Progress], Any] | None) -> Callable[..., bool] | None:
    if not line.enabled and observer is None:
        return None

    def tell(last: dict[str, Any], fraction: float, max_sweeps: int) -> bool:
        progress = Progress(SweepRecord(**last), fraction, max_sweeps)
        line.show(progress)
        return observer is None or observer(progress) is not False

    return tell


@knows_given
def optimize(
    mesh: MeshLike,
    options: OptimizeOptions | None = None,
    *,
    objective: Literal["energy", "accuracy"] = "energy",
    accuracy: AccuracyOptions = AccuracyOptions(),
    energy: EnergyName = "BP",
    star: Literal[0, 1, 2, "all"] = 1,
    gamma: SofteningLike | None = None,
    h0: SofteningLike | None = None,
    boundary_treatment: Literal["as_is", "absolute", "mirrored"] = "as_is",
    solver: Literal["newton", "golden", "alternating"] = "newton",
    unknowns: Literal["positions_and_weights", "positions", "weights"] = "positions_and_weights",
    weights_from: int = 0,
    weight_updates: Literal["immediate", "deferred"] = "immediate",
    flips: Literal["immediate", "deferred", "none"] = "immediate",
    inner: int = 1,
    outer: int = 0,
    flip_limit: Literal["unlimited", "before", "at", "after"] | None = None,
    overshoot: float = 1.1,
    relaxation: float | None = None,
    newton_passes: bool = True,
    interfaces: Literal["fixed", "sliding"] = "fixed",
    boundary: Literal["keep", "slide", "split"] = "keep",
    boundary_ratio: float = 4.0,
    inversion: Literal["refuse", "allow"] = "refuse",
    hidden: Literal["undo", "remove", "keep"] = "undo",
    order: Literal["hilbert", "input", "reverse", "random"] = "hilbert",
    anchor: int | None = None,
    collapse_from: int | None = None,
    collapse_energy: Literal["F", "T", "dT"] = "dT",
    collapse_ratio: float = 0.1,
    removal: Literal["none", "patch"] = "none",
    removal_measure: Literal["sum", "mean", "excess"] = "mean",
    removal_margin: float = 0.1,
    removal_from: int = 10,
    repair: Literal["none", "moves", "vertices"] = "moves",
    repair_trials: int = 20000,
    max_sweeps: int = 1000,
    tolerance: float = 1e-5,
    stopping: Literal["relative", "paper"] = "relative",
    size_band: float | None = None,
    time_limit: float = 0.0,
    seed: int = 1,
    size_field: SizeField | None = None,
    threads: int | None = None,
    observer: Callable[[Progress], Any] | None = None,
    progress: bool | None = None,
    tracer: Callable[[TraceEvent], Any] | None = None,
    watch: Callable[[Snapshot], Any] | None = None,
    _given: frozenset[str] = frozenset(),
) -> OptimizeReport:
    """Improves a mesh in place: moves vertices, weighs them and flips edges until every triangle is well-centered.

    A triangle is well-centered when its orthocenter is strictly inside and each of its edges is crossed by its dual:
    all h > 0 and all 0 < d < ℓ (docs/concepts.md). The domain boundary, fixed vertices and constrained edges stay, bit
    for bit, unless ``boundary`` and ``interfaces`` say otherwise; every triangle stays counter-clockwise.
    Never gives a worse mesh than the input's. The same input, options and seed give the same bits for any number of
    threads.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        Changed in place. (``optimized`` leaves it alone and gives another one.)
    options : OptimizeOptions, optional
        All options below in one value, such as ``paper_method()``; keywords given beside it win.

    What is minimised

    objective : {"energy", "accuracy"}
        ``accuracy``: the run lowers ``energy``, which has to be a barrier, until all margins are above
        ``accuracy.margin``, or it ends; then what the errors of a solver are proportional to, with the connectivity as
        it is.
    accuracy : AccuracyOptions
        Of that second phase: an error without it.
    energy : {"BP", "BH", "BHs", "F", "T", "dT"}
        Of the registry (``energies()``): the barriers BP, BH, BHs, or a HOT energy.
    star : {0, 1, 2, "all"}
        Hodge star of the energy, or of the objective ``accuracy``, which alone has all.
    gamma : float or Softening, optional
        γ of E_BP, relative to each edge when a plain number. None: shrinking from 0.5, or from 1 where a quarter of 100
        or more triangles is bad, to 0.003, there as soon as none is; when some stay bad, a second attempt from 2.
        Given: constant.
    h0 : float or Softening, optional
        −h° of E_BHs. None: relative, just beyond the worst h/ℓ of the mesh, shrinking as that improves.
    boundary_treatment : {"as_is", "absolute", "mirrored"}
        Of energy F only: the h of the triangle that a boundary edge lacks is 0; \\|h\\|; or as if mirrored at the edge.

    How vertices move

    solver : {"newton", "golden", "alternating"}
        Newton steps in (x, y, w) together; the paper's Algorithm 5, golden section; Newton in (x, y), then in w.
    unknowns : {"positions_and_weights", "positions", "weights"}
        Which unknowns of a vertex move.
    weights_from : int
        i_w: first sweep that changes weights.
    weight_updates : {"immediate", "deferred"}
        A new weight is seen by its neighbours at once, or after the sweep (not with ``solver="newton"``).
    relaxation : float, optional
        Over-relaxation of Newton steps, in (0, 2). None: 1.7, but 1.97 while γ shrinks from 1.
    newton_passes : bool
        Once γ has settled, every triangle is well-centered and sweeps gain less than 1 %, every other sweep makes a
        step of all vertices at once, as long as that gains more. Only for barriers with otherwise default moves.
    order : {"hilbert", "input", "reverse", "random"}
        In which a sweep visits the vertices.
    anchor : int, optional
        Vertex whose weight is shifted to 0 after each sweep (Algorithm 1, line 17).
    inversion : {"refuse", "allow"}
        Steps that would turn a triangle over.
    interfaces : {"fixed", "sliding"}
        Vertices of constrained edges stay, or move along the line when their two constrained edges are collinear.
    boundary : {"keep", "slide", "split"}
        ``slide``: vertices of straight pieces of the boundary, never corners, may move along them; ``split``: long
        edges of boundary and lines beside short ones are cut before the sweeps, and triangles with all corners there
        get a vertex inside.
    boundary_ratio : float
        Of ``split``: most between the lengths of edges that meet there; at least 2.

    Connectivity

    flips : {"immediate", "deferred", "none"}
        Edges are flipped as soon as they stop being regular, or after ``inner`` sweeps; or the connectivity is frozen,
        and no step may make an edge non-regular.
    inner, outer : int
        With deferred flips: most sweeps before edges are flipped (0: until they converge), and most rounds of sweeps
        and flips (0: until no flips are needed).
    flip_limit : {"unlimited", "before", "at", "after"}, optional
        How far a step may go past the point where an edge flips (§2.4). None: unlimited for barriers, after for HOT.
    overshoot : float
        Of ``flip_limit="after"``, at first; it shrinks towards 1 each sweep.
    hidden : {"undo", "remove", "keep"}
        What becomes of vertices whose weight hides them.
    collapse_from : int, optional
        i_c: first sweep with short-edge collapses (Algorithm 2). None: none.
    collapse_energy : {"dT", "F", "T"}
        E_c, which draws a vertex to an edge.
    collapse_ratio : float
        Of the distance to the nearest neighbour to that one's shorter edge on the link.
    removal : {"none", "patch"}
        ``patch``: remove a vertex when its patch is better without it (Algorithm 1, line 15).
    removal_measure : {"mean", "sum", "excess"}
        By what patches are compared: energy per triangle, summed (the paper's), or beyond equilateral triangles.
    removal_margin : float
        By which the patch must be better, relative.
    removal_from : int
        First sweep with removals.
    repair : {"moves", "none", "vertices"}
        What is done about triangles that sweeps of a barrier leave bad: sweeps from a larger γ and random kicks;
        nothing; the same, and vertices are removed and inserted.
    repair_trials : int
        Most edits that are tried, each on a copy of a neighbourhood; 1 to 3 ms each.

    Sizes

    size_field : SizeField, optional
        That sizes are compared with. None: the input's own.
    size_band : float, optional
        B ≥ 1: no step takes the local size of a vertex out of [s/B, B s], s the size field there. One thread.

    When it stops

    max_sweeps : int
        Each repair counts as a sweep of its own.
    tolerance : float
        Stop when a sweep gains less than this.
    stopping : {"relative", "paper"}
        E changed by less than tolerance × E in one sweep, or has not been lower for 25; the paper's: mean energy per
        triangle fell by less than tolerance, or rose.
    time_limit : float
        [seconds]; 0: none.
    seed : int
        Of the jitter that frees symmetric grids, and of repairs.

    The run

    threads : int, optional
        None or 0: as many as the machine has. The result does not depend on it.
    observer : callable, optional
        Called with a ``Progress`` at least once a sweep; returning False stops the run. An exception that it raises
        stops the run too, and is raised again once the mesh has its best state.
    progress : bool, optional
        None: one line on a terminal, and in notebooks; nothing in a pipe. False: never. True: lines in a pipe, too.
    tracer : callable, optional
        Called with each ``TraceEvent``; ``replay`` makes the mesh again from them.
    watch : callable, optional
        Called with a ``Snapshot`` between sweeps; a copy of the mesh each time.

    Returns
    -------
    OptimizeReport

    Raises
    ------
    TypeError
        An option of the wrong type. The mesh is then as it was.
    TemperError
        An option out of range, ``accuracy`` without ``objective="accuracy"``, weights that hide a vertex, a mesh
        outside the barrier of BH or BHs. The mesh is then as it was.
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
    >>> report.stopped, temper.quality(mesh).well_centered_fraction
    ('converged', 1.0)
    """
    values = dict(locals())
    plain = merge(options, {name: values[name] for name in OPTION_NAMES}, _given)
    for name, call in (("observer", observer), ("tracer", tracer), ("watch", watch)):
        if call is not None and not callable(call):
            raise TypeError(f"{name}: expected a callable or None, found {call!r}")
    if size_field is not None and not isinstance(size_field, SizeField):
        raise TypeError(f"size_field: expected a SizeField or None, found {type(size_field).__name__}")
    target = as_mesh(mesh)
    line = Line(progress)
    trace = (lambda event: tracer(TraceEvent(**event))) if tracer is not None else None
    look = (lambda shot: watch(Snapshot._of(shot))) if watch is not None else None
    field = size_field._handle if size_field is not None else None
    before = target._handle.version()
    try:
        report = _temper.optimize(target._handle, plain, field, threads, _observer(line, observer), trace, look)
    finally:
        line.clear()
        if target is not mesh and target._handle.version() != before:
            put_back(mesh, target)
    return _report(report)


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
