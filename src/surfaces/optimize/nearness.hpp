// The distance between a surface and the input surface.
#pragma once

#include <array>
#include <cstdint>
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

  /// Says whether all of a triangle is near the input.
  [[nodiscard]] bool is_near(const std::array<Vec3, 3>& triangle) const {
    return closest_.bound(triangle, most_, most_).most <= most_;
  }
  /// The results of the last look, for a mesh with the same numbers of triangles: their corners then, whether they were
  /// near the input, and whether the triangles of the input were near the mesh.
  struct Known {
    std::vector<ClosestPoints::Triangle> triangles;
    std::vector<std::uint8_t> is_near, is_input_near;
  };
  /// The results after an edit, if the mesh was near before it and the new triangles are near.
  [[nodiscard]] Known after_edit(const SurfaceMesh& before, const std::vector<TriangleId>& replaced,
                                 const SurfaceMesh& after) const;
  /// The vertices of triangles that are too far from the input, or nearest to places of the input that are too far.
  /// Looks again only at what has changed since the last time.
  [[nodiscard]] std::vector<VertexId> too_far(const SurfaceMesh& mesh, Known& known) const;
  /// A bound of the largest distance, both ways, of a mesh without vertices that are too far.
  [[nodiscard]] double distance(const SurfaceMesh& mesh) const;

 private:
  ClosestPoints closest_;
  double most_;
};

}  // namespace temper::surfaces
