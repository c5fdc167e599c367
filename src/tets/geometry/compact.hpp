// An exact number of bounded length, for polynomials of degree 6: their expansions would be long, but have few terms.
//
// In the range of is_exact_coordinate all results are multiples of 2^-1022 below 2^800. After compression each term
// takes the leading 53 bits of what is left, so (1022 + 800)/53 < 35 terms always suffice.
#pragma once

#include <array>

#include "base/assert.hpp"
#include "geometry/expansion.hpp"

namespace temper::exact {

class Compact {
 public:
  Compact() = default;
  static Compact difference(double a, double b) {
    Compact result;
    const TwoTerms t = two_diff(a, b);
    result.terms_.append(t.low);
    result.terms_.append(t.high);
    return result;
  }
  [[nodiscard]] Sign sign() const { return terms_.sign(); }
  [[nodiscard]] double rounded() const { return terms_.rounded(); }
  [[nodiscard]] const auto& terms() const { return terms_; }

  friend Compact operator+(const Compact& a, const Compact& b) {
    return compressed(sum_within<2 * kTerms>(a.terms_, b.terms_));
  }
  friend Compact operator-(const Compact& a, const Compact& b) {
    return compressed(sum_within<2 * kTerms>(a.terms_, -b.terms_));
  }
  friend Compact operator*(const Compact& a, const Compact& b) {
    if (a.terms_.size() < b.terms_.size()) return b * a;
    Compact product;
    for (int i = 0; i < b.terms_.size(); ++i)
      product = compressed(sum_within<3 * kTerms>(product.terms_, scale(a.terms_, b.terms_[i])));
    return product;
  }

 private:
  static constexpr int kTerms = 36;
  static constexpr int kShort = 6;  // a sum of so few terms stays as it is: compression would take longer

  /// Compression (Shewchuk): the same number in as few terms as possible.
  template <int N>
  static Compact compressed(const Expansion<N>& e) {
    Compact result;
    const int n = e.size();
    if (n <= kShort) {
      for (int i = 0; i < n; ++i) result.terms_.append(e[i]);
      return result;
    }
    std::array<double, N> larger;
    int bottom = n - 1;
    double carry = e[n - 1];
    for (int i = n - 2; i >= 0; --i) {
      const TwoTerms s = fast_two_sum(carry, e[i]);
      carry = s.high;
      if (s.low == 0) continue;
      larger[bottom--] = s.high;
      carry = s.low;
    }
    for (int i = bottom + 1; i < n; ++i) {
      const TwoTerms s = fast_two_sum(larger[i], carry);
      result.terms_.append(s.low);
      carry = s.high;
    }
    result.terms_.append(carry);
    TEMPER_ASSERT(result.terms_.size() <= kTerms);
    return result;
  }

  Expansion<kTerms> terms_;
};

}  // namespace temper::exact
