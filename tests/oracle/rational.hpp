// Rational numbers, and comparisons of doubles with them.
#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>

namespace temper::testing {

using Rational = mpq_class;

/// Of the operators: a few determinants, each off by 2⁻⁴² of itself at most, and a few roundings.
constexpr double kRelative = 1e-12;

inline void expect_relative(double found, const Rational& expected) {
  if (expected == 0) {
    EXPECT_EQ(found, 0);
    return;
  }
  const Rational error = (Rational(found) - expected) / expected;
  EXPECT_LE(std::abs(error.get_d()), kRelative) << found << " for " << expected.get_d();
}

}  // namespace temper::testing
