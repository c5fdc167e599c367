// A local copy on which the search for fewer vertices removes and inserts vertices. Sweeps make its triangles
// well-centered again, or soon find that this is hopeless. A move may return to an earlier state.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/repair/trial.hpp"

namespace temper {

class SearchCopy {
 public:
  SearchCopy(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, bool with_events);

  [[nodiscard]] const Mesh& mesh() const { return copy_.mesh(); }
  [[nodiscard]] bool may_be_removed(VertexId v) const { return copy_.may_be_removed(v); }

  // These changes leave all edges regular, except on the rim. False: the change is impossible, and the copy is of no
  // more use until it returns to an earlier state.

  bool remove(VertexId v) { return copy_.remove(v) && copy_.make_regular(); }
  /// Inserts a vertex at a random place in or at the triangle, or on one of its edges.
  bool insert_near(TriangleId t, Rng& rng);

  /// Sweeps until no triangle is bad, or until more sweeps are hopeless. If little is left, a linear program finds
  /// weights. Returns what is left.
  LocalDefect improve();
  [[nodiscard]] bool is_valid() const { return copy_.is_regular(); }

  using State = LocalCopy::State;
  [[nodiscard]] State state() const { return copy_.state(); }
  void return_to(const State& state) { copy_.return_to(state); }
  [[nodiscard]] std::vector<TraceEvent> take_events() { return copy_.take_events(); }

 private:
  LocalDefect sweep();
  bool assign_weights();
  [[nodiscard]] bool may_split_line(HalfedgeId h) const;
  bool insert_by_rule(TriangleId t, InsertionPlace rule);
  bool insert(TriangleId t, const WeightedPoint& place) { return copy_.insert(t, place) && copy_.make_regular(); }
  bool split(HalfedgeId h, double part);

  const Settings& settings_;
  LocalCopy copy_;
  double violation_before_;
};

}  // namespace temper
