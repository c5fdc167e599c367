// From an outline to a mesh: its segments divided, points placed inside, a constrained Delaunay triangulation, and
// that optimized until every triangle is well-centered.
//
// The boundary is what an optimization cannot change, so it is divided for it: edges follow the size, change it slowly,
// and are short enough where two pieces of the outline face each other that a row of free vertices fits between. Where
// triangles stay bad all the same, the outline is divided finer around them, and all is done again. On the sphere the
// same is done with arcs of great circles; without an outline, points are placed all around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/outline.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

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
  double size = 0;     ///< edge length wanted, > 0; of the units of the points. With a field it may be 0: no bound
  double grade = 0.3;  ///< how fast the size may grow with the distance from what is smaller, > 0
  std::optional<SizeField> field = {};        ///< edge length wanted at each place, where it is less than `size`
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
  std::size_t delaunay_bad = 0;           ///< as many were before the optimization
  int attempts = 1;                       ///< divisions of the outline that were tried
  OptimizeReport report;                  ///< of the optimization, of the attempt that was kept
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

/// A sphere, or the part of it that is to be meshed. Points of the outlines are longitude and latitude [degrees], 180
/// and -180 being the same; their segments are the shorter arcs of great circles. Of the two sides that a closed line
/// leaves it encloses the smaller, whatever its direction; the segments of one part are one line.
struct SphereOutline {
  double radius = 6371000;
  Outline basins = {};  ///< closed: what they enclose is meshed; without any, the whole sphere
  Outline coasts = {};  ///< closed: what they enclose is left out
  Outline lines = {};   ///< of any shape: they become constrained edges
};

/// Meshes a sphere by the same steps. `vertex_of_point` has the points of basins, coasts and lines, one after the
/// other. Errors besides: what is no longitude and latitude, coasts that are not closed, that divide the sphere into
/// halves, or leave nothing of it; a size field of another space.
[[nodiscard]] Expected<OutlineMesh> mesh_sphere(const SphereOutline& outline, const MesherOptions& options,
                                                const OptimizeHooks& hooks = {});

}  // namespace temper
