// Discrete exterior calculus on a weighted mesh of tetrahedra: temper/dec.hpp, with a dimension more. Incidence,
// diagonal stars with signed power duals, transmissibilities and the dual are one value of flat arrays.
//
// Conventions (docs/reference/operators.md), with the signs of temper/tets/geometry.hpp:
//
//            s            edges:   from the lower vertex to the higher, sorted; faces: pqr, p < q < r, sorted
//          / | \          behind:  the tetrahedron out of which the normal (q − p) × (r − p) of the face points
//         p--|--r         ahead:   the tetrahedron into which it points
//          \ | /          d0, d1:  +1 where the edge ends, −1 where it starts; pq and qr +1 in pqr, pr −1
//            q            d2:      +1 for the tetrahedron behind a face, −1 for the one ahead
//
//   ★0(v) = Σ d k h / 6 over the flags at v: signed volume of the dual cell, which sums to the volume of the domain
//   ★1(e) = Σ k h / 2 / ℓ over the flags at e: signed area of the dual face over the length
//   ★2(f) = (h_behind + h_ahead) / A: signed length of the dual edge over the area; on the boundary h / A
//   ★3(t) = 1 / volume
//
// A flag is a tetrahedron with one of its faces and an edge of this face. k is the height of the orthocenter of the
// face over the edge. On the boundary dual edges end at the orthocenter of the face, and dual faces at the weighted
// midpoint of the edge. Exact predicates decide the signs of ★2 and of all heights.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "temper/dec.hpp"
#include "temper/tets/mesh.hpp"
#include "temper/tets/tensor.hpp"

namespace temper::tets {

/// An undirected face. Faces are sorted by their vertices: (0, 1, 2), (0, 1, 3), …, (1, 2, 3), ….
using FaceId = Id<struct FaceTag>;

struct DecEdge {
  VertexId from, to;         ///< from < to
  bool is_boundary = false;  ///< Says whether it is an edge of a boundary face
  double length = 0;         ///< ℓ
  double crossing = 0;       ///< Crossing d: signed distance of the weighted midpoint from `from`, towards `to`
  double dual_area = 0;      ///< Signed area of the dual face
  Vec3 midpoint;             ///< Weighted midpoint, where the plane of the dual face crosses the line of the edge
};

struct DecFace {
  std::array<VertexId, 3> vertices;  ///< Ascending
  TetId behind, ahead;               ///< One of them is invalid on the boundary
  double area = 0;                   ///< Area A
  double behind_height = 0;  ///< Height h of the orthocenter of `behind` over this face, > 0 on its side; 0 without it
  double ahead_height = 0;   ///< Height h of the orthocenter of `ahead`, > 0 on its side; 0 without it
  double dual_length = 0;    ///< Sum of both heights, with the exact sign; accurate even if they cancel
  Vec3 orthocenter;          ///< Orthocenter of the face, where the line of the dual edge crosses the plane of the face

