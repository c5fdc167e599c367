// One Gauss-Seidel sweep over the vertices of a mesh, in parts that may run at once. The bytes of the result do not
// depend on the number of threads.
//
// The vertices of a working copy are numbered along a Hilbert curve. Parts are ranges of about 16,000 numbers, for any
// number of threads. Each part improves the vertices that are confined to it (partition.hpp), in order. It lists
// vertices that are not, or whose flips would not be. These wait for the parts of other cuts (ShiftedPartitions):
// nearly all are inside a part of one of three cuts. The few vertices that are left, mostly none, follow one after
// another. A mesh of one part is swept as a whole.
//
// Proof that parts may run at once. Call a triangle inner to a part if all its corners are in it. While parts run:
//
//  1. A part writes corners only of its inner triangles, and these stay inner. Only flips write corners, and they flip
//     an edge only if its quad is in the part (Lawson::run). So the inner triangles of a part are the same from
//     beginning to end, and a triangle that is inner to no part does not change.
//  2. A part writes twins and flags only of halfedges with both ends in the part: in its inner triangles, and across
//     the outer edges of a quad. By 1, the ends of a halfedge slot are in one part throughout or never, so at most one
//     part writes each slot. A part writes points and outgoing halfedges only of its own vertices.
//  3. A part reads corners only of triangles with a corner in the part. By 1, no other part writes them. It reads twins
//     and flags only of halfedges with an end in the part, around its own vertices, and of link edges after is_confined
//     has seen both ends inside. By 2, no other part writes these. It reads coordinates and outgoing halfedges only of
//     its own vertices: a step and the guard read star, link and across the link; flips read quads. Before a flip, the
//     guard reads those of the four triangles around that are in the part, and the rest end the step by 4.
//  4. A confined v stays confined until its step ends. A flip makes a new quad only from vertices of the part. Then
//     every edge of a changed triangle is tested, and its quad must be inside; otherwise the whole step is undone and
//     the vertex listed. Later reads (stuck edges, the patch again) are of changed triangles or of unchanged edges.
//  5. Adjacent slots are different objects: bytes, words and doubles, not bits. Regions do not change.
//
// So no part reads or writes what another part writes. Each part does what it would do alone, and the order of parts
// does not matter. Some steps read more (size bands and a guard of cells read the stars of neighbors), record events in
// order, or remove vertices. Then the same parts run one after another, with the same order in each, and make the same
// bytes.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "base/engine.hpp"
#include "optimize/batch/batch_step.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/run/run.hpp"

namespace temper {

/// The improver of one thread: batches of vertices where they suit, else steps one by one.
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

  /// Improves the vertices that still exist, in order, or in batches nearly in order. Vertices that need another part
  /// are appended to `left`, in the order of their numbers.
  void improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left) {
    if (context_.mesh.n_vertices() >= kLeastForBatches && step_.suits_batches()) {
      return batches_.improve(vertices, part, left);
    }
    for (const VertexId v : vertices) {
      if (!context_.mesh.is_isolated(v) && !step_.improve(v, part)) left.push_back(v);
    }
  }

  /// Writes all that a sweep changes in vertices: their data in the mesh, and the numbers that batches use.
  template <class Vertices>
  void write(ByteWriter& writer, const Vertices& vertices) const {
    for (const VertexId v : vertices) writer.write(context_.limits.degree[v]);
    for (const VertexId v : vertices) writer.write(context_.mesh.point(v));
  }
  template <class Vertices>
  void read(ByteReader& reader, const Vertices& vertices) {
    for (const VertexId v : vertices) reader.read(context_.limits.degree[v]);
    for (const VertexId v : vertices) {
      WeightedPoint p = context_.mesh.point(v);
      reader.read(p);
      context_.mesh.set_point(v, p);
      context_.limits.guard.follow(v);
    }
  }

  [[nodiscard]] VertexStep& step() { return step_; }
  [[nodiscard]] Flipper& flipper() { return flipper_; }

 private:
  // Vertices of a smaller mesh are improved one by one: batches gain little there, and rarely fill.
  static constexpr std::size_t kLeastForBatches = 1000;

  StepContext context_;
  Flipper flipper_;
  VertexStep step_;
  BatchStep batches_;
};

/// The improvers of parts that run at once. There are as many as ever work at the same time, and they are kept.
class Improvers {
  struct Place {
    std::atomic<bool> taken = false;
    std::unique_ptr<Improver> improver;
  };

 public:
  explicit Improvers(const StepContext& context) : context_(context) {}

  /// An improver for one user, until the lease ends.
  struct GiveBack {
    Place* place;
    void operator()(Improver*) const { place->taken.store(false, std::memory_order_release); }
  };
  using Lease = std::unique_ptr<Improver, GiveBack>;

  /// Makes room for n improvers. None may be leased.
  void make_room(std::size_t n);
  /// Leases the first free improver. With one place per block, one is always free, or will be in a moment.
  [[nodiscard]] Lease take();
  /// Visits every improver. None may be leased.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (Place& place : places_) {
      if (place.improver) visit(*place.improver);
    }
  }
  /// Calls VertexStep::begin_sweep for all improvers, present and later.
  void begin_sweep(int iteration, Unknowns unknowns);

 private:
  StepContext context_;
  int iteration_ = 0;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  std::deque<Place> places_;  // places do not move; few of them ever get an improver
};

/// Largest number of vertices in a part. A few percent of them are at its boundary, and 10⁵ vertices occupy several
/// threads.
inline constexpr std::size_t kPartSize = 16384;

class StopToken;

class Sweeper {
 public:
  /// `flipper` counts the changes of all parts. Steps use its settings, state and recorder.
  Sweeper(WorkingCopy& work, Flipper& flipper, std::size_t part_size);

  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;
  ~Sweeper() = default;

  /// Lines 9 to 16 of Algorithm 1. `sequence`: the order in which to visit the vertices one after another; empty: in
  /// parts along the numbers. Returns false if the caller or the clock stopped the sweep.
  bool sweep(int iteration, std::span<const VertexId> sequence, Run& run);

  /// Moves free vertices by up to `amount` of their shortest edge.
  void shake(double amount, Rng& rng);

  /// Follow a compaction of the mesh, or new vertices.
  void renumber(const Compaction& kept) {
    limits_.renumber(kept);
    partitions_.clear();
  }
  void grow() { limits_.grow(); }

 private:
  /// The results of a part other than moved vertices.
  struct Done {
    std::vector<VertexId> left;
    std::vector<HalfedgeId> flips;  // for other ranks
  };

  /// Visits each vertex once, to change these unknowns.
  bool visit_all(int iteration, Unknowns unknowns, std::span<const VertexId> sequence, Run& run);
  void visit_parts(StopToken& stop);
  void visit_in_order(std::span<const VertexId> vertices, StopToken& stop);
  template <class PartOf, class VerticesOf>
  void run_parts(std::size_t n, StopToken& stop, PartOf&& part, VerticesOf&& vertices);
  void hand_out(std::size_t cut);
  [[nodiscard]] Engine engine();
  void add_changes();

  VertexLimits limits_;
  StepContext context_;
  Flipper& flipper_;
  Improvers improvers_;
  SerialExecutor in_order_;
  std::size_t part_size_;
  std::vector<Done> done_;            // by part of the present phase; storage is kept
  std::vector<VertexId> waiting_;     // for the present phase
  std::vector<VertexId> handed_out_;  // waiting vertices in the order of their parts
  std::vector<std::size_t> begin_;    // of each part among the waiting vertices
  ShiftedPartitions partitions_;      // of the mesh at the first sweep with these vertices
};

}  // namespace temper
