// The determinants whose signs are the predicates, exactly, as expansions.
//
// Every determinant is a polynomial of differences of the inputs; a difference of two doubles is an expansion of
// two terms, exactly, so nothing here ever rounds. On inputs whose differences are single doubles (lattices, where
// ties are) the expansions stay a few terms long.
#pragma once

#include "geometry/expansion.hpp"
#include "temper/vec2.hpp"

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
inline auto doubled_split(const WeightedPoint& p, const WeightedPoint& q) {
  const ExactVector pq = difference(q, p);
  return dot(pq, pq) + difference(p.w, q.w);
}

}  // namespace temper::exact
