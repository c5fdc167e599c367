// Exact stages of the predicates, and the ties.
//
// Every determinant is a polynomial of differences of the inputs; a difference of two doubles is an expansion of
// two terms, exactly, so no stage ever rounds. On inputs whose differences are single doubles (lattices, where
// ties are) the expansions stay a few terms long.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "geometry/expansion.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper {

namespace {

constexpr Sign operator*(Sign a, Sign b) { return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b)); }

exact::Expansion<2> difference(double a, double b) { return exact::two_diff(a, b); }

struct ExactVector {
  exact::Expansion<2> x, y;
};

ExactVector difference(const WeightedPoint& a, const WeightedPoint& b) {
  return {difference(a.x, b.x), difference(a.y, b.y)};
}

exact::Expansion<16> exact_dot(const ExactVector& a, const ExactVector& b) { return a.x * b.x + a.y * b.y; }
exact::Expansion<16> exact_cross(const ExactVector& a, const ExactVector& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

namespace exact {

Sign orient2d(Vec2 a, Vec2 b, Vec2 c) {
  const ExactVector ac = {difference(a.x, c.x), difference(a.y, c.y)};
  const ExactVector bc = {difference(b.x, c.x), difference(b.y, c.y)};
  return exact_cross(ac, bc).sign();
}

Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d) {
  const ExactVector ad = difference(a, d);
  const ExactVector bd = difference(b, d);
  const ExactVector cd = difference(c, d);
  const auto lift = [&](const ExactVector& v, double w) { return exact_dot(v, v) - difference(w, d.w); };
  const auto from_a = lift(ad, a.w) * exact_cross(bd, cd);
  const auto from_b = lift(bd, b.w) * exact_cross(cd, ad);
  const auto from_c = lift(cd, c.w) * exact_cross(ad, bd);
  return (from_a + from_b + from_c).sign();
}

Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const ExactVector pq = difference(q, p);
  const ExactVector pr = difference(r, p);
  const ExactVector qr = difference(r, q);
  const auto at_r = exact_dot(pr, qr);
  const auto from_p = exact_dot(pq, pr) * (at_r + difference(q.w, r.w));
  const auto from_q = exact_dot(pq, qr) * (at_r + difference(p.w, r.w));  // minus D_q
  return (from_p - from_q).sign();
}

Sign edge_split_sign(const WeightedPoint& p, const WeightedPoint& q) {
  const ExactVector pq = difference(q, p);
  return (exact_dot(pq, pq) + difference(p.w, q.w)).sign();
}

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
