// The distance between a surface and the input surface.
#pragma once

#include <array>
#include <vector>

#include "surfaces/optimize/closest_point.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

class Nearness {
 public:
  /// `most`: the largest allowed distance [length].
  Nearness(const SurfaceMesh& input, double most);

  [[nodiscard]] const ClosestPoints& input() const { return closest_; }
  [[nodiscard]] double most() const { return most_; }

  /// Says whether a triangle is near the input, at its center and the midpoints of its edges.
  [[nodiscard]] bool is_near(const std::array<Vec3, 3>& triangle) const;
  /// The vertices of triangles that are too far from the input, or nearest to places of the input that are too far.
  /// Ascending.
  [[nodiscard]] std::vector<VertexId> too_far(const SurfaceMesh& mesh) const;
  /// The largest distance, measured both ways.
  [[nodiscard]] double distance(const SurfaceMesh& mesh) const;

 private:
  ClosestPoints closest_;
  std::vector<Vec3> samples_;  ///< Of the input
  double most_;
};

}  // namespace temper::surfaces
