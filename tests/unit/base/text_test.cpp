// to_text: the shortest decimal that reads back.
#include "base/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

#include "base/rng.hpp"

namespace temper {
namespace {

TEST(Text, OfNumbersPeopleWriteIsWhatTheyWrite) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(-0.0), "-0");
  EXPECT_EQ(to_text(42), "42");
  EXPECT_EQ(to_text(1e60), "1e+60");
  EXPECT_EQ(to_text(0.1 + 0.2), "0.30000000000000004");
}

TEST(Text, ReadsBackToTheSameBitsAndFitsItsBuffer) {
  Rng rng(1);
  int finite = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(rng.next());
    const std::string text = to_text(value);
    ASSERT_FALSE(text.empty());
    ASSERT_LT(text.size(), 32u);
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)), std::bit_cast<std::uint64_t>(value));
    ++finite;
  }
  EXPECT_GT(finite, 90000);
}

}  // namespace
}  // namespace temper
