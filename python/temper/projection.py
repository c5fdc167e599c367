"""Maps between longitude and latitude and the plane, by conformal maps of the sphere.

They keep angles. So a mesh that is well-centered on the map is well-centered on the globe, up to the curvature of
single triangles. The Earth is a sphere of 6371 km. Formulas: J. P. Snyder, Map Projections: A Working Manual, USGS
Professional Paper 1395, 1987.
"""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import _doubles
from ._outline import Outline
from ._records import Record, expect

__all__ = [
    "Projection", "direction_of", "forward", "inverse", "lon_lat_of", "mean_place", "parse_projection", "project",
    "scale_factor",
]  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Projection(Record):
    """Longitudes and latitudes are in degrees, x and y in meters from the center."""

    kind: Literal["stereographic", "mercator", "transverse_mercator"] = "stereographic"
    """Kind of the map. stereographic: best for round regions, poles included; mercator: for belts along the center's
    parallel; transverse_mercator: for strips along its meridian."""
    center: tuple[float, float] = (0.0, 0.0)
    """Longitude and latitude."""
    radius: float = 6371000.0
    """Radius of the sphere [m]."""

    def _plain(self) -> tuple[str, float, float, float]:
        return self.kind, self.center[0], self.center[1], self.radius


def parse_projection(text: str, places: npt.ArrayLike | None = None) -> Projection:
    """Reads ``"stereographic"``, ``"mercator:lon"``, ``"transverse-mercator:lon,lat"``. Without a center, the center
    of ``places``, (k, 2), is used."""
    return Projection(*_temper.parse_projection(text, _doubles(places, 2, "places")))


def forward(projection: Projection, lon_lat: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Places on the map, (k, 2) [m], from (k, 2) longitudes and latitudes [degrees]; inf if the map has no end
    there."""
    return _temper.forward(*expect("projection", projection, Projection)._plain(), _doubles(lon_lat, 2, "lon_lat"))


def inverse(projection: Projection, places: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Longitudes, in [center − 180, center + 180], and latitudes [degrees], (k, 2), from (k, 2) places on the map."""
    return _temper.inverse(*expect("projection", projection, Projection)._plain(), _doubles(places, 2, "places"))


def scale_factor(projection: Projection, lon_lat: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Length on the map over length on the sphere, (k,): the same in all directions."""
    return _temper.scale_factor(*expect("projection", projection, Projection)._plain(), _doubles(lon_lat, 2, "lon_lat"))


def direction_of(lon_lat: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Unit vectors, (k, 3), from (k, 2) longitudes and latitudes [degrees]; exact on the axes."""
    return _temper.direction_of(_doubles(lon_lat, 2, "lon_lat"))


def lon_lat_of(directions: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Longitudes, above −180 and up to 180, and latitudes [degrees], (k, 2), from (k, 3) vectors of any length."""
    return _temper.lon_lat_of(_doubles(directions, 3, "directions"))


def mean_place(lon_lat: npt.ArrayLike) -> tuple[float, float]:
    """The middle of places on the sphere: the direction of their sum."""
    return _temper.mean_place(_doubles(lon_lat, 2, "lon_lat"))


def project(outline: Outline, projection: Projection) -> Outline:
    """Maps an outline. TemperError, with its names: latitudes beyond the poles, longitudes beyond ±360, places that are
    infinitely far away, segments that are torn apart because the map ends between their ends."""
    plain = expect("outline", outline, Outline)._plain()
    projected = Outline._of(_temper.project(plain, *expect("projection", projection, Projection)._plain()))
    projected._degrees = (*expect("projection", projection, Projection)._plain(), plain["points"])
    return projected
