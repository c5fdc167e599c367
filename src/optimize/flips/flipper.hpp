// Flips, and other changes that make edges regular. The flipper prices and traces them, and can undo all flips of a
// step. It treats hidden vertices by the user's policy.
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

class Guard;
class SizeBand;

class Flipper {
 public:
  Flipper(Mesh& mesh, const Settings& settings, const SweepState& state, const Recorder& recorder)
      : mesh_(mesh), settings_(settings), state_(state), recorder_(recorder) {}

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] const SweepState& state() const { return state_; }
  [[nodiscard]] const Recorder& recorder() const { return recorder_; }

  /// A step of v from `origin`. v has moved already.
  struct Step {
    VertexId v;
    WeightedPoint origin;
    double before = 0, after = 0;  ///< energy of v's patch
    bool must_pay = false;         ///< the energy must fall, flips included
    SizeBand* band = nullptr;      ///< of local sizes; flips must not leave it
    Guard* guard = nullptr;        ///< flips must stay within it
    Part part = {};                ///< to which v and the flips are confined
  };
  /// The step is undone, too, if flips do not pay, hide a vertex against the policy, or would leave the part.
  enum class Settled { done, undone, escaped };
  /// Makes the edges around a step's vertex regular. If the result is `done`, v is still confined to the part.
  Settled settle(const Step& step);

  /// Line 20 of Algorithm 1. Returns false if a vertex is hidden against the policy. If the policy removes hidden
  /// vertices, this is a vertex that cannot be removed; otherwise all flips are undone.
  bool restore_all();

  /// Removes the plan's vertex. The caller treats the edges of the triangles that fill its place.
  void remove(EventKind kind, const RemovalPlan& plan, double before, double after);

  /// Replaces the edge of h by the other diagonal. The caller decides whether the flip is allowed.
  void flip(HalfedgeId h, double before, double after);
  /// Insert a vertex in a triangle or on an edge, number it and record it. The caller treats the edges around it.
  VertexId insert(WorkingCopy& work, TriangleId t, const WeightedPoint& p, double before, double after);
  VertexId split(WorkingCopy& work, HalfedgeId h, const WeightedPoint& p, double before, double after);
  /// Inserts the vertex of a plan and makes the plan's flips.
  VertexId commit(WorkingCopy& work, const InsertionPlan& plan, double before, double after);

  /// The changes since the last call of take_changes().
  struct Changes {
    std::size_t flips = 0, removed = 0;
  };
  Changes take_changes() { return std::exchange(changes_, {}); }
  /// Adds the changes of another flipper on the same mesh.
  void add(const Changes& more) {
    changes_.flips += more.flips;
    changes_.removed += more.removed;
  }
  [[nodiscard]] const Changes& changes() const { return changes_; }
  /// From now on, appends the halfedges that steps flip to the log, in order; null ends that.
  void log_flips(std::vector<HalfedgeId>* log) { log_ = log; }
  /// Repeats the flips that another flipper logged on an equal mesh.
  void repeat(std::span<const HalfedgeId> flips);
  [[nodiscard]] bool has_removed() const { return changes_.removed > 0; }

 private:
  LawsonRun run(std::optional<double>& change, std::size_t max_flips, SizeBand* band = nullptr, Guard* guard = nullptr,
                const Part& part = {});
  void push_irregular();
  bool accept_hidden();
  void treat_hidden();
  [[nodiscard]] std::vector<VertexId> hidden_at_stuck_edges();

  Mesh& mesh_;
  const Settings& settings_;
  const SweepState& state_;
  const Recorder& recorder_;
  Lawson lawson_;
  std::vector<FlipRecord> records_;  // of the present run, if traced
  RemovalPlan plan_;
  Changes changes_;
  std::vector<HalfedgeId>* log_ = nullptr;
};

}  // namespace temper
