// Signs and lengths of triangles in space: integers as oracle, and the plane.
#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// A point with whole numbers, for which all polynomials are whole numbers of 64 bits.
struct Whole {
  std::int64_t x, y, z, w;
  [[nodiscard]] WeightedPoint point() const {
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z), static_cast<double>(w)};
  }
};
std::int64_t dot_from(const Whole& o, const Whole& a, const Whole& b) {
  return (a.x - o.x) * (b.x - o.x) + (a.y - o.y) * (b.y - o.y) + (a.z - o.z) * (b.z - o.z);
}
std::int64_t squared_area(const Whole& p, const Whole& q, const Whole& r) {
  return dot_from(p, q, q) * dot_from(p, r, r) - dot_from(p, q, r) * dot_from(p, q, r);
}
/// D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r).
std::int64_t numerator(const Whole& p, const Whole& q, const Whole& r) {
  const std::int64_t d_r = dot_from(r, p, q);
  return dot_from(p, q, r) * (d_r + q.w - r.w) + dot_from(q, p, r) * (d_r + p.w - r.w);
}
Sign sign_of(std::int64_t x) { return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero; }
/// Of x/√a + y/√b.
Sign sign_of_sum(std::int64_t x, std::int64_t a, std::int64_t y, std::int64_t b) {
  const auto squared = [](std::int64_t n) { return n < 0 ? -n * n : n * n; };
  return sign_of(squared(x) * b + squared(y) * a);
}

Whole random_point(Rng& rng, std::uint32_t size) {
  const auto coordinate = [&] { return static_cast<std::int64_t>(rng.below(size)); };
  return {coordinate(), coordinate(), coordinate(), coordinate()};
}

TEST(SurfaceGeometry, SignsAreThoseOfWholeNumbers) {
  Rng rng(7);
  std::size_t ties = 0, triangles = 0;
  for (int i = 0; i < 200000; ++i) {
    const std::uint32_t size = 2 + rng.below(4);
    const Whole p = random_point(rng, size), q = random_point(rng, size), r = random_point(rng, size),
                s = random_point(rng, size);
    const std::int64_t left = squared_area(p, q, r), right = squared_area(q, p, s);
    ASSERT_EQ(is_flat(p.point().position(), q.point().position(), r.point().position()), left == 0);
    if (left == 0 || right == 0) continue;
    ++triangles;
    ASSERT_EQ(signed_height_sign(p.point(), q.point(), r.point()), sign_of(numerator(p, q, r)));
    ASSERT_EQ(dual_crossing_sign(p.point(), q.point()), sign_of(dot_from(p, q, q) + p.w - q.w));
    const Sign dual = sign_of_sum(numerator(p, q, r), left, numerator(q, p, s), right);
    ASSERT_EQ(dual_length_sign(p.point(), q.point(), r.point(), s.point()), dual);
    if (dual == Sign::zero) ++ties;
  }
  EXPECT_GT(triangles, 50000U);
  EXPECT_GT(ties, 1000U);
}

TEST(SurfaceGeometry, SignsInThePlaneAreThePlanesEvenInTheLastBit) {
  Rng rng(3);
  const auto nudged = [&](double x) { return std::nextafter(x, rng.below(2) == 0 ? -10.0 : 10.0); };
  for (int i = 0; i < 2000; ++i) {
    // Four points of a circle, moved by one bit.
    const auto on_circle = [&](double angle) {
      return temper::WeightedPoint{nudged(0.5 + std::cos(angle)), nudged(std::sin(angle)), 0};
    };
    const double turn = rng.uniform(0, 6);
    const auto a = on_circle(turn), b = on_circle(turn + 2), c = on_circle(turn + 3.5), d = on_circle(turn + 1);
    const auto lifted = [](const temper::WeightedPoint& p) { return WeightedPoint{p.x, p.y, 0, p.w}; };
    ASSERT_EQ(orient2d(a.position(), b.position(), c.position()), Sign::positive);
    ASSERT_EQ(dual_length_sign(lifted(a), lifted(b), lifted(c), lifted(d)), -power_test(a, b, c, d));
    ASSERT_EQ(signed_height_sign(lifted(a), lifted(b), lifted(c)), temper::signed_height_sign(a, b, c));
    const double over_length = dual_over_length(lifted(a), lifted(b), lifted(c), lifted(d));
    EXPECT_LT(std::abs(over_length), 1e-13);
    EXPECT_EQ(over_length > 0, power_test(a, b, c, d) == Sign::negative);
  }
}

