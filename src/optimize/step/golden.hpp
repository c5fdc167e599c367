// Golden-section search, the paper's line search (Algorithm 5).
#pragma once

#include <cmath>

namespace temper {

/// The t in [0, limit] where f is least, up to `tolerance` × limit, when f has one minimum there; else a local one.
/// f may be +∞. Costs 2 + log(1/tolerance)/log(1.618) evaluations.
template <class Function>
double golden_section(Function&& f, double limit, double tolerance) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  double low = 0, high = limit;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  while (high - low > tolerance * limit) {
    if (fb < fa) {
      low = a, a = b, fa = fb;
      b = low + ratio * (high - low);
      fb = f(b);
    } else {  // ties, and both infinite: towards the start, where the energy is finite
      high = b, b = a, fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    }
  }
  return fa <= fb ? a : b;
}

}  // namespace temper
