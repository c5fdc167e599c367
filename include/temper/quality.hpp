// The report on a primal-dual mesh: counts decided exactly, margins and energies in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/space.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

struct QualityOptions {
  LengthParameter gamma = {1.0, LengthScale::absolute};  ///< for E_BP in the report
  LengthParameter h0 = {0.0, LengthScale::absolute};     ///< for E_BHs: −h°
  std::size_t worst = 5;                                 ///< how many of the worst triangles to list
  Executor* executor = nullptr;
};

// On the sphere lengths and angles are those of arcs.

/// One of the triangles that are furthest from well-centered: those with the least h/ℓ or d/ℓ.
struct WorstTriangle {
  TriangleId triangle;
  std::array<VertexId, 3> vertices;
  Vec2 at;               ///< centroid; on the sphere its longitude and latitude [degrees]
  double h_over_l = 0;   ///< least of its three
  double angle_deg = 0;  ///< largest
  std::string why;       ///< "orthocenter outside across edge 3-9: angle of 138.3° at vertex 10"
};

/// Counts in equal bins over [low, high]: of all angles in degrees, of all h/ℓ of triangles and their edges, of the
/// lesser of d/ℓ and 1 − d/ℓ of each edge. What lies outside goes to the end bins; each bin holds its lower end.
struct Histogram {
  double low = 0;
  double high = 0;
  std::vector<std::size_t> counts;
};

/// The total energies of a mesh: [EnergyKind, the row of energies()][star], +∞ outside the domain of the energy.
using EnergiesByStar = std::array<std::array<double, 3>, kEnergyKinds>;

/// What codes that run on meshes refuse or are slowed by: quality_measures() has the definition of each, and whose it
/// is. A least over nothing is +∞, a largest 0. Interior edges have a triangle on both sides, closed cells are those of
/// vertices inside.
struct SolverMeasures {
  double min_edge_over_size = std::numeric_limits<double>::infinity();  ///< relative_lengths() of interior edges
  double min_dual_over_size = std::numeric_limits<double>::infinity();
  double min_dual_over_cell_median = std::numeric_limits<double>::infinity();  ///< of closed cells
  double max_orthogonality = 0;                                                ///< of interior edges, |cosine|
  double max_smoothness = 0;                                                   ///< of interior edges, ≥ 1
  double min_flow_link = std::numeric_limits<double>::infinity();              ///< of interior edges
  std::size_t small_flow_links = 0;                                            ///< less than 0.1
  double min_cell_quality = std::numeric_limits<double>::infinity();           ///< of closed cells
  double min_grid_spacing = std::numeric_limits<double>::infinity();           ///< [length]
  double max_grid_spacing = 0;                                                 ///< [length]
  double min_triangle_quality = std::numeric_limits<double>::infinity();
  double min_triangle_angle_quality = std::numeric_limits<double>::infinity();
  std::size_t obtuse_triangles = 0;          ///< exact
  double max_centroid_offset_over_size = 0;  ///< of closed cells
};

struct Quality : SolverMeasures {
  std::size_t vertices = 0, triangles = 0, edges = 0, boundary_edges = 0, regions = 0;
  std::size_t inverted_triangles = 0;       ///< exact
  std::size_t non_regular_edges = 0;        ///< interior edges with negative dual, exact
  std::size_t negative_boundary_duals = 0;  ///< boundary edges with h < 0, exact
  std::size_t orthocenters_outside = 0;     ///< triangles with some h ≤ 0, and inverted ones, exact
  std::size_t edges_not_crossed = 0;        ///< edges without 0 < d < ℓ, exact
  double well_centered_fraction = 0;        ///< triangles with all h > 0 and 0 < d < ℓ
  double min_h_over_l = 0;                  ///< over triangles and their edges; −∞ for an inverted triangle
  double min_d_over_l = 0;                  ///< over edges, the lesser of d/ℓ and 1 − d/ℓ
  double min_angle_deg = 0, max_angle_deg = 0;
  /// The largest over the median of the two-point-flux transmissibilities ℓ/|h_k + h_l| of interior edges (face length
  /// over the distance between the orthocenters). +∞ when a dual edge has length zero, exactly; 1 without interior
  /// edges.
  double max_transmissibility_over_median = 0;
  double transmissibility_ratio = 0;  ///< the largest over the least of them; 1 and +∞ as above
  EnergiesByStar energy = {};
  std::vector<WorstTriangle> worst;  ///< worst first
  Histogram angles, h_over_l, d_over_l;
};

/// What Quality says of a mesh, of one triangle: for data of cells.
struct TriangleQuality {
  bool well_centered = false;  ///< all h > 0 and 0 < d < ℓ, exact
  double min_h_over_l = 0;     ///< of its edges; −∞ for an inverted triangle
  double min_d_over_l = 0;     ///< of its edges, the lesser of d/ℓ and 1 − d/ℓ
  double min_angle_deg = 0;
};
[[nodiscard]] TriangleQuality triangle_quality(const Mesh& mesh, TriangleId t);
/// The same of corners in a space, before there is a mesh.
[[nodiscard]] TriangleQuality triangle_quality(const Space& space, const std::array<WeightedPoint, 3>& corners);

/// What one wants of a number.
enum class Preference : std::uint8_t {
  equal,   ///< counts: the number
  larger,  ///< minima and fractions: at least
  less,    ///< maxima and energies: at most
};

/// A number of Quality, the energies aside: requirements, reports and tables are made from these rows.
struct QualityMeasure {
  std::string_view key;         ///< of reports; a member of Quality has the same name
  std::string_view alias;       ///< a short name, or the one that its community uses; or empty
  std::string_view label;       ///< in tables
  std::string_view community;   ///< whose codes look at it; empty for those of primal-dual meshes as such
  std::string_view definition;  ///< of one line, with its source
  Preference better;
  bool count;                    ///< a whole number
  std::optional<double> wanted;  ///< what is asked for where nobody says more
  double (*of)(const Quality&);
};
[[nodiscard]] std::span<const QualityMeasure> quality_measures();

/// A number of each triangle, for pictures.
struct TriangleValue {
  std::string_view name;   ///< "quality", "angle", …
  std::string_view label;  ///< for legends, with its unit
  double (*of)(const Mesh& mesh, TriangleId t);
};
/// quality: the least of h/ℓ, d/ℓ and 1 − d/ℓ, −∞ for an inverted triangle: positive in well-centered ones; angle: the
/// largest [degrees]; size: the mean length of the edges; region.
[[nodiscard]] std::span<const TriangleValue> triangle_values();

/// Measures a mesh. The same report for any executor. Precondition: no erased triangles. O(n).
[[nodiscard]] Quality quality(const Mesh& mesh, const QualityOptions& options = {});

}  // namespace temper
