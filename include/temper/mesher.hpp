// From an outline to a mesh: its segments divided, points placed inside, a constrained Delaunay triangulation, and
// that optimised until every triangle is well-centered.
//
// The boundary is what an optimisation cannot change, so it is divided for it: edges follow the size, change it slowly,
// and are short enough where two pieces of the outline face each other that a row of free vertices fits between. Where
// triangles stay bad all the same, the outline is divided finer around them, and all is done again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/error.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"
#include "temper/outline.hpp"

namespace temper {

/// The meaning of the segments of an outline without parts: what they enclose.
enum class Enclosed {
  by_points,  ///< like `all` when it has hole or region points, else like `alternate`
  all,        ///< everything that segments enclose, but for the holes (Triangle's reading)
  alternate,  ///< nested loops take turns: land, lake, island
};

struct RegionSize {
  std::int32_t region = 0;
  double size = 0;
};

struct MesherOptions {
  double size = 0;     ///< edge length wanted, > 0; of the units of the points
  double grade = 0.3;  ///< how fast the size may grow with the distance from what is smaller, > 0
  std::vector<RegionSize> region_sizes = {};  ///< of these regions, when less than `size`
  Enclosed enclosed = Enclosed::by_points;
  std::optional<OptimizeOptions> optimize = OptimizeOptions();  ///< absent: the Delaunay mesh as it is
  int attempts = 8;                          ///< at most so many divisions of the outline while triangles stay bad
  std::size_t most_triangles = 200'000'000;  ///< sizes that would make more are refused
  double time_limit = 0;                     ///< of all of it, seconds; 0: none
};

/// An edge of the mesh that is part of a segment.
struct MeshLine {
  VertexId a, b;
  std::int32_t tag = 0;
};

struct OutlineMesh {
  Mesh mesh;
  std::vector<MeshLine> lines;            ///< each edge on the outline once, in the order of the segments
  std::vector<VertexId> vertex_of_point;  ///< invalid for points outside
  std::size_t bad = 0;                    ///< triangles that are not well-centered
  std::size_t delaunay_bad = 0;           ///< as many were before the optimisation
  int attempts = 1;                       ///< divisions of the outline that were tried
  OptimizeReport report;                  ///< of the optimisation, of the attempt that was kept
  std::vector<std::string> notes;         ///< what the user should know, in sentences
};

/// Meshes the inside of an outline. The same outline and options give the same mesh, bit for bit. Points of the outline
/// stay where they are; points of no segment become fixed vertices. Errors, by the outline's names: no points, ends of
/// segments out of range, not finite, out of the range of exact arithmetic, two points at one place, segments of no
/// length or crossing, nothing enclosed, holes and regions outside, parts that overlap, a domain that touches itself at
/// a point; sizes that are not positive or would make too many triangles; stopped, when the time or the caller's
/// patience ends before there is a mesh (later the best mesh so far is returned). About O(n log n) an attempt.
[[nodiscard]] Expected<OutlineMesh> mesh_outline(const Outline& outline, const MesherOptions& options,
                                                 const OptimizeHooks& hooks = {});

}  // namespace temper
