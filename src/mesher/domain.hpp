// The domain of a mesh: the outline as a planar graph, and the areas inside it.
#pragma once

#include "mesher/areas.hpp"
#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"

namespace temper::mesher {

/// Each edge has an area on one side at least.
struct Domain {
  Arrangement arrangement;
  Areas areas;

  [[nodiscard]] const Area& area(std::int32_t i) const { return areas.areas[static_cast<std::size_t>(i)]; }
};

/// If the inside touches itself at a place, it is divided there: each further fan gets a place of its own, half the
/// tolerance inwards. A note says so; without a tolerance it is an error. Further errors: those of arrange() and of
/// find_areas(), and ErrorCode::stopped.
[[nodiscard]] Expected<Domain> find_domain(const Problem& problem, Deadline& deadline);

}  // namespace temper::mesher
