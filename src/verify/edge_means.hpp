// Means of a field along each edge and its dual edge: all that the stars and the right-hand sides are made of. Areas
// need no quadrature of their own: ∫ u = ∮ V · n with div V = u, and ∫ Δu = ∮ ∇u · n.
#pragma once

#include "verify/fields.hpp"
#include "verify/setting.hpp"

namespace temper::verify_detail {

/// Vectors in the coordinates of direction(): x, y of the plane, or along and to the left of the edge. (On the sphere
/// these two turn on the way along an arc as it does.)
struct EdgeMeans {
  Vec2 gradient;        ///< of ∇u, along the edge
  Vec2 dual_gradient;   ///< along the dual edge
  Vec2 potential;       ///< of V, along the edge
  Vec2 dual_potential;  ///< along the dual edge
  Vec2 from_potential;  ///< on the boundary: from `from` to the weighted midpoint
  Vec2 to_potential;    ///< and from there to `to`
};

/// The means over each edge, computed on the executor's threads; the same for any.
[[nodiscard]] IdVector<EdgeId, EdgeMeans> edge_means(const Setting& setting, const Field& field);

}  // namespace temper::verify_detail
