// Means of a field along each edge and its dual edge: all that the stars and the right-hand sides are made of. Areas
// need no quadrature of their own: ∫ u = ∮ U n_x with ∂U/∂x = u, and ∫ Δu = ∮ ∇u · n.
#pragma once

#include "verify/fields.hpp"
#include "verify/setting.hpp"

namespace temper::verify_detail {

struct EdgeMeans {
  Vec2 gradient;              ///< of ∇u, along the edge
  Vec2 dual_gradient;         ///< along the dual edge
  double antiderivative = 0;  ///< of U, along the edge
  double dual_antiderivative = 0;
  double from_antiderivative = 0;  ///< on the boundary: from `from` to the weighted midpoint
  double to_antiderivative = 0;    ///< and from there to `to`
};

/// The means over each edge, computed on the executor's threads; the same for any.
[[nodiscard]] IdVector<EdgeId, EdgeMeans> edge_means(const Setting& setting, const Field& field);

}  // namespace temper::verify_detail
