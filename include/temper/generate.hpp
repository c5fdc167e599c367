// Example meshes: the meshes of the paper, and the classes of meshes on which a method should be tested. Each is made
// here from its parameters and a seed, by a constrained Delaunay triangulation with temper's own predicates.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A closed polygon: counter-clockwise for an outline, in either direction for a hole.
using Polygon = std::vector<Vec2>;

/// Points and segments to triangulate. The spans are read only during the call.
struct DelaunayInput {
  std::span<const Vec2> points;
  /// Constrained edges, 0-based. A segment through other points becomes a chain of edges.
  std::span<const std::array<std::int32_t, 2>> segments = {};
  /// Drop the triangles outside the outermost closed segments, and inside holes (by parity). A segment that encloses
  /// nothing stays as a constrained edge. If false, or without segments, the result is the convex hull.
  bool carve = true;
  /// Function that is called at each point and segment; true ends the call with ErrorCode::stopped.
  std::function<bool()> stop = {};
};
/// Returns the constrained Delaunay triangulation, with all weights zero. Points keep their numbers. Ties are broken by
/// number, so the result depends on points and segments alone. About O(n log n); a million points take 2 seconds.
///
/// Errors, with the number of the element:
///   - fewer than three points, all points on one line, points not finite or out of the range of exact arithmetic, two
///     points at one place, points outside
///   - segments out of range, of zero length, crossing, or enclosing nothing
///   - a domain that touches itself at a point
[[nodiscard]] Expected<Mesh> constrained_delaunay(const DelaunayInput& input);

/// The paper's sparse horseshoe (fig. 11 left): 5 vertices, 4 triangles.
[[nodiscard]] Mesh sparse_horseshoe();

/// The parameterized horseshoe (§6.5) with na × nb points. x and y are the semi-axes at b = 0 and 1. It is the
/// constrained Delaunay triangulation of the points between the two arches.
struct Horseshoe {
  int a = 7, b = 9;
  std::array<double, 2> x = {1, 2};
  std::array<double, 2> y = {1, 4};
};
[[nodiscard]] Expected<Mesh> horseshoe(const Horseshoe& shape = {});

/// Triangle with sides of length a and b from vertex 0, and an angle in degrees between them (§3.1.2, fig. 9).
struct SingleTriangle {
  double a = 0.5, b = 1, angle_deg = 120;
};
[[nodiscard]] Expected<Mesh> single_triangle(const SingleTriangle& shape = {});

/// Uniformly random points in a polygon, n vertices in all. The default polygon is a non-convex L shape with a notch.
/// The boundary is divided at the mean spacing, and inner points keep half a spacing from it. About half of the
/// triangles are bad.
struct RandomMesh {
  std::size_t vertices = 1000;
  std::uint64_t seed = 1;
  Polygon polygon = {};  ///< Outline; empty: the default polygon
};
[[nodiscard]] Expected<Mesh> random_mesh(const RandomMesh& shape = {});

// --- the whole sphere
// --------------------------------------------------------------------------------------------------

/// Returns the Delaunay triangulation of points around the sphere, given by their directions: the convex hull of the
/// points at the radius. All weights are zero. Points keep their numbers, which also break ties. About O(n log n).
/// Errors: a point without direction, two points in one direction, points that leave half of the sphere empty.
[[nodiscard]] Expected<Mesh> spherical_delaunay(std::span<const Vec3> points, double radius = 1);

/// The icosahedron with each triangle cut into four, `level` times: 10 · 4^level + 2 vertices.
struct Icosahedral {
  int level = 4;
  double radius = 1;
};
[[nodiscard]] Expected<Mesh> icosahedral(const Icosahedral& shape = {});

/// Delaunay triangulation of uniformly random points around the sphere: about half of the triangles are bad.
struct RandomSphere {
  std::size_t vertices = 1000;
  std::uint64_t seed = 1;
  double radius = 1;
};
[[nodiscard]] Expected<Mesh> random_sphere(const RandomSphere& shape = {});

