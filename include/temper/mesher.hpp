// From an outline to a mesh. The mesher divides the segments, places points inside, makes a constrained Delaunay
// triangulation, and optimizes it until every triangle is well-centered.
//
// An optimization cannot change the boundary, so the mesher divides the boundary with care. Edges follow the size and
// change their length slowly. If two pieces of the outline face each other, the edges are so short that a row of free
// vertices fits between them. If triangles stay bad, the mesher divides the outline finer around them and starts again.
// A line may become faces of power cells instead: then vertices lie on both sides of it, with weights that stay.
// On the sphere segments are arcs of great circles. Without an outline the mesher places points all around the sphere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/outline.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The area that the segments of an outline without parts enclose.
enum class Enclosed {
  by_points,  ///< `all` if the outline has hole or region points, else `alternate`
  all,        ///< Everything that segments enclose, except the holes (as in Triangle)
  alternate,  ///< Nested loops alternate: land, lake, island
};

struct RegionSize {
  std::int32_t region = 0;
  double size = 0;
};

/// The number of vertices of a mesh.
enum class MeshPoints {
  by_size,  ///< As many as the sizes ask for
  few,      ///< As few as the search finds, whatever the sizes
};

/// The cost of a mesh, estimated before the work.
struct MeshEstimate {
  double triangles = 0;  ///< Number of triangles
  double bytes = 0;      ///< Largest memory of the mesher and the optimization [bytes]

  /// "193 million".
  [[nodiscard]] std::string triangles_text() const;
  /// "77 GB".
  [[nodiscard]] std::string memory_text() const;
};

struct MesherOptions {
  /// Number of vertices. With `few` there are no sizes, and more time gives fewer vertices. Only in the plane.
  MeshPoints points = MeshPoints::by_size;
  double size = 0;     ///< Desired edge length, > 0, in the units of the points. With a field it may be 0: no bound
  double grade = 0.3;  ///< Largest growth rate of the size with the distance from smaller edges, > 0
  std::optional<SizeField> field = {};        ///< Desired edge length at each place, if less than `size`
  std::vector<RegionSize> region_sizes = {};  ///< Desired edge lengths of these regions, if less than `size`
  Enclosed enclosed = Enclosed::by_points;
  /// Tolerance: points that are nearer to each other or to a segment are joined. 0: nothing is joined. Absent: 1e-9 of
  /// the extent of the outline, or 1e-7 of the radius of the sphere.
  std::optional<double> snap = {};
  /// Leave out rings of polygons whose extent is less, such as small islands, and rings that joins within `snap` leave
  /// nothing of. 0: none
  double drop_below = 0;
  /// Divide segments where they cross, and leave out what is outside. Else crossings are errors.
  bool split_crossings = false;
  /// Options of the optimization; absent: the Delaunay mesh is returned.
  std::optional<OptimizeOptions> optimize = OptimizeOptions();
  int attempts = 8;                          ///< Largest number of divisions of the outline while triangles stay bad
  std::size_t most_triangles = 200'000'000;  ///< Largest number of triangles; sizes that would make more are refused
  double time_limit = 0;                     ///< Time limit of the whole call [s]; 0: none
  /// Memory that the call may take [bytes], such as io::free_memory(). Meshes that would need more are refused. Absent:
  /// no limit
  std::optional<std::uint64_t> memory = {};
  /// Function that gets the estimate before the work that it is for.
  std::function<void(const MeshEstimate&)> estimated = {};
};

/// A mesh edge that is part of a segment; or whose dual is, if the segment becomes faces: then Mesh::is_face() holds.
struct MeshLine {
  VertexId a, b;
  std::int32_t tag = 0;
};

/// A vertex that is a point of the outline with a tag, or a point of no segment.
struct MarkedVertex {
  VertexId vertex;
  std::int32_t tag = 0;
};

struct OutlineMesh {
  Mesh mesh;
  /// Each edge on the outline, in the order of the segments: once for each of its tags, or once with tag 0.
  std::vector<MeshLine> lines;
  std::vector<MarkedVertex> marked;       ///< Tagged points, then points of no segment without a tag
  std::vector<PhysicalName> groups;       ///< Names of these tags, and of regions
  std::vector<VertexId> vertex_of_point;  ///< Vertex of each point of the outline; invalid if the point is outside
  std::size_t bad = 0;                    ///< Number of triangles that are not well-centered
  std::size_t delaunay_bad = 0;           ///< Number of such triangles before the optimization
  int attempts = 1;                       ///< Number of divisions of the outline that were tried
  OptimizeReport report;                  ///< Report of the optimization, from the attempt that was kept
  std::vector<std::string> notes;         ///< Notes for the user, in sentences
  std::vector<std::string> warnings;      ///< Narrow places, and points that are lost
};

/// Makes lines become faces (LineKind): segments with these names or tags, and borders of regions with these names.
/// Error: nothing has the name.
[[nodiscard]] Expected<void> become_faces(Outline& outline, std::span<const std::string> names);

/// Meshes the inside of an outline. Equal outlines and options give equal meshes, bit for bit. Points of the outline
/// stay where they are, but those on faces are no vertices. Points of no segment become fixed vertices. About O(n log
/// n) per attempt.
///
/// Errors, with the outline's names:
///   - no points, indices of segment ends out of range, coordinates not finite or out of the range of exact arithmetic
///   - segments of zero length, segments that cross, parts that joins within `snap` leave nothing of
///   - nothing enclosed, holes or regions outside, parts that overlap,
///   - without joins: two points at one place, a domain that touches itself at a point
///   - lines that cannot become faces, with the reason
///   - sizes that are not positive, or would make too many triangles for `most_triangles` or `memory`
///   - stopped, if the time limit or the observer ends the run before there is a mesh; later the best mesh so far is
///     returned
[[nodiscard]] Expected<OutlineMesh> mesh_outline(const Outline& outline, const MesherOptions& options,
                                                 const OptimizeHooks& hooks = {});
/// Estimates the cost of mesh_outline(), from the sizes that it begins with. Narrow places may add to it. The errors
/// are those of the outline. About O(n log n) in the points of the outline.
[[nodiscard]] Expected<MeshEstimate> estimate_outline(const Outline& outline, const MesherOptions& options,
                                                      const OptimizeHooks& hooks = {});

/// A sphere, or the part of it to mesh. Points of the outlines are longitude and latitude [degrees]; 180 and -180 are
/// the same. Their segments are the shorter arcs of great circles. A closed line encloses the smaller of its two sides,
/// in either direction. The segments of one part are one line.
struct SphereOutline {
  double radius = 6371000;
  Outline basins = {};  ///< Closed lines around the area to mesh; none: the whole sphere
  Outline coasts = {};  ///< Closed lines around areas to leave out
  Outline lines = {};   ///< Lines of any shape that become constrained edges
};

/// Meshes a sphere in the same steps as mesh_outline(). `vertex_of_point` has the points of basins, coasts and lines,
/// in this order. Further errors: points that are no longitude and latitude; a size field of another space. Coasts must
/// be closed, must not divide the sphere into halves, and must leave some of it.
[[nodiscard]] Expected<OutlineMesh> mesh_sphere(const SphereOutline& outline, const MesherOptions& options,
                                                const OptimizeHooks& hooks = {});
/// Estimates the cost of mesh_sphere(), as estimate_outline() does.
[[nodiscard]] Expected<MeshEstimate> estimate_sphere(const SphereOutline& outline, const MesherOptions& options,
                                                     const OptimizeHooks& hooks = {});

}  // namespace temper
