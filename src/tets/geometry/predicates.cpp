// The predicates: the sign of a polynomial in doubles if rounding cannot change it, else of the same polynomial in
// exact numbers. Bounds and range: as in geometry/predicates_inline.hpp. A polynomial is a multiple of 2^-1022. If its
// bound underflows, 53 bits hold all such multiples, so that nothing was rounded at all.
#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/predicates_inline.hpp"
#include "tets/geometry/compact.hpp"
#include "tets/geometry/formulas.hpp"

namespace temper::tets {
namespace {

using exact::Compact;

template <class Exactly>
Sign filtered_sign(const Estimate& e, double bound, const Exactly& exactly) {
  return inlined::sign_or(inlined::Filtered<double>{e.value, bound * e.permanent}, exactly);
}

}  // namespace

// − det(p − s, q − s, r − s) is what the power test of the sphere computes.
Sign orientation(Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
  return inlined::sign_or(inlined::filtered_power_test(p, q, r, s), [&] { return exact::power_test(p, q, r, s); });
}

Sign power_test(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s,
                const WeightedPoint& t) {
  return filtered_sign(power_polynomial<Estimate>(p, q, r, s, t), kPowerBound,
                       [&] { return power_polynomial<Compact>(p, q, r, s, t).sign(); });
}

// The polynomial is linear in each weight, and has no product of two of them. Its derivative by the weight of a point
// is the orientation of the other four in their order, with signs +, −, +, −, +. The point with the lowest index whose
// derivative is not zero decides.
Sign power_test_perturbed(const std::array<WeightedPoint, 5>& points, const std::array<std::uint32_t, 5>& index) {
  const auto& [p, q, r, s, t] = points;
  const Sign unperturbed = power_test(p, q, r, s, t);
  if (unperturbed != Sign::zero) return unperturbed;
  std::array<std::size_t, 5> order = {0, 1, 2, 3, 4};
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return index[i] < index[j]; });
  for (const std::size_t i : order) {
    std::array<Vec3, 4> others;
    for (std::size_t k = 0; k < 4; ++k) others[k] = points[k < i ? k : k + 1].position();
    const Sign derivative = orientation(others[0], others[1], others[2], others[3]);
    if (derivative != Sign::zero) return i % 2 == 0 ? derivative : -derivative;
  }
  return Sign::zero;
}

Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                        const WeightedPoint& s) {
  return filtered_sign(height_polynomial<Estimate>(p, q, r, s), kHeightBound,
                       [&] { return height_polynomial<Compact>(p, q, r, s).sign(); });
}

Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return filtered_sign(height_polynomial<Estimate>(p, q, r), kFaceHeightBound,
                       [&] { return height_polynomial<Compact>(p, q, r).sign(); });
}

Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q) {
  return filtered_sign(crossing_polynomial<Estimate>(p, q), kCrossingBound,
                       [&] { return crossing_polynomial<Compact>(p, q).sign(); });
}

}  // namespace temper::tets
