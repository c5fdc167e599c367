// Exact signs: first doubles with bounds of their errors, then integers times powers of two, which never overflow.
#include "geometry/dyadic.hpp"
#include "surfaces/geometry/formulas.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// The sign of formula(T()) for T = Bounded, or for exact numbers if that leaves a doubt.
template <class Formula>
Sign exact_sign(const Formula& formula) {
  if (const auto sign = formula(Bounded()).sign()) return *sign;
  return formula(exact::Dyadic()).sign();
}

/// The sign of a sum, from the signs of its terms and a formula with the sign of the difference of their squares.
template <class Formula>
Sign sign_of_sum(Sign left, Sign right, const Formula& difference_of_squares) {
  if (left == right || right == Sign::zero) return left;
  if (left == Sign::zero) return right;
  const Sign farther = exact_sign(difference_of_squares);
  return left == Sign::positive ? farther : -farther;
}

}  // namespace

bool is_flat(Vec3 p, Vec3 q, Vec3 r) {
  return exact_sign([&]<class T>(T) { return squared_doubled_area<T>(p, q, r); }) == Sign::zero;
}

Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return exact_sign([&]<class T>(T) { return height_numerator<T>(p, q, r); });
}

Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q) {
  return exact_sign([&]<class T>(T) { return doubled_crossing<T>(p, q); });
}

Sign dual_length_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  return sign_of_sum(signed_height_sign(p, q, r), signed_height_sign(q, p, s),
                     [&]<class T>(T) { return difference_of_squares<T>(p, q, r, s); });
}

bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const auto is_positive = [](Sign sign) { return sign == Sign::positive; };
  const auto is_crossed = [&](const WeightedPoint& a, const WeightedPoint& b) {
    return is_positive(dual_crossing_sign(a, b)) && is_positive(dual_crossing_sign(b, a));
  };
  return is_positive(signed_height_sign(p, q, r)) && is_positive(signed_height_sign(q, r, p)) &&
         is_positive(signed_height_sign(r, p, q)) && is_crossed(p, q) && is_crossed(q, r) && is_crossed(r, p);
}

bool is_flat(const MetricTriangle& t) {
  return exact_sign([&]<class T>(T) { return squared_doubled_area<T>(t); }) != Sign::positive;
}

Sign signed_height_sign(const MetricTriangle& t) {
  return exact_sign([&]<class T>(T) { return height_numerator<T>(t); });
}

Sign dual_crossing_sign(const MetricTriangle& t) {
  return exact_sign([&]<class T>(T) { return doubled_crossing<T>(t); });
}

Sign dual_length_sign(const MetricTriangle& left, const MetricTriangle& right) {
  return sign_of_sum(signed_height_sign(left), signed_height_sign(right),
                     [&]<class T>(T) { return difference_of_squares<T>(left, right); });
}

bool is_well_centered(const MetricTriangle& t) {
  MetricTriangle side = t;
  for (int k = 0; k < 3; ++k, side = side.turned()) {
    if (signed_height_sign(side) != Sign::positive || dual_crossing_sign(side) != Sign::positive ||
        dual_crossing_sign(side.mirrored()) != Sign::positive)
      return false;
  }
  return true;
}

}  // namespace temper::surfaces
