// Exact stages of the predicates, and the ties.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "geometry/exact_determinants.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper {

namespace {

constexpr Sign operator*(Sign a, Sign b) { return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b)); }

}  // namespace

namespace exact {

Sign orient2d(Vec2 a, Vec2 b, Vec2 c) { return exact::doubled_area(a, b, c).sign(); }

Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d) {
  return exact::power_determinant(a, b, c, d).sign();
}

Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return exact::height_numerator(p, q, r).sign();
}

Sign edge_split_sign(const WeightedPoint& p, const WeightedPoint& q) { return exact::doubled_split(p, q).sign(); }

}  // namespace exact

Sign orient2d(Vec2 a, Vec2 b, Vec2 c) { return inlined::orient2d(a, b, c); }

Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d) {
  return inlined::power_test(a, b, c, d);
}

// The lifted determinant is linear in each weight, and has no product of two of them:
//   ∂/∂w of a, b, c, d = −orient(b, c, d), +orient(a, c, d), −orient(a, b, d), +orient(a, b, c).
// ε¹ ≫ ε² ≫ …, so the lowest index whose derivative is not zero decides.
Sign power_test_perturbed(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                          const WeightedPoint& d, const std::array<std::uint32_t, 4>& index) {
  const Sign unperturbed = inlined::power_test(a, b, c, d);
  if (unperturbed != Sign::zero) return unperturbed;

  const std::array<Vec2, 4> at = {a.position(), b.position(), c.position(), d.position()};
  std::array<int, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return index[i] < index[j]; });
  for (const int i : order) {
    const std::array<std::array<int, 3>, 4> others = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
    const Sign minor = inlined::orient2d(at[others[i][0]], at[others[i][1]], at[others[i][2]]);
    if (minor != Sign::zero) return i % 2 == 0 ? -minor : minor;
  }
  return Sign::zero;
}

Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Sign orientation = inlined::orient2d(p.position(), q.position(), r.position());
  return orientation * inlined::height_numerator_sign(p, q, r);
}

Sign edge_split_sign(const WeightedPoint& p, const WeightedPoint& q) { return inlined::edge_split_sign(p, q); }

bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::is_well_centered(p, q, r);
}

}  // namespace temper
