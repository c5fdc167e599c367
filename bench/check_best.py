#!/usr/bin/env python3
"""Checks that weights are the best ones, without temper: the gap of temper weights --mode center or accuracy.

    temper weights IN -o out.vtu --encoding ascii --mode center --certificate best.json
    bench/check_best.py out.vtu best.json [--tolerance 1e-8]

Reads positions and weights from the VTU file, and constraints with multipliers from the certificate. On the sphere the
certificate has the weights, too, which a mesh rounds to the last bit of the radius. Everything is computed from them with 50 digits, by the formulas of docs/explanation/best-weights.md. Exit code 0 means that the weights
keep the constraints, and that no other weights have an objective smaller by more than the tolerance times it.
"""

import argparse
import collections
import decimal
import itertools
import json
import sys
import xml.etree.ElementTree as xml
from decimal import Decimal

decimal.getcontext().prec = 50
REACH = 1  # for regular: crossings stay between -REACH l and (1 + REACH) l
KEPT = Decimal("1e-9")  # a slack may lack this much, as rounding does


def read_vtu(path):
    """Points, weights and the corners of cells, of a VTU file with text."""
    root = xml.parse(path).getroot()
    arrays = {}
    for kind in ("Points", "PointData", "Cells"):
        for array in root.iter(kind):
            for data in array.iter("DataArray"):
                if data.get("format") != "ascii":
                    sys.exit(f"{path}: expected --encoding ascii")
                arrays["Points" if kind == "Points" else data.get("Name")] = data.text.split()
    places = list(map(Decimal, map(float, arrays["Points"])))
    points = [tuple(places[i : i + 3]) for i in range(0, len(places), 3)]
    weights = list(map(Decimal, map(float, arrays.get("weight", ["0"] * len(points)))))
    ends, corners = ([int(x) for x in arrays[name]] for name in ("offsets", "connectivity"))
    cells = [corners[i:j] for i, j in zip([0] + ends, ends)]
    return points, weights, [cell for cell in cells if len(cell) == max(map(len, cells))]


def key_of(kind, vertices):
    """Returns a key of the constraint: its edge or face, and the opposite corner if it is a height."""
    if kind == "crossing":
        return kind, tuple(vertices)
    side = frozenset(vertices[: 3 if "face" in kind else 2])
    return (kind, side) if "dual" in kind else (kind, side, vertices[len(side)])


def constraints_of(cells, constraints):
    """The keys of all constraints of a mesh; for regular without the duals, which may be of some edges only."""
    keys = set()
    tetrahedra = len(cells[0]) == 4
    for cell in cells:
        for a, b in itertools.permutations(cell, 2):
            if constraints != "heights_only" and not (tetrahedra and constraints == "well_centered"):
                keys.add(("crossing", (a, b)))
        for side in itertools.combinations(cell, len(cell) - 1):
            opposite = next(v for v in cell if v not in side)
            if constraints != "regular":
                keys.add(("height_over_face" if tetrahedra else "height", frozenset(side), opposite))
            if constraints == "completely_well_centered":
                for edge in itertools.combinations(side, 2):
                    keys.add(("height", frozenset(edge), next(v for v in side if v not in edge)))
    return keys


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def det(a, b, c):
    return dot(a, cross(b, c))


class Linear(collections.Counter):
    """A linear function of the potentials: vertex -> coefficient, None -> constant."""

    def plus(self, other, factor):
        for vertex, x in other.items():
            self[vertex] += factor * x
        return self

    def at(self, potentials):
        return sum(x if v is None else x * potentials[v] for v, x in self.items())


