// Sweeps over the vertices at triangles that are not well-centered, and over no others.
//
//   for each step
//     until its triangles are good, with a γ that shrinks
//       sweep over these vertices of the triangles that are bad now
//
//   step   vertices                                              unknowns
//   1      of each bad triangle the corner of most bad ones      weights
//   2      the same                                              positions and weights
//   3      all corners                                           positions and weights
//   4      and one ring around                                   positions and weights
//
// A vertex that was disturbed is the corner of most bad triangles around it. So its place mostly changes alone.
//
//         * ----- *          v was moved to the right: the triangles at a, b and c are bad. It is a corner of all
//        / \     / \         of them, and every other corner is one of at most two of them
//       /   \   /   a
//      *      v---- *
//       \   /   \   b
//        \ /     \ /
//         * ----- * c
#pragma once

#include <vector>

#include "optimize/flips/flipper.hpp"
#include "optimize/run/run.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

/// Some vertices of bad triangles, and sweeps over them.
struct NearStep {
  int rings;  ///< around the bad triangles; −1: of each the corner of most bad ones alone
  bool only_weights;
  int most_sweeps;
};

class NearSweeps {
 public:
  /// `state`: its energy is that of sweeps. Its γ and relaxation are put back at the end.
  NearSweeps(WorkingCopy& work, Flipper& flipper, SweepState& state, Run& run)
      : work_(work), flipper_(flipper), settings_(flipper.settings()), state_(state), run_(run) {}

  /// Makes the sweeps, and returns true. Makes none if the options remove vertices or the criterion is another one.
  /// O(n) for each step that is needed, and O(its vertices) for each sweep.
  bool run();

 private:
  [[nodiscard]] bool allows(const NearStep& step) const;
  void sweep(const NearStep& step);
  [[nodiscard]] std::vector<VertexId> near(const NearStep& step) const;
  [[nodiscard]] std::vector<VertexId> centers(bool only_weights) const;
  void find_bad(const std::vector<VertexId>& swept);

  WorkingCopy& work_;
  Flipper& flipper_;
  const Settings& settings_;
  SweepState& state_;
  Run& run_;
  std::vector<TriangleId> bad_;  // ascending
};

}  // namespace temper