TEST(SurfaceGeometry, ATriangleOfThePlaneIsWellCenteredAsThere) {
  Rng rng(11);
  std::size_t good = 0, only_not_crossed = 0;
  for (int i = 0; i < 3000; ++i) {
    // Weights for an orthocenter in the triangle, which may be obtuse.
    std::array<Vec2, 3> at;
    for (Vec2& p : at) p = {rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (orient2d(at[0], at[1], at[2]) != Sign::positive) std::swap(at[1], at[2]);
    const double a = rng.uniform(0.01, 1), b = rng.uniform(0.01, 1), c = rng.uniform(0.01, 1);
    const Vec2 o = (1 / (a + b + c)) * (a * at[0] + b * at[1] + c * at[2]);
    const auto flat = [&](std::size_t k) { return temper::WeightedPoint{at[k].x, at[k].y, squared_length(o - at[k])}; };
    const auto lifted = [&](std::size_t k) { return WeightedPoint{at[k].x, at[k].y, 0, squared_length(o - at[k])}; };
    const bool there = temper::is_well_centered(flat(0), flat(1), flat(2));
    ASSERT_EQ(is_well_centered(lifted(0), lifted(1), lifted(2)), there);
    ++(there ? good : only_not_crossed);
  }
  EXPECT_GT(good, 500U);
  EXPECT_GT(only_not_crossed, 500U);
}

TEST(SurfaceGeometry, SignsDoNotOverflowOrUnderflow) {
  // A right-angled isosceles triangle, and one a little sharper.
  for (const double unit : {0x1p-190, 1.0, 0x1p190}) {
    const WeightedPoint p = {unit, 0, 0, 0}, q = {0, unit, 0, 0}, r = {0, 0, 0, 0};
    const WeightedPoint far = {0, 0, unit, 0};
    EXPECT_EQ(signed_height_sign(p, q, r), Sign::zero);
    EXPECT_EQ(signed_height_sign(p, q, far), Sign::positive);
    EXPECT_EQ(dual_length_sign(p, q, r, far), Sign::positive);
    EXPECT_EQ(is_well_centered(p, q, far), true);
    EXPECT_EQ(is_well_centered(p, q, r), false);
    EXPECT_FALSE(is_flat(p.position(), q.position(), r.position()));
  }
}

TEST(SurfaceGeometry, TheOrthocenterHasEqualPowersAndTheHeights) {
  Rng rng(5);
  const auto point = [&] {
    return WeightedPoint{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.3, 0.3)};
  };
  for (int i = 0; i < 1000; ++i) {
    const WeightedPoint p = point(), q = point(), r = point();
    const Vec3 n = cross(q.position() - p.position(), r.position() - p.position());
    if (length(n) < 0.2) continue;
    const Vec3 o = orthocenter(p, q, r);
    const auto power = [&](const WeightedPoint& v) { return squared_length(o - v.position()) - v.w; };
    EXPECT_NEAR(power(p), power(q), 1e-10);
    EXPECT_NEAR(power(p), power(r), 1e-10);
    EXPECT_NEAR(dot(o - p.position(), n), 0, 1e-11);
    const Vec3 along = (1 / length(q.position() - p.position())) * (q.position() - p.position());
    const Vec3 inward = (1 / length(n)) * cross(n, along);
    EXPECT_NEAR(signed_height(p, q, r), dot(o - p.position(), inward), 1e-11);
    EXPECT_NEAR(dual_crossing(p, q), dot(o - p.position(), along), 1e-11);
    const WeightedPoint s = point();
    if (length(cross(q.position() - p.position(), s.position() - p.position())) < 0.2) continue;
    const double sum = signed_height(p, q, r) + signed_height(q, p, s);
    EXPECT_NEAR(dual_over_length(p, q, r, s), sum / length(q.position() - p.position()), 1e-9);
  }
}

TEST(SurfaceGeometry, DualLengthsAreAccurateWhenHeightsCancel) {
  // A triangle of height a over the middle of the edge has h = (a² − 10²)/(2 a): 10.5 for a = 25, and −10.5 for a = 4.
  const WeightedPoint p = {0, 0, 0, 0}, q = {20, 0, 0, 0}, r = {10, 4, 0, 0};
  EXPECT_EQ(dual_over_length(p, q, r, {10, 15, 20, 0}), 0);
  for (const double change : {1e-6, 1e-10, 1e-14, -1e-200}) {
    // A weight w of the apex adds −w/(2 a) to its height.
    EXPECT_NEAR(dual_over_length(p, q, r, {10, 15, 20, change}) / (-change / 50 / 20), 1, 1e-6) << change;
  }
}

}  // namespace
}  // namespace temper::surfaces
