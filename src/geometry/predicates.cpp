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

/// The sign of a tie of four vertices. The determinant of the power test is linear in the perturbed quantity of each
/// vertex. Its derivatives for a, b, c, d have the signs − o(b, c, d), + o(a, c, d), − o(a, b, d), + o(a, b, c), where
/// o is the orientation. The vertex with the lowest index whose derivative is not zero decides.
template <class Orientation>
Sign perturbed_sign(const std::array<std::uint32_t, 4>& index, const Orientation& of) {
  std::array<int, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return index[i] < index[j]; });
  constexpr std::array<std::array<int, 3>, 4> kOthers = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
  for (const int i : order) {
    const Sign minor = of(kOthers[i][0], kOthers[i][1], kOthers[i][2]);
    if (minor != Sign::zero) return i % 2 == 0 ? -minor : minor;
  }
  return Sign::zero;
}

}  // namespace

namespace exact {

Sign orient2d(Vec2 a, Vec2 b, Vec2 c) { return exact::doubled_area(a, b, c).sign(); }

Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d) {
  return exact::power_determinant(a, b, c, d).sign();
}

Sign height_numerator_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return exact::height_numerator(p, q, r).sign();
}

Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q) { return exact::doubled_crossing(p, q).sign(); }

Sign orientation(Vec3 p, Vec3 q, Vec3 r) { return exact::orientation_determinant(p, q, r).sign(); }

Sign power_test(Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return exact::power_determinant(a, b, c, d).sign(); }

Sign height_numerator_sign(Vec3 p, Vec3 q, Vec3 r) { return exact::height_numerator(p, q, r).sign(); }

Sign dual_crossing_sign(Vec3 p, Vec3 q) { return exact::crossing_product(p, q).sign(); }

}  // namespace exact

Sign orient2d(Vec2 a, Vec2 b, Vec2 c) { return inlined::orient2d(a, b, c); }

Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c, const WeightedPoint& d) {
  return inlined::power_test(a, b, c, d);
}

// The lifted determinant is linear in each weight, and has no product of two of them; ε¹ ≫ ε² ≫ ….
Sign power_test_perturbed(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                          const WeightedPoint& d, const std::array<std::uint32_t, 4>& index) {
  const Sign unperturbed = inlined::power_test(a, b, c, d);
  if (unperturbed != Sign::zero) return unperturbed;
  const std::array<Vec2, 4> at = {a.position(), b.position(), c.position(), d.position()};
  return perturbed_sign(index, [&](int i, int j, int k) { return inlined::orient2d(at[i], at[j], at[k]); });
}

Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Sign orientation = inlined::orient2d(p.position(), q.position(), r.position());
  return orientation * inlined::height_numerator_sign(p, q, r);
}

Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q) { return inlined::dual_crossing_sign(p, q); }

bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::is_well_centered(p, q, r);
}

// --- on the sphere ---------------------------------------------------------------------------------------------

Sign orientation(Vec3 p, Vec3 q, Vec3 r) {
  return inlined::sign_or(inlined::filtered_orientation(p, q, r), [&] { return exact::orientation(p, q, r); });
}

Sign power_test(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return inlined::sign_or(inlined::filtered_power_test(a, b, c, d), [&] { return exact::power_test(a, b, c, d); });
}

// The determinant of the four rows (P, 1) is linear in the scale of each P. The products of two scales are smaller than
// every single scale.
Sign power_test_perturbed(Vec3 a, Vec3 b, Vec3 c, Vec3 d, const std::array<std::uint32_t, 4>& index) {
  const Sign unperturbed = power_test(a, b, c, d);
  if (unperturbed != Sign::zero) return unperturbed;
  const std::array<Vec3, 4> at = {a, b, c, d};
  return perturbed_sign(index, [&](int i, int j, int k) { return orientation(at[i], at[j], at[k]); });
}

Sign signed_height_sign(Vec3 p, Vec3 q, Vec3 r) {
  return inlined::sign_or(inlined::filtered_height_numerator(p, q, r),
                          [&] { return exact::height_numerator_sign(p, q, r); });
}

Sign dual_crossing_sign(Vec3 p, Vec3 q) {
  return inlined::sign_or(inlined::filtered_dual_crossing(p, q), [&] { return exact::dual_crossing_sign(p, q); });
}

bool is_well_centered(Vec3 p, Vec3 q, Vec3 r) {
  const auto crossed = [](Vec3 a, Vec3 b) {
    return dual_crossing_sign(a, b) == Sign::positive && dual_crossing_sign(b, a) == Sign::positive;
  };
  return orientation(p, q, r) == Sign::positive && signed_height_sign(p, q, r) == Sign::positive &&
         signed_height_sign(q, r, p) == Sign::positive && signed_height_sign(r, p, q) == Sign::positive &&
         crossed(p, q) && crossed(q, r) && crossed(r, p);
}

// --- in the space of a mesh --------------------------------------------------------------------------------------

Sign orientation(const Space& space, const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::orientation(space, p, q, r);
}

Sign power_test(const Space& space, const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                const WeightedPoint& d) {
  return inlined::power_test(space, a, b, c, d);
}

Sign power_test_perturbed(const Space& space, const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                          const WeightedPoint& d, const std::array<std::uint32_t, 4>& index) {
  if (space.is_plane()) return power_test_perturbed(a, b, c, d, index);
  return power_test_perturbed(as_vector(a), as_vector(b), as_vector(c), as_vector(d), index);
}

Sign signed_height_sign(const Space& space, const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return space.is_plane() ? signed_height_sign(p, q, r) : signed_height_sign(as_vector(p), as_vector(q), as_vector(r));
}
bool is_well_centered(const Space& space, const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return inlined::is_well_centered(space, p, q, r);
}

}  // namespace temper
