#include "tets/dec/accurate.hpp"

#include <cmath>

#include "dec/accurate.hpp"
#include "geometry/predicates_inline.hpp"
#include "tets/geometry/compact.hpp"
#include "tets/geometry/formulas.hpp"

namespace temper::tets::accurate {
namespace {

// More than the roundings that formulas.hpp counts.
constexpr double kBound = 32 * inlined::kUnitRoundoff;

/// Evaluates a polynomial in doubles if rounding hardly changes it, else exactly. `polynomial` takes a kind of number.
template <class Polynomial>
double evaluated(const Polynomial& polynomial) {
  const Estimate fast = polynomial(Estimate());
  if (kBound * fast.permanent < temper::accurate::kRelativeError * std::abs(fast.value)) return fast.value;
  return polynomial(exact::Compact()).rounded();
}

}  // namespace

double six_volumes(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  return evaluated([&]<class T>(const T&) { return volume_polynomial<T>(p, q, r, s); });
}

double squared_doubled_area(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return evaluated([&]<class T>(const T&) { return area_polynomial<T>(p, q, r); });
}

double power_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s,
                        const WeightedPoint& t) {
  return evaluated([&]<class T>(const T&) { return tets::power_polynomial<T>(p, q, r, s, t); });
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                        const WeightedPoint& s) {
  return evaluated([&]<class T>(const T&) { return height_polynomial<T>(p, q, r, s); });
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return evaluated([&]<class T>(const T&) { return height_polynomial<T>(p, q, r); });
}

double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  return evaluated([&]<class T>(const T&) { return crossing_polynomial<T>(p, q); });
}

}  // namespace temper::tets::accurate
