// The lines of the input along which vertices slide: pieces of its boundary, of its creases and of constrained edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "surfaces/optimize/closest_point.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Where a vertex may move: kHeld, kFree for all of the surface, or the number of a line.
using Track = std::int32_t;
inline constexpr Track kHeld = -2, kFree = -1;

/// Edges, each from its lower vertex.
using Edges = std::vector<std::array<VertexId, 2>>;
[[nodiscard]] inline std::array<VertexId, 2> ascending(VertexId a, VertexId b) {
  return {std::min(a, b), std::max(a, b)};
}

class Lines {
 public:
  Lines() = default;
  /// A vertex is inside of a line if exactly two edges meet there: of the boundary, of creases, or constrained ones.
  /// The line must not bend there by more than kCornerDeg, and fixed vertices end it. `creases` is ascending.
  Lines(const SurfaceMesh& mesh, const Edges& creases, bool may_slide);

  [[nodiscard]] const IdVector<VertexId, Track>& tracks() const { return tracks_; }
  /// The point of a line that is closest to p.
  [[nodiscard]] Vec3 closest(Track line, Vec3 p) const { return at(line).segments.find(p).at; }
  /// The direction of a line at its point that is closest to p: of length 1, and continuous along the line.
  [[nodiscard]] Vec3 direction(Track line, Vec3 p) const;
  /// The vertices of edges that are too far from their line. If a place of a line is too far from the mesh, also the
  /// ends of the edge that is closest to this place. `tracks`: of the mesh.
  [[nodiscard]] std::vector<VertexId> too_far(const SurfaceMesh& mesh, const IdVector<VertexId, Track>& tracks,
                                              double most) const;

 private:
  struct Line {
    ClosestPoints segments;
    std::vector<Vec3> points, directions;
  };
  [[nodiscard]] const Line& at(Track line) const { return lines_[static_cast<std::size_t>(line)]; }
  void add(const SurfaceMesh& mesh, const std::vector<VertexId>& vertices);

  IdVector<VertexId, Track> tracks_;
  std::vector<Line> lines_;
};

}  // namespace temper::surfaces
