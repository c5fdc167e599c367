// Exact arithmetic on doubles: a number is kept as an unevaluated sum of doubles, an expansion.
//
// Sums, differences and products of doubles have rounding errors that are doubles themselves (Dekker 1971, Knuth). So
// polynomials of doubles can be computed without error, and the leading term has their sign. (Shewchuk, "Adaptive
// precision floating-point arithmetic and fast robust geometric predicates", 1997.) The terms are nonoverlapping,
// smallest first, and never zero. The storage is on the stack, and its capacity is in the type.
//
// All of this relies on each operation being rounded to double, to nearest even, exactly as written. So no fast-math,
// no extended intermediate results, and -ffp-contract=off, given explicitly. Without it g++ fuses a * b + c into one
// rounding if the processor can. The proofs do not allow that, and the bits would depend on the processor. Products are
// split by Dekker's method, as std::fma is slow or absent on some targets (WebAssembly). So every target does the same
// operations.
#pragma once

#include <array>
#include <cfloat>
#include <cmath>

#include "temper/detail/geometry.hpp"

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__)
#error "temper's exact predicates are wrong under -ffast-math: compile temper without it"
#endif
#if FLT_EVAL_METHOD != 0
#error "temper's exact predicates need doubles rounded after every operation (on 32-bit x86: -msse2 -mfpmath=sse)"
#endif

namespace temper::exact {

/// A rounded result and its rounding error: high + low is exact, high is the nearest double to it.
struct TwoTerms {
  double high;
  double low;
};

/// a + b, when |a| ≥ |b| or a = 0.
inline TwoTerms fast_two_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

inline TwoTerms two_sum(double a, double b) {
  const double high = a + b;
  const double b_rounded = high - a;
  const double a_rounded = high - b_rounded;
  return {high, (a - a_rounded) + (b - b_rounded)};
}

inline TwoTerms two_diff(double a, double b) {
  const double high = a - b;
  const double b_rounded = a - high;
  const double a_rounded = high + b_rounded;
  return {high, (a - a_rounded) + (b_rounded - b)};
}

/// Veltkamp's splitting into halves of 26 bits, whose products are exact. |a| < 2^996.
inline TwoTerms split(double a) {
  constexpr double kSplitter = 0x1p27 + 1;  // cuts the 53-bit significand in the middle
  const double c = kSplitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

/// a b, with b split beforehand. Exact when a b neither overflows nor has bits below 2^-1074.
inline TwoTerms two_product(double a, double b, TwoTerms b_split) {
  const double high = a * b;
  const TwoTerms a_split = split(a);
  const double error1 = high - a_split.high * b_split.high;
  const double error2 = error1 - a_split.low * b_split.high;
  const double error3 = error2 - a_split.high * b_split.low;
  return {high, a_split.low * b_split.low - error3};
}

/// A sum of at most Capacity doubles. Empty means 0.
template <int Capacity>
class Expansion {
 public:
  Expansion() = default;
  Expansion(TwoTerms t) requires(Capacity >= 2) {
    append(t.low);
    append(t.high);
  }
  // Only the terms in use are copied: capacities are for the worst case, which hardly ever comes.
  Expansion(const Expansion& other) { *this = other; }
  Expansion& operator=(const Expansion& other) {
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) terms_[i] = other.terms_[i];
    return *this;
  }
  ~Expansion() = default;

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] double operator[](int i) const { return terms_[i]; }
  /// Adds a term of larger magnitude than all so far, unless it is 0.
  void append(double term) {
    if (term != 0) terms_[size_++] = term;
  }
  /// The leading term outweighs the sum of the others, so it has the sign of the number.
  [[nodiscard]] Sign sign() const {
    if (size_ == 0) return Sign::zero;
    const double leading = terms_[size_ - 1];
    return leading > 0 ? Sign::positive : leading < 0 ? Sign::negative : Sign::zero;
  }
  /// The number as a double. The terms do not overlap, smallest first: their sum is off by a rounding or two.
  [[nodiscard]] double rounded() const {
    double sum = 0;
    for (int i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

 private:
  int size_ = 0;
  std::array<double, Capacity> terms_;
};

/// e + f into a given capacity, which must be enough for the terms of both (fast expansion sum).
template <int Capacity, int M, int N>
Expansion<Capacity> sum_within(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<Capacity> result;
  int i = 0;
  int j = 0;
  const auto smallest_left = [&] {
    const bool from_e = j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]));
    return from_e ? e[i++] : f[j++];
  };
  const int n = e.size() + f.size();
  if (n == 0) return result;
  double carry = smallest_left();
  for (int k = 1; k < n; ++k) {
    const TwoTerms s = two_sum(carry, smallest_left());
    result.append(s.low);
    carry = s.high;
  }
  result.append(carry);
  return result;
}

template <int M, int N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
  return sum_within<M + N>(e, f);
}

template <int N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> result;
  for (int i = 0; i < e.size(); ++i) result.append(-e[i]);
  return result;
}

template <int M, int N>
Expansion<M + N> operator-(const Expansion<M>& e, const Expansion<N>& f) {
  return e + (-f);
}

/// e b (scale expansion).
template <int N>
Expansion<2 * N> scale(const Expansion<N>& e, double b) {
  Expansion<2 * N> result;
  if (e.size() == 0) return result;
  const TwoTerms b_split = split(b);
  const TwoTerms first = two_product(e[0], b, b_split);
  result.append(first.low);
  double carry = first.high;
  for (int i = 1; i < e.size(); ++i) {
    const TwoTerms product = two_product(e[i], b, b_split);
    const TwoTerms s = two_sum(carry, product.low);
    result.append(s.low);
    const TwoTerms t = fast_two_sum(product.high, s.high);
    result.append(t.low);
    carry = t.high;
  }
  result.append(carry);
  return result;
}

/// e f, by scaling the longer factor with each term of the shorter one.
template <int M, int N>
Expansion<2 * M * N> operator*(const Expansion<M>& e, const Expansion<N>& f) {
  if (e.size() < f.size()) return f * e;
  Expansion<2 * M * N> result;
  for (int j = 0; j < f.size(); ++j) result = sum_within<2 * M * N>(result, scale(e, f[j]));
  return result;
}

}  // namespace temper::exact
