// Explanations: for each triangle that is not well-centered, the reason and a cure.
//
// A reason is one of two things. Either it is a smallest set of triangles for which no common weights exist, with a
// certificate (temper/feasibility.hpp). Or weights exist, and only have to be found. A conflict is explained in
// lengths: each triangle allows its dual to cross an edge only in an interval. For some edge the intervals of its two
// sides do not meet (docs/explanation/proofs.md has the formulas). Each cure is tried on a copy of the neighborhood. It
// is verified only if the weights found there make every triangle of the copy well-centered, by the exact predicate.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/criterion.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/detail/vec.hpp"
#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Kinds of reasons why triangles are not well-centered. For edge, fan, patch and interface, a certificate proves that
/// no weights suit all triangles of the conflict. If any one triangle is taken away, some weights suit the rest.
enum class ReasonKind {
  split,         ///< A permanent edge must be split: no inner vertices, weights or connectivity help (necessity.hpp)
  edge,          ///< The triangles on the two sides of an edge need its dual to cross it at different places
  fan,           ///< Three or more triangles around one vertex have such a conflict
  patch,         ///< Any other set of triangles, for example closed around a vertex
  at_interface,  ///< Triangles on both sides of an interface between tensors, whose crossings cannot be equal
  weights,       ///< Weights exist for these triangles and their neighbors, but have not been found yet
  undecided      ///< Neither weights nor a certificate were found
};
[[nodiscard]] std::string_view name(ReasonKind kind);
[[nodiscard]] std::span<const std::string_view> words_of(ReasonKind);

/// One side of the edge of a conflict: the interval in which well-centered triangles let the dual cross the edge.
struct CrossingSide {
  std::vector<TriangleId> triangles;  ///< Triangles of this side; the first one has the edge
  double from = 0, to = 0;  ///< Ends of the interval, as distances from the edge's first vertex, exclusive [length]
  VertexId widest;          ///< Vertex of the largest angle of these triangles
  double angle_deg = 0;     ///< Largest angle of these triangles
};
[[nodiscard]] const ReportTable& table_of(const CrossingSide*);

/// An edge whose two sides have disjoint intervals: left.to ≤ right.from or right.to ≤ left.from.
struct CrossingConflict {
  VertexId p, q;
  double length = 0;
  CrossingSide left, right;  ///< Left and right side of p → q
};
[[nodiscard]] const ReportTable& table_of(const CrossingConflict*);

/// The common corner of the triangles of a fan.
struct FanCenter {
  VertexId vertex;
  bool on_boundary = false;
  double angle_deg = 0;        ///< Angle of the domain at a boundary vertex; else 360
  VertexId shortest, longest;  ///< Other ends of the shortest and the longest edge of the fan at the vertex
  double shortest_length = 0, longest_length = 0;
};
[[nodiscard]] const ReportTable& table_of(const FanCenter*);

/// A change that would cure a reason.
struct Cure {
  enum class Action {
    find_weights,     ///< find_weights(), without other changes
    optimize,         ///< optimize(), in which vertices may move
    move_vertex,      ///< Move `vertex` to `at`
    flip_edge,        ///< Flip `edge` to the other diagonal of its two triangles
    insert_vertex,    ///< Insert a vertex at `at`, inside `triangle`
    split_edge,       ///< Split the interior `edge` at `at`
    split_boundary,   ///< Split the boundary `edge` at `at`
    split_interface,  ///< Split the `edge` of an interface between tensors at `at`, on both sides
  };
  Action action = Action::optimize;
  std::vector<VertexId> edge;  ///< Two vertices, or none
  VertexId vertex;
  TriangleId triangle;
  Vec2 at;  ///< Position; on the sphere longitude and latitude [degrees]
  /// A trial on a copy succeeded: the `triangles` of the neighborhood then have weights that make them well-centered,
  /// checked exactly.
  bool verified = false;
  /// Only the triangles of the conflict and those that the change touches were tested. No change was found that suits
  /// the whole neighborhood.
  bool conflict_only = false;
  std::size_t triangles = 0;
  bool ends_conflict = false;  ///< For a split: neither half of the edge must be split again, checked exactly
  /// Number of bad triangles in the neighborhood that belong to other conflicts and were not tested.
  std::size_t left_out = 0;
  /// Best margin of h/ℓ and d/ℓ after the cure; find_weights for the whole mesh: Explanation::margin.
  double margin = 0;
  std::size_t changed = 0;  ///< For find_weights on the whole mesh: number of nonzero weights around the bad triangles
};
[[nodiscard]] std::string_view name(Cure::Action action);
[[nodiscard]] std::span<const std::string_view> words_of(Cure::Action);

