// A triangle with its dual and the names of its distances, d along edges and h from them: figs. 1 and 5.
#pragma once

#include <string>

#include "experiments/single_triangle.hpp"

namespace temper::gallery {

/// Vertices i, j, k in counter-clockwise order. Every d and h is drawn where it is measured; with `sub_triangle` only
/// d_ij and h_k are, and the right-angled triangle that has them as legs is filled.
struct LabeledTriangle {
  Corners corners;
  bool sub_triangle = false;
  double width = 460;  ///< pixels
};
[[nodiscard]] std::string labeled_triangle_svg(const LabeledTriangle& drawing);

}  // namespace temper::gallery
