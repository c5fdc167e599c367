// A copy of a neighborhood that a search changes: vertices inserted, removed and moved, weights by a linear program.
//
// The rim is frozen. With events, splice() (neighborhood.hpp) applies the changes to the whole mesh. Changes of
// vertices may leave edges that are not regular; make_regular() flips them.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "feasibility/region.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/step/vertex_step.hpp"

namespace temper {

/// Says whether v is neither fixed nor a vertex of the input on a line. plan_removal says whether it can be removed.
/// `is_own`: the run itself has put it on its line.
[[nodiscard]] bool may_be_removed(const Mesh& mesh, VertexId v, bool is_own);
[[nodiscard]] inline bool may_be_removed(const WorkingCopy& work, VertexId v) {
  return may_be_removed(work.mesh, v, work.divided_edge(v) != nullptr);
}
/// The same for a neighborhood's mesh and numbers, in which a vertex of the rim is frozen.
[[nodiscard]] inline bool may_be_removed(const Mesh& mesh, const std::vector<std::uint8_t>& frozen,
                                         const DividedEdges& divided, VertexId v) {
  return frozen[v.index] == 0 && may_be_removed(mesh, v, divided.contains(v));
}

/// The time that sweeps of a copy may take.
enum class Pace {
  quick,    ///< Fewer sweeps, and an early end if an edit is unlikely to help
  thorough  ///< All sweeps
};

class LocalCopy {
 public:
  /// `settings`: by settings_of_copies(). `grid`: the whole mesh's, for positions.
  LocalCopy(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, bool with_events);
  LocalCopy(const LocalCopy&) = delete;
  LocalCopy& operator=(const LocalCopy&) = delete;
  ~LocalCopy() = default;

  [[nodiscard]] const Mesh& mesh() const { return work_.mesh; }
  [[nodiscard]] bool is_frozen(VertexId v) const { return limits_.mobility[v] == Mobility::frozen; }
  [[nodiscard]] bool may_be_removed(VertexId v) const { return !is_frozen(v) && temper::may_be_removed(work_, v); }
  [[nodiscard]] bool is_rim(HalfedgeId h) const { return around_.is_rim(mesh().origin(h), mesh().target(h)); }

  // These changes return false if they are impossible.

  /// Inserts a vertex with the weight that the corners have there.
  bool insert(TriangleId t, const WeightedPoint& place);
  /// Splits an edge on both of its sides: a line at the part of the way, another edge at its midpoint.
  bool split(HalfedgeId h, double part);
  bool remove(VertexId v);
  bool make_regular() { return flipper_.restore_all(); }
  /// Gives the vertices of the mask the weights that lack least of a margin. Rim vertices keep theirs.
  bool assign_weights(VertexMask free, double margin);

  void set_weight(VertexId v, double w);
  /// Moves all free vertices at random (VertexStep::shake).
  void shake(double amount, Rng& rng) { step_.shake(amount, rng); }

  /// Sweeps of E_BP with a shrinking γ, until `ends`(sweep, γ of the next sweep) says so, or γ has been at its floor
  /// for a few sweeps. γ shrinks faster at a quick pace.
  template <class Ends>
  void sweep(Pace pace, const Ends& ends);
  /// Says whether the last sweep has moved a vertex.
  [[nodiscard]] bool has_moved() const { return step_.has_moved(); }

  /// Says exactly whether all edges are regular, on the rim too.
  [[nodiscard]] bool is_regular() const;

  struct State {
    WorkingCopy work;
    IdVector<VertexId, Mobility> mobility;
    std::size_t events = 0;
  };
  [[nodiscard]] State state() const { return {work_, limits_.mobility, events_.size()}; }
  void return_to(const State& state);

  /// Returns all changes since the beginning, in local numbers; new vertices last.
  [[nodiscard]] std::vector<TraceEvent> take_events() { return std::move(events_); }

 private:
  // γ/ℓ of the first sweep, its factor from sweep to sweep, and its least value; and enough sweeps for all of them.
  // With a guard, whose sweeps are slow, those at the floor change little.
  static constexpr double kFirstGamma = 0.5, kGammaFactor = 0.7, kQuickGammaFactor = 0.5, kLeastGamma = 0.003;
  static constexpr int kMostSweeps = 25, kMostGuardedSweeps = 18, kMostQuickSweeps = 11;

  [[nodiscard]] WeightedPoint place_on_line(HalfedgeId h, double part) const;

  const Neighborhood& around_;
  const Settings& settings_;
  const WorkingUnits& grid_;
  std::vector<TraceEvent> events_;
  Tracer tracer_;
  WorkingCopy work_;
  SweepState state_;
  Recorder recorder_;
  Flipper flipper_;
  VertexLimits limits_;
  VertexStep step_;
};

/// Returns the settings of sweeps in local copies: Newton steps on E_BP by temper's default method, with the unknowns
/// and constraints of the run.
[[nodiscard]] Settings settings_of_copies(const Settings& settings);

template <class Ends>
void LocalCopy::sweep(Pace pace, const Ends& ends) {
  const bool quick = pace == Pace::quick;
  double gamma = kFirstGamma;
  const int most = quick ? kMostQuickSweeps : settings_.guard == nullptr ? kMostSweeps : kMostGuardedSweeps;
  for (int i = 0; i < most; ++i) {
    state_.model.gamma = {gamma, LengthScale::relative};
    step_.begin_sweep(i, settings_.options.unknowns);
    for (const VertexId v : work_.mesh.vertices()) {
      if (!is_frozen(v) && !work_.mesh.is_isolated(v)) step_.improve(v);
    }
    gamma = std::max(kLeastGamma, (quick ? kQuickGammaFactor : kGammaFactor) * gamma);
    if (ends(i, gamma)) return;
  }
}

}  // namespace temper
