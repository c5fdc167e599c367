// The improvement of one vertex: the body of the paper's inner loop (lines 10 to 16 of Algorithm 1).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/flips/size_band.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/step/descent.hpp"
#include "optimize/step/dofs.hpp"
#include "optimize/step/star_objective.hpp"
#include "optimize/trace/recorder.hpp"
#include "optimize/working/working_copy.hpp"
#include "optimize/working/working_units.hpp"

namespace temper {

/// The limits of each vertex: mobility, size band and guard, shared by all that make steps on one mesh.
struct VertexLimits {
  VertexLimits(const WorkingCopy& work, const Settings& settings, const WorkingUnits& units)
      : mobility(mobilities(work.mesh, settings.options, settings.executor())),
        degree(work.mesh.n_vertices(), 0),
        band(work.mesh, units, settings.size_field, settings.options.size_band),
        guard(work.mesh, units, settings.guard, settings.in_copy),
        work_(work),
        mesh_(work.mesh),
        options_(settings.options) {
    if (work.divided.empty()) return;
    for (const VertexId v : mesh_.vertices()) mobility[v] = mobility_of(v, mobility[v]);
  }

  IdVector<VertexId, Mobility> mobility;
  IdVector<VertexId, std::uint8_t> degree;  ///< number of triangles when a batch last took the vertex; 0: never
  SizeBand band;                            ///< keeps its last query, so with a band only one step runs at a time
  Guard guard;                              ///< of which each step has a copy

  /// Fixes the position and weight of v.
  void freeze(VertexId v) { mobility[v] = Mobility::frozen; }
  /// Follows a compaction of the mesh.
  void renumber(const Compaction& kept) {
    mobility = kept_of(mobility, kept.vertices);
    degree.resize(mobility.size());
    band.renumber(kept);
    guard.renumber(kept);
  }
  /// Follows insertions and splits: new vertices are the last vertices of the mesh.
  void grow() {
    for (std::size_t i = mobility.size(); i < mesh_.n_vertices(); ++i) {
      mobility.push_back(mobility_of(VertexId(i), temper::mobility(mesh_, VertexId(i), options_)));
    }
    degree.resize(mobility.size());
    band.grow();
    guard.grow();
  }

  /// Returns the divided edge along which v slides, if v is a vertex of the run.
  [[nodiscard]] const DividedEdge* divided_edge(VertexId v) const {
    return mobility[v] == Mobility::sliding ? work_.divided_edge(v) : nullptr;
  }

 private:
  /// The run's own vertices on lines slide, whatever the options say about the vertices of the input.
  [[nodiscard]] Mobility mobility_of(VertexId v, Mobility of_input) const {
    return work_.divided_edge(v) != nullptr ? Mobility::sliding : of_input;
  }

  const WorkingCopy& work_;
  const Mesh& mesh_;
  const OptimizeOptions& options_;
};

/// The mesh and the settings that all steps on one working copy share.
struct StepContext {
  Mesh& mesh;
  const Settings& settings;
  const SweepState& state;
  const WorkingUnits& units;
  VertexLimits& limits;
  const Recorder& recorder;
};

/// The storage of vertex steps, kept from one vertex to the next: once warm, a step allocates nothing.
class VertexStep : StepContext {
 public:
  VertexStep(const StepContext& context, Flipper& flipper)
      : StepContext(context),
        flipper_(flipper),
        guard_(limits.guard),
        star_(make_star_objective(mesh, settings, state)) {}

  /// Prepares for a sweep, or for one of two visits: sets whether i ≥ i_c, and the overshoot of FlipLimit::after.
  void begin_sweep(int sweep, Unknowns unknowns);

  /// Collapses v, or moves it so that the energy falls, and flips edges that must flip. Then removes v if its patch is
  /// better without it. If nothing helps, all stays as it was. Returns false if v or its flips are not confined to the
  /// part: then v needs a larger part, or another one.
  bool improve(VertexId v, const Part& part = {});

  /// If v is free, no triangle turns over and no vertex is hidden, moves v by `by`, even if the energy rises.
  void nudge(VertexId v, Vec2 by);

  /// Nudges every vertex at random, by up to `amount` of its shortest edge on each axis.
  void shake(double amount, Rng& rng);

  /// Applies the deferred updates of all vertices.
  void end_sweep();

  [[nodiscard]] Unknowns unknowns() const { return unknowns_; }
  /// Says whether batches make the same steps.
  [[nodiscard]] bool suits_batches() const;
  [[nodiscard]] bool makes_newton_steps() const;
  [[nodiscard]] Guard& guard() { return guard_; }
  /// Says whether a vertex has a new place or weight since begin_sweep().
  [[nodiscard]] bool has_moved() const { return has_moved_; }

 private:
  enum class StepResult { accepted, not_lower, inverted, out_of_band, blocked_by_flip, escaped };

  bool collapse(VertexId v);
  void optimize_point(VertexId v);
  void remove_if_better(VertexId v);
  void make_steps();
  [[nodiscard]] Dofs freedom_in(Unknowns unknowns) const {
    if (edge_ != nullptr) return dofs(edge_->direction(), unknowns);
    return dofs(mesh, vertex_, limits.mobility[vertex_], unknowns);
  }
  [[nodiscard]] bool may_go(VertexId v) const { return limits.mobility[v] == Mobility::free; }

  void newton_search(const Dofs& of);
  void golden_search(const Dofs& dofs);
  bool gather(VertexId v);
  bool enter_domain();

  [[nodiscard]] double farthest(const Step& step) const;
  [[nodiscard]] double flip_limited(const Step& step, double t) const;
  [[nodiscard]] double short_of_flip(const Step& step, double t) const;
  [[nodiscard]] WeightedPoint moved(const Step& step, double t) const;
  StepResult try_step(const Step& step, double t);
  [[nodiscard]] bool keeps_size(const WeightedPoint& p);
  bool place(const WeightedPoint& p, double energy, bool must_pay);
  [[nodiscard]] bool keeps_connectivity() const;
  void note_regular_edges();

  Flipper& flipper_;
  Guard guard_;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  bool collapses_ = false, removes_ = false, has_moved_ = false;
  double overshoot_ = 1;

  VertexId vertex_;
  Part part_;                          // to which the step is confined
  bool escapes_ = false;               // whether edges that the step must flip are outside the part
  WeightedPoint origin_;               // the vertex's present place
  const DividedEdge* edge_ = nullptr;  // along which it slides, if it is a vertex of the run
  double energy_ = 0;                  // of the patch at origin_
  std::unique_ptr<StarObjective> star_;
  Patch collapsing_;  // gathered for E_c
  RemovalPlan plan_;
  std::vector<HalfedgeId> regular_;  // edges of star and link that a step must keep regular
  /// An update that waits for the end of the sweep. During the step of v, v is at its new place.
  struct Deferred {
    VertexId v;
    WeightedPoint from, to;
    double before = 0, after = 0;
  };
  std::optional<Deferred> waiting_;  // of the present vertex
  std::vector<Deferred> deferred_;
};

}  // namespace temper
