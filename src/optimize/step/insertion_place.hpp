// The point of a triangle at which a new vertex is tried.
#pragma once

#include "geometry/surface.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Returns the point, without a weight. `best` is the orthocenter.
[[nodiscard]] inline WeightedPoint insertion_point(const Space& space, InsertionPlace place, const WeightedPoint& a,
                                                   const WeightedPoint& b, const WeightedPoint& c) {
  const auto bare = [&](const WeightedPoint& p) { return space.with_weight(p, 0); };
  switch (place) {
    case InsertionPlace::centroid:
      return middle(space, a, b, c);
    case InsertionPlace::circumcenter:
      return orthocenter(space, bare(a), bare(b), bare(c));
    case InsertionPlace::orthocenter:
    case InsertionPlace::best:
      break;
  }
  return orthocenter(space, a, b, c);
}

}  // namespace temper
