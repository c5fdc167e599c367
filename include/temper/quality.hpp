// The report on a primal-dual mesh: counts decided exactly, margins and energies in doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/criterion.hpp"
#include "temper/detail/solver_measures.hpp"
#include "temper/detail/space.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;
struct ReportTable;

/// Says what quality() measures. All else keeps the values that it has without a mesh.
enum class QualityDetail {
  all,
  brief,      ///< No energies, and no SolverMeasures but the edges and duals over the local size
  criterion,  ///< No energies, SolverMeasures and transmissibilities: enough for violations()
};

struct QualityOptions {
  LengthParameter gamma = {1.0, LengthScale::absolute};  ///< Parameter γ of E_BP in the report
  LengthParameter h0 = {0.0, LengthScale::absolute};     ///< Parameter −h° of E_BHs in the report
  std::size_t worst = 5;                                 ///< Number of the worst triangles to list
  QualityDetail detail = QualityDetail::all;
  Executor* executor = nullptr;
};

// On the sphere all lengths and angles are measured along arcs.

/// A triangle that is far from well-centered: its least h/ℓ or d/ℓ is among the smallest of the mesh.
struct WorstTriangle {
  TriangleId triangle;
  std::array<VertexId, 3> vertices;
  Vec2 at;                       ///< Centroid; on the sphere its longitude and latitude [degrees]
  double h_over_l = 0;           ///< Least h/ℓ of its three edges
  double angle_deg = 0;          ///< Largest of its three angles
  std::string why;               ///< "orthocenter outside across edge 3-9: angle of 138.3° at vertex 10"
  std::optional<double> z = {};  ///< The third coordinate of the centroid, on a curved surface
};
[[nodiscard]] const ReportTable& table_of(const WorstTriangle*);

/// An edge as a place.
struct EdgePlace {
  std::array<VertexId, 2> vertices;
  Vec2 at;                       ///< Midpoint; on the sphere its longitude and latitude [degrees]
  std::optional<double> z = {};  ///< The third coordinate of the midpoint, on a curved surface
};
[[nodiscard]] const ReportTable& table_of(const EdgePlace*);

/// Counts in equal bins over [low, high]. Each bin includes its lower end. Values outside go to the end bins, and NaN
/// to the first one.
struct Histogram {
  double low = 0;
  double high = 0;
  std::vector<std::size_t> counts;

  void add(double value) {
    const double bins = static_cast<double>(counts.size());
    const double bin = std::floor((value - low) / (high - low) * bins);
    ++counts[static_cast<std::size_t>(std::min(std::max(0.0, bin), bins - 1))];  // max(0, NaN) is 0
  }
  /// Adds the counts of a histogram with the same bins.
  void merge(const Histogram& other) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
  }
};
[[nodiscard]] const ReportTable& table_of(const Histogram*);

struct Histograms {
  Histogram angles;    ///< Angles of all triangles [degrees]
  Histogram h_over_l;  ///< h/ℓ of each triangle and edge
  Histogram d_over_l;  ///< Lesser of d/ℓ and 1 − d/ℓ of each edge
};
[[nodiscard]] const ReportTable& table_of(const Histograms*);

/// Total energies of a mesh, as [EnergyKind, the row of energies()][star]. A value is +∞ outside the domain of the
/// energy.
using EnergiesByStar = std::array<std::array<double, 3>, kEnergyKinds>;

