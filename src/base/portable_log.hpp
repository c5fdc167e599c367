// A logarithm from additions, multiplications and divisions alone.
#pragma once

#include <numbers>

#include "base/pack.hpp"

namespace temper {

/// The natural logarithm of a normal x > 0, to about 2⁻⁵¹. It has the same bits wherever IEEE arithmetic is; logarithms
/// of C libraries do not.
template <class T>
[[nodiscard]] TEMPER_INLINE T portable_log(const T& x) {
  // x = m 2^k, m in [√½, √2); ln m = 2 artanh z, z = (m − 1)/(m + 1), z² < 0.0295: eleven terms reach rounding.
  const T m = mantissa(x), one = all<T>(1), z = (m - one) / (m + one), z2 = z * z;
  constexpr double kTerms[] = {1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3};
  T series = all<T>(1.0 / 21);
  for (const double term : kTerms) series = series * z2 + term;
  return std::numbers::ln2 * exponent(x) + 2 * (z + z * z2 * series);
}

}  // namespace temper
