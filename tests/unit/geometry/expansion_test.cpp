// Laws of exact arithmetic: whatever the operands, the rules of a commutative ring hold without error.
#include "geometry/expansion.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "unit/geometry/degenerate_families.hpp"

namespace temper::exact {
namespace {

using testing::integer;
using testing::Random;
using testing::real;

constexpr int kRounds = 2000;

/// A double of random magnitude within 2^±100, sometimes 0 and sometimes with few bits.
double any(Random& random) {
  const double significand = random() % 2 == 0 ? real(random) : integer(random, 3);
  return std::ldexp(significand, integer(random, 100));
}

Expansion<4> any_expansion(Random& random) {
  return Expansion<2>(two_diff(any(random), any(random))) + Expansion<2>(two_sum(any(random), any(random)));
}

/// Exponent of the lowest bit set in x ≠ 0.
int lowest_bit(double x) {
  int exponent = 0;
  const double significand = std::frexp(x, &exponent);
  const auto bits = static_cast<std::uint64_t>(std::abs(std::ldexp(significand, 53)));
  return exponent - 53 + std::countr_zero(bits);
}

template <int N>
bool is_nonoverlapping(const Expansion<N>& e) {
  for (int i = 0; i < e.size(); ++i) {
    if (e[i] == 0) return false;
    if (i + 1 < e.size() && std::ilogb(e[i]) >= lowest_bit(e[i + 1])) return false;
  }
  return true;
}

TEST(Expansion, SumsOfTwoDoublesKeepTheirRoundingError) {
  const TwoTerms sum = two_sum(1e16, 0.75 + 0x1p-52);  // next to 1e16 is 1e16 + 2
  EXPECT_EQ(sum.high, 1e16);
  EXPECT_EQ(sum.low, 0.75 + 0x1p-52);
  const TwoTerms difference = two_diff(0x1p-60, 1.0);
  EXPECT_EQ(difference.high, -1.0);
  EXPECT_EQ(difference.low, 0x1p-60);
}

TEST(Expansion, ProductsOfTwoDoublesKeepTheirRoundingError) {
  const double a = 1 + 0x1p-52;
  const TwoTerms product = two_product(a, a, split(a));  // 1 + 2^-51 + 2^-104
  EXPECT_EQ(product.high, 1 + 0x1p-51);
  EXPECT_EQ(product.low, 0x1p-104);
}

TEST(Expansion, SubtractingTheSummandsLeavesZero) {
  Random random(1);
  for (int round = 0; round < kRounds; ++round) {
    const auto a = any_expansion(random), b = any_expansion(random);
    EXPECT_EQ((a + b - a - b).sign(), Sign::zero);
    EXPECT_EQ((a - a).size(), 0);
  }
}

TEST(Expansion, MultiplicationIsCommutativeAndDistributive) {
  Random random(2);
  for (int round = 0; round < kRounds; ++round) {
    const auto a = any_expansion(random), b = any_expansion(random), c = any_expansion(random);
    EXPECT_EQ((a * b - b * a).sign(), Sign::zero);
    EXPECT_EQ(((a + b) * c - a * c - b * c).sign(), Sign::zero);
  }
}

TEST(Expansion, MultiplicationIsAssociative) {
  Random random(3);
  for (int round = 0; round < kRounds / 10; ++round) {
    const Expansion<2> a = two_sum(any(random), any(random));
    const Expansion<2> b = two_sum(any(random), any(random));
    const Expansion<2> c = two_sum(any(random), any(random));
    EXPECT_EQ(((a * b) * c - a * (b * c)).sign(), Sign::zero);
  }
}

TEST(Expansion, SignOfAProductIsTheProductOfTheSigns) {
  Random random(4);
  for (int round = 0; round < kRounds; ++round) {
    const auto a = any_expansion(random), b = any_expansion(random);
    EXPECT_EQ(static_cast<int>((a * b).sign()), static_cast<int>(a.sign()) * static_cast<int>(b.sign()));
  }
}

TEST(Expansion, TermsNeverOverlapAndAreNeverZero) {
  Random random(5);
  for (int round = 0; round < kRounds; ++round) {
    const auto a = any_expansion(random), b = any_expansion(random);
    EXPECT_TRUE(is_nonoverlapping(a));
    EXPECT_TRUE(is_nonoverlapping(a * b));
    EXPECT_TRUE(is_nonoverlapping(a * b + b));
  }
}

TEST(Expansion, AgreesWithIntegers) {
  Random random(6);
  for (int round = 0; round < kRounds; ++round) {
    const int a = integer(random, 1 << 20), b = integer(random, 1 << 20), c = integer(random, 1 << 20);
    const auto e = Expansion<2>(two_sum(a, b)) * Expansion<2>(two_diff(b, c));
    double value = 0;
    for (int i = 0; i < e.size(); ++i) value += e[i];
    EXPECT_EQ(value, static_cast<double>((std::int64_t{a} + b) * (std::int64_t{b} - c)));
  }
}

TEST(Expansion, ASmallTermSurvivesBetweenLargeOnesThatCancel) {
  const Expansion<2> large = two_sum(1e200, 1e-200);
  const Expansion<2> minus_large = two_diff(0, 1e200);
  EXPECT_EQ((large + minus_large).sign(), Sign::positive);
}

}  // namespace
}  // namespace temper::exact