  [[nodiscard]] bool is_boundary() const { return !behind.valid() || !ahead.valid(); }
};

/// The operators and the dual of a mesh. Vertices and tetrahedra have the numbers of the mesh.
struct DecComplex {
  IdVector<EdgeId, DecEdge> edges;
  IdVector<FaceId, DecFace> faces;
  IncidenceMatrix d0;                ///< Edges × vertices
  IncidenceMatrix d1;                ///< Faces × edges
  IncidenceMatrix d2;                ///< Tetrahedra × faces
  IdVector<VertexId, double> star0;  ///< [length³]
  IdVector<EdgeId, double> star1;    ///< Transmissibility of a vertex-centered scheme [length]
  IdVector<FaceId, double> star2;    ///< [length⁻¹]
  IdVector<TetId, double> star3;     ///< [length⁻³]
  /// Transmissibility of a two-point flux between orthocenters [length]: A / (h_behind + h_ahead), on the boundary A/h.
  /// It has the sign of ★2, and is +∞ if ★2 is 0.
  IdVector<FaceId, double> transmissibility;
  IdVector<TetId, Vec3> orthocenters;  ///< Dual vertices
  IdVector<TetId, double> volumes;     ///< Volumes of the tetrahedra, > 0
  // With a coefficient, see with_coefficient(); else empty.
  IdVector<TetId, double> coefficient;  ///< K of each tetrahedron
  IdVector<VertexId, double> capacity;  ///< ★0 with K: Σ K d k h / 6, for terms such as K ∂u/∂t [K length³]
  /// With tensors, see mapped_back(), else empty: K A/h, the transmissibility between the orthocenter of a tetrahedron
  /// and its face. The transmissibility of a face inside is 1/(1/a + 1/b) for those of its two halffaces.
  IdVector<HalffaceId, double> half_transmissibility;
};

/// Computes the operators of a mesh. Precondition: fewer than 2³¹ faces. O(n).
[[nodiscard]] DecComplex dec_operators(const TetMesh& mesh);

/// The operators for −div(K ∇u), from those of the mesh. K > 0 is constant on each tetrahedron.
///
///     ★1               Σ K k h / 2 / ℓ                 flux between two vertices, along all tetrahedra of the edge
///     transmissibility A / (h_b / K_b + h_a / K_a)     flux between two orthocenters, one after the other
///
/// On the boundary the missing term is left out. The other stars are the mesh's; `capacity` is ★0 with K. Errors: as
/// those of triangles. Precondition: `complex` is dec_operators(mesh). O(n).
[[nodiscard]] Expected<DecComplex> with_coefficient(const TetMesh& mesh, DecComplex complex,
                                                    std::span<const double> coefficient,
                                                    const InputNames* names = nullptr);

/// With diffusion tensors (temper/tets/tensor.hpp): the operators for −div(K ∇u) of a mesh, from the operators of
/// pieces = mapped(mesh, …). ★1 and transmissibility have the factor ∛(det K). Orthocenters and midpoints are mapped
/// back. Volumes are equal in both. ★2, lengths, areas, crossings and heights stay in the metric.
///
/// At an interface ★1 of an edge is the sum over the pieces around it, each in its own space. Its length and crossing
/// are of the piece with the first tetrahedron, and its dual area is ℓ times the sum of dual areas over lengths. ★2 of
/// a face is h_b/A_b + h_a/A_a, and its transmissibility is the harmonic sum of both sides. Its area and its
/// orthocenter are of the side behind. The height ahead is multiplied by A_b/A_a. ★0 is the sum of all copies of a
/// vertex.
[[nodiscard]] DecComplex mapped_back(const DecComplex& complex, const MetricMesh& pieces, const TetMesh& mesh);

/// A summary of the operators, for a check before a solver uses them.
struct DecSummary {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0, boundary_faces = 0;
  std::size_t negative_star0 = 0, negative_star1 = 0;
  std::size_t negative_star2 = 0, zero_star2 = 0;  ///< Interior faces, exact: not regular; cospherical
  std::size_t negative_boundary_star2 = 0;         ///< Boundary faces with the orthocenter outside the domain, exact
  std::size_t not_well_centered = 0;               ///< Number of such tetrahedra, exact
  double volume = 0;                               ///< Volume of the domain
  double star0_sum = 0;                            ///< Sum of ★0: the volume, except for rounding
  double min_star0 = 0, min_star1 = 0, min_star2 = 0;
  double median_star1 = 0, max_star1 = 0;  ///< Median and maximum of |★1| over all edges
  /// Median and maximum of |transmissibility| over interior faces; the maximum is +∞ if a dual edge has length 0.
  double median_transmissibility = 0, max_transmissibility = 0;
};
[[nodiscard]] const ReportTable& table_of(const DecSummary*);
[[nodiscard]] DecSummary summarize(const DecComplex& complex);

}  // namespace temper::tets
