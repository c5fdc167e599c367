// The polygons of sites around points of faces, as part of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/outline_mesh.hpp"

namespace temper::mesher {

/// Triangles and constrained edges of a mesh, as Mesh::build takes them.
struct Connectivity {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> regions;
  std::vector<std::array<std::int32_t, 2>> constrained;
};

/// Fills the holes that polygons of sites leave in the triangulation. Without faces it does nothing.
class FacePolygons {
 public:
  FacePolygons(const Domain& domain, const Corridors& corridors, const Inside& inside);

  /// Adds triangles of all polygons, in any order, and their sides as constrained edges.
  void add(Connectivity& connectivity) const;
  /// Weights of all vertices; empty without faces.
  [[nodiscard]] std::span<const double> weights() const { return weights_; }
  /// Makes the polygons regular, gives their triangles regions, keeps their faces, and appends lines. A triangle is in
  /// the region of most of its corners.
  void settle(Mesh& mesh, std::vector<MeshLine>& lines) const;

 private:
  [[nodiscard]] std::int32_t vertex(std::uint32_t point) const { return inside_.vertex[point]; }
  [[nodiscard]] VertexId id(std::uint32_t point) const {
    return VertexId(static_cast<std::size_t>(std::int64_t{vertex(point)}));
  }
  void make_regular(Mesh& mesh) const;
  void set_regions(Mesh& mesh) const;
  void append(const SitePair& pair, std::vector<MeshLine>& lines) const;

  const Domain& domain_;
  const Corridors& corridors_;
  const Inside& inside_;
  std::vector<double> weights_;
};

}  // namespace temper::mesher
