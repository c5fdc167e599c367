// An exact number of any length: a sum of doubles that grows as needed. It is for sums too long for the fixed
// capacities of geometry/expansion.hpp, whose error-free transformations it uses.
//
// The terms are nonoverlapping, smallest first and never zero (Shewchuk's expansions), so the last one has the sign.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/expansion.hpp"

namespace temper::exact {

class Number {
 public:
  Number() = default;
  explicit Number(double value) { add(value); }
  Number(TwoTerms t) { add(t.low), add(t.high); }

  /// Grow expansion: O(length).
  void add(double value) {
    std::size_t kept = 0;
    for (const double term : terms_) {
      const TwoTerms s = two_sum(value, term);
      value = s.high;
      if (s.low != 0) terms_[kept++] = s.low;
    }
    terms_.resize(kept);
    if (value != 0) terms_.push_back(value);
  }

  [[nodiscard]] Sign sign() const {
    if (terms_.empty()) return Sign::zero;
    return terms_.back() > 0 ? Sign::positive : Sign::negative;
  }
  /// The nearest double, up to one or two last bits.
  [[nodiscard]] double approximation() const {
    double sum = 0;
    for (const double term : terms_) sum += term;
    return sum;
  }

  Number& operator+=(const Number& other) {
    for (const double term : other.terms_) add(term);
    return *this;
  }
  friend Number operator+(Number a, const Number& b) { return std::move(a += b); }
  friend Number operator-(Number a) {
    for (double& term : a.terms_) term = -term;
    return a;
  }
  friend Number operator-(Number a, const Number& b) { return std::move(a += -b); }
  friend Number operator*(const Number& a, const Number& b) {
    Number product;
    for (const double y : b.terms_) {
      const TwoTerms y_split = split(y);
      for (const double x : a.terms_) {
        const TwoTerms xy = two_product(x, y, y_split);
        product.add(xy.low);
        product.add(xy.high);
      }
    }
    return product;
  }
  friend Number abs(Number a) { return a.sign() == Sign::negative ? -std::move(a) : a; }
  [[nodiscard]] static Number difference(double a, double b) { return two_diff(a, b); }

 private:
  std::vector<double> terms_;
};

}  // namespace temper::exact
