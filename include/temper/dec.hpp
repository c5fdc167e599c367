// Discrete exterior calculus on a weighted triangle mesh: incidence, diagonal stars with signed power duals, and the
// dual itself. What a finite-volume or DEC solver needs of a mesh, in one value of flat arrays.
//
// Conventions (docs/operators.md), with the signs of temper/detail/geometry.hpp:
//
//            k            edges:  each once, from the lower vertex number to the higher, sorted by (from, to)
//          / | \          d0:     −1 at from, +1 at to
//        /   o   \        d1:     +1 where the triangle is on the left of the edge, −1 where it is on the right
//      /     |h_k  \      ★0(v):  Σ d_ij h_k / 2 over the half-edges at v: the signed area of the dual cell
//    i ------+------ j    ★1(ij): (h_k + h_l) / ℓ; on the boundary h_k / ℓ: there the dual edge ends at the weighted
//      \     |h_l  /              midpoint of the edge, +
//        \   o   /        ★2(t):  1 / area
//          \ | /
//            l            The sum of ★0 is the area of the domain.
//
// On the sphere ℓ, d, h and dual lengths are lengths of arcs and areas spherical excess, times R and R², and
//   ★0(v) = Σ E over the half-edges at v, E the right triangle with legs d_ij and h_k: tan(E/2R²) = tan(d/2R)
//   tan(h/2R); Σ ★0 is 4πR² where the mesh is closed. ★1 = dual arc over arc, ★2 = 1 / area, with the same signs.
//
// A dual length is negative where the edge is not regular, or, on the boundary, where the orthocenter is outside; it is
// zero exactly where the four points are cocircular in the power sense. These signs are those of the exact predicates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/detail/ids.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// An undirected edge, once. Edges count in the order of their vertices: (0, 1), (0, 2), …, (1, 2), ….
using EdgeId = Id<struct EdgeTag>;

/// A sparse matrix of entries ±1, in compressed rows: row r has columns[starts[r]] … columns[starts[r + 1] − 1], in
/// ascending order, and the signs beside them.
struct IncidenceMatrix {
  std::size_t n_columns = 0;
  std::vector<std::int64_t> starts;   ///< rows + 1
  std::vector<std::int32_t> columns;  ///< one a non-zero
  std::vector<std::int8_t> signs;     ///< one a non-zero

  [[nodiscard]] std::size_t n_rows() const { return starts.empty() ? 0 : starts.size() - 1; }
};

struct DecEdge {
  VertexId from, to;        ///< from < to
  TriangleId left, right;   ///< of from → to; one of them is invalid on the boundary
  double length = 0;        ///< ℓ
  double crossing = 0;      ///< d, signed distance from `from`, towards `to`, of the weighted midpoint
  double left_height = 0;   ///< h of the orthocenter of `left` over this edge, > 0 on the side of `left`; 0 without it
  double right_height = 0;  ///< h of the orthocenter of `right`, > 0 on the side of `right`; 0 without it
  double dual_length = 0;   ///< left_height + right_height, with the exact sign, and accurate where they cancel
  Vec2 midpoint;  ///< in the plane: weighted midpoint, where the line of the dual edge crosses the line of the edge

  [[nodiscard]] bool is_boundary() const { return !left.valid() || !right.valid(); }
};

/// Operators and dual of a mesh. Vertices and triangles have the numbers of the mesh.
struct DecComplex {
  IdVector<EdgeId, DecEdge> edges;
  IdVector<HalfedgeId, EdgeId> edge_of_halfedge;
  IncidenceMatrix d0;                  ///< edges × vertices
  IncidenceMatrix d1;                  ///< triangles × edges
  IdVector<VertexId, double> star0;    ///< [length²]
  IdVector<EdgeId, double> star1;      ///< [1]: the transmissibility of a vertex-centered scheme
  IdVector<TriangleId, double> star2;  ///< [length⁻²]
  /// [1]: the transmissibility of a two-point flux between orthocenters, ℓ / (h_k + h_l), on the boundary ℓ / h_k; it
  /// has the sign of ★1, and is +∞ where that is 0.
  IdVector<EdgeId, double> transmissibility;
  IdVector<TriangleId, Vec2> orthocenters;  ///< the dual vertices of the plane; of images that of `points(t)`
  IdVector<TriangleId, double> areas;       ///< of the triangles, > 0
  // On the sphere instead of midpoint and orthocenters, at its radius. Empty in the plane.
  IdVector<EdgeId, Vec3> sphere_midpoints;
  IdVector<TriangleId, Vec3> sphere_orthocenters;
};

