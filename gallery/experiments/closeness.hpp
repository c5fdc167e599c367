// A measure of how nearly two vertices coincide, from the paper's short-edge rule (Algorithm 2), for marks and claims.
#pragma once

#include <vector>

#include "experiments/mesh_picture.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// Algorithm 2 removes a vertex whose E_c-optimal place is nearer than this to a neighbor.
inline constexpr double kCollapseRatio = 0.1;
/// Half of that: of vertices where the optimizer left them. Barriers at γ = 1 stay above, HOT falls to 1e−3 and less.
inline constexpr double kNearlyCoincident = 0.05;

/// An interior vertex, a neighbor, and their distance over the shorter perimeter edge at the neighbor.
struct ClosePair {
  VertexId vertex, neighbor;
  double ratio = 0;
};

/// The pair with the least ratio at that interior vertex.
[[nodiscard]] ClosePair closest_neighbor(const Mesh& mesh, VertexId v);
/// Pairs of lesser ratio, the nearest first, each once.
[[nodiscard]] std::vector<ClosePair> close_pairs(const Mesh& mesh, double ratio = kNearlyCoincident);
/// The least ratio of the mesh; +∞ without interior vertices.
[[nodiscard]] double least_closeness(const Mesh& mesh);

/// Red discs on nearly coincident vertices, yellow ones on those within the collapse ratio.
[[nodiscard]] std::vector<Mark> closeness_marks(const Mesh& mesh);

}  // namespace temper::gallery
