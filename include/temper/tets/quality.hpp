// The report on a primal-dual mesh of tetrahedra: counts decided exactly, margins in doubles. The words are those of
// temper/quality.hpp, with a dimension more: a dual edge crosses a face, and a dual face crosses an edge.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "temper/quality.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

struct QualityOptions {
  std::size_t worst = 5;  ///< Number of the worst tetrahedra to list
  Executor* executor = nullptr;
};

/// A tetrahedron that is far from well-centered: its least h/ℓ is among the smallest of the mesh.
struct WorstTet {
  TetId tetrahedron;
  std::array<VertexId, 4> vertices;
  Vec3 at;                  ///< Centroid
  double h_over_l = 0;      ///< Least h/ℓ of its four faces
  double dihedral_deg = 0;  ///< Largest of its six dihedral angles
  std::string why;  ///< "orthocenter outside across face 3-9-12: h/ℓ = -0.2; dihedral angle of 138.3° at edge 3-9"
};
[[nodiscard]] const ReportTable& table_of(const WorstTet*);

/// An edge or a face as a place.
template <std::size_t n>
struct PlaceOf {
  std::array<VertexId, n> vertices;
  Vec3 at;  ///< Centroid
};
using EdgePlace = PlaceOf<2>;
using FacePlace = PlaceOf<3>;
[[nodiscard]] const ReportTable& table_of(const EdgePlace*);
[[nodiscard]] const ReportTable& table_of(const FacePlace*);

struct Histograms {
  Histogram dihedrals;  ///< All dihedral angles [degrees]
  Histogram h_over_l;   ///< h/ℓ of each tetrahedron and face
};
[[nodiscard]] const ReportTable& table_of(const Histograms*);

/// The length ℓ of a face is the side of the equilateral triangle with its area, the length ℓ of an edge its own.
/// Heights are relative to the face or edge below them, so they do not depend on the size of other elements.
struct Quality {
  std::size_t vertices = 0, inner_vertices = 0, tetrahedra = 0, faces = 0, boundary_faces = 0, edges = 0, regions = 0;
  std::size_t inverted_tetrahedra = 0;             ///< Tetrahedra that are not positive, exact
  std::size_t non_regular_faces = 0;               ///< Interior faces with negative dual edge, exact
  std::size_t negative_boundary_duals = 0;         ///< Boundary faces with h < 0, exact
  std::size_t negative_coefficients = 0;           ///< Interior edges with negative coefficient, exact
  std::size_t negative_boundary_coefficients = 0;  ///< Boundary edges with negative coefficient, exact
  /// Pairs of an edge between regions and one of these, of which this region alone has a negative coefficient, exact
  std::size_t negative_region_coefficients = 0;
  std::size_t nonpositive_distances = 0;           ///< Interior faces with dual edge ≤ 0, exact
  std::size_t nonpositive_boundary_distances = 0;  ///< Boundary faces with h ≤ 0, exact
  std::size_t nonpositive_region_distances = 0;    ///< Sides of faces between regions with h ≤ 0, exact
  std::size_t orthocenters_outside = 0;            ///< Tetrahedra with some h ≤ 0, and inverted ones, exact
  std::size_t faces_not_crossed = 0;               ///< Faces whose orthocenter is not strictly inside, exact
  std::size_t edges_not_crossed = 0;               ///< Edges without 0 < d < ℓ, exact
  double well_centered_fraction = 0;               ///< Fraction of tetrahedra with all h > 0
  double completely_well_centered_fraction = 0;    ///< The same, with all four faces and all six edges crossed
  double min_coefficient = 0;  ///< Least coefficient of edges and their parts in regions, over the length of the edge
  EdgePlace min_coefficient_place;
  double min_distance = 0;  ///< Least dual of faces over ℓ, and h/ℓ of the sides of faces between regions
  FacePlace min_distance_place;
  double min_h_over_l = 0;       ///< Least h/ℓ of tetrahedra over their faces; −∞ for an inverted tetrahedron
  double min_face_h_over_l = 0;  ///< Least h/ℓ of faces over their edges
  double min_d_over_l = 0;       ///< Least of d/ℓ and 1 − d/ℓ over edges
  double min_dihedral_deg = 0, max_dihedral_deg = 0;
  double volume = 0, min_volume = 0, max_volume = 0;  ///< Of all tetrahedra together; least and largest [length³]
  /// As in temper::Quality. The transmissibility of an interior face is A/|h_k + h_l|, its area over the distance
  /// between the orthocenters.
  double max_transmissibility_over_median = 0;
  double transmissibility_ratio = 0;
  Histograms histograms;
  std::vector<WorstTet> worst;  ///< Worst tetrahedra, the worst first
};
[[nodiscard]] const ReportTable& table_of(const Quality*);
/// Returns the number of violations of a criterion: of tetrahedra if it is well_centered, else of duals, and inverted
/// tetrahedra. 0 means that the mesh meets it.
[[nodiscard]] std::size_t violations(const Quality& quality, Criterion criterion);

/// Quality of one tetrahedron, for cell data.
struct TetrahedronQuality {
  bool well_centered = false;   ///< All h > 0, exact
  double min_h_over_l = 0;      ///< Least h/ℓ over its faces; −∞ for an inverted tetrahedron
  double min_dihedral_deg = 0;  ///< Least of its six dihedral angles
};
[[nodiscard]] TetrahedronQuality tetrahedron_quality(const std::array<WeightedPoint, 4>& corners);

using QualityMeasure = MeasureRow<Quality>;
[[nodiscard]] std::span<const QualityMeasure> quality_measures();

/// Measures a mesh. The report does not depend on the executor. O(n).
[[nodiscard]] Quality quality(const TetMesh& mesh, const QualityOptions& options = {});

}  // namespace temper::tets
