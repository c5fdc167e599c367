// The steps of a run. Lengths are in units of the run, so that no product of lengths overflows or becomes 0.
//
//   rounds    descend, project, take back what is too far, flip; γ falls from round to round
//   weights   a linear program for all weights
//   repairs   copies of a few rings around bad triangles: descend again, flip, split or collapse an edge (repair.cpp)
//
// Two starts compete: moves alone, with weights at the end; and moves with weights. At first the surface must not turn
// more at its edges than a limit. As long as bad triangles are left, all begins again, with a wider limit and without.
// If none is left, rounds lower the accuracy energy of the scheme (polish.cpp). If weights alone suffice, the mesh with
// the least change of weights is polished too. If vertices slide, the whole run is repeated with these vertices held.
// The run returns the result with the least errors of the scheme, relative to the input; without measured errors, that
// with the least energy.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "surfaces/optimize/draft_energy.hpp"
#include "surfaces/optimize/nearness.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// A mesh of a run with its counts.
struct State {
  SurfaceMesh mesh;
  const Lines* lines = nullptr;
  IdVector<VertexId, Track> tracks;
  IdVector<VertexId, VertexId> origins;  ///< Numbers of vertices in the input
  Edges creases;                         ///< Ascending
  std::size_t bad = 0;                   ///< Number of cells at violations
  std::size_t repairs = 0;               ///< Number of edits
  double gain = 0;                       ///< Part of the accuracy energy by which the last round lowered it
  std::optional<double> cost = {};       ///< Run::cost_of() it, if known
};

[[nodiscard]] Turns turns_of(const SurfaceMesh& mesh, double sharp_deg);

/// A mesh in another unit of length.
[[nodiscard]] SurfaceMesh scaled(SurfaceMesh mesh, double factor);

inline constexpr double kLastGamma = 0.01;  // of the last rounds
/// The energy of a mesh.
[[nodiscard]] double energy_of(const SurfaceMesh& mesh, double gamma);
/// A draft of the whole mesh.
[[nodiscard]] Draft draft_of(const SurfaceMesh& mesh, const IdVector<VertexId, Track>& tracks, const Lines* lines,
                             bool with_weights);
/// A draft of the whole mesh, in which only weights change.
[[nodiscard]] Draft weights_of(const SurfaceMesh& mesh);

inline constexpr int kRounds = 16, kSteps = 30;
// Linear programs are for the last bad triangles: around many of them their regions meet, and cost minutes.
inline constexpr std::size_t kFewForPrograms = 100;

struct Run {
  const SurfaceOptions& options;
  const Nearness& nearness;
  LpSolver& solver;
  SurfaceReport& report;
  double unit = 1;                           ///< The user's length of one unit, a power of two
  const SurfaceMesh* judged = nullptr;       ///< The input, if measured errors decide
  std::vector<double> errors_of_input = {};  ///< Empty: not measured
  TurnLimit limit = {};
  std::size_t trials = 0;           ///< Number of edits since the last one that helped
  std::optional<State> shown = {};  ///< For the listener, if there is one
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

  /// The mesh of a state as the user has it: in the user's units, and creases are not constrained.
  [[nodiscard]] SurfaceMesh result(const State& state) const;
  /// A position with 0 for coordinates so small that files refuse them.
  [[nodiscard]] Vec3 without_tiny(Vec3 p) const;
  /// Asks the clock and the caller. Once the answer is yes, it stays, and the report has the reason.
  [[nodiscard]] bool must_stop() const;
  /// Puts a mesh into the history, and shows the progress.
  void record(SweepRecord measured) const;
  /// Shows the best mesh so far to the listener. It is `found`, unless this has more bad cells than one before.
  void offer(const State& found);
  [[nodiscard]] double seconds() const;
  /// The vertices of triangles and of lines that are too far from those of the input. Ascending.
  [[nodiscard]] std::vector<VertexId> too_far(const State& state, Nearness::Known& known) const;
  [[nodiscard]] std::size_t bad(const SurfaceMesh& mesh) const {
    return cells_at_violations(mesh, options.criterion).size();
  }

  /// The best of starts whose vertices slide along lines, if they may, and of starts whose vertices stay there.
  [[nodiscard]] State best_of_tracks(State input, State weighted, TurnLimit first);
  /// The better of two results: with fewer bad cells; if there are none, by cost_of().
  [[nodiscard]] State better(State best, State other);
  /// The largest ratio of an error to the input's; without errors, the mean energy of a triangle.
  [[nodiscard]] double cost_of(const State& state);
  /// The best of runs with wider and wider limits, and of moves where weights alone suffice; all polished.
  [[nodiscard]] State best_of_starts(const State& input, const State& weighted, TurnLimit first);
  /// If measured errors decide, the input with the least change of weights; otherwise, and if that fails, the other.
  [[nodiscard]] State with_least_change(const State& input, State otherwise) const;
  /// The best of runs with wider and wider limits, or `best` if it is better.
  [[nodiscard]] State best_of_limits(const State& input, State best, TurnLimit first);
  /// The better of two starts, or `best` if it is better.
  [[nodiscard]] State moved(const State& input, State best);
  /// Rounds that move all vertices, with or without their weights.
  void move_all(State& state, bool with_weights);
  /// Weights by descents, and for few bad cells by a linear program, if they leave fewer bad cells.
  void find_weights(State& state) const;
  /// Gives the mesh of a state the points of a draft, whose vertices go back to their first places until all is near
  /// the input. False if that is not enough.
  [[nodiscard]] bool take(State& state, Draft& draft, const IdVector<VertexId, WeightedPoint>& first,
                          Nearness::Known& known) const;
  /// Rounds that lower the accuracy energy of a mesh without bad cells, as long as none becomes bad. The mesh stays as
  /// it is if its measured errors are smaller.
  [[nodiscard]] State polished(State state);
  /// One of these rounds, with its gain; nothing if it fails, or if a margin is less than the least one.
  [[nodiscard]] std::optional<State> lowered(const State& state, const AccuracyModel& model, int steps,
                                             double least_margin, Nearness::Known& known) const;
  /// The mesh with weights by a linear program for a margin; nothing if that fails.
  [[nodiscard]] std::optional<SurfaceMesh> with_margin(SurfaceMesh mesh, WeightGoal goal, double margin) const;
  void take_if_better(State& state, SurfaceMesh changed) const;
  [[nodiscard]] bool may_try() const { return trials < static_cast<std::size_t>(options.repair_trials); }
  /// Edits next to bad triangles, as long as one helps; then weights.
  void repair(State& state);
};

}  // namespace temper::surfaces
