#include "dec/accurate.hpp"

#include <cmath>

#include "geometry/exact_determinants.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper::accurate {
namespace {

/// The terms do not overlap, smallest first: their sum is off by a rounding or two.
template <int N>
double nearest_double(const exact::Expansion<N>& e) {
  double sum = 0;
  for (int i = 0; i < e.size(); ++i) sum += e[i];
  return sum;
}

bool is_accurate(const inlined::Filtered<double>& f) { return f.bound < kRelativeError * std::abs(f.value); }

}  // namespace

double doubled_area(Vec2 a, Vec2 b, Vec2 c) {
  const auto fast = inlined::filtered_orient2d(a, b, c);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::doubled_area(a, b, c));
}

double power_determinant(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                         const WeightedPoint& d) {
  const auto fast = inlined::filtered_power_test(a, b, c, d);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::power_determinant(a, b, c, d));
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const auto fast = inlined::filtered_height_numerator(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::height_numerator(p, q, r));
}

double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const auto fast = inlined::filtered_dual_crossing(p, q);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::doubled_crossing(p, q));
}

double orientation_determinant(Vec3 p, Vec3 q, Vec3 r) {
  const auto fast = inlined::filtered_orientation(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::orientation_determinant(p, q, r));
}

double power_determinant(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto fast = inlined::filtered_power_test(a, b, c, d);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::power_determinant(a, b, c, d));
}

double height_numerator(Vec3 p, Vec3 q, Vec3 r) {
  const auto fast = inlined::filtered_height_numerator(p, q, r);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::height_numerator(p, q, r));
}

double crossing_product(Vec3 p, Vec3 q) {
  const auto fast = inlined::filtered_dual_crossing(p, q);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(exact::crossing_product(p, q));
}

}  // namespace temper::accurate