class Flat:
    """The plane, with periods or without, and space: potentials are weights."""

    fixed = False

    def __init__(self, points, weights, period):
        self.points, self.potentials, self.period = points, weights, period

    def vector(self, p, v):
        """From p to the image of v near p."""
        x = list(minus(self.points[v], self.points[p]))
        for axis, period in enumerate(self.period):
            if period:
                x[axis] -= period * (x[axis] / period).to_integral_value(decimal.ROUND_HALF_EVEN)
        return tuple(x)

    def lifted(self, p, places, factors):
        """Sum of factors times |v - p|^2 - w_v + w_p."""
        form = Linear()
        for v, factor in zip(places, factors):
            form.plus({None: dot(self.vector(p, v), self.vector(p, v)), v: -1, p: 1}, factor)
        return form

    def crossing(self, p, q):
        l2 = dot(self.vector(p, q), self.vector(p, q))
        return Linear({None: l2, p: Decimal(1), q: Decimal(-1)}), Linear({None: 2 * l2})

    def height(self, p, q, r):
        pq, pr = self.vector(p, q), self.vector(p, r)
        qr = minus(pr, pq)
        dp, dq, dr, l2 = dot(pq, pr), -dot(pq, qr), dot(pr, qr), dot(pq, pq)
        twice_area = dot(cross(pq, pr), cross(pq, pr)).sqrt()
        n = Linear({None: (dp + dq) * dr, q: dp, p: dq, r: -dp - dq})
        return n, Linear({None: 2 * l2 * twice_area})

    def dual(self, p, q, r, s):
        q_, r_, s_ = (self.vector(p, v) for v in (q, r, s))
        rs, sq, qr = cross(r_, s_)[2], cross(s_, q_)[2], cross(q_, r_)[2]
        return self.lifted(p, (q, r, s), (rs, sq, qr)), Linear({None: 2 * qr * sq})

    def height_over_face(self, p, q, r, s):
        q_, r_, s_ = (self.vector(p, v) for v in (q, r, s))
        n = cross(q_, r_)
        form = self.lifted(p, (q, r, s), (dot(n, cross(r_, s_)), dot(n, cross(s_, q_)), dot(n, n)))
        area, side = self.face(n)
        return form, Linear({None: 4 * side * area * dot(n, s_)})

    def dual_of_face(self, p, q, r, s, t):
        q_, r_, s_, t_ = (self.vector(p, v) for v in (q, r, s, t))
        n, st = cross(q_, r_), cross(s_, t_)
        form = self.lifted(p, (q, r, s, t), (-dot(r_, st), dot(q_, st), -dot(n, t_), dot(n, s_)))
        area, side = self.face(n)
        return form, Linear({None: side * dot(n, s_) * -dot(n, t_) / area})

    @staticmethod
    def face(n):
        area = dot(n, n).sqrt() / 2
        return area, (4 / Decimal(3).sqrt() * area).sqrt()

    def value(self, n, m):
        """N/M, which is linear."""
        return Linear().plus(n, 1 / m[None])

    def reach(self, p, q, others, constraints):
        l2 = dot(self.vector(p, q), self.vector(p, q))
        if constraints == "regular":
            return (1 + 2 * REACH) * l2
        if constraints == "completely_well_centered" or (constraints == "well_centered" and len(others) < 2):
            return l2
        squared = lambda a, b: dot(self.vector(a, b), self.vector(a, b))
        return max([l2] + [abs(squared(p, r) - squared(q, r)) for r in others])

    @staticmethod
    def beyond(reach, b):
        return reach + b


