// Centers, heights and duals in doubles.
#include <cmath>

#include "geometry/dyadic.hpp"
#include "regularity/duals.hpp"
#include "surfaces/geometry/formulas.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// N/S, which is 2 h ℓ.
double doubled_scaled_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec3 pq = q.position() - p.position(), pr = r.position() - p.position(), qr = r.position() - q.position();
  const double at_r = dot(pr, qr);
  return (dot(pq, pr) * (at_r + (q.w - r.w)) - dot(pq, qr) * (at_r + (p.w - r.w))) / length(cross(pq, pr));
}

}  // namespace

Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Vec3 a = q.position() - p.position(), b = r.position() - p.position(), n = cross(a, b);
  const double u = squared_length(a) + p.w - q.w, v = squared_length(b) + p.w - r.w;
  return p.position() + (0.5 / squared_length(n)) * (u * cross(b, n) + v * cross(n, a));
}

double dual_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const double l2 = squared_length(q.position() - p.position());
  return 0.5 * (l2 + p.w - q.w) / std::sqrt(l2);
}

double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return 0.5 * doubled_scaled_height(p, q, r) / length(q.position() - p.position());
}

double dual_over_length(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                        const WeightedPoint& s) {
  constexpr double kCanceled = 1e-3;  // part of the heights below which digits are missing
  const double left = doubled_scaled_height(p, q, r), right = doubled_scaled_height(q, p, s);
  const double l2 = squared_length(q.position() - p.position());
  double sum = left + right;
  if (!(std::abs(sum) > kCanceled * (std::abs(left) + std::abs(right)))) {
    // (x² − y²)/(x + y) with the exact difference of squares, x = |left| and y = |right|; the sign follows below. In
    // units of the edge the products of twelve lengths do not overflow.
    const double unit = std::ldexp(1.0, std::ilogb(l2) / 2);
    const auto scaled = [unit](const WeightedPoint& v) {
      return WeightedPoint{v.x / unit, v.y / unit, v.z / unit, v.w / unit / unit};
    };
    const WeightedPoint a = scaled(p), b = scaled(q), c = scaled(r), d = scaled(s);
    const auto area = [&](const WeightedPoint& v) {
      return squared_length(cross(b.position() - a.position(), v.position() - a.position()));
    };
    const double squares = difference_of_squares<exact::Dyadic>(a, b, c, d).approximation() / area(c) / area(d);
    sum = squares * unit * unit / ((std::abs(left) + std::abs(right)) / unit / unit);
  }
  return with_sign(0.5 * sum / l2, dual_length_sign(p, q, r, s));
}

double doubled_area(const MetricTriangle& t) {
  return 0.5 * std::sqrt(squared_doubled_area<exact::Dyadic>(t).approximation());
}

double dual_crossing(const MetricTriangle& t) { return 0.5 * (t.pq + t.wp - t.wq) / std::sqrt(t.pq); }

double signed_height(const MetricTriangle& t) {
  return 0.125 * height_numerator<exact::Dyadic>(t).approximation() / (std::sqrt(t.pq) * doubled_area(t));
}

double dual_over_length(const MetricTriangle& left, const MetricTriangle& right) {
  return with_sign((signed_height(left) + signed_height(right)) / std::sqrt(left.pq), dual_length_sign(left, right));
}

}  // namespace temper::surfaces
