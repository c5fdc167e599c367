// Curved surfaces: meshes of triangles with points in space, closed or with boundary, of any genus.
//
// Each triangle is plane. Its orthocenter, heights h and crossings d follow from three lengths and three weights, by
// the formulas of the plane (temper/detail/geometry.hpp). The dual of an edge has one part in each triangle: its length
// is h_k + h_l, as if both triangles were unfolded into one plane. So criteria, weights and operators keep their names.
//
//          k             The area A has a square root in space: h ℓ = N/(2 A) with N rational in coordinates and
//        / | \           weights. A sign of h is a sign of N. A sign of h_k + h_l compares the squares of N_k/A_k and
//      i---+---j         N_l/A_l. Exact arithmetic decides both.
//        \ | /
//          l             The library is temper::surfaces, beside the core.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "temper/dec.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/vec.hpp"
#include "temper/draw.hpp"
#include "temper/explain.hpp"
#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::surfaces {

// --- one triangle in space ----------------------------------------------------------------------------------------

/// A point of space and its weight. The power distance to q is |(x, y, z) − q|² − w.
struct WeightedPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  [[nodiscard]] constexpr Vec3 position() const { return {x, y, z}; }
  friend constexpr bool operator==(WeightedPoint, WeightedPoint) = default;
};

/// Says whether three points are on one line. Exact for all finite numbers, as are all signs here.
[[nodiscard]] bool is_flat(Vec3 p, Vec3 q, Vec3 r);
/// Sign of the height of the orthocenter of pqr over pq, positive on the side of r. Precondition: pqr is not flat.
[[nodiscard]] Sign signed_height_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// Sign of d_pq, measured from p towards q.
[[nodiscard]] Sign dual_crossing_sign(const WeightedPoint& p, const WeightedPoint& q);
/// Sign of the dual length of pq: the sum of the heights over pq in pqr and in qps. Precondition: neither is flat.
[[nodiscard]] Sign dual_length_sign(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                    const WeightedPoint& s);
/// Says whether all heights are > 0, and all edges are crossed by their duals: 0 < d < ℓ.
[[nodiscard]] bool is_well_centered(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);

// In doubles:

