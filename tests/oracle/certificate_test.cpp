// Certificates that the exact checker accepts, added up again in rational arithmetic; its arithmetic, number by number.
//
// The oracle shares no formula with the library: h comes from the orthocenter by Cramer's rule, with unit weights put
// on one vertex after the other, and the bounds on differences of weights are shortest paths over all edges of the
// mesh, by the bounds of the constraints.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <map>

#include "feasibility/exact_number.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

using Rational = mpq_class;

struct RationalPoint {
  Rational x, y, w;
};

RationalPoint at(const Mesh& mesh, VertexId v, const Rational& weight) {
  return {Rational(mesh.position(v).x), Rational(mesh.position(v).y), weight};
}

Rational doubled_area(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// h ℓ over pq: the cross product of the edge with the way from p to the orthocenter.
Rational scaled_height(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  const auto lift = [](const RationalPoint& a) -> Rational { return a.x * a.x + a.y * a.y - a.w; };
  const Rational ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
  const Rational a = (lift(q) - lift(p)) / 2, b = (lift(r) - lift(p)) / 2, area = doubled_area(p, q, r);
  const Rational x = (a * by - b * ay) / area, y = (ax * b - bx * a) / area;
  return ax * (y - p.y) - ay * (x - p.x);
}

/// N − margin M of a constraint where vertex `raised` has weight 1 and all others 0.
Rational value(const Mesh& mesh, const WeightConstraint& c, const Rational& margin, VertexId raised) {
  const auto point = [&](VertexId v) { return at(mesh, v, v == raised ? 1 : 0); };
  const RationalPoint p = point(c.p), q = point(c.q);
  const Rational l2 = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
  if (c.kind == WeightConstraint::Kind::crossing) return l2 + p.w - q.w - 2 * margin * l2;
  const RationalPoint r = point(c.r);
  const Rational area = doubled_area(p, q, r);
  if (c.kind == WeightConstraint::Kind::dual) {
    const RationalPoint s = point(c.s);
    const Rational across = doubled_area(q, p, s);
    const Rational dual = scaled_height(p, q, r) + scaled_height(q, p, s);
    return 2 * dual / l2 * area * across - 2 * margin * area * across;
  }
  return 2 * scaled_height(p, q, r) * area - 2 * margin * l2 * area;
}

Rational squared_distance(const Mesh& mesh, VertexId a, VertexId b) {
  const RationalPoint p = at(mesh, a, 0), q = at(mesh, b, 0);
  return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
}

/// How much weights of the ends of h can differ: the triangle of h may be the one that the certificate names, or not.
Rational most_difference(const Mesh& mesh, HalfedgeId h, Constraints constraints) {
  const VertexId p = mesh.origin(h), q = mesh.target(h), r = mesh.opposite(h);
  const Rational l2 = squared_distance(mesh, p, q);
  if (constraints == Constraints::well_centered) return l2;
  if (constraints == Constraints::regular) return Rational(kWeightReach) * l2;
  // Squares of distances of the orthocenter: their difference is linear, so greatest at a corner.
  const Rational at_r = abs(squared_distance(mesh, p, r) - squared_distance(mesh, q, r));
  return at_r > l2 ? at_r : l2;
}

/// Shortest paths by these bounds from a vertex (Bellman and Ford: the meshes are small).
std::vector<Rational> reach(const Mesh& mesh, VertexId root, Constraints constraints) {
  std::vector<Rational> distance(mesh.n_vertices(), Rational(-1));
  distance[root.index] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const HalfedgeId h : mesh.halfedges()) {
      for (const auto& [from, to] : {std::pair(mesh.origin(h), mesh.target(h)), {mesh.target(h), mesh.origin(h)}}) {
        if (distance[from.index] < 0) continue;
        const Rational there = distance[from.index] + most_difference(mesh, h, constraints);
        if (distance[to.index] >= 0 && distance[to.index] <= there) continue;
        distance[to.index] = there;
        changed = true;
      }
    }
  }
  return distance;
}

std::array<VertexId, 4> vertices_of(const WeightConstraint& c) { return {c.p, c.q, c.r, c.s}; }

/// Parts of a certificate that share no vertex, by the least vertex of each.
std::map<VertexId, VertexId> parts_of(const Certificate& certificate) {
  std::map<VertexId, VertexId> part;
  for (const auto& term : certificate.terms) {
    if (term.multiplier == 0) continue;
    for (const VertexId v : vertices_of(term.constraint)) {
      if (v.valid()) part.emplace(v, v);
    }
  }
  for (std::size_t round = 0; round < part.size(); ++round) {
    for (const auto& term : certificate.terms) {
      if (term.multiplier == 0) continue;
      VertexId least = part[term.constraint.p];
      for (const VertexId v : vertices_of(term.constraint)) {
        if (v.valid()) least = std::min(least, part[v]);
      }
      for (const VertexId v : vertices_of(term.constraint)) {
        if (v.valid()) part[v] = least;
      }
    }
  }
  return part;
}

