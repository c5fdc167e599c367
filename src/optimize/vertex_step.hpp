// One vertex, improved: the body of the paper's inner loop (lines 10 to 16 of Algorithm 1).
#pragma once

#include <cstdint>
#include <vector>

#include "base/rng.hpp"
#include "energy/patch.hpp"
#include "optimize/flipper.hpp"
#include "optimize/freedom.hpp"
#include "optimize/newton.hpp"
#include "optimize/settings.hpp"
#include "optimize/size_band.hpp"

namespace temper {

/// The storage of vertex steps, kept from one vertex to the next: once warm, a step allocates nothing.
class VertexStep {
 public:
  VertexStep(Mesh& mesh, const Settings& settings, const Frame& frame, Flipper& flipper, const Recorder& recorder)
      : mesh_(mesh),
        settings_(settings),
        frame_(frame),
        flipper_(flipper),
        recorder_(recorder),
        band_(mesh, frame, settings.size_field, settings.options.size_band),
        mobility_(mobilities(mesh, settings.options)) {}

  /// Of the sweep under way: i ≥ i_w, i ≥ i_c, and the overshoot of FlipLimit::after.
  void begin_sweep(int sweep);

  /// Collapses v; or moves it so that the energy falls, flips what must flip, and removes it if its patch is better
  /// without it; or leaves everything as it was.
  void improve(VertexId v);

  /// Moves v to p if it is free, no triangle turns over and no vertex is hidden, whatever that costs.
  void nudge(VertexId v, Vec2 p);

  /// Nudges every vertex, at random, by up to `amount` of its shortest edge on each axis.
  void shake(double amount, Rng& rng);

  /// With deferred weight updates: gives all vertices their new weights.
  void end_sweep();

  /// The mesh has been compacted.
  void renumber(const Compaction& kept);

  /// v stays, weight and all.
  void freeze(VertexId v) { mobility_[v] = Mobility::frozen; }

  /// Vertices have been inserted, or edges split: new vertices are the last ones of the mesh.
  void grow();

 private:
  enum class Outcome { accepted, not_lower, inverted, out_of_band, blocked_by_flip };

  bool collapse(VertexId v);
  void optimize_point(VertexId v);
  void remove_if_better(VertexId v);
  [[nodiscard]] bool may_go(VertexId v) const { return mobility_[v] == Mobility::free; }

  void newton_search(const Freedom& freedom);
  void golden_search(const Freedom& freedom);
  void gather(VertexId v);
  bool enter_domain();

  [[nodiscard]] double farthest(const Step& step) const;
  [[nodiscard]] double flip_limited(const Step& step, double t) const;
  [[nodiscard]] WeightedPoint moved(const Step& step, double t) const;
  Outcome try_step(const Step& step, double t);
  [[nodiscard]] bool stays_oriented(const WeightedPoint& p) const;
  [[nodiscard]] bool keeps_size(const WeightedPoint& p);
  bool place(const WeightedPoint& p, double energy, bool must_pay);
  [[nodiscard]] bool keeps_connectivity() const;
  [[nodiscard]] bool flips_at_once() const;
  void note_regular_edges();
  [[nodiscard]] bool regular_edges_still_are() const;

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  Flipper& flipper_;
  const Recorder& recorder_;
  SizeBand band_;
  IdVector<VertexId, Mobility> mobility_;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  bool collapses_ = false, removes_ = false;
  double overshoot_ = 1;

  VertexId vertex_;
  WeightedPoint origin_;  // where the vertex is
  double energy_ = 0;     // of the patch there
  Patch patch_;
  RemovalPlan plan_;
  std::vector<std::uint8_t> was_regular_;  // of the edges of star and link, in the order of the star
  struct NewWeight {
    VertexId v;
    double w, before, after;
  };
  std::vector<NewWeight> deferred_;
};

}  // namespace temper
