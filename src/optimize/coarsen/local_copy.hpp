// A copy of a neighborhood on which a search removes and inserts vertices. Sweeps of E_BP with a shrinking γ make its
// triangles well-centered again, or soon find that this is hopeless. A search may return to an earlier state.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/step/vertex_step.hpp"

namespace temper {

/// Says whether v is neither fixed nor a vertex of the input on a line. plan_removal says whether it can be removed.
[[nodiscard]] bool may_be_removed(const WorkingCopy& work, VertexId v);

class LocalCopy {
 public:
  /// `settings`: by settings_of_search(). `grid`: the whole mesh's, for positions. With events, take_events() returns
  /// what splice() needs.
  LocalCopy(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, bool with_events);
  LocalCopy(const LocalCopy&) = delete;
  LocalCopy& operator=(const LocalCopy&) = delete;
  ~LocalCopy() = default;

  [[nodiscard]] const Mesh& mesh() const { return work_.mesh; }
  [[nodiscard]] bool may_be_removed(VertexId v) const {
    return limits_.mobility[v] != Mobility::frozen && temper::may_be_removed(work_, v);
  }

  // These changes leave all edges regular, except on the rim. False: the change is impossible, and the copy is of no
  // more use until it returns to an earlier state.

  bool remove(VertexId v);
  /// Inserts a vertex at a random place in or at the triangle, or on one of its edges.
  bool insert_near(TriangleId t, Rng& rng);

  /// Sweeps until no triangle is bad, or until more sweeps are hopeless. If little is left, a linear program finds
  /// weights. Returns what is left.
  LocalDefect improve();
  /// Says exactly whether all edges are regular, on the rim too.
  [[nodiscard]] bool is_valid() const;

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
  LocalDefect sweep();
  bool assign_weights();
  [[nodiscard]] bool may_split_line(HalfedgeId h) const;
  bool insert_by_rule(TriangleId t, InsertionPlace rule);
  bool insert(TriangleId t, const WeightedPoint& place);
  bool split(HalfedgeId h, double part);
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
  double violation_before_;
};

/// Returns the settings of sweeps in a local copy: Newton steps on E_BP with the unknowns and constraints of the run.
[[nodiscard]] Settings settings_of_search(const Settings& settings);

}  // namespace temper
