// The two tests by which the paper removes a vertex, asked of a mesh as it is: the short-edge rule (Algorithm 2) and
// the patch test (§6.6.4). Written on the public energies alone, with another minimizer than the optimizer's: a second
// opinion on what a run did.
#pragma once

#include <cstddef>

#include "experiments/closeness.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// The place where E_F would put an inner vertex, and its distance to the nearest neighbor.
struct ShortEdge {
  Vec2 best;                ///< the E_F-optimal position
  VertexId nearest;         ///< the neighbor nearest to it
  double distance = 0;      ///< from `best` to that neighbor
  double distance_now = 0;  ///< from the vertex as it is to the neighbor nearest to that
  double ratio = 0;         ///< distance over the shorter link edge at the neighbor
  [[nodiscard]] bool collapses() const { return ratio < kCollapseRatio; }
};
[[nodiscard]] ShortEdge short_edge(const Mesh& mesh, VertexId v);

/// The change of the mesh's energy when v is removed: the patch test removes it when this is negative. +∞ when v cannot
/// be removed.
[[nodiscard]] double energy_change_without(const Mesh& mesh, const EnergyModel& model, VertexId v);

/// Edges at v.
[[nodiscard]] std::size_t valence(const Mesh& mesh, VertexId v);

}  // namespace temper::gallery
