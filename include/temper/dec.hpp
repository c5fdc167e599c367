// Discrete exterior calculus on a weighted triangle mesh: incidence, diagonal stars with signed power duals, and the
// dual. One value of flat arrays has all that a finite-volume or DEC solver needs of a mesh.
//
// Conventions (docs/reference/operators.md), with the signs of temper/detail/geometry.hpp:
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
// On the sphere ℓ, d, h and dual lengths are lengths of arcs, and areas are spherical excess; the factors are R and R².
//   ★0(v) = Σ E over the half-edges at v, E the right triangle with legs d_ij and h_k: tan(E/2R²) = tan(d/2R)
//   tan(h/2R); Σ ★0 is 4πR² on a closed mesh. ★1 = dual arc over arc, ★2 = 1 / area, with the same signs.
//
// A dual length is negative if the edge is not regular. On the boundary it is negative if the orthocenter is outside.
// It is zero exactly if the four points are cocircular in the power sense. Exact predicates decide these signs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct ReportTable;

/// An undirected edge. Edges are sorted by their vertices: (0, 1), (0, 2), …, (1, 2), ….
using EdgeId = Id<struct EdgeTag>;

/// A sparse matrix with entries ±1 in compressed rows. Row r has columns[starts[r]] … columns[starts[r + 1] − 1] in
/// ascending order, and the signs at the same positions.
struct IncidenceMatrix {
  std::size_t n_columns = 0;
  std::vector<std::int64_t> starts;   ///< Starts of the rows, and the end of the last
  std::vector<std::int32_t> columns;  ///< Column of each entry
  std::vector<std::int8_t> signs;     ///< Sign of each entry

  [[nodiscard]] std::size_t n_rows() const { return starts.empty() ? 0 : starts.size() - 1; }
};

struct DecEdge {
  VertexId from, to;       ///< from < to
  TriangleId left, right;  ///< Triangles on the left and right of from → to; one of them is invalid on the boundary
  double length = 0;       ///< ℓ
  double crossing = 0;     ///< Crossing d: signed distance of the weighted midpoint from `from`, towards `to`
  /// Height h of the orthocenter of `left` over this edge, > 0 on the side of `left`; 0 without it.
  double left_height = 0;
  double right_height = 0;  ///< Height h of the orthocenter of `right`, > 0 on the side of `right`; 0 without it
  double dual_length = 0;   ///< Sum left_height + right_height, with the exact sign; accurate even if they cancel
  Vec2 midpoint;  ///< Weighted midpoint in the plane, where the line of the dual edge crosses the line of the edge

  [[nodiscard]] bool is_boundary() const { return !left.valid() || !right.valid(); }
};

/// The operators and the dual of a mesh. Vertices and triangles have the numbers of the mesh.
struct DecComplex {
  IdVector<EdgeId, DecEdge> edges;
  IdVector<HalfedgeId, EdgeId> edge_of_halfedge;
  IncidenceMatrix d0;                  ///< Edges × vertices
  IncidenceMatrix d1;                  ///< Triangles × edges
  IdVector<VertexId, double> star0;    ///< [length²]
  IdVector<EdgeId, double> star1;      ///< Transmissibility of a vertex-centered scheme [1]
  IdVector<TriangleId, double> star2;  ///< [length⁻²]
  /// Transmissibility of a two-point flux between orthocenters [1]: ℓ / (h_k + h_l), on the boundary ℓ / h_k. It has
  /// the sign of ★1, and is +∞ if ★1 is 0.
  IdVector<EdgeId, double> transmissibility;
  IdVector<TriangleId, Vec2>
      orthocenters;                    ///< Dual vertices in the plane; in a periodic plane the image for `points(t)`
  IdVector<TriangleId, double> areas;  ///< Areas of the triangles, > 0
  // With a coefficient, see with_coefficient(); else empty.
  IdVector<TriangleId, double> coefficient;  ///< K of each triangle
  IdVector<VertexId, double> capacity;  ///< ★0 with K: Σ K d_ij h_k / 2, for terms such as K ∂u/∂t [K length²]
  /// With a tensor for each triangle, else empty: K ℓ/h, the transmissibility between the orthocenter of a triangle and
  /// its edge. The transmissibility of an edge inside is 1/(1/a + 1/b) for those of its two halfedges.
  IdVector<HalfedgeId, double> half_transmissibility;
  // On the sphere these replace midpoint and orthocenters, at its radius. Empty in the plane.
  IdVector<EdgeId, Vec3> sphere_midpoints;
  IdVector<TriangleId, Vec3> sphere_orthocenters;
};

/// Computes the operators of a mesh. Preconditions: no erased triangles; fewer than 2³¹ edges. O(n).
[[nodiscard]] DecComplex dec_operators(const Mesh& mesh);

/// The operators for −div(K ∇u), from those of the mesh. K > 0 is constant on each triangle.
///
///     ★1               (K_k h_k + K_l h_l) / ℓ      flux between two vertices, along both triangles of the edge
///     transmissibility ℓ / (h_k / K_k + h_l / K_l)  flux between two orthocenters, one after the other: harmonic mean
///
/// On the boundary the missing term is left out. ★0 and ★2 are the mesh's; `capacity` is ★0 with K. If heights are
/// negative, signs may differ from those of the mesh, and they are not exact. Errors: not one value per triangle; a
/// value that is not finite or not above 0. Precondition: `complex` is dec_operators(mesh). O(n).
[[nodiscard]] Expected<DecComplex> with_coefficient(const Mesh& mesh, DecComplex complex,
                                                    std::span<const double> coefficient,
                                                    const InputNames* names = nullptr);

