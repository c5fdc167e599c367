"""The space that a mesh lies in."""

from __future__ import annotations

import dataclasses
import math
from typing import Literal

from ._errors import TemperError


@dataclasses.dataclass(frozen=True, repr=False)
class Space:
    """The plane, ``Space()``, or a sphere around the origin, ``Space.sphere(radius)``. Immutable.

    On the sphere of radius R a vertex at p, \\|p\\| = R, with weight w is the lifted point P = p √(R² + w)/R: its
    direction is the place, and \\|P\\|² = R² + w. The regular triangulation is the boundary of the convex hull of all
    P.

    >>> from temper import Space
    >>> Space.sphere(6371e3), Space().is_plane
    (Space.sphere(6371000.0), True)
    """

    radius: float = 0.0
    """Of the sphere [length]; 0 of the plane."""

    def __post_init__(self) -> None:
        if not (math.isfinite(self.radius) and self.radius >= 0):
            found = f"the radius of a sphere is {self.radius}; expected a positive, finite number"
            raise TemperError("invalid_option", "", found)
        object.__setattr__(self, "radius", float(self.radius))

    @classmethod
    def sphere(cls, radius: float) -> Space:
        """The sphere around the origin. TemperError unless the radius is positive and finite."""
        if radius == 0:
            raise TemperError("invalid_option", "", "the radius of a sphere is 0; expected a positive, finite number")
        return cls(radius)

    @property
    def kind(self) -> Literal["plane", "sphere"]:
        """``"plane"`` or ``"sphere"``."""
        return "plane" if self.is_plane else "sphere"

    @property
    def is_plane(self) -> bool:
        """Whether it is the plane."""
        return self.radius == 0

    def __repr__(self) -> str:
        return "Space()" if self.is_plane else f"Space.sphere({self.radius!r})"
