// Certificates about meshes of the sphere, added up again in rational arithmetic.
//
// The oracle shares no formula with the library: coefficients of σ are differences of the predicates' polynomials of
// P = p/σ, with σ of one vertex doubled after the other, and σ_v/σ_root is bounded by products of bounds along paths
// over all edges of the mesh.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <map>

#include "feasibility/potential.hpp"
#include "support/spheres.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

using Rational = mpq_class;
using Kind = WeightConstraint::Kind;

struct RationalVector {
  Rational x, y, z;
};
RationalVector minus(const RationalVector& a, const RationalVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Rational dot(const RationalVector& a, const RationalVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
RationalVector cross(const RationalVector& a, const RationalVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Rational volume(const RationalVector& a, const RationalVector& b, const RationalVector& c) {
  return dot(a, cross(b, c));
}

RationalVector place(const Mesh& mesh, VertexId v) {
  const Vec3 p = position_of(mesh, v);
  return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

/// N − margin · M (σ_p + σ_q)/2 where σ of `doubled` is 2 and all others are 1.
Rational value_on_sphere(const Mesh& mesh, const WeightConstraint& c, const Rational& margin, VertexId doubled) {
  const auto sigma = [&](VertexId v) -> Rational { return v == doubled ? 2 : 1; };
  const auto lifted = [&](VertexId v) -> RationalVector {
    const RationalVector p = place(mesh, v);
    return {p.x / sigma(v), p.y / sigma(v), p.z / sigma(v)};
  };
  const RationalVector x = place(mesh, c.p), y = place(mesh, c.q), p = lifted(c.p), q = lifted(c.q);
  const Rational radius(mesh.space().radius()), cube = radius * radius * radius;
  const Rational mean = margin * (sigma(c.p) + sigma(c.q)) / 2, both = sigma(c.p) * sigma(c.q);
  if (c.kind == Kind::crossing) return dot(p, minus(p, q)) * sigma(c.p) * both - mean * dot(minus(x, y), minus(x, y));
  const RationalVector z = place(mesh, c.r), r = lifted(c.r);
  if (c.kind == Kind::height) {
    const Rational height = dot(cross(p, q), cross(minus(q, p), minus(r, p))) * both * both * sigma(c.r);
    return height - mean * dot(cross(x, y), cross(x, y)) * volume(x, y, z) / cube;
  }
  const RationalVector s = lifted(c.s);
  const Rational dual = volume(minus(p, s), minus(q, s), minus(r, s)) * both * sigma(c.r) * sigma(c.s);
  return dual - mean * volume(x, y, z) * volume(y, x, place(mesh, c.s)) / cube;
}

/// The most that σ of one end of h can be of the other's; 0: there is no bound.
Rational most_ratio(const Mesh& mesh, HalfedgeId h, Constraints constraints) {
  const RationalVector p = place(mesh, mesh.origin(h)), q = place(mesh, mesh.target(h)),
                       r = place(mesh, mesh.opposite(h));
  const Rational pq = dot(p, q), pr = dot(p, r), qr = dot(q, r);
  if (pq <= 0) return 0;
  Rational most = (dot(p, p) > dot(q, q) ? dot(p, p) : dot(q, q)) / pq;
  if (constraints == Constraints::regular) {
    const Rational far = 1 + Rational(kWeightReach) * (most - 1) * 1.001;
    return far < 2 ? far : Rational(2);
  }
  if (constraints == Constraints::heights_only) {
    if (pr <= 0 || qr <= 0) return 0;
    for (const Rational& ratio : {Rational(pr / qr), Rational(qr / pr)}) {
      if (ratio > most) most = ratio;
    }
  }
  return most;
}

/// Greatest σ_v/σ_root by these bounds (Bellman and Ford: the meshes are small); 0: not reached.
std::vector<Rational> reach_on_sphere(const Mesh& mesh, VertexId root, Constraints constraints) {
  std::vector<Rational> most(mesh.n_vertices(), Rational(0));
  most[root.index] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    for (const HalfedgeId h : mesh.halfedges()) {
      const Rational ratio = most_ratio(mesh, h, constraints);
      if (ratio == 0) continue;
      for (const auto& [from, to] : {std::pair(mesh.origin(h), mesh.target(h)), {mesh.target(h), mesh.origin(h)}}) {
        if (most[from.index] == 0) continue;
        const Rational there = most[from.index] * ratio;
        if (most[to.index] != 0 && most[to.index] <= there) continue;
        most[to.index] = there;
        changed = true;
      }
    }
  }
  return most;
}

/// Says whether Σ R_v σ_v ≤ 0 whatever σ within these bounds, as seen from one of the vertices.
bool is_contradiction(const Mesh& mesh, const Certificate& certificate) {
  std::map<VertexId, Rational> residual;
  for (const auto& [c, multiplier] : certificate.terms) {
    const Rational at_one = value_on_sphere(mesh, c, Rational(certificate.margin), VertexId());
    for (const VertexId v : {c.p, c.q, c.r, c.s}) {
      if (!v.valid()) continue;
      residual[v] += Rational(multiplier) * (value_on_sphere(mesh, c, Rational(certificate.margin), v) - at_one);
    }
  }
  return std::any_of(residual.begin(), residual.end(), [&](const auto& root) {
    const std::vector<Rational> most = reach_on_sphere(mesh, root.first, certificate.constraints);
    Rational bound = 0;
    for (const auto& [v, r] : residual) {
      if (r > 0 && most[v.index] == 0) return false;
      if (most[v.index] != 0) bound += r > 0 ? Rational(r * most[v.index]) : Rational(r / most[v.index]);
    }
    return bound <= 0;
  });
}

TEST(SphereCertificateOracle, AgreesThatAcceptedCertificatesAreContradictions) {
  std::map<Constraints, std::size_t> accepted;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = globe(20 + 2 * seed, seed, seed % 2 == 0 ? 6371000 : 1);
    for (const Constraints constraints : {Constraints::well_centered, Constraints::heights_only}) {
      const Certificate certificate = margin_of(mesh, constraints).certificate;
      if (certificate.terms.empty()) continue;
      ++accepted[constraints];
      ASSERT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
      EXPECT_TRUE(is_contradiction(mesh, certificate)) << seed << " " << name(constraints);
    }
  }
  EXPECT_GE(accepted[Constraints::well_centered], 4u);
  EXPECT_GE(accepted[Constraints::heights_only], 2u);
}

TEST(SphereCertificateOracle, AgreesWhateverIsAcceptedAfterCorruption) {
  std::size_t accepted = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = globe(20, seed);
    const Certificate certificate = margin_of(mesh).certificate;
    for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
      for (const double factor : {0.0, 0.5, 0.9, 1.1, 10.0}) {
        Certificate corrupted = certificate;
        corrupted.terms[i].multiplier *= factor;
        corrupted.margin = factor == 0.9 ? 0.125 : 0;
        if (check_certificate(mesh, corrupted) == CertificateCheck::proves) {
          ++accepted;
          EXPECT_TRUE(is_contradiction(mesh, corrupted));
        } else {
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(accepted, 5u);
  EXPECT_GT(refused, 5u);
}

}  // namespace
}  // namespace temper::test
