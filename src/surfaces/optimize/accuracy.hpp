// The accuracy energy of a surface and its barrier, with their derivatives.
//
// They are sums over edges of functions of lengths, heights and weights (energy/accuracy_energy.hpp). So an edge of a
// surface has the energy that its two triangles have in the plane, unfolded.
#pragma once

#include <cstddef>
#include <vector>

#include "energy/accuracy_edge.hpp"
#include "surfaces/optimize/draft.hpp"
#include "surfaces/optimize/triangle_side.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Takes sizes and floors from the first draft.
class DraftAccuracy {
 public:
  DraftAccuracy(const Draft& draft, const AccuracyModel& model);

  /// Energy and barrier, and their derivatives in each triangle. Precondition: room() is positive there.
  [[nodiscard]] double value(const Draft& draft, std::vector<CornerSlopes>& slopes) const;
  /// The margin of a triangle above its floor.
  [[nodiscard]] double room(const Draft& draft, std::size_t triangle) const;
  /// The local sizes: edges of equilateral triangles of the mean area around each vertex, averaged with the neighbors'.
  [[nodiscard]] const IdVector<VertexId, double>& sizes() const { return sizes_; }
  /// Says whether a triangle has a margin that doubles can keep.
  [[nodiscard]] bool has_floor(std::size_t triangle) const { return barriers_[triangle].floor > 0; }

 private:
  AccuracyModel model_;
  IdVector<VertexId, double> sizes_;
  std::vector<TriangleBarrier<double>> barriers_;
  std::vector<DraftEdge> edges_;
};

}  // namespace temper::surfaces
