#include "base/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/rng.hpp"

namespace temper {
namespace {

TEST(SineCosine, IsThatOfTheCLibraryButForRounding) {
#ifdef _WIN32
  GTEST_SKIP() << "sin() of this C library is wrong by four units of the last place at 5e5";
#endif
  Rng rng(3);
  for (const double most : {1.0, 10.0, 1e3, 9e5}) {
    for (int i = 0; i < 20'000; ++i) {
      const double x = rng.uniform(-most, most);
      const auto [sine, cosine] = sine_cosine(x);
      ASSERT_NEAR(sine, std::sin(x), 4e-16) << x;
      ASSERT_NEAR(cosine, std::cos(x), 4e-16) << x;
    }
  }
  for (int i = 0; i < 1000; ++i) {
    const double x = rng.uniform(1e6, 1e9);
    ASSERT_NEAR(sine_cosine(x).sine, std::sin(x), 2e-16 * x) << x;
  }
}

TEST(SineCosine, HasTheseBitsEverywhere) {
  std::uint64_t hash = 0;
  for (int i = -2000; i <= 2000; ++i) {
    const double x = i;
    const auto [sine, cosine] = sine_cosine(x * std::numbers::pi / 64 + x * x);
    for (const double value : {sine, cosine}) hash = hash * 31 + std::bit_cast<std::uint64_t>(value);
  }
  EXPECT_EQ(hash, 6858949834754607556u);
}

TEST(SineCosine, OfWhatIsNotFiniteIsNoNumber) {
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::infinity()).sine));
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::quiet_NaN()).cosine));
  EXPECT_EQ(sine_cosine(0).sine, 0);
  EXPECT_EQ(sine_cosine(0).cosine, 1);
}

TEST(ArcCosine, IsTheInverseOfTheCosineAtEachAngle) {
  for (int i = 0; i <= 10'000; ++i) {
    const double angle = i * std::numbers::pi / 10'000;
    const double x = std::cos(angle);
    ASSERT_NEAR(std::cos(arc_cosine(x)), x, 1e-15) << angle;
    // A rounding of x moves the angle by 1 / sine as much.
    ASSERT_NEAR(arc_cosine(x), std::acos(x), 1e-15 + 2e-16 / std::max(std::sin(angle), 1e-8)) << angle;
  }
  EXPECT_EQ(arc_cosine(1 + 1e-15), 0);
  EXPECT_EQ(arc_cosine(-1), std::numbers::pi);
}

}  // namespace
}  // namespace temper
