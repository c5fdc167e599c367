"""Types of options that several calls take."""

from __future__ import annotations

import dataclasses
import numbers
from typing import Literal, Union


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
