// Points inside, about one size apart: a front that starts from the outline and moves inwards row by row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/areas.hpp"
#include "mesher/deadline.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {

/// A place where the outline faces itself through the inside.
struct Gap {
  double width = 0;
  Vec3 at;
  /// Edges of the arrangement on both sides; or a point, as `kPoint` + its place.
  std::array<std::uint32_t, 2> sides = {};
  static constexpr std::uint32_t kPoint = 0x80000000u;
};

struct NarrowPlaces {
  std::vector<SizeSource> sources;
  std::optional<Gap> narrowest;
};

/// Sizes that leave room for a row of vertices between facing pieces. Only sizes that are below `size` by more than a
/// tenth. Isolated points count as pieces of no length.
[[nodiscard]] NarrowPlaces narrow_places(const DividedOutline& divided, const Triangulated& triangulated,
                                         const GradedSize& size, Deadline& deadline);

/// Places points. Each candidate is one size away from its point or piece. It is taken when nothing is too near and no
/// piece lies between. The order is the order of the pieces, then of the points: deterministic. Ends when there are
/// `most`, or when it is time to stop. A whole sphere without pieces is filled from its isolated points, or from the
/// start of the sizes. O(n log n).
[[nodiscard]] std::vector<Vec3> place_points(const DividedOutline& divided, const Areas& areas, const GradedSize& size,
                                             std::size_t most, Deadline& deadline);

}  // namespace temper::mesher
