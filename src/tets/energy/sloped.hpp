// A number with its gradient in (x, y, z, w) of one vertex: forward differentiation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tets/energy/matrix.hpp"

namespace temper::tets {

struct Sloped {
  double value = 0;
  std::array<double, 4> slope = {};

  Sloped() = default;
  explicit Sloped(double constant) : value(constant) {}
  /// An unknown: x, y, z and w are 0 to 3.
  Sloped(double at, std::size_t unknown) : value(at) { slope[unknown] = 1; }

  [[nodiscard]] PointVector<double> gradient() const { return {{slope[0], slope[1], slope[2]}, slope[3]}; }

  friend Sloped operator+(const Sloped& a, const Sloped& b) { return {a.value + b.value, 1, a, 1, b}; }
  friend Sloped operator-(const Sloped& a, const Sloped& b) { return {a.value - b.value, 1, a, -1, b}; }
  friend Sloped operator*(const Sloped& a, const Sloped& b) { return {a.value * b.value, b.value, a, a.value, b}; }
  friend Sloped operator/(const Sloped& a, const Sloped& b) {
    const double inverse = 1 / b.value, quotient = a.value * inverse;
    return {quotient, inverse, a, -quotient * inverse, b};
  }
  friend Sloped sqrt(const Sloped& a) {
    const double root = std::sqrt(a.value);
    return {root, 0.5 / root, a, 0, a};
  }

 private:
  /// Slopes s ∇a + t ∇b.
  Sloped(double of, double s, const Sloped& a, double t, const Sloped& b) : value(of) {
    for (std::size_t i = 0; i < 4; ++i) slope[i] = s * a.slope[i] + t * b.slope[i];
  }
};

}  // namespace temper::tets
