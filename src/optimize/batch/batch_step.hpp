// Vertices in batches of eight: Newton's method for all of them at once (star_batch.hpp), then one after the other
// into the mesh, by steps of single vertices where that is not enough.
//
// The vertices of a batch are those that come next in the sweep with about as many triangles, but for any that a step
// of another one in the batch looks at, or that looks at it: those wait for a later one. So nothing that a step reads
// is changed by another's, unless edges flip: stars are looked at again then.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "optimize/batch/star_batch.hpp"
#include "optimize/step/vertex_step.hpp"

namespace temper {

class BatchStep : StepContext {
 public:
  BatchStep(const StepContext& context, Flipper& flipper, VertexStep& alone)
      : StepContext(context), flipper_(flipper), alone_(alone) {}

  /// Improves those that are still there, each as VertexStep does, but that vertices wait for each other as described
  /// above. Those that need another part are appended to `left`, in the order of their numbers.
  void improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left);

 private:
  /// One vertex of the batch.
  struct Occupant {
    VertexId v;
    std::size_t n_link = 0;
    // As gathered; the first of them, when alone.
    std::array<VertexId, StarBatch::kMostTriangles + 1> link;
    std::array<HalfedgeId, StarBatch::kMostTriangles> spokes;
    bool alone = false;  // not for vectors: many neighbors, or on a line that it slides along
  };

  [[nodiscard]] std::size_t kind_of(VertexId v) const;
  std::size_t take_from(std::vector<VertexId>& list);
  bool take(VertexId v);
  void gather(VertexId v, Mobility mobility);
  [[nodiscard]] bool gather_star(Occupant& occupant, std::size_t lane);
  void gather_domain(const Occupant& occupant, std::size_t lane);
  void gather_lengths(HalfedgeId h, std::size_t i, std::size_t lane);
  void run();
  void step_and_settle();
  void settle(const Occupant& occupant, std::size_t lane, const StepOutcome& outcome, bool flips);
  void improve_alone(VertexId v);
  [[nodiscard]] bool reaches_its_link(const Occupant& occupant, const WeightedPoint& to) const;
  [[nodiscard]] bool has_its_link(const Occupant& occupant, bool open) const;

  Flipper& flipper_;
  VertexStep& alone_;

  // Of the call under way.
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  Part part_;
  std::vector<VertexId>* left_ = nullptr;
  std::array<std::vector<VertexId>, 4> waiting_;  // with up to 5 triangles, 6, 7, and more
  // Of the batch under way.
  StarBatch batch_;
  AccuracyLanes accuracy_;
  std::array<Occupant, kLanes> occupants_;
  // Whether a vertex of the batch looks at one of these numbers, modulo kMarks: who shares a number with another waits
  // sometimes for nothing.
  static constexpr std::size_t kMarks = 2048;
  enum class Mark : std::uint8_t { none, looked_at };
  std::array<Mark, kMarks> marks_{};
  [[nodiscard]] Mark& mark(VertexId v) { return marks_[v.index % kMarks]; }
};

}  // namespace temper
