// Every sign of the predicates on the sphere against rational arithmetic: on random points, on points with ties, and on
// the degenerate families of the plane, whose three numbers are three coordinates here.
//
// The oracle shares no formula with the library: it expands 4 × 4 determinants with a column of ones, finds the foot of
// the center on a face's plane and asks on which side of the edge's plane it is, and compares powers along edges.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "temper/detail/geometry.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using testing::Family;
using testing::Quad;
using testing::Random;
using Rational = mpq_class;

constexpr int kRounds = 600;

struct RationalPoint {
  Rational x, y, z;
};
using RationalQuad = std::array<RationalPoint, 4>;

RationalQuad to_rational(const Quad& q) {
  RationalQuad result;
  for (int i = 0; i < 4; ++i) result[i] = {Rational(q[i].x), Rational(q[i].y), Rational(q[i].w)};
  return result;
}

Rational determinant(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}

Rational product(const RationalPoint& a, const RationalPoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Sign sign_of(const Rational& x) { return static_cast<Sign>(sgn(x)); }

/// Minus | x y z 1 | of four points, along the ones: positive when the last one is above the others' plane.
Rational above(const RationalQuad& q) {
  return determinant(q[1], q[2], q[3]) - determinant(q[0], q[2], q[3]) + determinant(q[0], q[1], q[3]) -
         determinant(q[0], q[1], q[2]);
}

/// The side of the plane through the center, p and q on which the foot of the center on the plane of pqr is.
Sign rational_height_sign(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  // Barycentric coordinates of the foot times a positive number: normal n, foot = n (n·p)/(n·n).
  const Rational ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z, bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
  const RationalPoint n = {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
  const Rational height = product(n, p);
  if (height == 0) return sign_of(determinant(p, q, n));
  const RationalPoint foot = {n.x * height, n.y * height, n.z * height};
  const Sign side = sign_of(determinant(p, q, foot));
  return height > 0 ? side : -side;  // of a triangle seen from inside, the foot is behind its normal
}

/// d_pq > 0 where p itself is nearer, in the power sense, to p than to q: p·P > p·Q.
Sign rational_crossing_sign(const RationalPoint& p, const RationalPoint& q) {
  return sign_of(product(p, p) - product(p, q));
}

bool rational_well_centered(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  const auto good = [](const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
    return rational_height_sign(a, b, c) == Sign::positive && rational_crossing_sign(a, b) == Sign::positive &&
           rational_crossing_sign(b, a) == Sign::positive;
  };
  return determinant(p, q, r) > 0 && good(p, q, r) && good(q, r, p) && good(r, p, q);
}

/// A tie, with each point in turn a little farther out.
Sign rational_perturbed_sign(const RationalQuad& q, const std::array<std::uint32_t, 4>& index) {
  const Rational value = above(q);
  if (value != 0) return sign_of(value);
  std::array<int, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return index[i] < index[j]; });
  for (const int i : order) {
    RationalQuad longer = q;
    longer[i] = {2 * q[i].x, 2 * q[i].y, 2 * q[i].z};
    const Rational change = above(longer);
    if (change != 0) return sign_of(change);
  }
  return Sign::zero;
}

int wrong_signs(const Quad& quad, const std::array<std::uint32_t, 4>& index) {
  const RationalQuad exact = to_rational(quad);
  const Vec3 a = as_vector(quad[0]), b = as_vector(quad[1]), c = as_vector(quad[2]), d = as_vector(quad[3]);
  return (orientation(a, b, c) != sign_of(determinant(exact[0], exact[1], exact[2]))) +
         (power_test(a, b, c, d) != sign_of(above(exact))) +
         (power_test_perturbed(a, b, c, d, index) != rational_perturbed_sign(exact, index)) +
         (signed_height_sign(a, b, c) != rational_height_sign(exact[0], exact[1], exact[2])) +
         (dual_crossing_sign(a, b) != rational_crossing_sign(exact[0], exact[1])) +
         (is_well_centered(a, b, c) != rational_well_centered(exact[0], exact[1], exact[2]));
}

/// A lattice point with x² + y² + z² = 81: 96 of them, many on one plane or one great circle.
WeightedPoint on_lattice_sphere(Random& random) {
  constexpr std::array<std::array<int, 3>, 5> kPoints = {{{9, 0, 0}, {8, 4, 1}, {7, 4, 4}, {6, 6, 3}, {8, 1, 4}}};
  std::array<int, 3> p = kPoints[random() % kPoints.size()];
  std::shuffle(p.begin(), p.end(), random);
  for (int& x : p) x = random() % 2 == 0 ? x : -x;
  return {1.0 * p[0], 1.0 * p[1], 1.0 * p[2]};
}

/// A place near (0.6, 0, 0.8) on the unit sphere.
WeightedPoint nearby(Random& random, double distance) {
  const double x = 0.6 + distance * testing::real(random), y = distance * testing::real(random),
               z = 0.8 + distance * testing::real(random), l = std::sqrt(x * x + y * y + z * z);
  return {x / l, y / l, z / l};
}

