"""Proofs over connectivities, checked once more: in rational arithmetic, from the statements of docs/explanation/connectivities.md,
without temper's code."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

import temper


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def dot(a, b, c):
    return (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1])


class Domain:
    """The convex hull of points in general position: all vertices see each other."""

    def __init__(self, mesh):
        self.points = [(Fraction(float(x)), Fraction(float(y))) for x, y in mesh.points]
        self.kept = {frozenset(e) for e in mesh.boundary_edges.tolist()}

    def at(self, *vertices):
        return [self.points[v] for v in vertices]

    def is_left(self, a, b, c):
        return cross(*self.at(a, b, c)) > 0

    def do_cross(self, e, f):
        (a, b), (c, d) = e, f
        return not set(e) & set(f) and self.is_left(a, b, c) != self.is_left(a, b, d) and self.is_left(c, d, a) != self.is_left(c, d, b)

    def apexes(self, a, b):
        """Apexes of empty triangles to the left of a → b."""
        left = [x for x in range(len(self.points)) if x not in (a, b) and self.is_left(a, b, x)]
        return [x for x in left if not any(self.is_left(b, x, y) and self.is_left(x, a, y) for y in left if y != x)]


def polynomial(domain, constraint):
    """Coefficients of the weights, and the constant, of a constraint."""
    p, q, r = domain.at(constraint.p, constraint.q, max(constraint.r, 0))
    if constraint.kind == "crossing":
        return {constraint.p: Fraction(1), constraint.q: Fraction(-1)}, dot(p, q, q)
    assert constraint.kind == "height" and cross(p, q, r) > 0
    at_p, at_q, at_r = dot(p, q, r), dot(q, p, r), dot(r, p, q)
    return {constraint.p: at_q, constraint.q: at_p, constraint.r: -at_p - at_q}, (at_p + at_q) * at_r


def is_contradiction(domain, lemma, edges, crossings):
    residuals, constant = dict.fromkeys(range(len(domain.points)), Fraction(0)), Fraction(0)
    for constraint, multiplier in lemma.terms:
        assert multiplier >= 0
        if constraint.kind == "crossing":
            assert crossings
        else:
            assert frozenset((constraint.p, constraint.q)) in edges
        coefficients, rest = polynomial(domain, constraint)
        constant += Fraction(multiplier) * rest
        for v, coefficient in coefficients.items():
            residuals[v] += Fraction(multiplier) * coefficient
    assert sum(residuals.values()) == 0 and any(multiplier > 0 for _, multiplier in lemma.terms)
    root = domain.points[0]
    for v, residual in residuals.items():  # what rounding left: weights differ by less than a bound
        if crossings:
            constant += abs(residual) * dot(root, domain.points[v], domain.points[v])
        else:
            constant += abs(residual) * max(abs(dot(o, root, root) - dot(o, domain.points[v], domain.points[v])) for o in domain.points)
    return constant <= 0


def is_proof(domain, proof):
    for i, lemma in enumerate(proof.lemmas):
        edges = domain.kept | {frozenset(e) for e in lemma.edges}
        if lemma.terms:
            if not is_contradiction(domain, lemma, edges, proof.constraints == "well_centered"):
                return False
            continue
        a, b = lemma.side
        assert frozenset(lemma.side) in edges
        cases = dict(lemma.cases)
        for x in domain.apexes(a, b):
            added = [(a, x), (b, x)]
            if any(domain.do_cross(e, tuple(f)) for e, f in itertools.product(added, lemma.edges)):
                continue
            if not 0 <= cases.get(x, -1) < i:
                return False
            if not {frozenset(e) for e in proof.lemmas[cases[x]].edges} <= edges | set(map(frozenset, added)):
                return False
    return bool(proof.lemmas) and not proof.lemmas[-1].edges


@pytest.mark.parametrize("constraints", ["well_centered", "heights_only"])
def test_proofs_hold_in_rational_arithmetic(constraints):
    branched = 0
    for seed in range(40):
        points = np.random.default_rng(seed).uniform(size=(12 if constraints == "well_centered" else 10, 2))
        mesh = temper.generate.constrained_delaunay(points)
        report = temper.best_connectivity(mesh, constraints=constraints, time_limit=0)
        if report.proof is None:
            assert report.margin > 0
            continue
        domain = Domain(mesh)
        assert is_proof(domain, report.proof)
        branched += len(report.proof.lemmas) > 1
        last = report.proof.lemmas[-1]
        if last.cases:
            weaker = temper.types.Lemma(last.edges, last.terms, last.side, last.cases[1:])
            assert not is_proof(domain, temper.types.ConnectivityProof(constraints, [*report.proof.lemmas[:-1], weaker]))
    assert branched > 2