/// The operators of a mesh. Precondition: no erased triangles; fewer than 2³¹ edges. O(n).
[[nodiscard]] DecComplex dec_operators(const Mesh& mesh);

/// A summary of the operators, to be read before a solver uses them.
struct DecSummary {
  std::size_t vertices = 0, edges = 0, triangles = 0, boundary_edges = 0;
  std::size_t negative_star0 = 0;
  std::size_t negative_star1 = 0, zero_star1 = 0;  ///< of interior edges, exact: not regular; cocircular
  std::size_t negative_boundary_star1 = 0;         ///< of boundary edges, exact: orthocenter outside of the domain
  std::size_t not_well_centered = 0;               ///< triangles, exact
  double area = 0;                                 ///< of the domain
  double star0_sum = 0;                            ///< equal to it but for rounding
  double min_star0 = 0, min_star1 = 0;
  double median_star1 = 0, max_star1 = 0;  ///< of |★1| of all edges
  double median_transmissibility = 0,
         max_transmissibility = 0;  ///< of |transmissibility| of interior edges; +∞ where a dual edge has length 0
};
[[nodiscard]] DecSummary summarize(const Mesh& mesh, const DecComplex& complex);

/// What two power cells have in common, within the domain: a piece of the line across which their vertices have the
/// same power. It is perpendicular to the line between them, and crosses that at the weighted midpoint.
struct PowerFace {
  VertexId first, second;  ///< first < second
  double width = 0;        ///< > 0 [length]; on the sphere that of an arc
};

/// Power cells within the domain, as simple polygons, counter-clockwise. Ascending by vertex; a cell has one polygon,
/// or several that do not overlap, or none when it lies outside of the domain.
struct PowerCells {
  std::vector<VertexId> vertices;   ///< of each polygon
  std::vector<std::size_t> starts;  ///< polygon p has corners[starts[p]] … corners[starts[p + 1] − 1]
  std::vector<Vec2> corners;
  std::vector<Vec3> sphere_corners;   ///< on the sphere instead of corners, at its radius; sides are arcs
  std::vector<double> polygon_areas;  ///< of each polygon, > 0
  IdVector<VertexId, double> areas;   ///< of each vertex: of all its polygons. Sum: the area of the domain
  /// Each pair of cells once, ascending. In a well-centered mesh they are the edges, as wide as their duals.
  std::vector<PowerFace> faces;

  [[nodiscard]] std::size_t n_polygons() const { return vertices.size(); }
};

/// The power cell of each vertex, clipped to the domain. A point of triangle t belongs to the vertex of least power
/// distance among those that walks over mesh edges reach from the corners of t, through vertices that own some of t and
/// not around reflex corners of the domain. So, whatever the mesh, the cells are disjoint and cover the domain.
///   - In a regular triangulation of a convex domain they are the cells of the power diagram, half-plane by half-plane.
///   - In a well-centered mesh of any domain they are the polygons of orthocenters, whose areas are ★0.
///   - Where the domain is not convex, a cell does not jump over a crack, a notch or a hole.
/// On the sphere that is so of its power diagram: the flat faces with the weights |P|² are divided, and seen from 0.
/// In a periodic plane corners are where they are seen from the vertex, beyond the domain's edge where the cell is; a
/// cell must be narrower than half a period.
/// Precondition: no erased triangles, and `complex` is dec_operators(mesh). O(n) where triangles are well-centered, and
/// about ten microseconds for each that is not.
[[nodiscard]] PowerCells power_cells(const Mesh& mesh, const DecComplex& complex);

// --- with a diffusion tensor (temper/detail/tensor.hpp): operators of a mapped mesh, in the plane that it comes from
// ----------

/// The operators for −div(K ∇u) of a mesh whose image, mapped by the metric of K, has these: ★1 and transmissibility
/// are times √(det K), orthocenters and midpoints are mapped back, areas are the same in both. Lengths, crossings and
/// heights stay those of the metric.
[[nodiscard]] DecComplex mapped_back(DecComplex complex, const Metric& metric);
/// The cells of a mapped mesh: their corners are mapped back. Faces keep their widths, of the metric.
[[nodiscard]] PowerCells mapped_back(PowerCells cells, const Metric& metric);

}  // namespace temper
