#!/usr/bin/env python3
"""Checks that a mesh has no weights, without temper and without rounding: the proof of temper weights --certificate.

    temper convert IN -o in.vtu --encoding ascii
    temper weights in.vtu --mode margin --certificate why.json
    bench/check_none.py in.vtu why.json

Reads positions and regions from the VTU file, and constraints with multipliers from the certificate. Everything is
computed from them in fractions, by the formulas of docs/explanation/certificates.md. It is for the plane without periods, and
for tetrahedra. Exit code 0 means that no weights keep the constraints with the margin of the certificate.
"""

import argparse
import collections
import itertools
import json
import math
import sys
import xml.etree.ElementTree as xml
from fractions import Fraction

REACH = 2**20  # of weights, for constraints about dual lengths: they differ by less than REACH l^2 along edges
FLAT = Fraction(127, 128)  # least cos^2 between normals of faces that count as flat
KINDS = {  # of triangles, then of tetrahedra
    "well_centered": ({"height", "crossing"}, {"height_over_face"}),
    "heights_only": ({"height"}, set()),
    "regular": ({"dual"}, {"dual_of_face"}),
    "coefficients": ({"dual", "height"}, {"dual_of_face", "height_over_face", "dual", "height"}),
    "distances": ({"dual", "height"}, {"dual_of_face", "height_over_face"}),
    "completely_well_centered": (set(), {"height_over_face", "height", "crossing"}),
}
OUTER = ("coefficients", "distances")


def refuse(message):
    sys.exit(f"not proved: {message}")