/// Delaunay triangulation of random points around the sphere. Their sizes grow from one place to the opposite place by
/// a ratio. About half of the triangles are bad.
struct GradedSphere {
  std::size_t vertices = 10000;
  double ratio = 30;  ///< Ratio of the largest size to the least, ≥ 1
  Vec2 at = {};       ///< Place of the least size: longitude and latitude [degrees]
  std::uint64_t seed = 1;
  double radius = 1;
};
[[nodiscard]] Expected<Mesh> graded_sphere(const GradedSphere& shape = {});
/// The size that the points follow, in a direction from the center: the edge of equilateral triangles of the same
/// number. Its logarithm is linear in the coordinate along the axis through the place.
[[nodiscard]] double graded_sphere_size(const GradedSphere& shape, Vec3 direction);

// --- periodic planes ----------------------------------------------------------------------------------------------

/// Returns the Delaunay triangulation of points in a plane that is periodic along both axes, with all weights zero.
/// Points keep their numbers. About O(n log n). Errors: a point that is not finite, two points at one place, too few
/// points for triangles that fit into half a period.
[[nodiscard]] Expected<Mesh> periodic_delaunay(std::span<const Vec2> points, Vec2 period);

/// Delaunay triangulation of uniformly random points in a periodic plane: about half of the triangles are bad.
struct RandomPeriodic {
  std::size_t vertices = 1000;
  std::uint64_t seed = 1;
  Vec2 period = {1, 1};
};
[[nodiscard]] Expected<Mesh> random_periodic(const RandomPeriodic& shape = {});

/// Rows of hexagons as power cells, with equal distances between neighboring vertices, like planar_hex of MPAS-Tools. A
/// channel has no period along y.
struct PeriodicHexagons {
  int nx = 16, ny = 16;
  double distance = 1;
  bool channel = false;
};
[[nodiscard]] Expected<Mesh> periodic_hexagons(const PeriodicHexagons& shape = {});

/// nx × ny squares, each cut along the same diagonal, then sheared by x += shear · y.
struct ShearedGrid {
  int nx = 20, ny = 20;
  double shear = 0.5;
};
[[nodiscard]] Expected<Mesh> sheared_grid(const ShearedGrid& shape = {});

/// Rings of points between two circles, with the middle rings turned and jittered.
struct Annulus {
  double inner = 0.4, outer = 1;
  int around = 48, rings = 6;
  double jitter = 0.3;
  std::uint64_t seed = 1;
};
[[nodiscard]] Expected<Mesh> annulus(const Annulus& shape = {});

/// A box with a hole like an airfoil, graded from fine at the foil to coarse at the box.
struct Airfoil {
  int around = 80;       ///< Number of points on the foil
  double growth = 1.25;  ///< Ratio of the spacing of one layer to the layer before
  std::uint64_t seed = 1;
};
[[nodiscard]] Expected<Mesh> airfoil(const Airfoil& shape = {});

// --- hard meshes: plain sweeps do not make them well-centered, or only just -------------------------------------

/// A regular polygon of radius 1 with no vertex inside.
struct RegularPolygon {
  int corners = 60;
};
[[nodiscard]] Expected<Mesh> regular_polygon(const RegularPolygon& shape = {});

/// A letter A: 29 vertices, 29 triangles, a hole, no vertex inside.
[[nodiscard]] Mesh letter_a();

/// A triangle with a sharp corner between two sides of length 1. Each of these sides has `pieces` edges, and there are
/// as many random points inside.
struct Wedge {
  double angle_deg = 5;
  int pieces = 8;
  std::uint64_t seed = 1;
};
[[nodiscard]] Expected<Mesh> wedge(const Wedge& shape = {});

/// Random points in the unit square. Their size grows with the distance from a corner: finest + growth · distance.
struct GradedMesh {
  double finest = 1.0 / 64;
  double growth = 0.2;
  std::uint64_t seed = 1;
};
[[nodiscard]] Expected<Mesh> graded_mesh(const GradedMesh& shape = {});

}  // namespace temper
