// A cube root from additions, multiplications and divisions alone.
#pragma once

#include <cmath>

namespace temper {

/// The cube root of a normal x > 0, to a few roundings. It has the same bits wherever IEEE arithmetic is; cube roots of
/// C libraries do not. Twelve steps of Newton's method reach rounding from a third of the exponent.
[[nodiscard]] inline double cube_root(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  double root = std::ldexp(mantissa, exponent / 3);
  for (int i = 0; i < 12; ++i) root -= (root - x / (root * root)) / 3;
  return root;
}

}  // namespace temper