def read_vtu(path):
    """Points, and corners and region of each triangle or tetrahedron, of a VTU file with text."""
    arrays = {}
    for kind in ("Points", "Cells", "CellData"):
        for data in xml.parse(path).getroot().find(f".//{kind}").iter("DataArray"):
            if data.get("format") != "ascii":
                sys.exit(f"{path}: expected --encoding ascii")
            arrays["Points" if kind == "Points" else data.get("Name")] = data.text.split()
    places = [Fraction(float(x)) for x in arrays["Points"]]
    ends, corners = ([int(x) for x in arrays[name]] for name in ("offsets", "connectivity"))
    cells = [corners[i:j] for i, j in zip([0] + ends, ends)]
    regions = arrays.get("region", [0] * len(cells))
    size = max(map(len, cells))
    return ([tuple(places[i : i + 3]) for i in range(0, len(places), 3)],
            [(cell, int(region)) for cell, region in zip(cells, regions) if len(cell) == size])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def root_below(x):
    """A fraction that is at most the square root, and has 200 bits."""
    shift = max(0, 400 - x.numerator.bit_length() + x.denominator.bit_length())
    shift += shift % 2
    return Fraction(math.isqrt((x.numerator << shift) // x.denominator), 1 << shift // 2)


class Checker:
    def __init__(self, points, cells, constraints):
        self.points, self.constraints = points, constraints
        self.tetrahedra = len(cells[0][0]) == 4
        self.kinds = KINDS[constraints][self.tetrahedra]
        self.regions = collections.defaultdict(list)  # of the cells at each side: a face or an edge
        self.parts = set()  # all sets of corners of a cell
        for cell, region in cells:
            for n in range(2, len(cell) + 1):
                self.parts.update(map(frozenset, itertools.combinations(cell, n)))
            for side in itertools.combinations(cell, len(cell) - 1):
                self.regions[frozenset(side)].append(region)
        self.thirds = collections.defaultdict(list)  # at edges of the surface and of interfaces
        if self.tetrahedra:
            for side in filter(self.is_outer, self.regions):
                for edge in itertools.combinations(side, 2):
                    self.thirds[frozenset(edge)] += side - set(edge)

    def is_outer(self, side):
        return len(self.regions[side]) == 1 or len(set(self.regions[side])) == 2

    def to(self, p, v):
        return minus(self.points[v], self.points[p])

    def squared(self, p, q):
        return dot(self.to(p, q), self.to(p, q))

    def is_flat(self, p, q):
        """Says whether an edge has two faces of the surface, and they are nearly coplanar."""
        thirds = self.thirds[frozenset((p, q))]
        if len(thirds) != 2:
            return False
        up, down = (cross(self.to(p, q), self.to(p, v)) for v in thirds)
        both = -dot(up, down)
        return both > 0 and both * both >= FLAT * dot(up, up) * dot(down, down)

    def corners_of(self, term):
        """The vertices that the formula of a term takes. The order of their corners makes areas and volumes positive."""
        kind = term["kind"]
        if kind == "crossing":
            return tuple(term["edge"])
        of_face = "face" in kind
        side, cell = (term[key] for key in (("face", "tetrahedron") if of_face else ("edge", "triangle")))
        across = [term["across"]] if "dual" in kind else []
        return (*side, *(v for v in cell if v not in side), *across)

    def expect_of_mesh(self, kind, v):
        """Refuses a term that is no constraint of the mesh."""
        sizes = {"crossing": 2, "height": 3, "dual": 4, "height_over_face": 4, "dual_of_face": 5}
        if kind not in self.kinds or len(v) != sizes[kind] or len(set(v)) != len(v):
            refuse(f"{kind} of {v} is not of these constraints")
        cells = [v]
        if kind == "dual":
            cells = [v[:3], (v[1], v[0], v[3])]
        elif kind == "dual_of_face":
            cells = [v[:4], (v[0], v[2], v[1], v[4])]
        for cell in cells:
            if frozenset(cell) not in self.parts:
                refuse(f"{cell} is not in the mesh")
            if len(cell) == 4 or (len(cell) == 3 and not self.tetrahedra):
                if not self.size(cell) > 0:
                    refuse(f"{cell} is negative")
        if self.constraints not in OUTER or kind == "dual_of_face" or (kind == "dual" and not self.tetrahedra):
            return
        if kind == "height_over_face" or not self.tetrahedra:
            if not self.is_outer(frozenset(v[:-1])):
                refuse(f"{v} is no height over the boundary or an interface")
        elif not set(v[2:]) <= set(self.thirds[frozenset(v[:2])]) or self.is_flat(*v[:2]) != (kind == "dual"):
            refuse(f"{v} is no {kind} within the surface")

    def size(self, cell):
        """Twice the area, or six times the volume."""
        a, *rest = (self.to(cell[0], v) for v in cell[1:])
        return cross(a, rest[0])[2] if len(rest) == 1 else dot(cross(a, rest[0]), rest[1])

    def lifted(self, v, factors):
        """Sum of factors times |v - p|^2 - w_v + w_p: the constant, and the coefficients of weights."""
        form = collections.Counter()
        for u, factor in zip(v[1:], factors):
            form[None] += factor * self.squared(v[0], u)
            form[u] -= factor
            form[v[0]] += factor
        return form

    def polynomial(self, kind, v, margin):
        """N - margin M, with M at most a tiny part too small."""
        p, q = v[:2]
        pq, l2 = self.to(p, q), self.squared(p, q)
        pr, ps, pt = (self.to(p, u) for u in (v + (p, p, p))[2:5])
        n = cross(pq, pr)
        if kind == "crossing":
            form, m = collections.Counter({None: l2, p: 1, q: -1}), 2 * l2
        elif kind == "height":
            at_p, at_q, at_r = dot(pq, pr), l2 - dot(pq, pr), dot(pr, self.to(q, v[2]))
            form = collections.Counter({None: l2 * at_r, p: at_q, q: at_p, v[2]: -l2})
            m = 2 * l2 * root_below(dot(n, n))
        elif kind == "dual" and not self.tetrahedra:
            factors = [cross(a, b)[2] for a, b in ((pr, ps), (ps, pq), (pq, pr))]
            form, m = self.lifted(v, factors), -2 * factors[2] * cross(pq, ps)[2]
        elif kind in ("dual", "height_over_face"):
            form, m = self.lifted(v, [dot(n, cross(pr, ps)), dot(n, cross(ps, pq)), dot(n, n)]), Fraction(0)
            if kind == "height_over_face":
                m = 2 * self.side(n) * root_below(dot(n, n)) * dot(n, ps)
        else:
            st = cross(ps, pt)
            form = self.lifted(v, [-dot(pr, st), dot(pq, st), -dot(n, pt), dot(n, ps)])
            m = 2 * self.side(n) * dot(n, ps) * -dot(n, pt) / dot(n, n) * root_below(dot(n, n))
        inner = kind == ("dual_of_face" if self.tetrahedra else "dual")
        if self.constraints != "coefficients" or inner:
            form[None] -= margin * m
        return form

    @staticmethod
    def side(n):
        """The side of an equilateral triangle of the face's area."""
        return root_below(root_below(Fraction(4, 3) * dot(n, n)))

    def reach(self, p, q, cell):
        l2 = self.squared(p, q)
        if self.constraints in OUTER or self.constraints == "regular":
            return REACH * l2
        if self.constraints == "completely_well_centered" or (self.constraints == "well_centered" and not self.tetrahedra):
            return l2
        return max([l2] + [abs(self.squared(p, r) - self.squared(q, r)) for r in cell if r not in (p, q)])

    def upper_bound(self, terms, margin):
        """The largest value of the sum of all terms, whatever the weights."""
        total, around = collections.Counter(), collections.defaultdict(list)
        for term in terms:
            multiplier, kind, v = Fraction(float(term["multiplier"])), term["kind"], self.corners_of(term)
            if multiplier < 0:
                refuse("a multiplier is negative")
            self.expect_of_mesh(kind, v)
            for u, x in self.polynomial(kind, v, margin).items():
                total[u] += multiplier * x
            for cell in (v[:-1], v[:-2] + v[-1:]) if "dual" in kind else (v,):
                for p in cell:
                    around[p].append(cell)
        bound, seen = total[None], set()
        for root in sorted(around):
            if root in seen:
                continue
            reach, queue = {root: Fraction(0)}, [root]
            for p in queue:
                bound += abs(total[p]) * reach[p]
                for cell in around[p]:
                    for q in cell:
                        if q not in reach:
                            reach[q] = reach[p] + self.reach(p, q, cell)
                            queue.append(q)
            seen.update(reach)
        return bound


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("mesh")
    parser.add_argument("certificate")
    options = parser.parse_args()
    with open(options.certificate) as file:
        certificate = json.load(file)
    constraints, margin = certificate.get("constraints", "well_centered"), Fraction(float(certificate["margin"]))
    if not 0 <= margin < Fraction(1, 2) or not any(term["multiplier"] > 0 for term in certificate["terms"]):
        refuse("the margin is out of range, or all multipliers are zero")
    checker = Checker(*read_vtu(options.mesh), constraints)
    bound = checker.upper_bound(certificate["terms"], margin)
    if bound > 0 or (bound == 0 and constraints == "coefficients"):
        refuse(f"the sum may be as large as {float(bound):.3g}")
    print(f"{constraints}: {len(certificate['terms'])} terms, their sum is at most {float(bound):.3g}: proved")
    return 0


if __name__ == "__main__":
    sys.exit(main())