struct Quality : SolverMeasures {
  std::size_t vertices = 0, triangles = 0, edges = 0, boundary_edges = 0, regions = 0;
  std::size_t inverted_triangles = 0;       ///< Exact number
  std::size_t non_regular_edges = 0;        ///< Interior edges with negative dual, exact
  std::size_t negative_boundary_duals = 0;  ///< Boundary edges with h < 0, exact
  /// Sides of interfaces between regions with h < 0, exact: a coefficient of this region alone is negative
  std::size_t negative_region_coefficients = 0;
  std::size_t nonpositive_distances = 0;           ///< Interior edges with dual ≤ 0, exact
  std::size_t nonpositive_boundary_distances = 0;  ///< Boundary edges with h ≤ 0, exact
  std::size_t nonpositive_region_distances = 0;    ///< Sides of interfaces between regions with h ≤ 0, exact
  std::size_t orthocenters_outside = 0;            ///< Triangles with some h ≤ 0, and inverted triangles, exact
  std::size_t edges_not_crossed = 0;               ///< Edges without 0 < d < ℓ, exact
  double well_centered_fraction = 0;               ///< Fraction of triangles with all h > 0 and 0 < d < ℓ
  /// Least coefficient: dual over ℓ of edges, and h/ℓ of the sides of interfaces. It is also the least distance over ℓ
  double min_coefficient = 0;
  EdgePlace min_coefficient_place;
  double min_h_over_l = 0;  ///< Least over triangles and their edges; −∞ for an inverted triangle
  double min_d_over_l = 0;  ///< Least of d/ℓ and 1 − d/ℓ over edges
  double min_angle_deg = 0, max_angle_deg = 0;
  /// Largest over median transmissibility. The transmissibility of an interior edge is ℓ/|h_k + h_l|, the length of the
  /// face over the distance between the orthocenters (two-point flux). +∞ if a dual edge has exactly length zero; 1
  /// without interior edges.
  double max_transmissibility_over_median = 0;
  double transmissibility_ratio = 0;  ///< Largest over least transmissibility; 1 and +∞ as above
  EnergiesByStar energy = {};
  Histograms histograms;
  std::vector<WorstTriangle> worst;  ///< Worst triangles, the worst first
};
[[nodiscard]] const ReportTable& table_of(const Quality*);
/// Returns the number of violations of a criterion: of triangles if it is well_centered, else of duals, and inverted
/// triangles. 0 means that the mesh meets it.
[[nodiscard]] std::size_t violations(const Quality& quality, Criterion criterion);

/// Quality of one triangle, for cell data.
struct TriangleQuality {
  bool well_centered = false;  ///< All h > 0 and 0 < d < ℓ, exact
  double min_h_over_l = 0;     ///< Least h/ℓ of its edges; −∞ for an inverted triangle
  double min_d_over_l = 0;     ///< Least of d/ℓ and 1 − d/ℓ over its edges
  double min_angle_deg = 0;
};
[[nodiscard]] TriangleQuality triangle_quality(const Mesh& mesh, TriangleId t);
/// Quality of a triangle with these corners in a space, before there is a mesh.
[[nodiscard]] TriangleQuality triangle_quality(const Space& space, const std::array<WeightedPoint, 3>& corners);

/// The direction in which a number is better.
enum class Preference : std::uint8_t {
  equal,   ///< A count must be this number
  larger,  ///< A minimum or fraction must be at least this number
  less,    ///< A maximum or energy must be at most this number
};

/// A row of the table of measures, for each number of a report except energies. Requirements, reports and tables are
/// made from these rows.
template <class Report>
struct MeasureRow {
  std::string_view key;    ///< Key in reports, and name of the member of Report
  std::string_view alias;  ///< Short name, or the name that its community uses; or empty
  std::string_view label;  ///< Label in tables
  /// Community whose codes use the measure; empty for measures of primal-dual meshes in general.
  std::string_view community;
  std::string_view definition;  ///< Definition in one line, with its source
  Preference better;
  bool count;                    ///< Measure is a whole number
  std::optional<double> wanted;  ///< Requirement by default, if the user gives no other
  double (*of)(const Report&);
};
using QualityMeasure = MeasureRow<Quality>;
[[nodiscard]] std::span<const QualityMeasure> quality_measures();

/// A number per triangle, for pictures.
struct TriangleValue {
  std::string_view name;   ///< "quality", "angle", …
  std::string_view label;  ///< Label for legends, with the unit
  double (*of)(const Mesh& mesh, TriangleId t);
  Preference better = Preference::larger;  ///< Values that are bright in pictures
};
/// Rows of the table of triangle values:
///   - quality: the least of h/ℓ, d/ℓ and 1 − d/ℓ; positive in well-centered triangles, −∞ in inverted ones
///   - angle: the largest angle [degrees]
///   - size: the mean length of the edges
///   - region: the region number
[[nodiscard]] std::span<const TriangleValue> triangle_values();

/// Measures a mesh. The report does not depend on the executor. Precondition: no erased triangles. O(n).
[[nodiscard]] Quality quality(const Mesh& mesh, const QualityOptions& options = {});
/// Measures a mesh that nobody else reads meanwhile. A large one with scattered numbers is not copied, but ordered in
/// place, and gets its order back.
[[nodiscard]] Quality quality_in_place(Mesh& mesh, const QualityOptions& options = {});

}  // namespace temper
