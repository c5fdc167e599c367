// Checks in a useful order: numbers, indices, places, parts.
#include "mesher/outline_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::mesher {
namespace {

using Error = std::optional<InputError>;

InputError at_point(const Problem& problem, ErrorCode code, std::size_t i, const std::string& what) {
  return {code, problem.names.point_where(i), problem.names.point(i) + " " + what};
}

Error check_points(const Problem& problem) {
  const Outline& o = problem.outline;
  if (!problem.is_closed() && (o.points.empty() || o.segments.empty())) {
    return InputError{ErrorCode::empty_input, "",
                      "the outline has no " + std::string(o.points.empty() ? "points" : "segments")};
  }
  for (std::size_t i = 0; i < o.points.size(); ++i) {
    const Vec2 p = o.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      return at_point(problem, ErrorCode::not_finite, i,
                      "has coordinates " + coordinates(p) + "; expected finite numbers");
    }
    if (!is_exact_coordinate(p.x) || !is_exact_coordinate(p.y)) {
      return at_point(problem, ErrorCode::out_of_scale, i,
                      "has coordinates too large or too small for exact arithmetic");
    }
  }
  return check_tags(o.point_tags, "point", o.points.size());
}

Error check_segments(const Problem& problem) {
  const Outline& o = problem.outline;
  const auto n = static_cast<std::int64_t>(o.points.size());
  for (std::size_t i = 0; i < o.segments.size(); ++i) {
    const auto& ends = o.segments[i].ends;
    for (const std::int32_t end : ends) {
      if (end < 0 || end >= n) {
        return at_segment(problem, ErrorCode::index_out_of_range, i,
                          "uses " + problem.names.point(static_cast<std::size_t>(std::int64_t{end})) +
                              ", but the outline has " + std::to_string(n) + " points");
      }
    }
    if (ends[0] == ends[1]) {
      return at_segment(problem, ErrorCode::zero_area, i,
                        "has no length: both its ends are " + problem.names.point(static_cast<std::size_t>(ends[0])));
    }
  }
  return check_tags(o.further_tags, "segment", o.segments.size());
}

/// Two points at one place are an error if nothing is joined.
Error check_places(const Problem& problem) {
  const Outline& o = problem.outline;
  if (problem.tolerance > 0) return {};
  std::vector<std::uint32_t> order(o.points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::array{problem.points[i].x, problem.points[i].y, problem.points[i].z};
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j) || (key(i) == key(j) && i < j); });
  Error first;
  std::uint32_t least = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (key(order[k - 1]) != key(order[k]) || (first && order[k] > least)) continue;
    least = order[k];
    first = at_point(
        problem, ErrorCode::duplicate_point, order[k],
        "is at the same place as " + problem.names.point(order[k - 1]) + ", " + problem.text(problem.points[least]));
  }
  return first;
}

Error check_uses(const Problem& problem, const std::string& what, const std::vector<std::int32_t>& segments) {
  const auto n = static_cast<std::int32_t>(problem.outline.segments.size());
  for (const std::int32_t segment : segments) {
    if (segment >= 0 && segment < n) continue;
    return InputError{ErrorCode::index_out_of_range, "",
                      what + " uses " + problem.names.segment(static_cast<std::size_t>(std::int64_t{segment})) +
                          ", but the outline has " + std::to_string(n) + " segments"};
  }
  return {};
}

Error check_parts(const Problem& problem) {
  const Outline& o = problem.outline;
  for (std::size_t i = 0; i < o.parts.size(); ++i) {
    if (Error error = check_uses(problem, problem.names.part(i), o.parts[i].segments)) return error;
  }
  for (std::size_t i = 0; i < o.rings.size(); ++i) {
    if (Error error = check_uses(problem, problem.names.ring(i), o.rings[i].segments)) return error;
    if (o.rings[i].shell >= static_cast<std::int32_t>(o.rings.size())) {
      return InputError{ErrorCode::index_out_of_range, "",
                        problem.names.ring(i) + " is a hole of ring " + std::to_string(o.rings[i].shell) +
                            ", but the outline has " + std::to_string(o.rings.size()) + " rings"};
    }
  }
  return {};
}

}  // namespace

InputError at_segment(const Problem& problem, ErrorCode code, std::size_t i, const std::string& what) {
  return {code, problem.names.segment_where(i), problem.names.segment(i) + " " + what};
}

std::optional<InputError> check_outline(const Problem& problem) {
  for (const auto check : {check_points, check_segments, check_places, check_parts}) {
    if (Error error = check(problem)) return error;
  }
  return {};
}

}  // namespace temper::mesher
