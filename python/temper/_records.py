"""Reports are dataclasses that show themselves as text, and as tables in notebooks."""

from __future__ import annotations

import dataclasses
import html
import keyword
import math
from typing import Any, TypeVar

import numpy as np

_T = TypeVar("_T")

_SHOWN = 12  # longer arrays and lists are described by their shape


def expect(name: str, value: Any, kind: type[_T]) -> _T:
    """The value, which must be of this class. TypeError: it is of another one."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise TypeError(f"{name}: expected {article} {kind.__name__}, found {type(value).__name__}")
    return value


def pair(name: str, value: Any) -> tuple[float, float]:
    """Two numbers. TypeError: something else."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__getitem__") or not hasattr(value, "__len__") or isinstance(value, dict):
        raise TypeError(f"{name}: expected two numbers, found {value!r}")
    if len(value) != 2:
        raise ValueError(f"{name}: expected two numbers, found {len(value)}")
    return float(value[0]), float(value[1])


def show(value: Any) -> str:
    """One value in a few characters."""
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, np.ndarray):
        return f"array {value.dtype} {'×'.join(map(str, value.shape))}"
    if isinstance(value, (list, tuple)) and (len(value) > _SHOWN or any(dataclasses.is_dataclass(v) for v in value)):
        return f"{len(value)} {type(value[0]).__name__}" if value else "none"
    if isinstance(value, (list, tuple)):
        return ", ".join(show(v) for v in value) if value else "none"
    if isinstance(value, dict):
        return "; ".join(f"{k}: {show(v)}" for k, v in value.items())
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return type(value).__name__
    return str(value)


def table(title: str, rows: list[tuple[str, str]], after: str = "") -> str:
    """Rows of names and values as HTML; the HTML in ``after`` follows."""
    body = "".join(
        f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
        f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
        for name, value in rows
    )
    return f"<div><b>{html.escape(title)}</b><table>{body}</table>{after}</div>"


def same(a: Any, b: Any) -> bool:
    """Says whether two values of fields are equal."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b, equal_nan=np.asarray(a).dtype.kind == "f")
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (a != a and b != b)
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    return bool(a == b)


CLASSES: dict[str, type[Record]] = {}
"""Classes of records by the names of their tables."""


def made(name: str, fields: dict[str, Any]) -> Record:
    """The report whose fields the compiled half has read by their table."""
    return CLASSES[name](**{key + "_" * keyword.iskeyword(key): value for key, value in fields.items()})


class Record:
    """Base of the reports: text for ``print``, a table in notebooks, plain values from ``as_dict``."""

    def __init_subclass__(cls) -> None:
        CLASSES[cls.__name__] = cls

    def __eq__(self, other: object) -> bool:
        """Says whether all values are equal; NaN is equal to itself."""
        names = [f.name for f in dataclasses.fields(self) if f.compare]  # type: ignore[arg-type]
        return type(other) is type(self) and all(same(getattr(self, n), getattr(other, n)) for n in names)

    __hash__ = None  # type: ignore[assignment]

    def _rows(self) -> list[tuple[str, str]]:
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        return [(f.name, show(getattr(self, f.name))) for f in fields if f.repr]

    def __str__(self) -> str:
        rows = self._rows()
        width = max(len(name) for name, _ in rows)
        return "\n".join([type(self).__name__, *(f"  {name:<{width}}  {value}" for name, value in rows)])

    def _repr_html_(self) -> str:
        return table(type(self).__name__, self._rows())

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers, strings, lists and dictionaries for ``json.dump``. Infinite numbers and NaN become None, as in
        the reports of the program."""
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        return {f.name: plain(getattr(self, f.name)) for f in fields if f.repr}


def merged(values: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """The values, with some of them replaced."""
    return {**values, **changes}


def plain(value: Any) -> Any:
    """The value without NumPy and dataclasses."""
    if isinstance(value, Record):
        return value.as_dict()
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items()}
    return value
