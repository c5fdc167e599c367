// Explanations for tetrahedra: for each one that is not well-centered, its heights over its faces, and what may help.
//
// Triangles have smallest conflicts with certificates (temper/explain.hpp). For tetrahedra the certificate is of the
// whole mesh. A vertex inside may move. If all corners are on the boundary, only weights, flips and new vertices help.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "temper/explain.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/weights.hpp"

namespace temper::tets {

/// The height of the orthocenter of a tetrahedron over one of its faces.
struct FaceHeight {
  std::array<VertexId, 3> vertices;
  bool boundary = false;
  bool at_interface = false;  ///< The face is on an interface between tensors
  double h = 0;               ///< Height, positive inside [length]; not finite if the tetrahedron is flat
  double h_over_l = 0;        ///< Height over the side of the equilateral triangle with the area of the face
  bool outside = false;       ///< h ≤ 0, exact
  bool crossed = false;       ///< The orthocenter of the face is strictly inside it, exact
};

[[nodiscard]] const ReportTable& table_of(const FaceHeight*);

/// A change that may make tetrahedra well-centered. It is not tried.
enum class Cure {
  weights,         ///< find_weights(): weights of the whole mesh exist
  optimize,        ///< optimize(), in which vertices inside may move
  split_boundary,  ///< optimize() with new vertices on the boundary
  slide,           ///< optimize() with vertices that slide on the boundary and on interfaces between tensors
};
[[nodiscard]] std::string_view name(Cure cure);
[[nodiscard]] std::span<const std::string_view> words_of(Cure);

/// A tetrahedron that is not well-centered.
struct Reason : WorstTet {
  Vec3 orthocenter;  ///< Not finite if the tetrahedron is flat
  std::array<FaceHeight, 4> faces;
  bool all_on_boundary = false;  ///< All corners are on the boundary, or on interfaces between tensors
  Cure cure = Cure::optimize;
};

struct ExplainOptions {
  std::size_t reasons = static_cast<std::size_t>(-1);  ///< Largest number of reasons, the worst
  /// Size limit of the search for weights of the whole mesh: at most this many tetrahedra, or this many bad ones.
  std::size_t whole = 1000;
};

struct Explanation {
  Quality quality;  ///< Quality of the whole mesh, without its list of the worst tetrahedra
  std::size_t bad = 0;
  std::size_t all_on_boundary = 0;      ///< Number of bad tetrahedra with all corners on the boundary
  bool has_interfaces = false;          ///< Tensors differ
  std::optional<WeightReport> weights;  ///< Weights of the whole mesh, or the proof that none exist, if searched for
  std::vector<Reason> reasons;          ///< Reasons, worst first

  /// Verdict on the whole mesh with its positions and connectivity; undecided if no weights were searched for.
  [[nodiscard]] Feasibility verdict() const { return weights ? weights->verdict : Feasibility::undecided; }
  /// The change that may cure a bad tetrahedron.
  [[nodiscard]] Cure cure(bool all_corners_on_boundary) const;
};

/// An explanation with its mesh, for the front ends.
struct ExplanationReport {
  const TetMesh& mesh;
  const Explanation& explanation;
};
[[nodiscard]] const ReportTable& table_of(const ExplanationReport*);

/// Explains each tetrahedron that is not well-centered. Signs rest on exact predicates, and a verdict on
/// check_certificate(). It fails as find_weights() does. O(n), and a linear program of the whole mesh.
[[nodiscard]] Expected<Explanation> explain(const TetMesh& mesh, LpSolver& solver, const ExplainOptions& options = {});
/// The same in the spaces of several tensors: weights must keep the equations of interfaces. Numbers and places are
/// those of `pieces.mesh`.
[[nodiscard]] Expected<Explanation> explain(const MetricMesh& pieces, LpSolver& solver,
                                            const ExplainOptions& options = {});

/// Explains the worst violations of a criterion of duals, at most `most`. For a negative coefficient it names the
/// face with the largest part. Precondition: the criterion is not well_centered. O(n).
[[nodiscard]] DualExplanation explain_duals(const TetMesh& mesh, Criterion criterion, std::size_t most,
                                            Executor* executor = nullptr);

}  // namespace temper::tets
