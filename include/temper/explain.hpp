// Explanations: for every triangle that is not well-centered, the reason and what would cure it.
//
// A reason is a smallest set of triangles that no weights suit all at once, with its certificate
// (temper/feasibility.hpp), or that weights do exist and only have to be found. What forces a conflict is said in
// lengths: each triangle lets its dual cross each of its edges in an interval only, and somewhere the intervals of the
// two sides of an edge do not meet (docs/explain.md has the formulae). A cure is tried on a copy of the neighborhood
// and called verified only when the weights that the program finds there make its every triangle well-centered, by
// the exact predicate.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/vec.hpp"
#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Kinds of reasons why triangles are not well-centered. For edge, fan and patch no weights suit all triangles of the
/// conflict at once, as certified, while some suit all that are left when any one of them is taken away.
enum class ReasonKind {
  split,     ///< an edge that stays has to be split: no vertices inside, weights or connectivity help (necessity.hpp)
  edge,      ///< the triangles on the two sides of an edge need its dual to cross it at different places
  fan,       ///< the same, three or more triangles around one vertex
  patch,     ///< any other set of triangles: closed around a vertex, say
  weights,   ///< weights exist for these triangles and those around them; they have not been found yet
  undecided  ///< no weights were found, and no certificate
};
[[nodiscard]] std::string_view name(ReasonKind kind);

/// One side of the edge in a conflict: where its triangles let the dual cross, if they are to be well-centered.
struct CrossingSide {
  std::vector<TriangleId> triangles;  ///< the first has the edge
  double from = 0, to = 0;            ///< distances from the edge's first vertex, exclusive [length]
  VertexId widest;                    ///< where the largest angle of these triangles is,
  double angle_deg = 0;               ///< and that angle
};

/// An edge whose sides cannot agree: left.to ≤ right.from or right.to ≤ left.from.
struct CrossingConflict {
  VertexId p, q;
  double length = 0;
  CrossingSide left, right;  ///< of p → q
};

/// The corner that the triangles of a fan go around.
struct FanCenter {
  VertexId vertex;
  bool on_boundary = false;
  double angle_deg = 0;        ///< of the domain there, when on the boundary; else 360
  VertexId shortest, longest;  ///< other ends of the shortest and the longest edge of the fan at the vertex
  double shortest_length = 0, longest_length = 0;
};

/// A change that would cure a reason.
struct Cure {
  enum class Action {
    find_weights,    ///< find_weights(); the rest as it is
    optimize,        ///< optimize(): vertices are free to move
    move_vertex,     ///< `vertex` to `at`
    flip_edge,       ///< `edge`, for the other diagonal of its two triangles
    insert_vertex,   ///< at `at`, inside `triangle`
    split_edge,      ///< interior `edge`, at `at`
    split_boundary,  ///< boundary `edge`, at `at`
  };
  Action action = Action::optimize;
  std::vector<VertexId> edge;  ///< two, or none
  VertexId vertex;
  TriangleId triangle;
  Vec2 at;  ///< on the sphere longitude and latitude [degrees]
  /// Tried: the `triangles` of the neighborhood then have weights that make them well-centered, exactly checked.
  bool verified = false;
  /// Only the triangles of the conflict, and those that the change touches, were asked to be well-centered: no change
  /// was found that suits all of the neighborhood.
  bool conflict_only = false;
  std::size_t triangles = 0;
  bool ends_conflict = false;  ///< split: neither half of the edge must be split again, exactly checked
  std::size_t left_out = 0;    ///< bad triangles of the neighborhood that belong to other conflicts, and were not asked
  double margin = 0;  ///< their best margin then, h/ℓ and d/ℓ; find_weights for the whole mesh: Explanation::margin
  std::size_t changed = 0;  ///< find_weights for the whole mesh: weights not zero around the bad triangles
};
[[nodiscard]] std::string_view name(Cure::Action action);

struct Reason {
  ReasonKind kind = ReasonKind::undecided;
  std::vector<TriangleId> bad;       ///< triangles not well-centered for this reason, worst first
  std::vector<TriangleId> conflict;  ///< edge, fan, patch: the smallest set that no weights suit; `bad` are of these
  std::optional<EdgeConflict> must_split;  ///< split
  Certificate certificate;                 ///< edge, fan, patch: the proof; check_certificate accepts it
  /// edge, fan, patch: best margin of the conflict, at most 0. weights: of the neighborhood, above 0.
  double margin = 0;
  bool each = false;        ///< weights, undecided: `margin` is the least of each bad triangle with those that touch it
  std::size_t checked = 0;  ///< triangles that `margin` is of
  std::optional<CrossingConflict> crossing;  ///< edge, fan, and patches without closed rings
  std::optional<FanCenter> center;           ///< edge, fan, patch, when a vertex is common to all
  std::vector<VertexId> free;                ///< corners of the conflict (weights: of the bad) that may move
  double least_margin = 0;                   ///< least h/ℓ or d/ℓ of the bad triangles as they are
  Vec2 at;                                   ///< centroid of the worst of them; on the sphere as for cures
  bool cures_searched = false;               ///< else `cures` has only what needs no search
  std::vector<Cure> cures;                   ///< best first
};

struct ExplainOptions {
  std::size_t cures = 20;  ///< cures are searched for so many reasons, the worst
  /// Weights are asked of the whole mesh when it has at most so many triangles, or so many bad ones; else reasons of
  /// the kind `weights` speak for their neighborhood alone.
  std::size_t whole = 1000;
  /// Called now and then with how many of the bad triangles are explained; Continue::no stops, with an error.
  std::function<Continue(std::size_t done, std::size_t all)> progress = {};
};

struct Explanation {
  std::size_t triangles = 0, bad = 0;
  /// The verdict on the whole mesh, positions and connectivity as they are. Feasible when nothing is bad.
  Feasibility verdict = Feasibility::undecided;
  std::size_t changed = 0;      ///< feasible: weights that differ from zero in the answer of find_weights,
  double margin = 0;            ///< and the margin it was asked for: 0.01, or half of the best when that is less
  std::vector<Reason> reasons;  ///< certified ones first, least margin first; then by least_margin
};

/// Explains each triangle that is not well-centered, by exactly one reason. Verdicts rest on exact predicates and on
/// check_certificate; which of several smallest conflicts is named may depend on the solver. Precondition: no erased
/// triangles, all counter-clockwise. Errors: stopped by progress, a periodic plane. About a millisecond a bad triangle,
/// and some ten more a reason whose cures are searched.
///
///     const auto why = explain(mesh, *clp_solver());
///     for (const Reason& reason : why->reasons) puts(reason_text(mesh, reason).c_str());
[[nodiscard]] Expected<Explanation> explain(const Mesh& mesh, LpSolver& solver, const ExplainOptions& options = {});

/// A reason in words, some sentences, with the user's numbers. `names` may be null: counted from 0.
[[nodiscard]] std::string reason_text(const Mesh& mesh, const Reason& reason, const InputNames* names = nullptr);
/// A cure in words, a sentence.
[[nodiscard]] std::string cure_text(const Mesh& mesh, const Cure& cure, const InputNames* names = nullptr);

}  // namespace temper