/// Most that Σ R_v w_v can be when no weights differ by more than the way between their vertices: what is positive is
/// carried to what is negative. Any plan is a bound, and none costs more than one that goes by way of a root.
Rational carried(const Mesh& mesh, Constraints constraints, std::map<VertexId, Rational> residual) {
  Rational bound = 0;
  for (auto& [from, surplus] : residual) {
    if (surplus <= 0) continue;
    const std::vector<Rational> distance = reach(mesh, from, constraints);
    for (auto& [to, lack] : residual) {
      if (lack >= 0 || surplus <= 0) continue;
      const Rational amount = surplus < -lack ? surplus : Rational(-lack);
      bound += amount * distance[to.index];
      surplus -= amount;
      lack += amount;
    }
    EXPECT_EQ(surplus, 0);  // a constant on all weights changes nothing
  }
  return bound;
}

/// The largest that the sum of a certificate can be, over weights that differ no more than its constraints let them.
Rational upper_bound(const Mesh& mesh, const Certificate& certificate) {
  Rational bound = 0;
  const std::map<VertexId, VertexId> part = parts_of(certificate);
  std::map<VertexId, std::map<VertexId, Rational>> residuals;
  for (const auto& [c, multiplier] : certificate.terms) {
    if (multiplier == 0) continue;
    const Rational m(multiplier), t(certificate.margin);
    const Rational zero = value(mesh, c, t, VertexId());
    bound += m * zero;
    for (const VertexId v : vertices_of(c)) {
      if (v.valid()) residuals[part.at(v)][v] += m * (value(mesh, c, t, v) - zero);
    }
  }
  for (const auto& [least, residual] : residuals) bound += carried(mesh, certificate.constraints, residual);
  return bound;
}

TEST(CertificateOracle, AgreesThatAcceptedCertificatesAreContradictions) {
  std::map<Constraints, std::size_t> accepted;
  const auto check_one = [&](const Mesh& mesh, Constraints constraints) {
    const Certificate certificate = margin_of(mesh, constraints).certificate;
    if (certificate.terms.empty()) return;
    ++accepted[constraints];
    ASSERT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
    EXPECT_LE(upper_bound(mesh, certificate), 0);
  };
  const auto check = [&](const Mesh& mesh) {
    for (const ConstraintsInfo& row : constraints_table()) check_one(mesh, row.constraints);
  };
  for (const double turn : {0.02, 0.1, 0.15}) check(pinwheel(turn));
  check(sparse_horseshoe());
  check(*horseshoe());
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    check(jittered_lattice(seed, 5));
    Rng rng(seed);
    check(mesh_of_random_points(rng, 8));
  }
  EXPECT_GT(accepted[Constraints::well_centered], 20u);
  EXPECT_GT(accepted[Constraints::heights_only], 20u);
  EXPECT_GE(accepted[Constraints::regular], 3u);
}

TEST(CertificateOracle, AgreesWhateverIsAcceptedAfterCorruption) {
  std::size_t accepted = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const Mesh mesh = mesh_of_random_points(rng, 6);
    const Certificate certificate = margin_of(mesh).certificate;
    for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
      for (const double factor : {0.0, 0.5, 0.9, 1.1, 2.0, 10.0}) {
        Certificate corrupted = certificate;
        corrupted.terms[i].multiplier *= factor;
        corrupted.margin = factor == 0.9 ? 0.125 : 0;
        if (check_certificate(mesh, corrupted) == CertificateCheck::proves) {
          ++accepted;
          EXPECT_LE(upper_bound(mesh, corrupted), 0);
        } else {
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(accepted, 20u);
  EXPECT_GT(refused, 20u);
}

TEST(ExactNumber, IsWhatRationalsSay) {
  Rng rng(1);
  const auto random = [&] { return std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(80)) - 40); };
  for (int round = 0; round < 200; ++round) {
    exact::Number number;
    Rational expected = 0;
    for (int i = 0; i < 12; ++i) {
      const double a = random(), b = random(), c = random();
      const exact::Number term = exact::Number::difference(a, b) * exact::Number(c);
      const Rational rational = (Rational(a) - Rational(b)) * Rational(c);
      if (i % 3 == 2) {
        number = number * term;
        expected *= rational;
      } else {
        number = i % 3 == 0 ? number + term : number - term;
        expected = i % 3 == 0 ? Rational(expected + rational) : Rational(expected - rational);
      }
    }
    EXPECT_EQ(static_cast<int>(number.sign()), sgn(expected));
    // Taking the rational's own nearest double off leaves what the rational says is left.
    const double nearest = expected.get_d();
    number.add(-nearest);
    EXPECT_EQ(static_cast<int>(number.sign()), sgn(expected - Rational(nearest)));
  }
  EXPECT_EQ(exact::Number(0.0).sign(), Sign::zero);
  EXPECT_EQ((exact::Number(0.1) - exact::Number(0.1)).sign(), Sign::zero);
}

}  // namespace
}  // namespace temper::test
