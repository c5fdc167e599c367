// An outline checked before it becomes a planar graph: numbers, indices, places.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "mesher/problem.hpp"

namespace temper::mesher {

/// An error of points, segments, parts and rings, taken alone. Two points at one place are one if nothing is joined.
[[nodiscard]] std::optional<InputError> check_outline(const Problem& problem);

/// The error that a segment `what`.
[[nodiscard]] InputError at_segment(const Problem& problem, ErrorCode code, std::size_t i, const std::string& what);

}  // namespace temper::mesher
