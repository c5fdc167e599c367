// The formulas whose signs are the predicates, for any kind of numbers: doubles with bounds of their errors, or exact
// ones. Heights h over pq in pqr, with S twice the area:
//
//   N  = (pq·pr) (pr·qr + w_q − w_r) − (pq·qr) (pr·qr + w_p − w_r) = 2 h ℓ S
//   S² = |pq × pr|²
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// A double with a bound of its error. Each operation adds its own rounding.
class Bounded {
 public:
  Bounded() = default;
  explicit Bounded(double value) : value_(value) {}

  /// The sign, if the error leaves no doubt. Numbers that overflow have none.
  [[nodiscard]] std::optional<Sign> sign() const {
    if (value_ > error_) return Sign::positive;
    if (value_ < -error_) return Sign::negative;
    return std::nullopt;
  }

  friend Bounded operator+(Bounded a, Bounded b) {
    const double sum = a.value_ + b.value_;
    return {sum, (a.error_ + b.error_ + kRounding * std::abs(sum)) * kUp};
  }
  friend Bounded operator-(Bounded a) { return {-a.value_, a.error_}; }
  friend Bounded operator*(Bounded a, Bounded b) {
    const double product = a.value_ * b.value_;
    const double error =
        std::abs(a.value_) * b.error_ + a.error_ * (std::abs(b.value_) + b.error_) + kRounding * std::abs(product);
    return {product, error * kUp + kUnderflow};
  }

 private:
  static constexpr double kRounding = 0x1p-53;
  static constexpr double kUp = 1 + 0x1p-49;  // above the roundings of the bound itself
  static constexpr double kUnderflow = 4 * std::numeric_limits<double>::min();

  Bounded(double value, double error) : value_(value), error_(error) {}

  double value_ = 0, error_ = 0;
};

template <class T>
T difference(double a, double b) {
  return T(a) + (-T(b));
}

template <class T>
struct VectorOf {
  T x, y, z;
};
template <class T>
VectorOf<T> from_to(Vec3 a, Vec3 b) {
  return {difference<T>(b.x, a.x), difference<T>(b.y, a.y), difference<T>(b.z, a.z)};
}
template <class T>
T dot(const VectorOf<T>& a, const VectorOf<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
VectorOf<T> cross(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a.y * b.z + (-(a.z * b.y)), a.z * b.x + (-(a.x * b.z)), a.x * b.y + (-(a.y * b.x))};
}

/// N of the height over pq in pqr.
template <class T>
T height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const VectorOf<T> pq = from_to<T>(p.position(), q.position()), pr = from_to<T>(p.position(), r.position()),
                    qr = from_to<T>(q.position(), r.position());
  const T at_r = dot(pr, qr);
  return dot(pq, pr) * (at_r + difference<T>(q.w, r.w)) + (-(dot(pq, qr) * (at_r + difference<T>(p.w, r.w))));
}

/// S² of pqr.
template <class T>
T squared_doubled_area(Vec3 p, Vec3 q, Vec3 r) {
  const VectorOf<T> n = cross(from_to<T>(p, q), from_to<T>(p, r));
  return dot(n, n);
}

/// ℓ² + w_p − w_q = 2 d ℓ.
template <class T>
T doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const VectorOf<T> pq = from_to<T>(p.position(), q.position());
  return dot(pq, pq) + difference<T>(p.w, q.w);
}

/// N_r² S_s² − N_s² S_r² for the heights over pq in pqr and qps: it says which of |h_r| and |h_s| is greater.
template <class T>
T difference_of_squares(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                        const WeightedPoint& s) {
  const T n_r = height_numerator<T>(p, q, r), n_s = height_numerator<T>(q, p, s);
  return n_r * n_r * squared_doubled_area<T>(p.position(), q.position(), s.position()) +
         (-(n_s * n_s * squared_doubled_area<T>(p.position(), q.position(), r.position())));
}

// --- by squared lengths, where pq·pr = (|pq|² + |pr|² − |qr|²)/2 ---------------------------------------------------

/// 2 pq·pr, from |pq|², |pr|² and |qr|².
template <class T>
T doubled_dot(double pq, double pr, double qr) {
  return T(pq) + T(pr) + (-T(qr));
}

/// 4 N.
template <class T>
T height_numerator(const MetricTriangle& t) {
  const T at_p = doubled_dot<T>(t.pq, t.rp, t.qr), at_q = doubled_dot<T>(t.pq, t.qr, t.rp),
          at_r = doubled_dot<T>(t.qr, t.rp, t.pq), two = T(2);
  return at_p * (at_r + two * difference<T>(t.wq, t.wr)) + at_q * (at_r + two * difference<T>(t.wp, t.wr));
}
/// 4 S².
template <class T>
T squared_doubled_area(const MetricTriangle& t) {
  const T at_p = doubled_dot<T>(t.pq, t.rp, t.qr);
  return T(4) * T(t.pq) * T(t.rp) + (-(at_p * at_p));
}
template <class T>
T doubled_crossing(const MetricTriangle& t) {
  return T(t.pq) + difference<T>(t.wp, t.wq);
}
template <class T>
T difference_of_squares(const MetricTriangle& left, const MetricTriangle& right) {
  const T n_r = height_numerator<T>(left), n_s = height_numerator<T>(right);
  return n_r * n_r * squared_doubled_area<T>(right) + (-(n_s * n_s * squared_doubled_area<T>(left)));
}

}  // namespace temper::surfaces
