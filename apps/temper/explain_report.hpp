// The reports of `temper explain`: text for people, and JSON.
#pragma once

#include <cstddef>
#include <string>

#include "input.hpp"
#include "report_text.hpp"
#include "temper/explain.hpp"

namespace temper::app {

/// Counts, then a paragraph a reason, at most `limit` conflicts and `limit` groups that only lack weights.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const Input& input, std::size_t limit,
                                           const TextStyle& style);
/// All reasons. Vertices and triangles are counted from 0, in the texts too.
[[nodiscard]] std::string explanation_json(const Explanation& explanation, const Input& input);

}  // namespace temper::app
