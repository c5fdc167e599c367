// Random numbers: known values, so that a seed means the same everywhere, and the ranges and evenness promised.
#include "base/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <set>

namespace temper {
namespace {

TEST(Rng, GivesThePublishedSequenceOfSplitmix64) {
  // The first outputs for seed 1234567, as in the tests of other implementations.
  Rng rng(1234567);
  EXPECT_EQ(rng.next(), 6457827717110365317u);
  EXPECT_EQ(rng.next(), 3203168211198807973u);
  EXPECT_EQ(rng.next(), 9817491932198370423u);
  EXPECT_EQ(rng.next(), 4593380528125082431u);
  EXPECT_EQ(rng.next(), 16408922859458223821u);
}

TEST(Rng, IsAConstantExpression) {
  constexpr std::uint64_t kFirst = [] { return Rng(1234567).next(); }();
  EXPECT_EQ(kFirst, 6457827717110365317u);
}

TEST(Rng, OfTheSameSeedRepeatsAndOfAnotherDiffers) {
  Rng a(7), b(7), c(8);
  int same = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t x = a.next();
    EXPECT_EQ(x, b.next());
    same += x == c.next() ? 1 : 0;
  }
  EXPECT_EQ(same, 0);
}

TEST(Rng, UniformIsInItsRangeWithTheRightMoments) {
  Rng rng(3);
  constexpr int kDraws = 200000;
  double sum = 0, squares = 0, least = 1, greatest = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    ASSERT_EQ(x * 0x1p53, static_cast<double>(static_cast<std::uint64_t>(x * 0x1p53)));
    sum += x;
    squares += x * x;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  // Five standard deviations of the means, 1/√(12 n) and √(4/(45 n)).
  EXPECT_NEAR(sum / kDraws, 0.5, 5 * 0.000646);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 5 * 0.000667);
  EXPECT_LT(least, 1e-4);
  EXPECT_GT(greatest, 1 - 1e-4);
  for (int i = 0; i < 1000; ++i) {
    const double x = rng.uniform(-3, 5);
    EXPECT_GE(x, -3);
    EXPECT_LT(x, 5);
  }
}

TEST(Rng, BelowMeetsEveryValueEvenly) {
  Rng rng(4);
  constexpr int kDraws = 70000;
  std::array<int, 7> counts{};
  for (int i = 0; i < kDraws; ++i) {
    const std::uint32_t k = rng.below(7);
    ASSERT_LT(k, 7u);
    ++counts[k];
  }
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 7, 5 * 93);  // √(n p (1 − p)) = 92.6
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.below(1), 0u);
}

TEST(Mix64, IsInjectiveOnWhatWasTriedAndChangesHalfOfTheBits) {
  std::set<std::uint64_t> images;
  int changed = 0;
  for (std::uint64_t x = 0; x < 10000; ++x) {
    images.insert(mix64(x));
    changed += std::popcount(mix64(x + 1) ^ mix64(x));
  }
  EXPECT_EQ(images.size(), 10000u);
  EXPECT_NEAR(changed / 10000.0, 32, 1);
}

}  // namespace
}  // namespace temper
