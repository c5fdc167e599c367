// A number with its gradient in (x, y, z, w) of one vertex: forward differentiation. A number whose values and slopes
// have slopes themselves has the Hessian, too.
#pragma once

#include <array>
#include <cstddef>

#include "tets/energy/matrix.hpp"

namespace temper::tets {

template <class T>
struct SlopedOf {
  T value = T(0);
  std::array<T, 4> slope = {T(0), T(0), T(0), T(0)};

  SlopedOf() = default;
  explicit SlopedOf(double constant) : value(constant) {}
  /// An unknown: x, y, z and w are 0 to 3.
  SlopedOf(const T& at, std::size_t unknown) : value(at) { slope[unknown] = T(1); }

  [[nodiscard]] PointVector<T> gradient() const { return {{slope[0], slope[1], slope[2]}, slope[3]}; }

  friend SlopedOf operator+(const SlopedOf& a, const SlopedOf& b) {
    return a.with(b, [](const T& x, const T& y) { return x + y; });
  }
  friend SlopedOf operator-(const SlopedOf& a, const SlopedOf& b) {
    return a.with(b, [](const T& x, const T& y) { return x - y; });
  }
  friend SlopedOf operator*(const SlopedOf& a, const SlopedOf& b) {
    return {a.value * b.value, b.value, a, a.value, b};
  }
  friend SlopedOf operator*(double s, const SlopedOf& a) {
    return a.with(a, [s](const T& x, const T&) { return s * x; });
  }
  friend SlopedOf operator/(const SlopedOf& a, const SlopedOf& b) {
    const T inverse = T(1) / b.value, quotient = a.value * inverse;
    return {quotient, inverse, a, T(-1) * quotient * inverse, b};
  }

 private:
  /// Applies f to the value and each slope, with those of b.
  template <class F>
  [[nodiscard]] TEMPER_INLINE SlopedOf with(const SlopedOf& b, const F& f) const {
    SlopedOf result;
    result.value = f(value, b.value);
    for (std::size_t i = 0; i < 4; ++i) result.slope[i] = f(slope[i], b.slope[i]);
    return result;
  }
  /// Slopes s ∇a + t ∇b.
  SlopedOf(const T& of, const T& s, const SlopedOf& a, const T& t, const SlopedOf& b) : value(of) {
    for (std::size_t i = 0; i < 4; ++i) slope[i] = s * a.slope[i] + t * b.slope[i];
  }
};

using Sloped = SlopedOf<double>;

}  // namespace temper::tets
