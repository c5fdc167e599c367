// The improver of one thread: batches of vertices where they suit, else steps one by one.
#pragma once

#include <span>
#include <vector>

#include "optimize/batch/batch_step.hpp"

namespace temper {

class Improver {
 public:
  explicit Improver(const StepContext& context)
      : context_(context),
        flipper_(context.mesh, context.settings, context.state, context.recorder),
        step_(context, flipper_),
        batches_(context, flipper_, step_) {}
  Improver(const Improver&) = delete;
  Improver& operator=(const Improver&) = delete;
  ~Improver() = default;

  /// Improves those that are still there, in that order, or in batches nearly so. Those that need another part are
  /// appended to `left`, in the order of their numbers.
  void improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left) {
    if (context_.mesh.n_vertices() >= kLeastForBatches && step_.suits_batches()) {
      return batches_.improve(vertices, part, left);
    }
    for (const VertexId v : vertices) {
      if (!context_.mesh.is_isolated(v) && !step_.improve(v, part)) left.push_back(v);
    }
  }

  /// Appends what is flipped to a log, or to none.
  void log_flips(std::vector<HalfedgeId>* log) { flipper_.log_flips(log); }
  /// Does again what another one has logged.
  void repeat(std::span<const HalfedgeId> flips) { flipper_.repeat(flips); }
  /// Writes all that a sweep changes of vertices: what the mesh has of them, and what batches go by.
  template <class Vertices>
  void write(ByteWriter& writer, const Vertices& vertices) const {
    for (const VertexId v : vertices) writer.write(context_.limits.degree[v]);
    write_points(writer, context_.mesh, vertices);
  }
  template <class Vertices>
  void read(ByteReader& reader, const Vertices& vertices) {
    for (const VertexId v : vertices) reader.read(context_.limits.degree[v]);
    read_points(reader, context_.mesh, vertices);
  }

  [[nodiscard]] VertexStep& step() { return step_; }
  [[nodiscard]] Flipper& flipper() { return flipper_; }

 private:
  // The vertices of a smaller mesh are improved one by one: there is little to gain, and eight do not find each other.
  static constexpr std::size_t kLeastForBatches = 1000;

  StepContext context_;
  Flipper flipper_;
  VertexStep step_;
  BatchStep batches_;
};

}  // namespace temper
