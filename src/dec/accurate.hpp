// The determinants of the operators, with a small relative error whatever cancels in them.
//
// The operators are quotients of these. A determinant is a double if the bound on its rounding is small against the
// value, otherwise an exact expansion, rounded once at the end. So every sign is right, ties are 0, and the relative
// error of a quotient of two of them is at most three times kRelativeError.
#pragma once

#include "temper/detail/vec.hpp"

namespace temper::accurate {

/// The largest relative error of a determinant. At 2⁻⁴² one edge in a hundred of usual meshes goes to the exact stage.
inline constexpr double kRelativeError = 0x1p-42;

/// Twice the signed area of abc.
[[nodiscard]] double doubled_area(Vec2 a, Vec2 b, Vec2 c);
/// The lifted determinant whose sign is power_test: > 0 where d conflicts with abc.
[[nodiscard]] double power_determinant(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                                       const WeightedPoint& d);
/// 2 h ℓ S of edge pq in triangle pqr, S twice its signed area.
[[nodiscard]] double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// 2 d ℓ of edge pq, from p.
[[nodiscard]] double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q);

// --- on the sphere, of weighted vectors -----------------------------------------------------------------------------

/// det(P, Q, R).
[[nodiscard]] double orientation_determinant(Vec3 p, Vec3 q, Vec3 r);
/// − det(A − D, B − D, C − D), whose sign is power_test: > 0 where d conflicts with abc.
[[nodiscard]] double power_determinant(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
/// (P × Q)·n, where n = (Q − P) × (R − P) is the normal of the face.
[[nodiscard]] double height_numerator(Vec3 p, Vec3 q, Vec3 r);
/// P·(P − Q).
[[nodiscard]] double crossing_product(Vec3 p, Vec3 q);

}  // namespace temper::accurate
