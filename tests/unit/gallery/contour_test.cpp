// Contours against what is known of them: lines of a plane, areas of its bands, the length of a circle, and the
// laws that hold whatever the samples are.
#include "plot/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "base/rng.hpp"

namespace temper {
namespace {

constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-12;  // of coordinates and areas of order 100

struct Samples {
  std::size_t nx = 0, ny = 0;
  std::vector<double> values;
  [[nodiscard]] SampleGrid grid() const { return {nx, ny, values}; }
};

Samples sample(std::size_t nx, std::size_t ny, const std::function<double(double, double)>& f) {
  Samples samples{nx, ny, {}};
  for (std::size_t j = 0; j < ny; ++j) {
    for (std::size_t i = 0; i < nx; ++i) samples.values.push_back(f(static_cast<double>(i), static_cast<double>(j)));
  }
  return samples;
}

double signed_area(const std::vector<std::vector<Vec2>>& loops) {
  double sum = 0;
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) sum += cross(loop[k], loop[(k + 1) % loop.size()]) / 2;
  }
  return sum;
}

double area_above(const Samples& samples, double level) { return signed_area(superlevel_loops(samples.grid(), level)); }

double total_length(const std::vector<std::vector<Vec2>>& lines) {
  double sum = 0;
  for (const auto& line : lines) {
    for (std::size_t k = 1; k < line.size(); ++k) sum += length(line[k] - line[k - 1]);
  }
  return sum;
}

constexpr double kEverything = -std::numeric_limits<double>::infinity();

TEST(Contour, OfAPlaneIsOneStraightLineAtExactlyTheLevel) {
  const auto f = [](double x, double y) { return 3 * x - 2 * y + 1; };
  const Samples samples = sample(12, 9, f);
  for (const double level : {0.5, 3.25, 7.0, 19.9}) {
    const auto lines = contour_lines(samples.grid(), level);
    ASSERT_EQ(lines.size(), 1u) << level;
    ASSERT_GE(lines[0].size(), 2u);
    for (const Vec2 p : lines[0]) EXPECT_NEAR(f(p.x, p.y), level, 20 * kRounding);
    EXPECT_NEAR(length(lines[0].back() - lines[0].front()), total_length(lines), kRounding) << "not straight";
  }
}

TEST(Contour, HasTheHigherSideOnItsLeft) {
  const Samples samples = sample(5, 5, [](double x, double) { return x; });
  const auto lines = contour_lines(samples.grid(), 1.5);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GT(lines[0].front().y, lines[0].back().y) << "down, with larger x on the left";
}

TEST(Contour, BandsOfAPlaneHaveTheirAreas) {
  // x + y over [0, 10]²: below level s ≤ 10 lies a triangle of area s²/2.
  const Samples samples = sample(11, 11, [](double x, double y) { return x + y; });
  for (const double s : {0.7, 2.0, 5.3, 10.0}) EXPECT_NEAR(area_above(samples, s), 100 - s * s / 2, 100 * kRounding);
  EXPECT_NEAR(area_above(samples, kEverything), 100, 100 * kRounding);
  EXPECT_NEAR(area_above(samples, 20.5), 0, kRounding);
}

TEST(Contour, OfAConeIsACircleOfTheRightLengthAndArea) {
  const Samples samples = sample(41, 41, [](double x, double y) { return -std::hypot(x - 20, y - 20); });
  const double radius = 15;
  const auto lines = contour_lines(samples.grid(), -radius);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back()) << "a loop";
  EXPECT_NEAR(total_length(lines), 2 * std::numbers::pi * radius, 0.01 * 2 * std::numbers::pi * radius);
  EXPECT_NEAR(area_above(samples, -radius), std::numbers::pi * radius * radius, 0.01 * 700);
}

