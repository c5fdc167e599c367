// Vertices in batches of eight. Newton's method runs for all of them at once (star_batch.hpp). Then the steps are
// applied to the mesh one by one. If a batch step is not enough, its vertex makes a single step.
//
// A batch takes the next vertices of the sweep with about equal numbers of triangles. If the step of one vertex reads
// another vertex of the batch, one of them waits for a later batch. So no step changes what another one reads, unless
// edges flip: then the batch checks the stars again.
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

  /// Improves the vertices that still exist, each as VertexStep does, except that vertices wait for each other as
  /// above. Vertices that need another part are appended to `left`, in the order of their numbers.
  void improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left);

 private:
  /// One vertex of the batch.
  struct Occupant {
    VertexId v;
    std::size_t n_link = 0;
    // The star when it was gathered; only its first entries if `alone`.
    std::array<VertexId, StarBatch::kMostTriangles + 1> link;
    std::array<HalfedgeId, StarBatch::kMostTriangles> spokes;
    bool alone = false;  // makes a single step: has many neighbors, or slides along a line
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

  // State of the present call.
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  Part part_;
  std::vector<VertexId>* left_ = nullptr;
  std::array<std::vector<VertexId>, 4> waiting_;  // with up to 5, 6, 7 and more triangles
  // State of the present batch.
  StarBatch batch_;
  AccuracyLanes accuracy_;
  std::array<Occupant, kLanes> occupants_;
  // Marks vertices, by number modulo kMarks, that the batch's steps read. A shared mark may make a vertex wait in vain.
  static constexpr std::size_t kMarks = 2048;
  enum class Mark : std::uint8_t { none, looked_at };
  std::array<Mark, kMarks> marks_{};
  [[nodiscard]] Mark& mark(VertexId v) { return marks_[v.index % kMarks]; }
};

}  // namespace temper
