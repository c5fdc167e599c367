// One vertex, improved: the body of the paper's inner loop (lines 10 to 14 of Algorithm 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "energy/patch.hpp"
#include "optimize/freedom.hpp"
#include "optimize/newton.hpp"
#include "optimize/settings.hpp"
#include "regularity/lawson.hpp"

namespace temper {

/// The storage of vertex steps, kept from one vertex to the next: once warm, a step allocates nothing.
class VertexStep {
 public:
  VertexStep(Mesh& mesh, const Settings& settings, const Frame& frame)
      : mesh_(mesh), settings_(settings), frame_(frame), mobility_(mobilities(mesh, settings.options.interfaces)) {}

  /// Of the sweep under way: i ≥ weights_from, and the overshoot of FlipLimit::after.
  void begin_sweep(int sweep);

  /// Moves v so that the energy falls, flips what must flip, or leaves everything as it was.
  void improve(VertexId v);

  /// Edge flips since begin_sweep.
  [[nodiscard]] std::size_t flips() const { return flips_; }

 private:
  enum class Outcome { accepted, not_lower, inverted, blocked_by_flip };

  void newton_search(const Freedom& freedom);
  void golden_search(const Freedom& freedom);
  void gather(VertexId v);
  bool enter_domain();

  [[nodiscard]] double radius() const;
  [[nodiscard]] double inversion_limit(const Step& step) const;
  [[nodiscard]] double flip_limited(const Step& step, double t) const;
  [[nodiscard]] WeightedPoint moved(const Step& step, double t) const;
  Outcome try_step(const Step& step, double t);
  Outcome commit_if_lower(const WeightedPoint& p, double energy);
  [[nodiscard]] bool stays_oriented(const WeightedPoint& p) const;
  bool place(const WeightedPoint& p, std::optional<double> change);
  [[nodiscard]] bool flips_at_once() const;
  void note_regular_edges();
  [[nodiscard]] bool regular_edges_still_are() const;
  [[nodiscard]] bool flip_to_regular(std::optional<double> change);

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  IdVector<VertexId, Mobility> mobility_;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  double overshoot_ = 1;
  std::size_t flips_ = 0;

  VertexId vertex_;
  WeightedPoint origin_;  // where the vertex is
  double energy_ = 0;     // of the patch there
  Patch patch_;
  Lawson lawson_;
  std::vector<std::uint8_t> was_regular_;  // of the edges of star and link, in the order of the star
};

}  // namespace temper
