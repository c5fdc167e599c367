// A coefficient on the elements of a mesh: the two sides of a dual edge have different factors.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "base/text.hpp"
#include "temper/detail/error.hpp"

namespace temper {

/// The two heights of a dual edge, and their sum, which is accurate even if they cancel.
struct DualEdge {
  double length, first, second;

  /// a h_1 + b h_2. The difference of a and b multiplies the smaller height, so equal factors give a whole.
  [[nodiscard]] double combined(double a, double b) const {
    return std::abs(first) <= std::abs(second) ? b * length + (a - b) * first : a * length + (b - a) * second;
  }
};

/// An error unless each of n elements has a finite value above 0. `element` gives the place and the name of an element.
template <class Element>
std::optional<InputError> check_coefficient(std::span<const double> coefficient, std::size_t n, const char* elements,
                                            const Element& element) {
  if (coefficient.size() != n) {
    return InputError{ErrorCode::invalid_option, "",
                      "expected one coefficient for each of the " + std::to_string(n) + " " + elements + ", found " +
                          std::to_string(coefficient.size())};
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (coefficient[i] > 0 && std::isfinite(coefficient[i])) continue;
    const auto [where, name] = element(i);
    return InputError{ErrorCode::invalid_option, where,
                      name + " has the coefficient " + to_text(coefficient[i]) + "; expected a finite number above 0"};
  }
  return {};
}

}  // namespace temper
