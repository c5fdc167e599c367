// The improvement of one vertex: the body of the paper's inner loop (lines 10 to 16 of Algorithm 1).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/step/descent.hpp"
#include "optimize/step/dofs.hpp"
#include "optimize/step/star_objective.hpp"
#include "optimize/step/vertex_limits.hpp"
#include "optimize/step/vertex_removal.hpp"

namespace temper {

/// The storage of vertex steps, kept from one vertex to the next: once warm, a step allocates nothing.
class VertexStep : StepContext {
 public:
  VertexStep(const StepContext& context, Flipper& flipper)
      : StepContext(context),
        flipper_(flipper),
        guard_(limits.guard),
        removal_(*this, flipper, guard_),
        star_(make_star_objective(mesh, settings, state)) {}
  VertexStep(const VertexStep&) = delete;  // the removal refers to its guard
  VertexStep& operator=(const VertexStep&) = delete;
  ~VertexStep() = default;

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

  void optimize_point(VertexId v);
  void make_steps();
  [[nodiscard]] Dofs freedom_in(Unknowns unknowns) const {
    if (edge_ != nullptr) return dofs(edge_->direction(), unknowns);
    return dofs(mesh, vertex_, limits.mobility[vertex_], unknowns);
  }

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
  VertexRemoval removal_;
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
