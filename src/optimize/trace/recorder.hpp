// A recorder turns what happens in the working copy into the events of a trace, in the user's numbers and units.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "optimize/working/working_copy.hpp"
#include "temper/detail/trace.hpp"
#include "temper/topology.hpp"

namespace temper {

/// The energy of an event that has none.
inline constexpr double kNoEnergy = std::numeric_limits<double>::quiet_NaN();

/// One flip, in the numbers of the working copy: halfedge a→b became d→c.
struct FlipRecord {
  VertexId a, b, c, d;
  double before = 0, after = 0;
};

class Recorder {
 public:
  /// `energy_unit`: the user's energy of one unit in the units.
  Recorder(const Tracer& tracer, const WorkingCopy& work, double energy_unit)
      : tracer_(tracer), work_(work), energy_unit_(energy_unit) {}

  void set_energy_unit(double energy_unit) { energy_unit_ = energy_unit; }
  /// Says whether anybody listens: if not, nothing else need be called.
  [[nodiscard]] bool on() const { return static_cast<bool>(tracer_); }
  void begin_sweep(int sweep) { sweep_ = sweep; }
  [[nodiscard]] int sweep() const { return sweep_; }

  void placed(VertexId v, const WeightedPoint& from, const WeightedPoint& to, double before, double after) const;
  void flipped(std::span<const FlipRecord> flips) const;
  void removed(EventKind kind, const RemovalPlan& plan, double before, double after) const;
  /// insert_in_triangle(mesh, abc) has made v, and WorkingCopy::name_new() has named it.
  void inserted(VertexId v, const std::array<VertexId, 3>& triangle, double before, double after) const;
  /// split_edge(mesh, a→b) has made v, named as above. c, d: the corners on the left and the right of a→b before, d
  /// invalid on the boundary.
  void split(VertexId v, const std::array<VertexId, 4>& quad, double before, double after) const;
  void hidden(VertexId v) const {
    record({.kind = EventKind::hidden, .vertex = v, .before = kNoEnergy, .after = kNoEnergy});
  }
  void undone(VertexId v, double before, double after) const {
    record({.kind = EventKind::undo, .vertex = v, .before = before, .after = after});
  }
  /// Everything since the end of that sweep has been taken back; −1: since the input.
  void returned_to(int sweep) const {
    record({.kind = EventKind::undo, .before = kNoEnergy, .after = kNoEnergy, .to_sweep = sweep});
  }

 private:
  /// `event`: with vertices in the numbers of the working copy, energies in the units of the units, and no sweep.
  void record(TraceEvent event) const;
  [[nodiscard]] WeightedPoint place(VertexId v) const { return work_.units.to_user(work_.mesh.point(v)); }

  const Tracer& tracer_;
  const WorkingCopy& work_;
  double energy_unit_;
  int sweep_ = 0;
};

}  // namespace temper
