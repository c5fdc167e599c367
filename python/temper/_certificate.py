"""Proofs that no weights exist."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

from . import _temper
from ._records import Record

Constraints = Literal[
    "well_centered", "heights_only", "regular", "coefficients", "distances", "completely_well_centered"
]


@dataclasses.dataclass(frozen=True)
class WeightConstraint:
    """One inequality of the constraints."""

    kind: Literal["height", "crossing", "dual", "height_over_face", "dual_of_face", "equal_crossing"]
    """height: h over edge pq of the triangle pqr, counter-clockwise; crossing: d from p towards q, for any edge pq;
    dual: dual length of pq between the triangles pqr and qps; height_over_face: h over the face pqr of the tetrahedron
    pqrs; dual_of_face: dual length of pqr between the tetrahedra pqrs and prqt; equal_crossing: equation of pq, which is
    rs on the other side of an interface between tensors."""
    p: int
    q: int
    r: int
    """Third vertex; −1 for a crossing."""
    s: int = -1
    """Fourth vertex; −1 for a crossing and a height."""
    t: int = -1
    """Fifth vertex, only for a dual of a face; else −1."""


def read_certificate(text: str, part: str) -> dict[str, Any]:
    """The certificate or proof in a text, which must have this part."""
    d = _temper.certificate_from_json(text)
    if part not in d:
        raise TypeError(f"expected a certificate with {part}. Next: temper.types.{'ConnectivityProof' if 'lemmas' in d else 'Certificate'} reads it")
    return d


@dataclasses.dataclass(frozen=True)
class Certificate(Record):
    """A proof that no weights exist (Farkas): constraints with multipliers ≥ 0 whose sum is a contradiction. The
    polynomials are in ``temper/feasibility.hpp`` and docs/explanation/certificates.md."""

    margin: float
    """Refuted margin: no weights keep the constraints with more than this margin."""
    terms: list[tuple[WeightConstraint, float]]
    """Constraints and their multipliers; empty: no certificate."""
    constraints: Constraints = "well_centered"
    """Kind of constraints. For ``regular`` the proof assumes that weights differ by less than 2²⁰ ℓ² along edges."""

    def _plain(self) -> dict[str, Any]:
        terms = [(dataclasses.astuple(c), float(m)) for c, m in self.terms]
        return {"margin": self.margin, "terms": terms, "constraints": self.constraints}

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Certificate:
        return cls(d["margin"], [(WeightConstraint(*c), m) for c, m in d["terms"]], d["constraints"])

    def to_json(self) -> str:
        """The certificate as JSON, which ``temper weights --check-certificate`` reads. Vertices count from 0."""
        return str(_temper.certificate_to_json(self._plain()))

    @classmethod
    def from_json(cls, text: str) -> Certificate:
        """Reads the text of ``to_json`` or of ``temper weights --certificate``.

        Raises
        ------
        TemperError
            No such certificate. The message names the wrong term.

        >>> import temper
        >>> proof = temper.find_weights(temper.generate.sparse_horseshoe(), goal="margin").certificate
        >>> temper.types.Certificate.from_json(proof.to_json()) == proof
        True
        """
        return cls._of(read_certificate(text, "terms"))
