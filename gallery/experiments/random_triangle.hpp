// Triangles for claims about all triangles.
#pragma once

#include "experiments/random.hpp"
#include "experiments/single_triangle.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {

/// Counter-clockwise, corners in [−1, 1]², weights between −w and w. Slivers are left out: they keep few digits.
inline Corners random_triangle(Random& random, double w) {
  constexpr double kLeastDoubledArea = 0.1;
  Corners p;
  do {
    for (WeightedPoint& corner : p) corner = {random(-1, 1), random(-1, 1), w > 0 ? random(-w, w) : 0};
  } while (doubled_area(p[0].position(), p[1].position(), p[2].position()) < kLeastDoubledArea);
  return p;
}

}  // namespace temper::gallery
