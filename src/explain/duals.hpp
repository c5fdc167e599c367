// What explanations of duals share for all kinds of cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "quality/measure.hpp"
#include "temper/explain.hpp"

namespace temper {

/// "h/ℓ = -0.31 on the side of vertex 7"
[[nodiscard]] inline std::string height_text(double h_over_l, VertexId apex) {
  return "h/ℓ = " + rounded(h_over_l) + " on the side of vertex " + std::to_string(apex.index);
}

/// The explanation of violations, each with a value: reason(violated) of the worst. Ties are in their order.
template <class Violated, class Value, class ReasonOf>
[[nodiscard]] DualExplanation worst_of(Criterion criterion, std::vector<Violated> violated, std::size_t most,
                                       const Value& value, const ReasonOf& reason) {
  std::stable_sort(violated.begin(), violated.end(),
                   [&](const Violated& a, const Violated& b) { return value(a) < value(b); });
  DualExplanation result = {criterion, violated.size(), {}};
  violated.resize(std::min(most, violated.size()), Violated());
  for (const Violated& each : violated) result.reasons.push_back(reason(each));
  return result;
}

}  // namespace temper
