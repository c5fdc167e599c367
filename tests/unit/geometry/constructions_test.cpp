// Laws of the constructions in doubles, with error bounds relative to what enters them.
#include <gtest/gtest.h>

#include <numbers>

#include "temper/detail/geometry.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using testing::Random;
using testing::real;

constexpr int kRounds = 2000;
constexpr double kUnitRoundoff = 0x1p-53;
// Each construction takes fewer than 30 roundings; conditioning is in the scale that each test multiplies with.
constexpr double kRoundings = 32 * kUnitRoundoff;

struct Triangle {
  WeightedPoint p, q, r;
};

/// Counter-clockwise, weights comparable to squared edge lengths, smallest angle not below about 3°.
Triangle random_triangle(Random& random, double offset = 0) {
  for (;;) {
    const auto draw = [&]() -> WeightedPoint {
      return {offset + real(random), offset + real(random), 0.5 * real(random)};
    };
    const Triangle t = {draw(), draw(), draw()};
    if (doubled_area(t.p.position(), t.q.position(), t.r.position()) > 0.05) return t;
  }
}

double power(Vec2 x, const WeightedPoint& p) { return squared_length(x - p.position()) - p.w; }

TEST(Constructions, TheOrthocenterHasEqualPowerToTheThreeCorners) {
  Random random(1);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const Vec2 o = orthocenter(p, q, r);
    // An error δ of o changes powers by 2 |o − x| δ, and δ is conditioned by 1 / area.
    const double distance = length(o - p.position()) + 3;
    const double tolerance = kRoundings * distance * distance / doubled_area(p.position(), q.position(), r.position());
    EXPECT_NEAR(power(o, p), power(o, q), tolerance);
    EXPECT_NEAR(power(o, p), power(o, r), tolerance);
  }
}

TEST(Constructions, WeightsPlaceTheOrthocenterAnywhere) {
  Random random(2);
  for (int round = 0; round < kRounds; ++round) {
    auto [p, q, r] = random_triangle(random);
    const Vec2 target = {10 * real(random), 10 * real(random)};
    for (WeightedPoint* corner : {&p, &q, &r}) corner->w = squared_length(target - corner->position());
    const double tolerance =
        kRoundings * 300 / doubled_area(p.position(), q.position(), r.position());  // weights ≤ 300
    const Vec2 o = orthocenter(p, q, r);
    EXPECT_NEAR(o.x, target.x, tolerance);
    EXPECT_NEAR(o.y, target.y, tolerance);
  }
}

TEST(Constructions, ThePartsOfAnEdgeSumToItsLength) {
  Random random(3);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const double l = length(q.position() - p.position());
    const double tolerance = kRoundings * (l + std::abs(p.w - q.w) / l);
    EXPECT_NEAR(dual_crossing(p, q) + dual_crossing(q, p), l, tolerance);
  }
}

TEST(Constructions, ScaledHeightsSumToTwiceTheArea) {
  Random random(4);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const auto heights = scaled_heights(p, q, r);
    const double area = doubled_area(p.position(), q.position(), r.position());
    // Numerators are sums of products of two dot products (or a weight), each at most 8.
    EXPECT_NEAR(heights[0] + heights[1] + heights[2], area, kRoundings * 3 * 64 / area);
  }
}

TEST(Constructions, HeightsAreDistancesOfTheOrthocenterFromTheEdges) {
  Random random(5);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const Vec2 o = orthocenter(p, q, r);
    const auto heights = scaled_heights(p, q, r);
    const double area = doubled_area(p.position(), q.position(), r.position());
    const double tolerance = kRoundings * 64 / area;
    EXPECT_NEAR(heights[0], doubled_area(q.position(), r.position(), o), tolerance);
    EXPECT_NEAR(heights[1], doubled_area(r.position(), p.position(), o), tolerance);
    EXPECT_NEAR(heights[2], doubled_area(p.position(), q.position(), o), tolerance);
    const double l = length(q.position() - p.position());
    EXPECT_DOUBLE_EQ(signed_height(p, q, r) * l, heights[2]);
    EXPECT_NEAR(dual_crossing(p, q) * l, dot(o - p.position(), q.position() - p.position()), tolerance);
  }
}

