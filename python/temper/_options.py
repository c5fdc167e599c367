"""The options of an optimization from the library's table: names, types, defaults and meanings.

Type checkers read a stub next to the compiled module, which write_stubs.py makes from the same table.
"""

from __future__ import annotations

import dataclasses
import inspect
import itertools
import numbers
import textwrap
import warnings
from typing import Any, Callable, Literal, TypeVar, Union

from . import _temper
from ._errors import TemperWarning
from ._records import Record

@dataclasses.dataclass(frozen=True)
class LengthParameter:
    """A parameter of an energy: γ > 0 of E_BP, −h° ≥ 0 of E_BHs.

    ``scale`` is the unit of ``value``. ``"relative"``: a multiple of the length of each edge, which makes the energy
    exactly scale-free. ``"absolute"``: a length. A plain number is relative.
    """

    value: float
    scale: Literal["absolute", "relative"] = "relative"


LengthParameterLike = Union[LengthParameter, float]


def _length_parameter(name: str, value: LengthParameterLike) -> tuple[float, str]:
    length, scale = (value.value, value.scale) if isinstance(value, LengthParameter) else (value, "relative")
    if not isinstance(length, numbers.Real) or not isinstance(scale, str):
        raise TypeError(f"{name}: expected a number or a LengthParameter, found {value!r}")
    return float(length), scale


TABLE: list[dict[str, Any]] = _temper.option_table()
OPTION_NAMES = tuple(row["name"] for row in TABLE)
EnergyName = Literal[tuple(next(row["choices"] for row in TABLE if row["name"] == "energy"))]
ObjectiveName = Literal[tuple(next(row["choices"] for row in TABLE if row["name"] == "objective"))]
_SOFTENINGS = [row["name"] for row in TABLE if row["type"].startswith("LengthParameterLike")]


def _from_plain(name: str, value: Any) -> Any:
    return LengthParameter(*value) if name in _SOFTENINGS and value is not None else value


def _description(row: dict[str, Any]) -> str:
    """A row in the format of numpydoc."""
    text = row["sentence"][0].upper() + row["sentence"][1:]
    if not row["choices"] and row["range"]:
        text += f"; {row['range']}"
    if row["absent"]:
        text += f". None: {row['absent']}"
    text += f". Default: {_from_plain(row['name'], row['default'])!r}."
    return f"{row['name']} : {row['type']}\n" + textwrap.indent(textwrap.fill(text, 110), "    ")


def _documentation() -> str:
    parts = [
        "All options of ``optimize``. Each is also a keyword of ``optimize``.\n\n"
        "``dataclasses.replace(options, star=0)`` returns changed options.\n\nParameters\n----------"
    ]
    for title, rows in itertools.groupby(TABLE, lambda row: row["group"]):
        parts += [f"\n{title}\n", "\n".join(map(_description, rows))]
    return "\n".join(parts)


def _plain(self: Any) -> dict[str, Any]:
    """The values for the compiled module."""
    values = {name: getattr(self, name) for name in OPTION_NAMES}
    for name in _SOFTENINGS:
        if values[name] is not None:
            values[name] = _length_parameter(name, values[name])
    return values


OptimizeOptions = dataclasses.make_dataclass(
    "OptimizeOptions",
    [(row["name"], row["type"], dataclasses.field(default=_from_plain(row["name"], row["default"]))) for row in TABLE],
    bases=(Record,),
    namespace={"__doc__": _documentation(), "__module__": __name__, "_plain": _plain},
    frozen=True,
)


def changed(options: Any, changes: dict[str, Any]) -> Any:
    """The options (by default the usual ones) with some of them replaced. Warns about options without effect."""
    if options is not None and not isinstance(options, OptimizeOptions):
        raise TypeError(f"options: expected OptimizeOptions, found {type(options).__name__}")
    for name in changes:
        if name not in OPTION_NAMES:
            raise TypeError(f"optimize() got an unexpected keyword argument {name!r}")
    result = dataclasses.replace(options or OptimizeOptions(), **changes)
    for sentence in _temper.idle_options(result._plain(), list(changes)):
        warnings.warn(sentence, TemperWarning, stacklevel=3)
    return result


def paper_method(**changes: Any) -> Any:
    """The options of the paper's Algorithm 1 with all its parts: golden section, flips after the inner iterations have
    converged, unlimited steps, inversions allowed, hidden vertices kept, collapses and the patch test from the first
    sweep, vertex 0 as anchor, γ = 1, vertices in their order, convergence by mean energy. ``changes`` replace some
    options.

    >>> import temper
    >>> temper.paper_method(max_sweeps=20).solver
    'golden'
    """
    return _method("paper", changes)


def odt_method(**changes: Any) -> Any:
    """The options of optimal Delaunay triangulations (Chen and Xu 2004), for comparison. Their energy is ``"ODT"``,
    whose unknowns are positions alone. Weights must be equal. ``changes`` replace some options.

    >>> import temper
    >>> temper.odt_method().energy
    'ODT'
    """
    return _method("odt", changes)


def cvt_method(**changes: Any) -> Any:
    """The options of centroidal Voronoi tessellations (Du, Faber and Gunzburger 1999), for comparison. Their energy is
    ``"F"`` for ★0, the moment of the Voronoi cells about their vertices. Lloyd's iterations lower the same energy.
    Unknowns are positions alone. ``changes`` replace some options.

    >>> import temper
    >>> temper.cvt_method().star
    0
    """
    return _method("cvt", changes)


def _method(method: str, changes: dict[str, Any]) -> Any:
    plain = _temper.methods()[method]
    options = OptimizeOptions(**{name: _from_plain(name, value) for name, value in plain.items()})
    return dataclasses.replace(options, **changes)


F = TypeVar("F", bound=Callable[..., Any])


def shows_options(function: F) -> F:
    """Shows each option to ``help`` and editors instead of ``**changes``."""
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    options = [
        inspect.Parameter(f.name, inspect.Parameter.KEYWORD_ONLY, default=f.default, annotation=f.type)
        for f in dataclasses.fields(OptimizeOptions)
    ]
    function.__signature__ = signature.replace(parameters=own + options)  # type: ignore[attr-defined]
    return function
