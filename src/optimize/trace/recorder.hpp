// A recorder turns what happens in the working copy into the events of a trace, in the user's numbers and units.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "optimize/working/working_copy.hpp"
#include "temper/detail/trace.hpp"
#include "temper/topology.hpp"

namespace temper {

/// The energy of events that have no energy.
inline constexpr double kNoEnergy = std::numeric_limits<double>::quiet_NaN();

/// One flip, in the numbers of the working copy: halfedge a→b became d→c.
struct FlipRecord {
  VertexId a, b, c, d;
  double before = 0, after = 0;
};

class Recorder {
 public:
  /// `energy_unit`: one unit of energy here, in the user's units.
  Recorder(const Tracer& tracer, const WorkingCopy& work, double energy_unit)
      : tracer_(tracer), work_(work), energy_unit_(energy_unit) {}

  void set_energy_unit(double energy_unit) { energy_unit_ = energy_unit; }
  /// Says whether there is a tracer. If not, other calls may be left out.
  [[nodiscard]] bool on() const { return static_cast<bool>(tracer_); }
  void begin_sweep(int sweep) { sweep_ = sweep; }
  [[nodiscard]] int sweep() const { return sweep_; }

  void placed(VertexId v, const WeightedPoint& from, const WeightedPoint& to, double before, double after) const;
  void flipped(std::span<const FlipRecord> flips) const;
  void removed(EventKind kind, const RemovalPlan& plan, double before, double after) const;
  /// Call this after insert_in_triangle has made v, and WorkingCopy::name_new() has numbered it.
  void inserted(VertexId v, const std::array<VertexId, 3>& triangle, double before, double after) const;
  /// Call this after split_edge of a→b has made v, numbered as above. c and d: the former corners on the left and right
  /// of a→b. On the boundary d is invalid.
  void split(VertexId v, const std::array<VertexId, 4>& quad, double before, double after) const;
  void hidden(VertexId v) const {
    record({.kind = EventKind::hidden, .vertex = v, .before = kNoEnergy, .after = kNoEnergy});
  }
  void undone(VertexId v, double before, double after) const {
    record({.kind = EventKind::undo, .vertex = v, .before = before, .after = after});
  }
  /// Records that everything since the end of this sweep was undone; −1: since the input.
  void returned_to(int sweep) const {
    record({.kind = EventKind::undo, .before = kNoEnergy, .after = kNoEnergy, .to_sweep = sweep});
  }

 private:
  /// `event` has the vertex numbers and energy units of the working copy, and no sweep.
  void record(TraceEvent event) const;
  [[nodiscard]] WeightedPoint place(VertexId v) const { return work_.units.to_user(work_.mesh.point(v)); }

  const Tracer& tracer_;
  const WorkingCopy& work_;
  double energy_unit_;
  int sweep_ = 0;
};

}  // namespace temper
