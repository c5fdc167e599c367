// Numbers of any length: against integers of 64 bits, and by the laws of a ring.
#include "geometry/dyadic.hpp"

#include <gtest/gtest.h>

#include "unit/geometry/degenerate_families.hpp"

namespace temper::exact {
namespace {

using testing::Random;

bool equal(const Dyadic& a, const Dyadic& b) { return (a + -b).sign() == Sign::zero; }

TEST(Dyadic, IsTheDouble) {
  EXPECT_EQ(Dyadic().sign(), Sign::zero);
  EXPECT_EQ(Dyadic(0).sign(), Sign::zero);
  for (const double x : {1.0, 0x1p-1074, 0x1.fffffffffffffp1023, 0x1.fffffffffffffp-31, 0x1.8p32, 3.0, 0x1p-33}) {
    EXPECT_EQ(Dyadic(x).sign(), Sign::positive) << x;
    EXPECT_EQ(Dyadic(-x).sign(), Sign::negative) << x;
    EXPECT_TRUE(equal(Dyadic(x), -Dyadic(-x))) << x;
    EXPECT_TRUE(equal(Dyadic(x) + Dyadic(x), Dyadic(2) * Dyadic(x))) << x;
  }
}

TEST(Dyadic, TheApproximationIsTheDoubleOrTheNearestToASum) {
  Random random(3);
  EXPECT_EQ(Dyadic().approximation(), 0);
  for (int round = 0; round < 2000; ++round) {
    const double x = std::ldexp(testing::real(random), testing::integer(random, 400));
    const double y = std::ldexp(testing::real(random), testing::integer(random, 400));
    EXPECT_EQ(Dyadic(x).approximation(), x);
    for (const auto& [found, rounded] : {std::pair((Dyadic(x) + Dyadic(y)).approximation(), x + y),
                                         std::pair((Dyadic(x) * Dyadic(y)).approximation(), x * y)})
      EXPECT_LE(std::abs(found - rounded), 0x1p-52 * std::abs(rounded)) << x << ' ' << y;
  }
}

TEST(Dyadic, CountsLikeIntegers) {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    const auto a = static_cast<std::int64_t>(random() >> (34 + random() % 20)) * (random() % 2 == 0 ? 1 : -1);
    const auto b = static_cast<std::int64_t>(random() >> (34 + random() % 20)) * (random() % 2 == 0 ? 1 : -1);
    const auto number = [](std::int64_t n) {
      return Dyadic(static_cast<double>(n >> 32) * 0x1p32) + Dyadic(static_cast<double>(n & 0xffffffff));
    };
    EXPECT_TRUE(equal(number(a) + number(b), number(a + b)));
    EXPECT_TRUE(equal(number(a) * number(b), number(a * b)));
  }
}

TEST(Dyadic, NoDigitIsLostAtAnyDistance) {
  for (const double far : {0x1p-1000, 0x1p-500, 0x1p-64, 0x1p-31}) {
    const Dyadic large(1 / far), small(far);
    const Dyadic sum = large + small;
    EXPECT_EQ((sum + -large).sign(), Sign::positive);
    EXPECT_TRUE(equal(sum + -large, small));
    EXPECT_TRUE(equal(sum * sum, large * large + small * small + Dyadic(2)));
    EXPECT_EQ((large + -sum).sign(), Sign::negative);
  }
}

TEST(Dyadic, IsARing) {
  Random random(2);
  const auto draw = [&] {
    Dyadic number;
    for (int i = 0; i < 4; ++i)
      number = number + Dyadic(std::ldexp(testing::real(random), testing::integer(random, 300)));
    return number;
  };
  for (int round = 0; round < 500; ++round) {
    const Dyadic a = draw(), b = draw(), c = draw();
    EXPECT_TRUE(equal((a + b) + c, a + (b + c)));
    EXPECT_TRUE(equal(a * (b + c), a * b + a * c));
    EXPECT_TRUE(equal((a * b) * c, a * (b * c)));
    EXPECT_EQ((a + -a).sign(), Sign::zero);
    EXPECT_EQ((a * a).sign(), Sign::positive);
    EXPECT_EQ(static_cast<int>((a * b).sign()), static_cast<int>(a.sign()) * static_cast<int>(b.sign()));
  }
}

}  // namespace
}  // namespace temper::exact
