// The part of a step after which an edge flips, for steps that end at a bound.
#pragma once

#include <array>

#include "temper/mesh.hpp"

namespace temper {

/// Returns flip_threshold(mesh, v, step), or `most` if that is less. Most edges of a short step need no root and no
/// exact test.
[[nodiscard]] double flip_threshold_up_to(const Mesh& mesh, VertexId v, const std::array<double, 3>& step, double most);

}  // namespace temper
