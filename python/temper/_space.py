"""The space of a mesh."""

from __future__ import annotations

import dataclasses
import math
from typing import Literal

from ._errors import TemperError


@dataclasses.dataclass(frozen=True, repr=False)
class Space:
    """The plane, ``Space()``, a sphere around the origin, ``Space.sphere(radius)``, or a periodic plane,
    ``Space.periodic(x, y)``. Immutable.

    On the sphere of radius R a vertex at p, \\|p\\| = R, with weight w is the weighted vector P = p √(R² + w)/R. Its
    direction is the place, and \\|P\\|² = R² + w. The regular triangulation is the boundary of the convex hull of all
    P.

    In a periodic plane a vertex has images, whole periods away. A mesh has the image in the domain, from 0 to the
    period. An edge is the shortest way between images of its ends; triangles fit into half a period along each axis.

    >>> from temper import Space
    >>> Space.sphere(6371e3), Space().is_plane
    (Space.sphere(6371000.0), True)
    >>> Space.periodic(2, 0).period
    (2.0, 0.0)
    """

    radius: float = 0.0
    """Radius of the sphere [length]; 0 in the plane."""
    period: tuple[float, float] = (0.0, 0.0)
    """Periods of a periodic plane along x and y [length]; 0 if there is none."""

    def __post_init__(self) -> None:
        x, y = (float(length) for length in self.period)
        if not (math.isfinite(x) and math.isfinite(y) and x >= 0 and y >= 0 and (self.radius == 0 or x == y == 0)):
            found = f"the periods of a plane are {x} and {y}"
            raise TemperError("invalid_option", "", f"{found}; expected finite lengths, 0 for none, and no radius")
        object.__setattr__(self, "period", (x, y))
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

    @classmethod
    def periodic(cls, x: float, y: float) -> Space:
        """The plane with these periods along x and y, which a mesh rounds to about 14 digits. 0 means none along that
        axis. TemperError unless they are finite, none is negative, and one is positive."""
        if x == 0 and y == 0:
            raise TemperError("invalid_option", "", "the periods of a plane are 0 and 0; expected one that is positive")
        return cls(period=(x, y))

    @property
    def kind(self) -> Literal["plane", "sphere", "periodic_plane"]:
        """``"plane"``, ``"sphere"`` or ``"periodic_plane"``."""
        return "periodic_plane" if self.is_periodic else "plane" if self.is_plane else "sphere"

    @property
    def is_plane(self) -> bool:
        """Says whether it is the plane, periodic or not."""
        return self.radius == 0

    @property
    def is_periodic(self) -> bool:
        """Says whether it is a periodic plane."""
        return self.period != (0.0, 0.0)

    def __repr__(self) -> str:
        if self.is_periodic:
            return f"Space.periodic{self.period!r}"
        return "Space()" if self.is_plane else f"Space.sphere({self.radius!r})"
