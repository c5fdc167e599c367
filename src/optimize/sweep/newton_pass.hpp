// Newton's method for many vertices at once, where sweeps have become slow: once every triangle is well-centered and
// γ has settled, what is left of the energy is in waves longer than a star, which a sweep moves by one vertex a time.
//
// A pass goes through parts of the mesh, ranges of about 16,000 vertex numbers, and makes one step of the vertices of
// each whose stars are inside (part_system.hpp): the first of t = 1, 1/2, … 1/32 at which all triangles that move are
// well-centered, exactly, and their energy is lower. Parts are shifted by half of their size from pass to pass, and a
// sweep between passes moves what lies between parts.
//
// No edge is flipped and none ever needs to be. The heights of a well-centered triangle are positive, so an edge
// between two of them has a dual of positive length: it is regular. All triangles are well-centered before a pass, and
// those that move are after it.
//
// Parts may run at once: each reads and writes points of its own vertices alone, and connectivity does not change.
#pragma once

#include "optimize/step/step_context.hpp"
#include "optimize/sweep/for_parts.hpp"
#include "optimize/sweep/part_system.hpp"

namespace temper {

/// Says whether the options leave steps to Newton's method, as passes make them: of a barrier, with flips at once, and
/// nothing that goes by single vertices or sweeps, as the paper's stopping rule does.
[[nodiscard]] bool allows_newton_passes(const Settings& settings, const Space& space);

class NewtonPass {
 public:
  NewtonPass(const StepContext& context, std::size_t part_size)
      : mesh_(context.mesh),
        settings_(context.settings),
        frame_(context.frame),
        limits_(context.limits),
        recorder_(context.recorder),
        part_size_(part_size) {}

  /// One pass. Before it, every triangle of the mesh is well-centered.
  void run(Unknowns unknowns, StopToken& stop);

  void visit(Archive& archive);

 private:
  /// The storage of one part while it runs.
  struct Worker {
    PartSystem system;
    std::vector<WeightedPoint> before;  // the part's points
  };

  void improve(const Part& part, Unknowns unknowns, Worker& worker);
  void place(Worker& worker, double t);
  void take_back(Worker& worker);
  void record(const Worker& worker) const;

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  const VertexLimits& limits_;
  const Recorder& recorder_;
  std::size_t part_size_;
  std::size_t passes_ = 0;
  WorkerPool<Worker> workers_{[] { return std::make_unique<Worker>(); }};
  SerialExecutor in_order_;
};

}  // namespace temper
