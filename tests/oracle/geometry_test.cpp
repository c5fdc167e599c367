// Every sign of the predicates against rational arithmetic, on random points and on the degenerate families.
//
// The oracle shares no formula with the library: it expands the 4 × 4 determinants on raw coordinates, finds the
// orthocenter by Cramer's rule and takes heights and crossings from it, and reads the derivative by a weight off
// a difference of two determinants.
#include "temper/detail/geometry.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using testing::degenerate_families;
using testing::Family;
using testing::Quad;
using testing::Random;
using Rational = mpq_class;

constexpr int kRounds = 600;

struct RationalPoint {
  Rational x, y, w;
};
using RationalQuad = std::array<RationalPoint, 4>;

RationalQuad to_rational(const Quad& q) {
  RationalQuad result;
  for (int i = 0; i < 4; ++i) result[i] = {Rational(q[i].x), Rational(q[i].y), Rational(q[i].w)};
  return result;
}

/// | x y 1 | of three points.
Rational determinant(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return a.x * b.y - a.y * b.x + b.x * c.y - b.y * c.x + c.x * a.y - c.y * a.x;
}

/// | x y x² + y² − w 1 | of four points, along its third column.
Rational lifted_determinant(const RationalQuad& q) {
  const auto z = [&](int i) -> Rational { return q[i].x * q[i].x + q[i].y * q[i].y - q[i].w; };
  return z(0) * determinant(q[1], q[2], q[3]) - z(1) * determinant(q[0], q[2], q[3]) +
         z(2) * determinant(q[0], q[1], q[3]) - z(3) * determinant(q[0], q[1], q[2]);
}

Sign sign_of(const Rational& x) { return static_cast<Sign>(sgn(x)); }

/// The point of equal power to p, q, r, which are not on a line.
RationalPoint rational_orthocenter(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  const auto lift = [](const RationalPoint& a) -> Rational { return a.x * a.x + a.y * a.y - a.w; };
  const Rational ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
  const Rational a = (lift(q) - lift(p)) / 2, b = (lift(r) - lift(p)) / 2;
  const Rational area = ax * by - ay * bx;
  return {(a * by - b * ay) / area, (ax * b - bx * a) / area, 0};
}

Sign rational_height_sign(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  if (determinant(p, q, r) == 0) return Sign::zero;
  return sign_of(determinant(p, q, rational_orthocenter(p, q, r)));
}

/// From powers along the edge: d_pq > 0 when p itself is nearer, in the power sense, to p than to q.
Sign rational_crossing_sign(const RationalPoint& p, const RationalPoint& q) {
  const Rational x = q.x - p.x, y = q.y - p.y;
  const Rational power_to_p = -p.w, power_to_q = x * x + y * y - q.w;
  return sign_of(power_to_q - power_to_p);
}

bool rational_well_centered(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  if (determinant(p, q, r) <= 0) return false;
  const auto good = [](const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
    return rational_height_sign(a, b, c) == Sign::positive && rational_crossing_sign(a, b) == Sign::positive &&
           rational_crossing_sign(b, a) == Sign::positive;
  };
  return good(p, q, r) && good(q, r, p) && good(r, p, q);
}

Sign rational_perturbed_sign(const RationalQuad& q, const std::array<std::uint32_t, 4>& index) {
  const Rational value = lifted_determinant(q);
  if (value != 0) return sign_of(value);
  std::array<int, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return index[i] < index[j]; });
  for (const int i : order) {
    RationalQuad heavier = q;
    heavier[i].w += 1;
    const Rational change = lifted_determinant(heavier) - value;
    if (change != 0) return sign_of(change);
  }
  return Sign::zero;
}

/// The power test as a programr without exact arithmetic would write it.
Sign naive_power_test(const Quad& q) {
  const auto lift = [&](int i) { return squared_length(q[i].position() - q[3].position()) - (q[i].w - q[3].w); };
  const auto minor = [&](int i, int j) {
    return cross(q[i].position() - q[3].position(), q[j].position() - q[3].position());
  };
  const double value = lift(0) * minor(1, 2) + lift(1) * minor(2, 0) + lift(2) * minor(0, 1);
  return value > 0 ? Sign::positive : value < 0 ? Sign::negative : Sign::zero;
}

/// Number of predicates whose sign is not the rational one.
int wrong_signs(const Quad& q, const RationalQuad& exact, const std::array<std::uint32_t, 4>& index) {
  return (orient2d(q[0].position(), q[1].position(), q[2].position()) !=
          sign_of(determinant(exact[0], exact[1], exact[2]))) +
         (power_test(q[0], q[1], q[2], q[3]) != sign_of(lifted_determinant(exact))) +
         (power_test_perturbed(q[0], q[1], q[2], q[3], index) != rational_perturbed_sign(exact, index)) +
         (signed_height_sign(q[0], q[1], q[2]) != rational_height_sign(exact[0], exact[1], exact[2])) +
         (dual_crossing_sign(q[0], q[1]) != rational_crossing_sign(exact[0], exact[1])) +
         (is_well_centered(q[0], q[1], q[2]) != rational_well_centered(exact[0], exact[1], exact[2]));
}

TEST(RationalOracle, NoSignIsWrongOnAnyDegenerateFamily) {
  ASSERT_GE(degenerate_families().size(), 16u);
  int ties = 0;
  int naively_wrong = 0;
  for (const Family& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    Random random(2);
    std::array<std::uint32_t, 4> index = {0, 1, 2, 3};
    int wrong = 0;
    for (int round = 0; round < kRounds; ++round) {
      const Quad q = family.draw(random);
      const RationalQuad exact = to_rational(q);
      std::shuffle(index.begin(), index.end(), random);
      wrong += wrong_signs(q, exact, index);
      const Sign truth = sign_of(lifted_determinant(exact));
      ties += truth == Sign::zero;
      naively_wrong += naive_power_test(q) != truth;
    }
    EXPECT_EQ(wrong, 0);
  }
  // The families are as hard as they claim to be.
  EXPECT_GT(ties, kRounds);
  EXPECT_GT(naively_wrong, kRounds / 2);
}

TEST(RationalOracle, NoSignIsWrongOnRandomPoints) {
  Random random(3);
  std::array<int, 3> seen = {};
  for (int round = 0; round < 10 * kRounds; ++round) {
    const Quad q = testing::four(random, [](Random& r) -> WeightedPoint {
      return {testing::real(r), testing::real(r), testing::real(r)};
    });
    const RationalQuad exact = to_rational(q);
    EXPECT_EQ(wrong_signs(q, exact, {0, 1, 2, 3}), 0);
    ++seen[static_cast<int>(sign_of(lifted_determinant(exact))) + 1];
  }
  EXPECT_GT(seen[0], kRounds);
  EXPECT_GT(seen[2], kRounds);
}

}  // namespace
}  // namespace temper