TEST(Contour, ASaddleIsJoinedOnTheSideOfItsSaddlePoint) {
  // Corners 2, −1, 2, −1: the bilinear saddle has the value (2·2 − 1·1)/(2 + 2 + 1 + 1) = 0.5.
  const Samples samples{2, 2, {2, -1, -1, 2}};
  EXPECT_EQ(superlevel_loops(samples.grid(), 0.4).size(), 1u) << "one region through the saddle";
  EXPECT_EQ(superlevel_loops(samples.grid(), 0.6).size(), 2u) << "two corners";
  EXPECT_EQ(contour_lines(samples.grid(), 0.4).size(), 2u);
  EXPECT_EQ(contour_lines(samples.grid(), 0.6).size(), 2u);
  EXPECT_GT(area_above(samples, 0.4), 0.5);
  EXPECT_LT(area_above(samples, 0.6), 0.5);
}

TEST(Contour, SamplesThatAreNotFiniteAreOutside) {
  // A hole of one sample: the four cells around it keep the half that does not have it.
  Samples samples = sample(7, 7, [](double x, double) { return x; });
  samples.values[3 * 7 + 3] = kOutside;
  EXPECT_NEAR(area_above(samples, kEverything), 36 - 2, kRounding);
  // A row and a column of infinities: whole cells.
  Samples cut = sample(7, 7, [](double x, double y) { return y == 0 || x == 6 ? 1 / 0.0 : x; });
  EXPECT_NEAR(area_above(cut, kEverything), 25, kRounding);
  for (const auto& line : contour_lines(cut.grid(), 2.5)) {
    for (const Vec2 p : line) EXPECT_GE(p.y, 1);
  }
  const Samples nothing = sample(4, 4, [](double, double) { return kOutside; });
  EXPECT_TRUE(superlevel_loops(nothing.grid(), kEverything).empty());
  EXPECT_TRUE(contour_lines(nothing.grid(), 0).empty());
}

// The level line is the common border of what is above it and what is above −level in −f.
TEST(Contour, WhatIsAboveAndWhatIsBelowFillTheDomainWhateverTheSamples) {
  Rng rng(7);
  int with_holes = 0;
  for (int round = 0; round < 200; ++round) {
    const double holes = round % 2 == 0 ? 0 : 0.15;
    Samples f{2 + rng.below(9), 2 + rng.below(9), {}}, negative;
    for (std::size_t k = 0; k < f.nx * f.ny; ++k) f.values.push_back(rng.uniform() < holes ? kOutside : rng.uniform());
    negative = f;
    for (double& v : negative.values) v = -v;
    const double level = rng.uniform(0.1, 0.9);
    const double domain = area_above(f, kEverything);
    with_holes += domain < static_cast<double>((f.nx - 1) * (f.ny - 1)) ? 1 : 0;
    EXPECT_NEAR(area_above(f, level) + area_above(negative, -level), domain, 100 * kRounding) << "round " << round;
    EXPECT_NEAR(total_length(contour_lines(f.grid(), level)), total_length(contour_lines(negative.grid(), -level)),
                100 * kRounding);
    EXPECT_LE(area_above(f, level + 0.05), area_above(f, level) + kRounding) << "higher levels have less above them";
  }
  EXPECT_GT(with_holes, 50);
}

TEST(Contour, LevelsThatMeetSamplesExactlyLeaveNoGap) {
  const Samples samples = sample(6, 6, [](double x, double y) { return std::floor((x + 2 * y) / 3); });
  for (const double level : {0.0, 1.0, 2.0, 3.0}) {
    Samples negative = samples;
    for (double& v : negative.values) v = -v;
    // On plateaus the two differ by who owns the plateau; together they cover at least everything.
    EXPECT_GE(area_above(samples, level) + area_above(negative, -level), 25 - kRounding) << level;
    for (const auto& loop : superlevel_loops(samples.grid(), level)) EXPECT_GE(loop.size(), 3u);
  }
}

TEST(Contour, TheLargestValuesDoNotOverflow) {
  const Samples samples{2, 2, {-1.7e308, 1.7e308, -1.7e308, 1.7e308}};
  const auto lines = contour_lines(samples.grid(), 0);
  ASSERT_EQ(lines.size(), 1u);
  for (const Vec2 p : lines[0]) EXPECT_NEAR(p.x, 0.5, kRounding);
}

}  // namespace
}  // namespace temper
