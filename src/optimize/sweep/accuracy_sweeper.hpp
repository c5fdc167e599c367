// One Gauss-Seidel sweep for the accuracy objective, in parts that may run at once: the same bytes for any number of
// threads, and for none.
//
// As in sweeper.hpp the vertices are cut into ranges of about 16,000 numbers, each range improves in order those of its
// vertices that are confined to it, ranges shifted by half of their size take what is left, and what is left then is
// improved one by one. Here nothing but points is ever written, and a step writes only that of its own vertex, which is
// in its part; it reads points of its star, its link and across the link, which are in there too, or it is not
// confined. So nothing that one part writes is read or written by another.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "optimize/step/accuracy_step.hpp"
#include "optimize/sweep/desks.hpp"
#include "optimize/sweep/partition.hpp"
#include "optimize/sweep/watch.hpp"

namespace temper {

class AccuracySweeper {
 public:
  AccuracySweeper(Mesh& mesh, const Settings& settings, const Frame& frame, const AccuracyGround& ground,
                  const Recorder& recorder, std::size_t part_size);

  /// False when the caller or the clock has cut it short.
  bool sweep(Run& run);

 private:
  void run_parts(bool shifted, Watch& watch);
  void improve(AccuracyStep& step, std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left,
               Watch& watch) const;
  [[nodiscard]] bool may_run_at_once() const;
  [[nodiscard]] AccuracyStep make_step() { return {mesh_, settings_, frame_, limits_, ground_, recorder_}; }

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  const AccuracyGround& ground_;
  const Recorder& recorder_;
  VertexLimits limits_;
  std::size_t n_parts_;
  AccuracyStep main_;                        // of the thread that calls
  std::vector<VertexId> waiting_;            // for the phase under way, in order
  std::vector<std::vector<VertexId>> left_;  // by each part
  Desks<AccuracyStep> desks_;
};

}  // namespace temper
