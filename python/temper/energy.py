"""The energies of mesh optimization: their table, and their values and derivatives on a mesh.

>>> from temper import energy, generate
>>> energy.total_energy(generate.annulus(), energy.EnergyModel("F")) > 0
True
"""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, _doubles, as_mesh
from ._options import EnergyName, LengthParameter, LengthParameterLike, _length_parameter
from ._records import Record, expect
from ._space import Space

__all__ = ["EnergyInfo", "EnergyModel", "VertexDerivatives", "energies", "total_energy", "triangle_energy", "vertex_energy"]


@dataclasses.dataclass(frozen=True)
class EnergyInfo(Record):
    """A row of the table of energies."""

    name: EnergyName
    formula: str
    boundary_treatment: Literal["as_is", "absolute", "mirrored"]
    """Treatment of boundary duals in its definition."""
    barrier: bool
    """The energy is infinite outside 0 < d < ℓ."""
    softened_by_gamma: bool
    softened_by_h0: bool
    length_exponent: int
    """Exponent p: E(s · mesh) = s^p · E(mesh) with a relative length parameter."""
    signed_by_dual: bool
    """The sign of an edge is the sign of its dual length."""
    normalized: bool
    """The energy of each triangle is divided by its squared area."""
    positions_alone: bool
    """The energy is for meshes without weights, which stay without."""


def energies() -> list[EnergyInfo]:
    """All energies, for ★s with α = (1/4, 1/3, 1/12), β = (1/12, 1/3, 1/4), per half-edge (eqs. 2 to 7 of the
    paper)."""
    return [EnergyInfo(**row) for row in _temper.energies()]


@dataclasses.dataclass(frozen=True)
class EnergyModel(Record):
    """An energy with all its parameters."""

    energy: EnergyName = "BP"
    star: Literal[0, 1, 2] = 1
    boundary_treatment: Literal["as_is", "absolute", "mirrored"] = "as_is"
    """Boundary treatment of F and nF; the other energies define their own."""
    gamma: LengthParameterLike = LengthParameter(1.0, "absolute")
    """Parameter γ of E_BP; the paper's examples use 1, absolute."""
    h0: LengthParameterLike = LengthParameter(0.0, "absolute")
    """Parameter −h° of E_BHs, ≥ 0."""
    wall: bool = False
    """Make a barrier infinite on inverted triangles too; the paper's E_BP and E_BHs are finite there."""

    def _plain(self) -> dict[str, Any]:
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        return {**values, "gamma": _length_parameter("gamma", self.gamma), "h0": _length_parameter("h0", self.h0)}


def total_energy(mesh: MeshLike, model: EnergyModel = EnergyModel(), *, threads: int | None = None) -> float:
    """The energy of a mesh; inf if any term is outside its domain. Any number of threads gives the same bits."""
    return _temper.total_energy(as_mesh(mesh)._handle, expect("model", model, EnergyModel)._plain(), threads)


def triangle_energy(model: EnergyModel, corners: npt.ArrayLike, *, space: Space = Space()) -> float:
    """The energy of one triangle alone, all its edges boundary edges. ``corners`` is (3, 3) with rows x, y, w; on a
    sphere rows are weighted vectors. On a sphere all energies are computed on the flat triangles of the weighted
    vectors.

    >>> from temper import energy
    >>> model = energy.EnergyModel("BH")
    >>> round(energy.triangle_energy(model, [(0, 0, 0), (1, 0, 0), (0.5, 0.75**0.5, 0)]), 12)
    4.618802153517
    """
    return _temper.triangle_energy(expect("model", model, EnergyModel)._plain(), _doubles(corners, 3, "corners"), space.radius)


@dataclasses.dataclass(frozen=True)
class VertexDerivatives(Record):
    """The energy as a function of one vertex."""

    value: float
    """Value; inf if not feasible."""
    feasible: bool
    """The vertex is inside the domain of the energy; else the rest is zero."""
    gradient: tuple[float, float, float]
    """∂E/∂x, ∂E/∂y, ∂E/∂w; on a sphere x and y are along two unit vectors at right angles to P and each other."""
    hessian: tuple[float, float, float, float, float, float]
    """xx, xy, xw, yy, yw, ww."""


def vertex_energy(mesh: MeshLike, model: EnergyModel, vertex: int) -> VertexDerivatives:
    """The part of the total energy that depends on a vertex, with its derivatives."""
    return VertexDerivatives(**_temper.vertex_energy(as_mesh(mesh)._handle, expect("model", model, EnergyModel)._plain(), vertex))
