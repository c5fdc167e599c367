// Triangle geometry of the power diagram, and the exact predicates that decide validity.
//
// Conventions (docs/reference/symbols.md): triangle ijk is counter-clockwise. The orthocenter o has equal power to
// i, j and k. h_k is the signed distance from edge ij to o, positive on the left of i → j, the side of k. d_ij = ℓ/2 +
// (w_i − w_j)/(2ℓ) is measured from i towards j, so d_ij + d_ji = ℓ.
#pragma once

#include <array>
#include <cstdint>

#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

enum class Sign : int { negative = -1, zero = 0, positive = 1 };
constexpr Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }

// --- exact predicates: right for all doubles in the range below -----------------------------------

/// The range in which no intermediate result of the predicates overflows or underflows: coordinates 0 or of
/// magnitude 2^-214 … 2^250, weights 0 or 2^-428 … 2^500. (The determinants have degree 4 in length; a coordinate
/// above 2^-214 is a multiple of 2^-266, and (2^-266)^4 > 2^-1074.) NaN and infinities are outside.
[[nodiscard]] constexpr bool is_exact_coordinate(double x) {
  const double magnitude = x < 0 ? -x : x;
  return magnitude == 0 || (magnitude >= 0x1p-214 && magnitude <= 0x1p250);
}
[[nodiscard]] constexpr bool is_exact_weight(double w) {
  const double magnitude = w < 0 ? -w : w;
  return magnitude == 0 || (magnitude >= 0x1p-428 && magnitude <= 0x1p500);
}

/// Positive when a, b, c turn counter-clockwise. Sign of cross(b − a, c − a), exact.
[[nodiscard]] Sign orient2d(Vec2 a, Vec2 b, Vec2 c);

/// Power test (eq. 9 of the paper, oriented), for a, b, c counter-clockwise. Exact. Positive if d conflicts: its power
/// to the orthocenter of abc is less than the power of a, b and c. Then the edge between abc and d is not regular. Zero
/// if all four are cocircular in the power sense. Negative if the edge is regular.
[[nodiscard]] Sign power_test(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                              const WeightedPoint& d);

/// Power test with ties broken by vertex index. The weights are perturbed to w_i + ε^(i+1), ε → 0+, so that the regular
/// triangulation is unique for any order of construction. Zero only if all four points are collinear.
[[nodiscard]] Sign power_test_perturbed(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                                        const WeightedPoint& d, const std::array<std::uint32_t, 4>& index);

/// Sign of h, the signed height of the orthocenter of the counter-clockwise triangle pqr over its edge pq. Exact.
[[nodiscard]] Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// Sign of d_pq = (ℓ² + w_p − w_q)/(2ℓ). Exact.
[[nodiscard]] Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q);

/// Says whether a triangle is well-centered: all h > 0, all 0 < d < ℓ, and counter-clockwise. Exact.
[[nodiscard]] bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

// --- the same on the sphere, for weighted vector P (space.hpp): exact for coordinates in the range above -----------

/// Positive when p, q, r turn counter-clockwise, seen from outside. Sign of det(P, Q, R), exact.
[[nodiscard]] Sign orientation(Vec3 p, Vec3 q, Vec3 r);

/// Positive when d conflicts with abc counter-clockwise: it lies above the plane of ABC, seen from the center. Exact.
[[nodiscard]] Sign power_test(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// Power test with ties broken by vertex index. The points are perturbed to P_i (1 + ε_i), with ε_0 ≫ ε_1 ≫ … → 0+,
/// where no ε is less than the product of any two. Zero only if all four points are on a great circle.
[[nodiscard]] Sign power_test_perturbed(Vec3 a, Vec3 b, Vec3 c, Vec3 d, const std::array<std::uint32_t, 4>& index);

/// Sign of (P × Q)·n, with n the normal of the counter-clockwise face PQR. It is the sign of the height of the
/// orthocenter over the arc pq. Exact.
[[nodiscard]] Sign signed_height_sign(Vec3 p, Vec3 q, Vec3 r);

/// Sign of P·(P − Q). It is the sign of d_pq, the arc from p, towards q, to the weighted midpoint. Exact.
[[nodiscard]] Sign dual_crossing_sign(Vec3 p, Vec3 q);

/// All heights > 0, all edges crossed by their duals, and counter-clockwise. Exact.
[[nodiscard]] bool is_well_centered(Vec3 p, Vec3 q, Vec3 r);

// --- in the space of a mesh -----------------------------------------------------------------------------------

[[nodiscard]] Sign orientation(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                               const WeightedPoint& r);
[[nodiscard]] Sign power_test(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                              const WeightedPoint& c, const WeightedPoint& d);
[[nodiscard]] Sign power_test_perturbed(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                        const WeightedPoint& c, const WeightedPoint& d,
                                        const std::array<std::uint32_t, 4>& index);
[[nodiscard]] Sign signed_height_sign(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                      const WeightedPoint& r);
[[nodiscard]] bool is_well_centered(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                    const WeightedPoint& r);

// --- constructions, in doubles ---------------------------------------------------------------------

/// The point of equal power to p, q and r.
[[nodiscard]] Vec2 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// d_pq = ℓ/2 + (w_p − w_q)/(2ℓ): distance from p, towards q, of the weighted midpoint.
[[nodiscard]] double dual_crossing(const WeightedPoint& p, const WeightedPoint& q);

/// h: signed distance from edge pq to the orthocenter of pqr, positive on the left of p → q.
[[nodiscard]] double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// h ℓ of the three edges qr, rp, pq (the edges opposite p, q, r). Their sum is twice the area. They are rational in
/// the coordinates and weights, and the energies are computed from them.
[[nodiscard]] std::array<double, 3> scaled_heights(const WeightedPoint& p, const WeightedPoint& q,
                                                   const WeightedPoint& r);

/// Twice the signed area.
[[nodiscard]] double doubled_area(Vec2 p, Vec2 q, Vec2 r);

/// The angle at p, in radians.
[[nodiscard]] double corner_angle(Vec2 p, Vec2 q, Vec2 r);

// --- the same on the sphere: arcs in radians, signed as in the plane ---------------------------------------------

/// The direction of equal power to p, q and r: the normal of their face, of length 1.
[[nodiscard]] Vec3 orthocenter(Vec3 p, Vec3 q, Vec3 r);
[[nodiscard]] double arc_length(Vec3 p, Vec3 q);
/// d_pq: tan d = P·(P − Q)/|P × Q|.
[[nodiscard]] double dual_crossing(Vec3 p, Vec3 q);
/// h over pq: sin h = (P × Q)·n/(|P × Q| |n|).
[[nodiscard]] double signed_height(Vec3 p, Vec3 q, Vec3 r);
/// The angle at p between the arcs to q and to r.
[[nodiscard]] double corner_angle(Vec3 p, Vec3 q, Vec3 r);
/// The solid angle of the triangle, its spherical excess; signed.
[[nodiscard]] double solid_angle(Vec3 p, Vec3 q, Vec3 r);

/// Distance along the ground of a space from one vertex to another [length].
[[nodiscard]] double distance(const Space& space, const WeightedPoint& p, const WeightedPoint& q);
/// The angle at p in the space of a mesh, in radians.
[[nodiscard]] double corner_angle(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                  const WeightedPoint& r);

}  // namespace temper