class Sphere:
    """The sphere: potentials are sigma = R/|P|, and N and M are linear in them."""

    fixed = True

    def __init__(self, points, weights, radius):
        self.radius = radius
        lengths = [dot(x, x).sqrt() for x in points]
        self.points = [tuple(radius * c / length for c in x) for x, length in zip(points, lengths)]
        self.potentials = [radius / (radius * radius + w).sqrt() for w in weights]

    def crossing(self, p, q):
        x, y = self.points[p], self.points[q]
        return Linear({q: dot(x, x), p: -dot(x, y)}), self.mean(p, q, dot(minus(x, y), minus(x, y)))

    def height(self, p, q, r):
        x, y, z = (self.points[v] for v in (p, q, r))
        n = cross(x, y)
        form = Linear({p: dot(n, cross(y, z)), q: dot(n, cross(z, x)), r: dot(n, n)})
        return form, self.mean(p, q, dot(n, n) * det(x, y, z) / self.radius**3)

    def dual(self, p, q, r, s):
        x, y, z, u = (self.points[v] for v in (p, q, r, s))
        form = Linear({p: -det(y, z, u), q: det(x, z, u), r: -det(x, y, u), s: det(x, y, z)})
        return form, self.mean(p, q, det(x, y, z) * det(y, x, u) / self.radius**3)

    @staticmethod
    def mean(p, q, m):
        return Linear({p: m / 2, q: m / 2})

    def value(self, n, m):
        """The linear part of N/M at equal sigma."""
        all_m = sum(m.values())
        c = sum(n.values()) / all_m
        return Linear({None: c}).plus(n, 1 / all_m).plus(m, -c / all_m)

    def reach(self, p, q, others, constraints):
        x, y = self.points[p], self.points[q]
        apart = lambda ratio: max(abs(ratio - 1), abs(1 / ratio - 1))
        if constraints == "regular":
            lacking = 1 - dot(x, y) / self.radius**2
            return (1 + 2 * REACH) * lacking / (1 - (1 + REACH) * lacking)
        most = max(apart(dot(x, y) / dot(x, x)), apart(dot(y, y) / dot(x, y)))
        if constraints == "heights_only":
            most = max([most] + [apart(dot(self.points[r], y) / dot(self.points[r], x)) for r in others])
        return most

    @staticmethod
    def beyond(reach, b):
        return reach + b + reach * b


def corners_of(term):
    """The vertices that the formula of a term takes, and its cells."""
    kind, edge = term["kind"], term.get("edge")
    if kind == "crossing":
        return edge, [edge]
    if kind in ("height", "dual"):
        third = [v for v in term["triangle"] if v not in edge]
        if kind == "height":
            return edge + third, [edge + third]
        return edge + third + [term["across"]], [edge + third, edge + [term["across"]]]
    face = term["face"]
    fourth = [v for v in term["tetrahedron"] if v not in face]
    if kind == "height_over_face":
        return face + fourth, [face + fourth]
    return face + fourth + [term["across"]], [face + fourth, face + [term["across"]]]


def offset(space, term):
    """The value of an offset less its target."""
    kind, (vertices, _) = term["kind"], corners_of(term)
    if kind in ("crossing", "height", "height_over_face"):
        form = space.value(*getattr(space, kind)(*vertices))
    elif kind == "dual":
        p, q, r, s = vertices
        form = Linear().plus(space.value(*space.height(p, q, r)), Decimal("0.5"))
        form.plus(space.value(*space.height(q, p, s)), Decimal("-0.5"))
    else:
        p, q, r, s, t = vertices
        form = Linear().plus(space.value(*space.height_over_face(p, q, r, s)), Decimal("0.5"))
        form.plus(space.value(*space.height_over_face(p, r, q, t)), Decimal("-0.5"))
    form[None] -= Decimal(term["target"])
    return form


def components(space, cells, constraints):
    """For each component its root, and for each of its vertices the most by which potentials differ along a path."""
    around = collections.defaultdict(list)
    for cell in cells:
        for v in cell:
            around[v].append(cell)
    reach = {}
    for root in sorted(around):
        if root in reach:
            continue
        part = {root: Decimal(0)}
        queue = [root]
        for p in queue:
            for cell in around[p]:
                for q in cell:
                    if q not in part:
                        others = [v for v in cell if v not in (p, q)]
                        part[q] = space.beyond(part[p], space.reach(p, q, others, constraints))
                        queue.append(q)
        reach.update(part)
        yield root, part