TEST(Constructions, HeightsHaveTheirExactSignsWhereTheyAreNotTiny) {
  Random random(6);
  int negative = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const double h = signed_height(p, q, r);
    if (std::abs(h) > 1e-9) {
      EXPECT_EQ(h > 0, signed_height_sign(p, q, r) == Sign::positive);
      negative += h < 0;
    }
    const double d = dual_crossing(p, q);
    if (std::abs(d) > 1e-9) {
      EXPECT_EQ(d > 0, dual_crossing_sign(p, q) == Sign::positive);
    }
  }
  EXPECT_GT(negative, kRounds / 20);
}

TEST(Constructions, AnInvertedTriangleHasTheSameOrthocenterAndOppositeHeights) {
  Random random(7);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random);
    const double area = doubled_area(p.position(), q.position(), r.position());
    const double l = length(q.position() - p.position());
    EXPECT_NEAR(signed_height(q, p, r), -signed_height(p, q, r), kRoundings * 64 / (area * l));
    EXPECT_EQ(signed_height_sign(q, p, r), -signed_height_sign(p, q, r));
  }
}

TEST(Constructions, ScalingByAPowerOfTwoScalesResultsBitForBit) {
  Random random(8);
  for (const double s : {0x1p-40, 0x1p40}) {
    for (int round = 0; round < kRounds / 10; ++round) {
      const auto [p, q, r] = random_triangle(random);
      const auto scaled = [&](const WeightedPoint& a) -> WeightedPoint { return {s * a.x, s * a.y, s * s * a.w}; };
      EXPECT_EQ(orthocenter(scaled(p), scaled(q), scaled(r)), s * orthocenter(p, q, r));
      EXPECT_EQ(dual_crossing(scaled(p), scaled(q)), s * dual_crossing(p, q));
      EXPECT_EQ(signed_height(scaled(p), scaled(q), scaled(r)), s * signed_height(p, q, r));
      EXPECT_EQ(corner_angle(s * p.position(), s * q.position(), s * r.position()),
                corner_angle(p.position(), q.position(), r.position()));
    }
  }
}

TEST(Constructions, AMillionfoldOffsetChangesHeightsByNoMoreThanItRoundsTheCorners) {
  Random random(9);
  for (int round = 0; round < kRounds; ++round) {
    const auto [p, q, r] = random_triangle(random, 1e6);
    const auto back = [](const WeightedPoint& a) -> WeightedPoint { return {a.x - 1e6, a.y - 1e6, a.w}; };  // exact
    EXPECT_EQ(scaled_heights(back(p), back(q), back(r)), scaled_heights(p, q, r));
    EXPECT_EQ(dual_crossing(back(p), back(q)), dual_crossing(p, q));
  }
}

TEST(Constructions, AnglesOfATriangleSumToPi) {
  Random random(10);
  for (int round = 0; round < kRounds; ++round) {
    const auto t = random_triangle(random);
    const Vec2 p = t.p.position(), q = t.q.position(), r = t.r.position();
    EXPECT_NEAR(corner_angle(p, q, r) + corner_angle(q, r, p) + corner_angle(r, p, q), std::numbers::pi,
                kRoundings * std::numbers::pi);
    EXPECT_EQ(corner_angle(p, q, r), corner_angle(p, r, q));
  }
}

TEST(Constructions, SmallAnglesKeepTheirDigits) {
  const Vec2 p = {0, 0}, q = {1, 0};
  EXPECT_DOUBLE_EQ(corner_angle(p, q, Vec2{1, 1e-12}), 1e-12);
  EXPECT_DOUBLE_EQ(corner_angle(p, q, Vec2{-1, 0}), std::numbers::pi);
}

TEST(Constructions, TheEquilateralTriangleIsAsInTheTextbook) {
  const double height = std::sqrt(3.0) / 2;
  const WeightedPoint p = {0, 0, 0}, q = {1, 0, 0}, r = {0.5, height, 0};
  EXPECT_DOUBLE_EQ(signed_height(p, q, r), height / 3);
  EXPECT_DOUBLE_EQ(dual_crossing(p, q), 0.5);
  EXPECT_DOUBLE_EQ(orthocenter(p, q, r).y, height / 3);
  EXPECT_DOUBLE_EQ(corner_angle(p.position(), q.position(), r.position()), std::numbers::pi / 3);
  EXPECT_TRUE(is_well_centered(p, q, r));
}

TEST(Constructions, ALargerWeightMovesTheCrossingAwayFromIt) {
  const WeightedPoint p = {0, 0, 1}, q = {2, 0, 0};
  EXPECT_DOUBLE_EQ(dual_crossing(p, q), 1.25);
  EXPECT_DOUBLE_EQ(dual_crossing(q, p), 0.75);
}

}  // namespace
}  // namespace temper
