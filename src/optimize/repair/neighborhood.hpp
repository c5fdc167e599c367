// A few rings of triangles around a place, as a small mesh on which repairs are tried.
//
// Triangles outside stay, so every vertex with a triangle outside keeps its position and weight. Its corners alone
// decide whether a triangle is well-centered. So triangles that are well-centered here are also well-centered in the
// whole mesh, and a rim edge between two such triangles is regular.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "optimize/flips/flipper.hpp"
#include "optimize/flips/guard.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct Neighborhood {
  Mesh mesh;
  TriangleId seed;                           ///< the triangle at the center, by local number
  std::vector<VertexId> vertices;            ///< of the whole mesh, by local number
  std::vector<std::uint8_t> frozen;          ///< by local number
  std::vector<WeightedPoint> beyond;         ///< by rim edge: opposite corner of the triangle outside
  std::vector<std::int32_t> region_beyond;   ///< by rim edge: region of the triangle outside
  std::vector<std::array<VertexId, 2>> rim;  ///< edges of the rim that have a triangle outside, by local numbers
  std::vector<OutsideNeighbors> outside;     ///< by local number
  DividedEdges divided;                      ///< of the run's own vertices on lines, by local number

  /// Says whether the edge between a and b has a triangle outside.
  [[nodiscard]] bool is_rim(VertexId a, VertexId b) const;
};

/// Returns `rings` rings of triangles around the seed, and further ones so that no vertex joins two fans. O(its size).
[[nodiscard]] Neighborhood neighborhood_of(const WorkingCopy& work, TriangleId seed, int rings);

/// Returns the halfedges of boundary and constrained edges at v: out of v, or into v if the edge has only this one.
[[nodiscard]] std::vector<HalfedgeId> lines_at(const Mesh& mesh, VertexId v);

/// Says exactly whether the unconstrained edges of the rim are regular with the present local mesh.
[[nodiscard]] bool rim_is_regular(const Neighborhood& around, const Mesh& local);
/// Returns the edges of the present local mesh that violate the criterion in the whole mesh: edges of the rim have two
/// sides there. Precondition: the criterion is not well_centered.
[[nodiscard]] std::vector<ViolatedEdge> violated_edges(const Neighborhood& around, const Mesh& local,
                                                       Criterion criterion);

/// Applies the events of a trial on `around` to its mesh, which must not have changed since, and traces them. Removed
/// vertices stay isolated until the caller compacts. Returns the new vertices of the place: they include all corners of
/// changed triangles.
std::vector<VertexId> splice(WorkingCopy& work, Flipper& flipper, const Neighborhood& around,
                             std::span<const TraceEvent> events);

}  // namespace temper
