// The exact stages are those of the predicates (geometry/predicates.cpp), but for their value, not their sign.
#include "dec/accurate.hpp"

#include <cmath>

#include "geometry/expansion.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper::accurate {
namespace {

struct ExactDifference {
  exact::Expansion<2> x, y;
};

ExactDifference exact_difference(Vec2 a, Vec2 b) { return {exact::two_diff(a.x, b.x), exact::two_diff(a.y, b.y)}; }

auto dot_of(const ExactDifference& a, const ExactDifference& b) { return a.x * b.x + a.y * b.y; }
auto cross_of(const ExactDifference& a, const ExactDifference& b) { return a.x * b.y - a.y * b.x; }

/// The terms do not overlap, smallest first: their sum is off by a rounding or two.
template <int N>
double nearest_double(const exact::Expansion<N>& e) {
  double sum = 0;
  for (int i = 0; i < e.size(); ++i) sum += e[i];
  return sum;
}

bool is_accurate(const inlined::Filtered<double>& f) { return f.bound < kRelativeError * std::abs(f.value); }

}  // namespace

double doubled_area(Vec2 a, Vec2 b, Vec2 c) {
  const auto fast = inlined::filtered_orient2d(a, b, c);
  if (is_accurate(fast)) return fast.value;
  return nearest_double(cross_of(exact_difference(a, c), exact_difference(b, c)));
}

double power_determinant(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                         const WeightedPoint& d) {
  const auto fast = inlined::filtered_power_test(a, b, c, d);
  if (is_accurate(fast)) return fast.value;
  const ExactDifference ad = exact_difference(a.position(), d.position());
  const ExactDifference bd = exact_difference(b.position(), d.position());
  const ExactDifference cd = exact_difference(c.position(), d.position());
  const auto lift = [&](const ExactDifference& v, double w) {
    return dot_of(v, v) - exact::Expansion<2>(exact::two_diff(w, d.w));
  };
  return nearest_double(lift(ad, a.w) * cross_of(bd, cd) + lift(bd, b.w) * cross_of(cd, ad) +
                        lift(cd, c.w) * cross_of(ad, bd));
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const auto fast = inlined::filtered_height_numerator(p, q, r);
  if (is_accurate(fast)) return fast.value;
  const ExactDifference pq = exact_difference(q.position(), p.position());
  const ExactDifference pr = exact_difference(r.position(), p.position());
  const ExactDifference qr = exact_difference(r.position(), q.position());
  const auto at_r = dot_of(pr, qr);
  return nearest_double(dot_of(pq, pr) * (at_r + exact::Expansion<2>(exact::two_diff(q.w, r.w))) -
                        dot_of(pq, qr) * (at_r + exact::Expansion<2>(exact::two_diff(p.w, r.w))));
}

double doubled_split(const WeightedPoint& p, const WeightedPoint& q) {
  const auto fast = inlined::filtered_edge_split(p, q);
  if (is_accurate(fast)) return fast.value;
  const ExactDifference pq = exact_difference(q.position(), p.position());
  return nearest_double(dot_of(pq, pq) + exact::Expansion<2>(exact::two_diff(p.w, q.w)));
}

}  // namespace temper::accurate
