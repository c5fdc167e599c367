"""The options of an optimisation, and how calls take them."""

from __future__ import annotations

import dataclasses
import functools
import inspect
import numbers
from typing import Any, Callable, Literal, Optional, TypeVar, Union

from . import _temper
from ._errors import TemperError
from ._records import Record


@dataclasses.dataclass(frozen=True)
class Softening:
    """A parameter of an energy: γ > 0 of E_BP, −h° ≥ 0 of E_BHs.

    ``scale`` says what ``value`` is measured by: ``"relative"``, times the length of each edge, which makes the energy
    exactly scale-free; ``"absolute"``, a length. A plain number stands for a relative one.
    """

    value: float
    scale: Literal["absolute", "relative"] = "relative"


SofteningLike = Union[Softening, float]


def _softening(name: str, value: SofteningLike) -> tuple[float, str]:
    length, scale = (value.value, value.scale) if isinstance(value, Softening) else (value, "relative")
    if not isinstance(length, numbers.Real) or not isinstance(scale, str):
        raise TypeError(f"{name}: expected a number or a Softening, found {value!r}")
    return float(length), scale


EnergyName = Literal["F", "T", "dT", "BH", "BHs", "BP"]


@dataclasses.dataclass(frozen=True)
class AccuracyOptions(Record):
    """Of the objective ``accuracy``. With L the squared length of an edge, G that times its dual length over its
    length, H the difference where G is the sum of the heights times the length on its two sides, δw the difference of
    the weights of its ends and s the local size there, what is lowered is

        E = Σ_edges s⁻² (G/L) [ (α L² + β G²)/4 + ¾ c (α δw² + β H²) ]   [length²]

    which for c = 1 is E_F / s² (eq. 2 of the paper). docs/accuracy.md derives it.
    """

    offset_weight: float = 10.0
    """c ≥ 0: 1 is HOT itself."""
    boundary_offset_weight: float = 18.0
    """Of H² of edges on the boundary; a smaller one is better for vertex-centered solvers, a larger one for
    cell-centered ones. ≥ 0"""
    margin: float = 0.02
    """ε: all h/ℓ, d/ℓ and 1 − d/ℓ stay above it. 0 < ε < 1/4 (equilateral: h/ℓ = 0.289)."""
    barrier: float = 0.003
    """μ > 0 of the logarithms that keep them there, in units of s² a triangle."""
    sweeps: int = 30
    """At most, after those that make every triangle well-centered; ≥ 0."""
    tolerance: float = 1e-5
    """A sweep that changes E and barrier by less than this part of E is the last. ≥ 0"""


