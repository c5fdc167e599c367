// Flips, and what else regularity asks for, as the optimizer wants them: priced, traced, undone whole, and with hidden
// vertices treated by the user's policy.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "optimize/flips/partition.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/trace/recorder.hpp"
#include "regularity/lawson.hpp"

namespace temper {

class SizeBand;

class Flipper {
 public:
  Flipper(Mesh& mesh, const Settings& settings, const SweepState& state, const Recorder& recorder)
      : mesh_(mesh), settings_(settings), state_(state), recorder_(recorder) {}

  /// A step of v from `origin`, already made.
  struct Step {
    VertexId v;
    WeightedPoint origin;
    double before = 0, after = 0;  ///< energy of v's patch
    bool must_pay = false;         ///< with what the flips change, the energy must fall
    SizeBand* band = nullptr;      ///< of local sizes, which flips must not leave
    Part part = {};                ///< that v is confined to, and flips too
  };
  /// Undone is the step too: because flips do not pay, hide a vertex that may not be, or would escape from the part.
  enum class Settled { done, undone, escaped };
  /// Makes the edges around a step's vertex regular. When it is done, v is still confined to the part.
  Settled settle(const Step& step);

  /// Line 20 of Algorithm 1. False when a vertex is hidden that may not be: where hidden vertices are removed, one that
  /// cannot be; else all is undone.
  bool restore_all();

  /// Removes the plan's vertex. The edges of what fills its place are left to the caller.
  void remove(EventKind kind, const RemovalPlan& plan, double before, double after);

  /// Replaces the edge of h by the other diagonal; whether that is a good idea is the caller's to know.
  void flip(HalfedgeId h, double before, double after);
  /// A new vertex in a triangle, or on an edge: named and told. The edges around it are left to the caller.
  VertexId insert(WorkingCopy& work, TriangleId t, const WeightedPoint& p, double before, double after);
  VertexId split(WorkingCopy& work, HalfedgeId h, const WeightedPoint& p, double before, double after);
  /// The vertex of a plan, with the plan's flips.
  VertexId commit(WorkingCopy& work, const InsertionPlan& plan, double before, double after);

  /// Since the last call of this.
  struct Changes {
    std::size_t flips = 0, removed = 0, inserted = 0;
  };
  Changes take_changes() { return std::exchange(changes_, {}); }
  /// Adds the changes of another flipper on the same mesh.
  void add(const Changes& more) {
    changes_.flips += more.flips;
    changes_.removed += more.removed;
    changes_.inserted += more.inserted;
  }
  [[nodiscard]] const Changes& changes() const { return changes_; }
  /// Appends to the log, from here on, the halfedges that steps flip, in order; null: no longer.
  void log_flips(std::vector<HalfedgeId>* log) { log_ = log; }
  /// Does again what another flipper logged, on a mesh as that one was.
  void repeat(std::span<const HalfedgeId> flips);
  [[nodiscard]] bool has_removed() const { return changes_.removed > 0; }

 private:
  LawsonRun run(std::optional<double>& change, std::size_t max_flips, SizeBand* band = nullptr, const Part& part = {});
  void push_irregular();
  bool accept_hidden();
  void treat_hidden();
  [[nodiscard]] std::vector<VertexId> hidden_at_stuck_edges();

  Mesh& mesh_;
  const Settings& settings_;
  const SweepState& state_;
  const Recorder& recorder_;
  Lawson lawson_;
  std::vector<FlipRecord> records_;  // of the run under way, when traced
  RemovalPlan plan_;
  Changes changes_;
  std::vector<HalfedgeId>* log_ = nullptr;
};

}  // namespace temper
