"""The options of an optimization from the library's table: names, types, defaults and meanings.

Type checkers read a stub next to the compiled module, which write_stubs.py makes from the same table.
"""

from __future__ import annotations

import dataclasses
import itertools
import numbers
import textwrap
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Callable, Literal, TypeVar, Union

from . import _temper
from ._errors import TemperWarning
from ._records import Record

F = TypeVar("F", bound=Callable[..., Any])


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
        "All options of ``optimize``, which takes them as ``options``.\n\n"
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


def settled(target: str, effort: str, keep: Any, options: Any, **changes: Any) -> Any:
    """The options of a run: those of the words, with ``options`` and ``changes`` on top. None changes nothing.

    Warns about options without effect.
    """
    changes = {name: value for name, value in changes.items() if value is not None}
    if not (options is None or isinstance(options, (OptimizeOptions, Mapping))):
        raise TypeError(f"options: expected a dict or OptimizeOptions, found {options!r}")
    if isinstance(options, OptimizeOptions):
        if (target, effort, keep) != ("any", "normal", ()):
            raise TypeError("options: has all options already, so target, effort and keep have no effect; expected a dict")
        return dataclasses.replace(options, **changes)
    result = _options_for(target, effort, keep, {**(options or {}), **changes})
    plain = result._plain()
    _temper.check_words(plain, target, _words(keep))
    for sentence in _temper.idle_options(plain, list(options or {})):
        warnings.warn(sentence, TemperWarning, stacklevel=3)
    return result


def rows_set(options: Any, changes: Mapping[str, Any]) -> list[str]:
    """Names of the options that a user set; of an ``OptimizeOptions`` those that no effort sets so."""
    names: Sequence[str] = tuple(options or ()) if not isinstance(options, OptimizeOptions) else ()
    if isinstance(options, OptimizeOptions):
        usual = [_options_for("any", effort, (), {}) for effort in PRESETS["effort"]]
        names = [name for name in OPTION_NAMES if getattr(options, name) not in [getattr(each, name) for each in usual]]
    return [*names, *(name for name, value in changes.items() if value is not None)]


def _words(keep: Any) -> tuple[str, ...]:
    words = (keep,) if isinstance(keep, str) else tuple(keep)
    for word in words:
        if not isinstance(word, str):
            raise TypeError(f"keep: expected words, found {word!r}")
    return words


def _options_for(target: str, effort: str, keep: Any, changes: Mapping[str, Any]) -> Any:
    for name, word in (("target", target), ("effort", effort)):
        if not isinstance(word, str):
            raise TypeError(f"{name}: expected a word, found {word!r}")
    for name in changes:
        if name not in OPTION_NAMES:
            guess = _temper.did_you_mean(str(name), list(OPTION_NAMES)) or "; help(temper.OptimizeOptions) lists all"
            raise TypeError(f"there is no option {name!r}{guess}")
    plain = _temper.options_for(target, effort, _words(keep))
    options = OptimizeOptions(**{name: _from_plain(name, value) for name, value in plain.items()})
    return dataclasses.replace(options, **changes)


PRESETS: dict[str, dict[str, str]] = _temper.presets()
TargetName = Literal[tuple(PRESETS["target"])]
EffortName = Literal[tuple(PRESETS["effort"])]
KeepName = Literal[tuple(PRESETS["keep"])]


def lists_presets(function: F) -> F:
    """Puts the words of target, effort and keep into a docstring, as lists."""
    for name, words in PRESETS.items():
        lines = "\n".join(f"        - ``{word}``: {meaning}." for word, meaning in words.items())
        if name == "target":
            solvers = ", ".join(f"``{solver}`` ({target})" for solver, target in _temper.solver_targets().items())
            lines += f"\n\n        The name of a solver stands for its target: {solvers}."
        function.__doc__ = (function.__doc__ or "").replace(f"        [{name}]", lines)
    return function


@lists_presets
def options_for(target: str = "any", effort: str = "normal", keep: Any = (), **changes: Any) -> Any:
    """Returns the options for a target, an effort and parts of the mesh to keep.

    Parameters
    ----------
    target : str
        Use of the mesh.

        [target]
    effort : str
        Time that the run may take.

        [effort]
    keep : str or sequence of str
        Parts of the mesh that stay.

        [keep]
    **changes
        Options of ``OptimizeOptions`` that replace the values of these words.

    Returns
    -------
    OptimizeOptions

    Raises
    ------
    TemperError
        An unknown word, or parts to keep that leave nothing to change.
    TypeError
        An unknown option.

    Examples
    --------
    >>> import temper
    >>> temper.options_for("paper", max_sweeps=20).solver
    'golden'
    >>> temper.options_for("mpas").unknowns
    'positions'
    """
    return _options_for(target, effort, keep, changes)
