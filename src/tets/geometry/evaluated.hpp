// The value of a polynomial of formulas.hpp with a small relative error, whatever cancels in it.
#pragma once

#include <cmath>

#include "geometry/predicates_inline.hpp"
#include "tets/geometry/compact.hpp"
#include "tets/geometry/formulas.hpp"

namespace temper::tets {

/// The value in doubles if its relative error is at most `relative`, else the exact value, rounded once. So its sign is
/// right, and 0 is exactly 0. `polynomial` takes a kind of number.
template <class Polynomial>
double evaluated(double relative, const Polynomial& polynomial) {
  constexpr double kBound = 32 * inlined::kUnitRoundoff;  // more than the roundings that formulas.hpp counts
  const Estimate fast = polynomial(Estimate());
  if (kBound * fast.permanent < relative * std::abs(fast.value)) return fast.value;
  return polynomial(exact::Compact()).rounded();
}

}  // namespace temper::tets
