// How far one vertex can go before an edge around it must flip (§2.4 of the paper).
//
// Let p(t) = p + t s with s = (s_x, s_y, s_w), and a, b, c three other vertices, seen from p. The lifted determinant
//   F(t) = F(0) + t (B s_x + C s_y − D s_w) + t² D (s_x² + s_y²),     D = −2 area(abc)
// is quadratic in t, linear when only the weight moves. Two kinds of edges can flip: link edges (a, b, c is the
// outer triangle, regular while F ≤ 0) and spokes (a, b, c are three neighbours on the link, regular while F ≥ 0).
#pragma once

#include <array>
#include <limits>

#include "temper/mesh.hpp"

namespace temper {

inline constexpr double kNoThreshold = std::numeric_limits<double>::infinity();

/// The least t ≥ 0 at which an unconstrained edge of v's star or link that is regular now stops being so when v moves
/// along step; kNoThreshold when none does. In doubles: near it, only the exact test decides.
[[nodiscard]] double flip_threshold(const Mesh& mesh, VertexId v, const std::array<double, 3>& step);

}  // namespace temper
