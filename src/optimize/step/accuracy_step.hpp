// One vertex, moved and weighted so that the energy of the accuracy objective falls, with the connectivity as it is.
//
// Why no edge can stop being regular. The dual of an interior edge has the length h_k + h_l, and the edge is regular
// where that is not negative. A step is made only where the triangles of the star, and those across its link, are
// well-centered (those without a floor are not, and what touches them stays), and it is taken only when those of the
// star, which alone change, still are, by exact predicates. So at every edge that changes, both heights are positive
// before and after: its dual is, and no edge has to be flipped. For the same reason triangles stay counter-clockwise,
// orthocenters inside and edges crossed by their duals; and each triangle keeps more than its floor in doubles, outside
// of which the energy is +∞.
#pragma once

#include "energy/accuracy_energy.hpp"
#include "energy/patch.hpp"
#include "optimize/step/newton.hpp"
#include "optimize/step/vertex_limits.hpp"
#include "optimize/trace/recorder.hpp"

namespace temper {

/// What all steps share.
struct AccuracyGround {
  VertexSizes sizes;
  AccuracyFloors floors;
  VertexId anchor;  ///< whose weight stays; invalid: none
};

/// The storage of steps, kept from one vertex to the next: once warm, a step allocates nothing.
class AccuracyStep {
 public:
  AccuracyStep(Mesh& mesh, const Settings& settings, const Frame& frame, VertexLimits& limits,
               const AccuracyGround& ground, const Recorder& recorder)
      : mesh_(mesh), settings_(settings), frame_(frame), limits_(limits), ground_(ground), recorder_(recorder) {}

  /// One Newton step of v: over-relaxed, then plain, then halved until the energy falls; or none.
  void improve(VertexId v);

 private:
  enum class Found { step, none, only_outside_of_band };
  Found search(VertexId v, const Freedom& freedom);
  [[nodiscard]] WeightedPoint moved(const WeightedPoint& from, const Step& step, double t) const;
  [[nodiscard]] bool keeps_size(VertexId v, const WeightedPoint& from, const WeightedPoint& to);

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  VertexLimits& limits_;
  const AccuracyGround& ground_;
  const Recorder& recorder_;
  AccuracyPatch patch_;
  Patch star_;  // of a size band
};

}  // namespace temper
