#include "dec/accurate.hpp"

#include <cmath>

#include "geometry/exact_determinants.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper::accurate {
namespace {

bool is_accurate(const inlined::Filtered<double>& f) { return f.bound < kRelativeError * std::abs(f.value); }

}  // namespace

double doubled_area(Vec2 a, Vec2 b, Vec2 c) {
  const auto fast = inlined::filtered_orient2d(a, b, c);
  if (is_accurate(fast)) return fast.value;
  return exact::doubled_area(a, b, c).rounded();
}

double power_determinant(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                         const WeightedPoint& d) {
  const auto fast = inlined::filtered_power_test(a, b, c, d);
  if (is_accurate(fast)) return fast.value;
  return exact::power_determinant(a, b, c, d).rounded();
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const auto fast = inlined::filtered_height_numerator(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return exact::height_numerator(p, q, r).rounded();
}

double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const auto fast = inlined::filtered_dual_crossing(p, q);
  if (is_accurate(fast)) return fast.value;
  return exact::doubled_crossing(p, q).rounded();
}

double orientation_determinant(Vec3 p, Vec3 q, Vec3 r) {
  const auto fast = inlined::filtered_orientation(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return exact::orientation_determinant(p, q, r).rounded();
}

double power_determinant(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto fast = inlined::filtered_power_test(a, b, c, d);
  if (is_accurate(fast)) return fast.value;
  return exact::power_determinant(a, b, c, d).rounded();
}

double height_numerator(Vec3 p, Vec3 q, Vec3 r) {
  const auto fast = inlined::filtered_height_numerator(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return exact::height_numerator(p, q, r).rounded();
}

double crossing_product(Vec3 p, Vec3 q) {
  const auto fast = inlined::filtered_dual_crossing(p, q);
  if (is_accurate(fast)) return fast.value;
  return exact::crossing_product(p, q).rounded();
}

}  // namespace temper::accurate