/// A summary of the operators, for a check before a solver uses them.
struct DecSummary {
  std::size_t vertices = 0, edges = 0, triangles = 0, boundary_edges = 0;
  std::size_t negative_star0 = 0;
  /// Interior edges, exact: not regular; cocircular. Edges inside polygons around ends of faces are neither.
  std::size_t negative_star1 = 0, zero_star1 = 0;
  std::size_t negative_boundary_star1 = 0;  ///< Boundary edges with the orthocenter outside the domain, exact
  std::size_t not_well_centered = 0;        ///< Number of such triangles, exact
  double area = 0;                          ///< Area of the domain
  double star0_sum = 0;                     ///< Sum of ★0: the area, except for rounding
  double min_star0 = 0, min_star1 = 0;
  double median_star1 = 0, max_star1 = 0;  ///< Median and maximum of |★1| over all edges
  /// Median and maximum of |transmissibility| over interior edges; the maximum is +∞ if a dual edge has length 0.
  double median_transmissibility = 0, max_transmissibility = 0;
};
[[nodiscard]] const ReportTable& table_of(const DecSummary*);
/// `mesh`: as it was measured; in pieces if tensors are of several planes.
[[nodiscard]] DecSummary summarize(const Mesh& mesh, const DecComplex& complex);

/// The common face of two power cells within the domain: a piece of the line on which both vertices have equal power.
/// It is perpendicular to the line between the vertices, and crosses it at the weighted midpoint.
struct PowerFace {
  VertexId first, second;  ///< first < second
  double width = 0;        ///< Width of the face, > 0 [length]; on the sphere the length of an arc
};

/// Power cells within the domain, as simple counter-clockwise polygons, ascending by vertex. A cell may have several
/// polygons that do not overlap. It has none if it lies outside the domain.
struct PowerCells {
  std::vector<VertexId> vertices;   ///< Vertex of each polygon
  std::vector<std::size_t> starts;  ///< Starts: polygon p has corners[starts[p]] … corners[starts[p + 1] − 1]
  std::vector<Vec2> corners;
  std::vector<Vec3> sphere_corners;   ///< Corners on the sphere, instead of corners, at its radius; sides are arcs
  std::vector<double> polygon_areas;  ///< Area of each polygon, > 0
  IdVector<VertexId, double> areas;   ///< Area of all polygons of each vertex. Sum: the area of the domain
  /// Region of the triangles that have the largest part of each cell; the lowest number of equal ones
  IdVector<VertexId, std::int32_t> regions;
  IdVector<VertexId, double> region_shares;  ///< This part over the area of the cell, 0 to 1; 0 for no polygons
  /// Each pair of neighboring cells once, ascending. In a well-centered mesh faces are the edges, and their widths are
  /// the dual lengths.
  std::vector<PowerFace> faces;

  [[nodiscard]] std::size_t n_polygons() const { return vertices.size(); }
};

/// Computes the power cell of each vertex, clipped to the domain. A point of triangle t belongs to the vertex with the
/// least power distance among those that can be reached from the corners of t. A vertex is reached by a walk over mesh
/// edges through vertices that own some part of t, but not around reflex corners of the domain. So the cells of any
/// mesh are disjoint and cover the domain.
///   - In a regular triangulation of a convex domain, they are the cells of the power diagram.
///   - In a well-centered mesh of any domain, they are the polygons of orthocenters, with the areas ★0.
///   - In a non-convex domain, a cell does not jump over a crack, a notch or a hole.
///
/// On the sphere these rules hold for its power diagram: the flat faces with the weights |P|² are divided, and
/// projected from the center. In a periodic plane corners are near their vertex, beyond the edge of the periodic domain
/// if necessary. A cell must be narrower than half a period. Preconditions: no erased triangles; `complex` is
/// dec_operators(mesh). O(n) for well-centered triangles, and about ten microseconds for each other triangle.
[[nodiscard]] PowerCells power_cells(const Mesh& mesh, const DecComplex& complex);

// --- with diffusion tensors (temper/detail/tensor.hpp): operators of a mapped mesh, in the plane that it comes from
// ---

/// The operators for −div(K ∇u) of a mesh, from the operators of pieces = mapped(mesh, …). ★1 and transmissibility have
/// the factor √(det K). Orthocenters and midpoints are mapped back. Areas are equal in both. Lengths, crossings and
/// heights stay in the metric.
///
/// At an edge of an interface ★1 is √(det K_k) h_k/ℓ_k + √(det K_l) h_l/ℓ_l, each part in the plane of its side. The
/// transmissibility is the harmonic sum of the two. Length and crossing are of the side on the left. The height on the
/// right is multiplied by ℓ_k/ℓ_l. ★0 is the sum of all copies of a vertex.
[[nodiscard]] DecComplex mapped_back(DecComplex complex, const MetricMesh& pieces, const Mesh& mesh);
/// The cells of pieces with their corners mapped back, and those of all copies of a vertex as one. Faces keep their
/// widths in the metric.
[[nodiscard]] PowerCells mapped_back(PowerCells cells, const MetricMesh& pieces);

}  // namespace temper
