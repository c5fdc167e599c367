// A few rings of triangles around a place, as a small mesh of its own: what a repair is tried on.
//
// What is outside stays as it is, so every vertex with a triangle outside is frozen, in position and weight. A triangle
// is well-centered or not by its own corners alone; so what is found well-centered here is so in the whole mesh, and an
// edge of the rim between two such triangles is regular.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "optimize/flips/flipper.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct Neighborhood {
  Mesh mesh;
  TriangleId seed;                           ///< that it was taken around, by local number
  std::vector<VertexId> vertices;            ///< of the whole mesh, by local number
  std::vector<std::uint8_t> frozen;          ///< by local number
  std::vector<WeightedPoint> beyond;         ///< across the rim: opposite corner of the triangle outside, by rim edge
  std::vector<std::array<VertexId, 2>> rim;  ///< the rim's edges that have a triangle outside, local numbers
};

/// The triangles that share a vertex with the seed, `rings` times over, and what it takes to touch itself nowhere.
/// O(its size).
[[nodiscard]] Neighborhood neighborhood_of(const Mesh& mesh, TriangleId seed, int rings);

/// Are the rim's edges regular, seen from the local mesh as it is now? Exact; constrained ones do not count.
[[nodiscard]] bool rim_is_regular(const Neighborhood& around, const Mesh& local);

/// Applies the events of a trial on `around`, traced like all else, to the mesh that it was taken from, which must not
/// have changed since. Removed vertices stay as isolated ones until the caller compacts. Returns the vertices of the
/// place as it is then: every triangle that has changed has its corners among them.
std::vector<VertexId> splice(WorkingCopy& work, Flipper& flipper, const Recorder& recorder, const Neighborhood& around,
                             std::span<const TraceEvent> events);

}  // namespace temper
