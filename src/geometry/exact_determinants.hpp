// The determinants whose signs are the predicates, exactly, as expansions.
//
// Every determinant is a polynomial of differences of the inputs. A difference of two doubles is exactly an expansion
// of two terms, so nothing here ever rounds. If differences are single doubles (on lattices, which have the ties), the
// expansions stay a few terms long.
#pragma once

#include "geometry/expansion.hpp"
#include "temper/detail/vec.hpp"

namespace temper::exact {

struct ExactVector {
  Expansion<2> x, y;
};

inline ExactVector difference(Vec2 a, Vec2 b) { return {two_diff(a.x, b.x), two_diff(a.y, b.y)}; }
inline ExactVector difference(const WeightedPoint& a, const WeightedPoint& b) {
  return difference(a.position(), b.position());
}
inline Expansion<2> difference(double a, double b) { return two_diff(a, b); }

inline Expansion<16> dot(const ExactVector& a, const ExactVector& b) { return a.x * b.x + a.y * b.y; }
inline Expansion<16> cross(const ExactVector& a, const ExactVector& b) { return a.x * b.y - a.y * b.x; }

/// Twice the signed area of abc.
inline auto doubled_area(Vec2 a, Vec2 b, Vec2 c) { return cross(difference(a, c), difference(b, c)); }

/// The lifted determinant, translated to d.
inline auto power_determinant(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                              const WeightedPoint& d) {
  const ExactVector ad = difference(a, d), bd = difference(b, d), cd = difference(c, d);
  const auto lift = [&](const ExactVector& v, double w) { return dot(v, v) - difference(w, d.w); };
  const auto from_a = lift(ad, a.w) * cross(bd, cd);
  const auto from_b = lift(bd, b.w) * cross(cd, ad);
  const auto from_c = lift(cd, c.w) * cross(ad, bd);
  return from_a + from_b + from_c;
}

/// 2 h ℓ S over edge pq: see geometry/predicates_inline.hpp.
inline auto height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const ExactVector pq = difference(q, p), pr = difference(r, p), qr = difference(r, q);
  const auto at_r = dot(pr, qr);
  const auto from_p = dot(pq, pr) * (at_r + difference(q.w, r.w));
  const auto from_q = dot(pq, qr) * (at_r + difference(p.w, r.w));  // minus D_q
  return from_p - from_q;
}

/// 2 d ℓ of edge pq, from p.
inline auto doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const ExactVector pq = difference(q, p);
  return dot(pq, pq) + difference(p.w, q.w);
}

// --- of weighted vectors --------------------------------------------------------------------------------------------

struct ExactVector3 {
  Expansion<2> x, y, z;
};

inline ExactVector3 difference(Vec3 a, Vec3 b) { return {two_diff(a.x, b.x), two_diff(a.y, b.y), two_diff(a.z, b.z)}; }

inline Expansion<24> dot(const ExactVector3& a, const ExactVector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Expansion<12> dot(Vec3 p, const ExactVector3& a) { return scale(a.x, p.x) + scale(a.y, p.y) + scale(a.z, p.z); }

/// a_x b_y − a_y b_x.
inline Expansion<4> minor(double ax, double ay, double bx, double by) {
  const auto product = [](double a, double b) { return Expansion<2>(two_product(a, b, split(b))); };
  return product(ax, by) - product(ay, bx);
}

/// det(P, Q, R).
inline auto orientation_determinant(Vec3 p, Vec3 q, Vec3 r) {
  return scale(minor(q.y, q.z, r.y, r.z), p.x) + scale(minor(q.z, q.x, r.z, r.x), p.y) +
         scale(minor(q.x, q.y, r.x, r.y), p.z);
}

/// − det(A − D, B − D, C − D).
inline auto power_determinant(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const ExactVector3 ad = difference(a, d), bd = difference(b, d), cd = difference(c, d);
  const auto plane_minor = [](const ExactVector3& u, const ExactVector3& v) { return u.x * v.y - u.y * v.x; };
  return -(ad.z * plane_minor(bd, cd) + bd.z * plane_minor(cd, ad) + cd.z * plane_minor(ad, bd));
}

/// (P × Q)·n: see geometry/predicates_inline.hpp.
inline auto height_numerator(Vec3 p, Vec3 q, Vec3 r) {
  const ExactVector3 a = difference(q, p), b = difference(r, p);
  return dot(p, a) * dot(a, b) - dot(p, b) * dot(a, a);
}

/// P·(P − Q).
inline auto crossing_product(Vec3 p, Vec3 q) { return dot(p, difference(p, q)); }

}  // namespace temper::exact