def check(space, certificate, cells_of_mesh):
    """Objective and gap, and the least slack."""
    u, goal, constraints = space.potentials, certificate["goal"], certificate["constraints"]
    objective, gap, least, slope, cells = Decimal(0), Decimal(0), Decimal("Infinity"), Linear(), set()
    seen, first = set(), []
    for term in certificate["terms"]:
        vertices, of_term = corners_of(term)
        key = key_of(term["kind"], vertices)
        if key in seen or not term["multiplier"] >= 0:
            sys.exit("a term occurs twice, or a multiplier is negative")
        seen.add(key)
        first.append(vertices[0])
        cells.update(tuple(cell) for cell in of_term)
        n, m = getattr(space, term["kind"])(*vertices)
        margin = -REACH if constraints == "regular" and term["kind"] == "crossing" else Decimal(certificate["margin"])
        form = Linear().plus(n, 1).plus(m, -margin)
        slack, y = form.at(u), Decimal(term["multiplier"])
        of_one = slack / m.at(u)
        least = min(least, of_one)
        if goal == "center":
            # On the sphere the slack is N over M at equal sigma.
            objective -= (slack / sum(m.values())).ln()
            gap += slack * y - 1 - (slack * y).ln()
        else:
            gap += abs(slack * y)
        slope.plus(form, -y)
    if {key for key in seen if "dual" not in key[0]} != constraints_of(cells_of_mesh, constraints):
        sys.exit("the terms are not the constraints of the mesh")
    for term in certificate.get("offsets", []):
        form, factor = offset(space, term), Decimal(term["factor"])
        value = form.at(u)
        objective += factor * value * value
        slope.plus(form, 2 * factor * value)
    for root, part in components(space, cells, constraints):
        scaled = goal == "center" and space.fixed
        if scaled:  # the sum of sigma is the number of vertices
            n = Decimal(len(part))
            in_part = sum(1 for v in first if v in part)
            each = Decimal(in_part) / n
            low, high = sum(1 / (1 + w) for w in part.values()), sum(1 + w for w in part.values())
            objective += each * sum(u[v] for v in part)
            for v, w in part.items():
                slope[v] += each
                gap += abs(slope[v]) * (n / low * (1 + w) - n / high / (1 + w))
            objective -= in_part  # as Σ σ = n, this is a constant
            if abs(sum(u[v] for v in part) - n) > Decimal("1e-6") * n:
                sys.exit("the sum of sigma is not the number of vertices")
        else:
            if space.fixed and abs(u[root] - 1) > KEPT:
                sys.exit(f"sigma of vertex {root} is not one")
            gap += sum(abs(slope[v]) * 2 * w for v, w in part.items())
    return objective, gap, least


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("mesh")
    parser.add_argument("certificate")
    parser.add_argument("--tolerance", type=Decimal, default=Decimal("1e-8"))
    options = parser.parse_args()
    points, weights, cells = read_vtu(options.mesh)
    with open(options.certificate) as file:
        certificate = json.load(file)
    if "radius" in certificate:
        for v, exact in certificate["weights"]:
            exact, before = Decimal(exact), weights[v]
            weights[v] = exact
            if abs(exact - before) > Decimal("1e-13") * Decimal(certificate["radius"]) ** 2:
                sys.exit(f"weight {v} is {before} in the mesh, {exact} in the certificate")
        space = Sphere(points, weights, Decimal(certificate["radius"]))
    else:
        space = Flat(points, weights, list(map(Decimal, certificate.get("period", []))))
    objective, gap, least = check(space, certificate, cells)
    relative = gap / abs(objective)
    proved = relative <= options.tolerance and least >= -KEPT
    print(f"{certificate['goal']}: objective {objective:.10g}, relative gap {relative:.2g}, least slack {least:.3g}: "
          f"{'proved' if proved else 'not proved'}")
    return 0 if proved else 1


if __name__ == "__main__":
    sys.exit(main())