@dataclasses.dataclass(frozen=True)
class OptimizeOptions(Record):
    """All options of ``optimize``, which documents them: the same names and defaults.

    ``dataclasses.replace(options, star=0)`` makes others of them; keywords given to ``optimize`` beside them win.
    """

    objective: Literal["energy", "accuracy"] = "energy"
    accuracy: AccuracyOptions = AccuracyOptions()
    energy: EnergyName = "BP"
    star: Literal[0, 1, 2, "all"] = 1
    gamma: Optional[SofteningLike] = None
    h0: Optional[SofteningLike] = None
    boundary_treatment: Literal["as_is", "absolute", "mirrored"] = "as_is"
    solver: Literal["newton", "golden", "alternating"] = "newton"
    unknowns: Literal["positions_and_weights", "positions", "weights"] = "positions_and_weights"
    weights_from: int = 0
    weight_updates: Literal["immediate", "deferred"] = "immediate"
    flips: Literal["immediate", "deferred", "none"] = "immediate"
    inner: int = 1
    outer: int = 0
    flip_limit: Optional[Literal["unlimited", "before", "at", "after"]] = None
    overshoot: float = 1.1
    relaxation: Optional[float] = None
    newton_passes: bool = True
    interfaces: Literal["fixed", "sliding"] = "fixed"
    boundary: Literal["keep", "slide", "split"] = "keep"
    boundary_ratio: float = 4.0
    inversion: Literal["refuse", "allow"] = "refuse"
    hidden: Literal["undo", "remove", "keep"] = "undo"
    order: Literal["hilbert", "input", "reverse", "random"] = "hilbert"
    anchor: Optional[int] = None
    collapse_from: Optional[int] = None
    collapse_energy: Literal["F", "T", "dT"] = "dT"
    collapse_ratio: float = 0.1
    removal: Literal["none", "patch"] = "none"
    removal_measure: Literal["sum", "mean", "excess"] = "mean"
    removal_margin: float = 0.1
    removal_from: int = 10
    repair: Literal["none", "moves", "vertices"] = "moves"
    repair_trials: int = 20000
    max_sweeps: int = 1000
    tolerance: float = 1e-5
    stopping: Literal["relative", "paper"] = "relative"
    size_band: Optional[float] = None
    time_limit: float = 0.0
    seed: int = 1

    def _plain(self) -> dict[str, Any]:
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        for name in ("gamma", "h0"):
            if values[name] is not None:
                values[name] = _softening(name, values[name])
        if not isinstance(self.accuracy, AccuracyOptions):
            raise TypeError(f"accuracy: expected AccuracyOptions, found {self.accuracy!r}")
        values["accuracy"] = {f.name: getattr(self.accuracy, f.name) for f in dataclasses.fields(self.accuracy)}
        return values


OPTION_NAMES = tuple(f.name for f in dataclasses.fields(OptimizeOptions))


def _options_from_plain(values: dict[str, Any]) -> OptimizeOptions:
    for name in ("gamma", "h0"):
        if values[name] is not None:
            values[name] = Softening(*values[name])
    if "accuracy" in values:
        values["accuracy"] = AccuracyOptions(**values["accuracy"])
    return OptimizeOptions(**values)


def paper_method(**changes: Any) -> OptimizeOptions:
    """The options of the paper's Algorithm 1 with all its parts: golden section, flips after the inner iterations have
    converged, unlimited steps, inversions allowed, hidden vertices kept, collapses and the patch test from the first
    sweep, vertex 0 as anchor, γ = 1, vertices in their order, convergence by mean energy. ``changes`` replace some.

    >>> import temper
    >>> temper.paper_method(max_sweeps=20).solver
    'golden'
    """
    return dataclasses.replace(_options_from_plain(_temper.paper_method()), **changes)


F = TypeVar("F", bound=Callable[..., Any])


def knows_given(function: F) -> F:
    """Tells the function, as ``_given``, the names of the keywords that a call gave: those win over ``options`` even
    where they say what the default says. Its signature stays the documented one."""

    @functools.wraps(function)
    def call(*args: Any, **keywords: Any) -> Any:
        return function(*args, **keywords, _given=frozenset(keywords))

    signature = inspect.signature(function)
    shown = [p for p in signature.parameters.values() if p.name != "_given"]
    call.__signature__ = signature.replace(parameters=shown)  # type: ignore[attr-defined]
    return call  # type: ignore[return-value]


def merge(options: OptimizeOptions | None, values: dict[str, Any], given: frozenset[str]) -> dict[str, Any]:
    """The options as the compiled half takes them."""
    if options is not None and not isinstance(options, OptimizeOptions):
        raise TypeError(f"options: expected OptimizeOptions, found {type(options).__name__}")
    if options is None:
        merged = OptimizeOptions(**{name: values[name] for name in OPTION_NAMES})
    else:
        merged = dataclasses.replace(options, **{name: values[name] for name in OPTION_NAMES if name in given})
    plain = merged._plain()
    # Of one value of options, a call may well turn the objective off.
    meant = "accuracy" in given or ("objective" not in given and merged.accuracy != AccuracyOptions())
    if merged.objective == "energy" and meant:
        raise TemperError("invalid_option", "", 'accuracy: expected only with objective="accuracy"; found "energy"')
    return plain