struct Reason {
  ReasonKind kind = ReasonKind::undecided;
  std::vector<TriangleId> bad;  ///< Triangles that are not well-centered for this reason, worst first
  std::vector<TriangleId>
      conflict;  ///< For edge, fan, patch: smallest set of triangles for which no weights exist; `bad` is a part of it
  std::optional<EdgeConflict> must_split;  ///< Conflict of the edge, for split
  /// The edge that must be split is on an interface between tensors, or a corner of the conflict is
  bool at_interface = false;
  Certificate certificate;  ///< Proof for edge, fan, patch, interface; check_certificate accepts it
  /// Best margin. For edge, fan, patch: margin of the conflict, at most 0. For weights: margin of the neighborhood,
  /// above 0.
  double margin = 0;
  bool each = false;  ///< For weights, undecided: `margin` is the least over bad triangles, each with the triangles
                      ///< that touch it
  std::size_t checked = 0;                   ///< Number of triangles that `margin` is for
  std::optional<CrossingConflict> crossing;  ///< Crossings, for edge, fan, and patches without closed rings
  std::optional<FanCenter> center;           ///< Common vertex of all triangles, for edge, fan, patch, if there is one
  std::vector<VertexId> free;   ///< Corners of the conflict that may move (for weights: corners of the bad triangles)
  double least_margin = 0;      ///< Least h/ℓ or d/ℓ of the bad triangles as they are
  Vec2 at;                      ///< Centroid of the worst triangle; on the sphere longitude and latitude [degrees]
  bool cures_searched = false;  ///< Cures were searched for; else `cures` has only those that need no search
  std::vector<Cure> cures;      ///< Cures, best first
};

struct ExplainOptions {
  std::size_t cures = 20;  ///< Largest number of reasons, the worst, for which cures are searched
  /// Size limit of the search for weights of the whole mesh: at most this many triangles, or this many bad ones. Above
  /// it, reasons of the kind `weights` hold only for their neighborhood.
  std::size_t whole = 1000;
  /// Progress function, called now and then with the number of explained bad triangles. Continue::no stops, with an
  /// error.
  std::function<Continue(std::size_t done, std::size_t all)> progress = {};
};

struct Explanation {
  std::size_t triangles = 0, bad = 0;
  /// Verdict on the whole mesh with its positions and connectivity. Feasible if no triangle is bad.
  Feasibility verdict = Feasibility::undecided;
  std::size_t changed = 0;      ///< For feasible: number of nonzero weights in the result of find_weights
  double margin = 0;            ///< Requested margin of these weights: 0.01, or half of the best margin if that is less
  std::vector<Reason> reasons;  ///< Reasons: certified ones first, by least margin; then by least_margin
};

/// Explains each triangle that is not well-centered by exactly one reason. Verdicts rest on exact predicates and on
/// check_certificate. If there are several smallest conflicts, the solver may decide which one is named. Preconditions:
/// no erased triangles, all counter-clockwise. Errors: stopped by progress, a periodic plane. About 1 ms per bad
/// triangle, and some 10 ms more per reason whose cures are searched.
///
///     const auto why = explain(mesh, *clp_solver());
///     for (const Reason& reason : why->reasons) puts(reason_text(mesh, reason).c_str());
[[nodiscard]] Expected<Explanation> explain(const Mesh& mesh, LpSolver& solver, const ExplainOptions& options = {});
/// The same in the planes of several tensors: weights must keep the equations of interfaces. Numbers and places are
/// those of `pieces.mesh`.
[[nodiscard]] Expected<Explanation> explain(const MetricMesh& pieces, LpSolver& solver,
                                            const ExplainOptions& options = {});

/// A reason in words, with the user's numbers: what is bad and where, and why.
struct ReasonWords {
  std::string what, why;
};
[[nodiscard]] ReasonWords reason_words(const Mesh& mesh, const Reason& reason, const InputNames* names = nullptr);
/// Both in one text, in several sentences with the user's numbers. If `names` is null, numbers count from 0.
[[nodiscard]] std::string reason_text(const Mesh& mesh, const Reason& reason, const InputNames* names = nullptr);
/// A cure in words, in one sentence.
[[nodiscard]] std::string cure_text(const Mesh& mesh, const Cure& cure, const InputNames* names = nullptr);

/// A dual that a criterion does not allow, with the reason.
struct DualReason {
  std::vector<VertexId> vertices;  ///< Vertices of its edge or face
  DualKind kind = DualKind::inside;
  double over_l = 0;  ///< Signed length of the dual over ℓ of the edge or face; signed area of the dual over ℓ²
  Vec3 at;            ///< Centroid of the edge or face, with z = 0 in the plane; on a sphere [degrees]
  std::string why;    ///< "h/ℓ = -0.31 on the side of vertex 7, where the angle is 120.1°"
};
[[nodiscard]] const ReportTable& table_of(const DualReason*);

/// The violations of a criterion of duals.
struct DualExplanation {
  Criterion criterion = Criterion::coefficients;
  std::size_t violations = 0;       ///< Number of duals that the criterion does not allow
  std::vector<DualReason> reasons;  ///< Reasons, worst first
};
[[nodiscard]] const ReportTable& table_of(const DualExplanation*);

/// Explains the worst violations of a criterion, at most `most`: heights, angles across, and if the weights are the
/// cause. Preconditions: the criterion is not well_centered, all triangles are counter-clockwise. O(n).
[[nodiscard]] DualExplanation explain_duals(const Mesh& mesh, Criterion criterion, std::size_t most,
                                            Executor* executor = nullptr);

/// An explanation as a report: with the mesh and the names for its sentences.
struct ExplanationReport {
  const Mesh& mesh;
  const Explanation& explanation;
  const InputNames* names = nullptr;
};
[[nodiscard]] const ReportTable& table_of(const ExplanationReport*);

}  // namespace temper