/// The point of equal power to p, q and r in their plane.
[[nodiscard]] Vec3 orthocenter(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// d_pq [length].
[[nodiscard]] double dual_crossing(const WeightedPoint& p, const WeightedPoint& q);
/// h over pq in pqr [length].
[[nodiscard]] double signed_height(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// The dual length of pq over its length, with the exact sign. It is accurate even if both heights cancel.
[[nodiscard]] double dual_over_length(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                      const WeightedPoint& s);

/// A triangle pqr by its squared lengths, and its weights, both [length²].
struct MetricTriangle {
  double pq = 0, qr = 0, rp = 0;
  double wp = 0, wq = 0, wr = 0;
  /// This triangle with its corners as q, r, p, and its mirror image with q, p, r.
  [[nodiscard]] constexpr MetricTriangle turned() const { return {qr, rp, pq, wq, wr, wp}; }
  [[nodiscard]] constexpr MetricTriangle mirrored() const { return {pq, rp, qr, wq, wp, wr}; }
  /// pq·pr, qp·qr and rp·rq.
  [[nodiscard]] constexpr std::array<double, 3> dots() const {
    return {0.5 * (pq + rp - qr), 0.5 * (pq + qr - rp), 0.5 * (qr + rp - pq)};
  }
};
// As above, for the lengths as they are. The height is over pq. `left` is pqr, and `right` is qps.
[[nodiscard]] bool is_flat(const MetricTriangle& t);
[[nodiscard]] Sign signed_height_sign(const MetricTriangle& t);
[[nodiscard]] Sign dual_crossing_sign(const MetricTriangle& t);
[[nodiscard]] Sign dual_length_sign(const MetricTriangle& left, const MetricTriangle& right);
[[nodiscard]] bool is_well_centered(const MetricTriangle& t);
[[nodiscard]] double doubled_area(const MetricTriangle& t);
[[nodiscard]] double dual_crossing(const MetricTriangle& t);
[[nodiscard]] double signed_height(const MetricTriangle& t);
[[nodiscard]] double dual_over_length(const MetricTriangle& left, const MetricTriangle& right);

// --- the mesh -----------------------------------------------------------------------------------------------------

/// Arrays that make a mesh, as MeshInput. SurfaceMesh::build reads the spans only during the call.
struct SurfaceInput {
  std::span<const Vec3> points = {};     ///< Points of space, n of them
  std::span<const double> weights = {};  ///< Weights of the points [length²]; empty: all zero
  /// Corners of the m triangles, 0-based, in either orientation.
  std::span<const std::array<std::int32_t, 3>> triangles = {};
  std::span<const std::array<std::int32_t, 2>> constrained_edges = {};  ///< Edges that must never flip, 0-based
  std::span<const std::int32_t> regions = {};         ///< Region numbers of the triangles; empty: all zero
  std::span<const std::int32_t> fixed_vertices = {};  ///< Vertices that must never move, 0-based
  const InputNames* names = nullptr;                  ///< Numbering of the user, for errors
};

/// A mesh of a surface. Halfedges, flags and regions are those of a Mesh (temper/mesh.hpp), without its geometry.
class SurfaceMesh {
 public:
  SurfaceMesh() = default;

  /// Builds a mesh and checks it. Triangles of one component get one orientation; the fewest are reversed, and counted.
  /// Edges between different regions become constrained. Weights need not be regular. O(n log n).
  ///
  /// The checks are:
  ///   - finite coordinates of exact range, indices in range, no unused point, no triangle of zero area
  ///   - at most two triangles per edge, one fan per vertex, an orientation
  ///
  /// The surface may touch or cross itself: nothing looks for this. Points at one place are counted.
  [[nodiscard]] static Expected<struct BuiltSurface> build(const SurfaceInput& input);

  /// Halfedges, corners, stars, flags, regions and weights. Its positions have no meaning.
  [[nodiscard]] const Mesh& connectivity() const { return mesh_; }

  [[nodiscard]] std::size_t n_vertices() const { return mesh_.n_vertices(); }
  [[nodiscard]] std::size_t n_triangles() const { return mesh_.n_triangles(); }
  [[nodiscard]] IdRange<VertexId> vertices() const { return mesh_.vertices(); }
  [[nodiscard]] IdRange<TriangleId> triangles() const { return mesh_.triangles(); }
  [[nodiscard]] IdRange<HalfedgeId> halfedges() const { return mesh_.halfedges(); }

  [[nodiscard]] std::array<VertexId, 3> corners(TriangleId t) const { return mesh_.corners(t); }
  [[nodiscard]] std::int32_t region(TriangleId t) const { return mesh_.region(t); }
  [[nodiscard]] Vec3 position(VertexId v) const { return {mesh_.point(v).x, mesh_.point(v).y, z_[v]}; }
  [[nodiscard]] double weight(VertexId v) const { return mesh_.point(v).w; }
  [[nodiscard]] WeightedPoint point(VertexId v) const {
    const auto [x, y, w] = mesh_.point(v);
    return {x, y, z_[v], w};
  }
  [[nodiscard]] std::array<WeightedPoint, 3> points(TriangleId t) const {
    const auto [a, b, c] = mesh_.corners(t);
    return {point(a), point(b), point(c)};
  }
  /// The caller keeps triangles from becoming flat.
  void set_position(VertexId v, Vec3 p) { mesh_.set_point(v, {p.x, p.y, weight(v)}), z_[v] = p.z; }
  void set_weight(VertexId v, double w) { mesh_.set_point(v, {mesh_.point(v).x, mesh_.point(v).y, w}); }

  void set_fixed(VertexId v, bool fixed) { mesh_.set_fixed(v, fixed); }
  void set_constrained(HalfedgeId h, bool constrained) { mesh_.set_constrained(h, constrained); }

  /// Checks that no triangle is flat (exact), and that twins, stars and flags fit. Returns the first fault, or nothing.
  [[nodiscard]] std::optional<std::string> validate() const;

  friend bool operator==(const SurfaceMesh&, const SurfaceMesh&) = default;

 private:
  friend class SurfaceBuilder;
  friend class SurfaceEditor;

  Mesh mesh_;
  IdVector<VertexId, double> z_;
};

/// The result of SurfaceMesh::build, with its repairs.
struct BuiltSurface {
  SurfaceMesh mesh;
  std::size_t reversed_triangles = 0;  ///< Number of triangles whose orientation did not fit
  std::size_t components = 0;          ///< Number of connected components
  std::size_t coincident_points = 0;   ///< Number of points at the place of another point
};

// --- quality --------------------------------------------------------------------------------------------------------

/// The report on a surface. No triangle of a surface is inverted. Energies and SolverMeasures are not measured: they
/// keep the values that they have without a mesh. `at` of a place is x and y, and `z` the third coordinate.
struct Quality : temper::Quality {};
[[nodiscard]] const ReportTable& table_of(const Quality*);
/// The rows of temper::quality_measures() that are measured on surfaces.
[[nodiscard]] std::span<const QualityMeasure> quality_measures();

/// Measures a mesh. O(n).
[[nodiscard]] Quality quality(const SurfaceMesh& mesh, std::size_t worst = 5);
/// Quality of one triangle. Precondition: it is not flat.
[[nodiscard]] TriangleQuality triangle_quality(const std::array<WeightedPoint, 3>& corners);
[[nodiscard]] inline TriangleQuality triangle_quality(const SurfaceMesh& mesh, TriangleId t) {
  return triangle_quality(mesh.points(t));
}
/// As those of the plane (temper/detail/criterion.hpp). O(n).
[[nodiscard]] std::vector<ViolatedEdge> violated_edges(const SurfaceMesh& mesh, Criterion criterion);
[[nodiscard]] std::vector<TriangleId> cells_at_violations(const SurfaceMesh& mesh, Criterion criterion);
[[nodiscard]] bool meets(const SurfaceMesh& mesh, Criterion criterion);

// --- weights --------------------------------------------------------------------------------------------------------

/// The margin of the mesh's own weights, in doubles, as temper::weight_margin.
[[nodiscard]] double weight_margin(const SurfaceMesh& mesh, Constraints constraints = Constraints::well_centered,
                                   std::span<const HalfedgeId> edges = {});
/// Σ over edges |Δw_i − Δw_j| / (2ℓ).
[[nodiscard]] double weight_change(const SurfaceMesh& mesh, const IdVector<VertexId, double>& from,
                                   const IdVector<VertexId, double>& to);

/// Finds weights for a mesh with fixed positions and connectivity, as temper::find_weights. The same exact signs and
/// certificates decide. A curved surface has no weights that make all duals zero, so dual lengths cannot be stretched:
/// the best margin of `regular` may have any sign. Error also: WeightGoal::accuracy.
[[nodiscard]] Expected<WeightReport> find_weights(const SurfaceMesh& mesh, LpSolver& solver,
                                                  const WeightOptions& options = {}, ConvexSolver* convex = nullptr);

/// Verifies a certificate in exact arithmetic, from the positions alone. Heights and crossings have the polynomials of
/// the plane (temper/feasibility.hpp). With N_r and N_s of the heights over pq in pqr and qps, a dual length has
///
///   dual    N = N_r T + N_s S = 2 (h_r + h_s) ℓ S T,   M = 2 ℓ² S T
///
/// S and T have square roots. The checker adds the largest effect of their rounding.
[[nodiscard]] CertificateCheck check_certificate(const SurfaceMesh& mesh, const Certificate& certificate);

// --- explanations and pictures --------------------------------------------------------------------------------------

/// Why triangles are bad, and what weights alone can do.
struct Explanation {
  std::size_t triangles = 0, bad = 0;
  Feasibility verdict = Feasibility::undecided;  ///< Weights for the whole mesh, with its positions and triangles
  std::size_t changed = 0;                       ///< Number of weights that change, if the verdict is feasible
  double margin = 0;                             ///< Best margin, or a bound of it, as in WeightReport
  Certificate certificate;                       ///< Proof that there are no weights; or no terms
  std::vector<WorstTriangle> worst;              ///< The worst triangles with their reasons, bad ones alone
};
[[nodiscard]] const ReportTable& table_of(const Explanation*);
/// Explains at most `most` bad triangles. `whole`: as in WeightOptions.
[[nodiscard]] Expected<Explanation> explain(const SurfaceMesh& mesh, LpSolver& solver, std::size_t most,
                                            std::size_t whole = WeightOptions().whole);
/// As temper::explain_duals.
[[nodiscard]] DualExplanation explain_duals(const SurfaceMesh& mesh, Criterion criterion, std::size_t most);

/// Draws the triangles that are in view, from the direction `view` of the options, by default from −60°, 30°. Each is
/// colored by its margin, and bad ones are hatched. A triangle is in view if no other one hides its centroid. Only the
/// options `primal`, `fill`, `view`, `zoom`, `width` and `title` apply. O(n log n) for usual surfaces.
[[nodiscard]] std::string draw_svg(const SurfaceMesh& mesh, const DrawOptions& options = {});
/// Draws two surfaces next to each other.
[[nodiscard]] std::string draw_before_after_svg(const SurfaceMesh& before, const SurfaceMesh& after,
                                                const DrawOptions& options = {});

// --- operators ------------------------------------------------------------------------------------------------------

/// Computes the operators of a surface (temper/dec.hpp). `sphere_orthocenters` and `sphere_midpoints` have the centers
/// in space: each orthocenter in the plane of its triangle, and the weighted midpoints of edges. Areas and dual areas
/// are those of the plane triangles. Precondition: fewer than 2³¹ edges. O(n).
[[nodiscard]] DecComplex dec_operators(const SurfaceMesh& mesh);
/// As those of triangles (temper/dec.hpp).
[[nodiscard]] inline Expected<DecComplex> with_coefficient(const SurfaceMesh& mesh, DecComplex complex,
                                                           std::span<const double> coefficient,
                                                           const InputNames* names = nullptr) {
  return temper::with_coefficient(mesh.connectivity(), std::move(complex), coefficient, names);
}
[[nodiscard]] DecSummary summarize(const SurfaceMesh& mesh, const DecComplex& complex);
/// The dual cells of the vertices. A cell has a quadrilateral in each of its triangles, from the vertex over midpoints
/// of edges to the orthocenter, in `sphere_corners`. Areas are signed, and those of cells are ★0. There are no faces.
[[nodiscard]] PowerCells dual_cells(const SurfaceMesh& mesh, const DecComplex& complex);

// --- places ---------------------------------------------------------------------------------------------------------

/// The place of the surface that is closest to each point. O(log n) for a point near the surface.
[[nodiscard]] std::vector<Place> closest_places(const SurfaceMesh& mesh, std::span<const Vec3> points);

// --- intrinsic triangulations -----------------------------------------------------------------------------------

/// A triangulation of a fixed surface. Its edges are shortest lines within two triangles, known by their lengths: no
/// file of points and triangles holds them. Flips change the triangulation, and the surface stays. An edge has two
/// different ends, and no two edges have the same ends.
///
/// Lengths of new edges are rounded. Signs and certificates are exact for the squared lengths as they are stored.
class IntrinsicMesh {
 public:
  IntrinsicMesh() = default;
  /// The triangulation of the mesh itself, with its weights.
  explicit IntrinsicMesh(const SurfaceMesh& mesh);

  /// Halfedges, corners, stars, flags, regions and weights. Its positions have no meaning.
  [[nodiscard]] const Mesh& connectivity() const { return mesh_; }
  /// ℓ² of the edge of h.
  [[nodiscard]] double squared_length(HalfedgeId h) const { return squared_lengths_[h]; }
  [[nodiscard]] double weight(VertexId v) const { return mesh_.weight(v); }
  void set_weight(VertexId v, double w) { mesh_.set_weight(v, w); }
  /// The triangle of h, as pqr with h = pq.
  [[nodiscard]] MetricTriangle triangle(HalfedgeId h) const;

  /// Flips an edge. Returns false, and changes nothing, if it is on the boundary or constrained, if its ends or those
  /// of the new edge would have two edges or none, or if the two triangles do not unfold to a convex quadrilateral.
  bool flip(HalfedgeId h);

 private:
  Mesh mesh_;
  IdVector<HalfedgeId, double> squared_lengths_;
};

/// Numbers of flip_to_regular.
struct IntrinsicFlips {
  std::size_t flips = 0;
  std::size_t blocked = 0;  ///< Edges whose dual lengths stay negative, because they cannot flip
};
/// Flips edges with negative dual lengths, as Lawson, until none is left that can flip. With zero weights the result is
/// an intrinsic Delaunay triangulation if no edge is blocked.
IntrinsicFlips flip_to_regular(IntrinsicMesh& mesh);

[[nodiscard]] double weight_margin(const IntrinsicMesh& mesh, Constraints constraints = Constraints::well_centered);
/// Number of triangles that do not satisfy the constraints, exactly. O(n).
[[nodiscard]] std::size_t n_bad_triangles(const IntrinsicMesh& mesh,
                                          Constraints constraints = Constraints::well_centered);
/// As those of meshes.
[[nodiscard]] Expected<WeightReport> find_weights(const IntrinsicMesh& mesh, LpSolver& solver,
                                                  const WeightOptions& options = {}, ConvexSolver* convex = nullptr);
[[nodiscard]] CertificateCheck check_certificate(const IntrinsicMesh& mesh, const Certificate& certificate);
/// The operators. They have no places: no midpoints and orthocenters.
[[nodiscard]] DecComplex dec_operators(const IntrinsicMesh& mesh);

struct IntrinsicWeights {
  WeightReport report;         ///< of the last triangulation
  IntrinsicFlips flips;        ///< of all rounds; `blocked` of the last one
  std::size_t bad_before = 0;  ///< n_bad_triangles before the first flip
  std::size_t bad_after = 0;   ///< and with the weights of the report
  std::size_t rounds = 0;      ///< Triangulations that were tried up to this one
};
/// Finds weights for a triangulation. If triangles stay bad, it flips the triangulation to the regular one of zero
/// weights, or with `from_input` of the weights of the mesh, and finds weights again. Then it flips to the regular
/// triangulation of these weights, and so on, while the number of bad triangles falls. The mesh gets the best
/// triangulation and its weights. Errors: those of find_weights.
[[nodiscard]] Expected<IntrinsicWeights> find_intrinsic_weights(IntrinsicMesh& mesh, LpSolver& solver,
                                                                const WeightOptions& options = {},
                                                                ConvexSolver* convex = nullptr);

// --- optimization ---------------------------------------------------------------------------------------------------

/// The mesh to keep if the run ends now.
struct BestSoFar {
  const SurfaceMesh& mesh;
  const IdVector<VertexId, VertexId>& vertices;  ///< Numbers of the vertices, as in SurfaceReport::vertices
};

/// Squared errors of a scheme on a mesh, each of another norm; empty if there are none.
using SquaredErrors = std::function<std::vector<double>(const SurfaceMesh& mesh, Scheme scheme)>;

struct SurfaceOptions {
  /// Condition on the mesh. A run for another criterion also tries well_centered, because its coefficients are larger.
  /// Once a mesh meets it that did not before, up to 16 rounds lower the accuracy energy of `scheme`.
  Criterion criterion = Criterion::well_centered;
  Scheme scheme = Scheme::all;  ///< Scheme whose errors are lowered
  double margin = 0.01;         ///< Margin t of the final weights, in (0, 1/2)
  /// Largest distance from each point of the input to the result, and back, as a part of the diagonal of the bounding
  /// box. It also holds between lines. 0 is taken as 1e-12, for rounding: vertices move in planes alone.
  double surface_distance = 0.005;
  /// Creases are edges whose triangles turn by more than this angle, from 1° to 180°. No vertex leaves a crease. New
  /// vertices may split its edges. A thin triangle that two such edges fold out of the surface has none.
  double crease_angle_deg = 70;
  bool may_flip = true;    ///< Allow flips of edges in space
  bool may_insert = true;  ///< Allow edges to be split and collapsed next to bad triangles
  bool may_move = true;    ///< Allow vertices to move. Else only weights change
  /// Allow vertices of lines to slide along the line of the input. A line is a piece of the boundary, of a crease or of
  /// constrained edges. Its ends, and vertices where it bends by more than 40°, stay. If false, all vertices stay.
  bool may_slide = false;
  /// Repairs end after this number of edits in a row that do not help. Usually fewer than one edit of 20 helps.
  int repair_trials = 600;
  /// Squared errors of a scheme (temper/solvers.hpp). Up to 20,000 vertices they choose among meshes that meet the
  /// criterion: the largest ratio to the input's shall be the least. Otherwise the mean energy of a triangle chooses.
  SquaredErrors squared_errors = {};
  double time_limit = 0;                       ///< Time limit of the run [s]; 0: none
  std::function<bool()> must_stop = {};        ///< If it says yes, the run ends with the best mesh so far
  Observer observer = {};                      ///< Observer of the progress after each round, which may stop the run
  BestListenerOf<BestSoFar> best_so_far = {};  ///< Listener that may get the best mesh so far, after each round
  /// Start of the time limit, as in temper::OptimizeHooks. Absent: the time of the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};
/// The options of a surface among those of all meshes. Errors: options that are out of range, or contradict each other.
[[nodiscard]] Expected<SurfaceOptions> surface_options(const OptimizeOptions& options);

/// The angles by which a surface turns at its edges, between the normals of neighbors.
struct Turns {
  std::size_t sharp = 0;   ///< Number of edges that turn more than SurfaceOptions::crease_angle_deg
  double largest_deg = 0;  ///< Largest angle [degrees]
};

/// The objective is the energy at the least γ. A sweep is a round that moves all vertices.
struct SurfaceReport : RunReport {
  Quality before, after;
  std::size_t violations_before = 0, violations_after = 0;  ///< Numbers of violations of the criterion
  /// Upper bound of the distance between input and result, from each point of one to the other [length]
  double surface_distance = 0;
  double diagonal = 0;      ///< Diagonal of the bounding box of the input [length]
  std::size_t repairs = 0;  ///< Number of edits next to bad triangles
  std::size_t crease_edges = 0;
  Turns turns_before, turns_after;
  /// Number in the input of each vertex, invalid for inserted ones. Empty: the numbers are the same.
  IdVector<VertexId, VertexId> vertices;
};
[[nodiscard]] const ReportTable& table_of(const SurfaceReport*);

/// Improves a mesh in place until it meets the criterion, and then its margins. A mesh that meets it already stays.
/// Vertices move in their tangent planes and come back to the input surface. Edges flip in space, and weights follow by
/// linear programs. Vertices on the boundary, on constrained edges and on creases stay, or slide along them with
/// may_slide. Fixed vertices stay. Errors: an option out of range.
[[nodiscard]] Expected<SurfaceReport> optimize(SurfaceMesh& mesh, LpSolver& solver, const SurfaceOptions& options = {});

}  // namespace temper::surfaces
