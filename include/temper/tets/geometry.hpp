// Tetrahedron geometry of the power diagram, and the exact predicates that decide validity.
//
// Conventions: tetrahedron pqrs is positive if ((q − p) × (r − p))·(s − p) > 0, as in Gmsh and VTK. Seen from s, the
// face pqr then turns counter-clockwise. The orthocenter o has equal power to p, q, r and s. h_s is the signed distance
// from the plane of pqr to o, positive on the side of s.
//
//            s
//          / | \          h_s of face pqr: orthocenter of pqrs over its plane
//         p--|--r         h_r of edge pq:  orthocenter of the face pqr over the edge, in the plane of the face
//          \ | /          d_pq:            where the bisector of p and q crosses their edge, measured from p
//            q
#pragma once

#include <array>
#include <cstdint>

#include "temper/detail/geometry.hpp"
#include "temper/detail/vec.hpp"

namespace temper::tets {

/// A point of space and its weight. The power distance to q is |(x, y, z) − q|² − w. None is in two cache lines.
struct alignas(32) WeightedPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  [[nodiscard]] constexpr Vec3 position() const { return {x, y, z}; }
  friend constexpr bool operator==(WeightedPoint, WeightedPoint) = default;
};

// --- exact predicates: right for all doubles in the range below -----------------------------------

/// The range in which no intermediate result of the predicates overflows or underflows: coordinates 0 or of
/// magnitude 2^-118 … 2^125, weights 0 or 2^-236 … 2^250. (The determinants have degree 6 in length; a coordinate
/// above 2^-118 is a multiple of 2^-170, and the polynomials are multiples of (2^-170)^6 > 2^-1022.)
[[nodiscard]] constexpr bool is_exact_coordinate(double x) {
  const double magnitude = x < 0 ? -x : x;
  return magnitude == 0 || (magnitude >= 0x1p-118 && magnitude <= 0x1p125);
}
[[nodiscard]] constexpr bool is_exact_weight(double w) {
  const double magnitude = w < 0 ? -w : w;
  return magnitude == 0 || (magnitude >= 0x1p-236 && magnitude <= 0x1p250);
}

/// Sign of ((q − p) × (r − p))·(s − p): positive for a positive tetrahedron. Exact, degree 3.
[[nodiscard]] Sign orientation(Vec3 p, Vec3 q, Vec3 r, Vec3 s);

/// Power test of a positive tetrahedron pqrs and a point t. Positive if t conflicts: its power to the orthocenter of
/// pqrs is less than the power of the corners. Then the face between pqrs and t is not regular, and its dual edge is
/// negative. Zero if all five are cospherical in the power sense. Exact, degree 5.
[[nodiscard]] Sign power_test(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                              const WeightedPoint& s, const WeightedPoint& t);

/// Power test with ties broken by vertex index, by the rule of the plane: weights are perturbed to w_i + ε^(i+1),
/// ε → 0+. Zero only if all five points are coplanar.
[[nodiscard]] Sign power_test_perturbed(const std::array<WeightedPoint, 5>& points,
                                        const std::array<std::uint32_t, 5>& index);

/// Sign of h_s, the height of the orthocenter of pqrs over its face pqr. Exact, degree 6. Precondition: pqrs is not
/// flat; either orientation will do.
[[nodiscard]] Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                      const WeightedPoint& s);

/// Sign of h_r, the height of the orthocenter of the face pqr over its edge pq. Exact, degree 4. Precondition: the
/// corners of the face are not collinear.
[[nodiscard]] Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// Sign of d_pq = (ℓ² + w_p − w_q)/(2ℓ). Exact, degree 2.
[[nodiscard]] Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q);

// --- constructions: in doubles ---------------------------------------------------------------------

/// Six times the signed volume.
[[nodiscard]] double six_volumes(Vec3 p, Vec3 q, Vec3 r, Vec3 s);

/// The point of equal power to all four corners. Precondition: pqrs is not flat.
[[nodiscard]] Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                               const WeightedPoint& s);

/// The point in the plane of pqr of equal power to its corners: the foot of the orthocenters of both tetrahedra of the
/// face. Precondition: the corners are not collinear.
[[nodiscard]] Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// h_s: signed distance from the plane of pqr to the orthocenter of pqrs, positive on the side of s [length].
[[nodiscard]] double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                   const WeightedPoint& s);

/// h_r: signed distance from edge pq to the orthocenter of the face pqr in its plane, positive on the side of r
/// [length].
[[nodiscard]] double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

/// d_pq, from p [length].
[[nodiscard]] double dual_crossing(const WeightedPoint& p, const WeightedPoint& q);

/// The angle inside pqrs at its edge pq, in radians, of a tetrahedron in either orientation.
[[nodiscard]] double dihedral_angle(Vec3 p, Vec3 q, Vec3 r, Vec3 s);

/// The solid angle of a positive tetrahedron pqrs at p, in steradians.
[[nodiscard]] double solid_angle(Vec3 p, Vec3 q, Vec3 r, Vec3 s);

}  // namespace temper::tets