const std::vector<Family>& families_of_the_sphere() {
  static const std::vector<Family> families = {
      {"lattice sphere", [](Random& r) { return testing::four(r, on_lattice_sphere); }},
      {"nudged lattice sphere",
       [](Random& r) {
         return testing::four(r, [](Random& s) -> WeightedPoint {
           const WeightedPoint p = on_lattice_sphere(s);
           return {testing::nudge(s, p.x), testing::nudge(s, p.y), testing::nudge(s, p.w)};
         });
       }},
      {"lattice sphere with lengths",
       [](Random& r) {
         return testing::four(r, [](Random& s) -> WeightedPoint {
           const WeightedPoint p = on_lattice_sphere(s);
           const double f = 1 + static_cast<double>(s() % 3);
           return {f * p.x, f * p.y, f * p.w};
         });
       }},
      {"a circle of the lattice sphere",
       [](Random& r) {
         return testing::four(r, [](Random& s) {
           WeightedPoint p = on_lattice_sphere(s);
           while (p.w != 4) p = on_lattice_sphere(s);
           return p;
         });
       }},
      {"near each other", [](Random& r) { return testing::four(r, [](Random& s) { return nearby(s, 1e-3); }); }},
      {"very near each other", [](Random& r) { return testing::four(r, [](Random& s) { return nearby(s, 1e-9); }); }},
      {"all but one place", [](Random& r) { return testing::four(r, [](Random& s) { return nearby(s, 1e-15); }); }},
      {"a great circle",
       [](Random& r) {
         return testing::four(r, [](Random& s) -> WeightedPoint {
           const double x = testing::real(s), y = testing::real(s);
           return {x, testing::nudge(s, 2 * x), y};
         });
       }},
      {"bisected octahedron",
       [](Random& r) {
         return testing::four(r, [](Random& s) -> WeightedPoint {
           const double root = std::sqrt(0.5);
           std::array<double, 3> p =
               s() % 2 == 0 ? std::array<double, 3>{1, 0, 0} : std::array<double, 3>{root, root, 0};
           std::shuffle(p.begin(), p.end(), s);
           for (double& x : p) x = s() % 2 == 0 ? x : -x;
           return {p[0], p[1], p[2]};
         });
       }},
  };
  return families;
}

/// Families of the plane have weights in units of length²: as a coordinate, their root where it must be.
double as_coordinate(double w) { return is_exact_coordinate(w) ? w : std::copysign(std::sqrt(std::abs(w)), w); }

void expect_right_signs(const std::vector<Family>& families, int& ties) {
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    Random random(5);
    std::array<std::uint32_t, 4> index = {0, 1, 2, 3};
    int wrong = 0;
    for (int round = 0; round < kRounds; ++round) {
      Quad q = family.draw(random);
      for (WeightedPoint& p : q) p.w = as_coordinate(p.w);
      std::shuffle(index.begin(), index.end(), random);
      wrong += wrong_signs(q, index);
      ties += above(to_rational(q)) == 0;
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST(RationalOracleOnTheSphere, NoSignIsWrongOnAnyDegenerateFamily) {
  int ties = 0, ties_of_the_plane = 0;
  expect_right_signs(families_of_the_sphere(), ties);
  expect_right_signs(testing::degenerate_families(), ties_of_the_plane);
  EXPECT_GT(ties, kRounds);
  EXPECT_GT(ties_of_the_plane, kRounds);
}

TEST(RationalOracleOnTheSphere, NoSignIsWrongOnRandomPoints) {
  Random random(6);
  std::array<int, 3> seen = {};
  for (int round = 0; round < 10 * kRounds; ++round) {
    const Quad q = testing::four(random, [](Random& r) -> WeightedPoint {
      return {testing::real(r), testing::real(r), testing::real(r)};
    });
    EXPECT_EQ(wrong_signs(q, {0, 1, 2, 3}), 0);
    ++seen[static_cast<int>(sign_of(above(to_rational(q)))) + 1];
  }
  EXPECT_GT(seen[0], kRounds);
  EXPECT_GT(seen[2], kRounds);
}

// The theorem of temper/detail/space.hpp: the flat triangle with the weights |P|² has its weighted midpoints and
// orthocenter where the spherical one has them, so heights and crossings read in its plane have the signs of the
// predicates.
TEST(RationalOracleOnTheSphere, TheFlatTriangleWithSquaredLengthsAsWeightsHasTheSameSigns) {
  Random random(7);
  int positive = 0, negative = 0;
  for (int round = 0; round < kRounds; ++round) {
    const RationalQuad q = to_rational(testing::four(random, on_lattice_sphere));
    if (determinant(q[0], q[1], q[2]) <= 0) continue;
    const RationalPoint &p = q[0], &b = q[1], &c = q[2];
    const RationalPoint u = {b.x - p.x, b.y - p.y, b.z - p.z}, v = {c.x - p.x, c.y - p.y, c.z - p.z};
    // 2 h ℓ S over pq: N = u_c |u|² − u_b u·v, with 2 u_b = |u|² + |P|² − |B|² and so on.
    const Rational u_b = product(u, u) + product(p, p) - product(b, b),
                   u_c = product(v, v) + product(p, p) - product(c, c);
    const Sign flat = sign_of(u_c * product(u, u) - u_b * product(u, v));
    EXPECT_EQ(flat, rational_height_sign(p, b, c));
    EXPECT_EQ(sign_of(u_b), rational_crossing_sign(p, b));
    positive += flat == Sign::positive, negative += flat == Sign::negative;
  }
  EXPECT_GT(positive, kRounds / 20);
  EXPECT_GT(negative, kRounds / 20);
}

}  // namespace
}  // namespace temper
