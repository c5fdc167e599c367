// One Gauss-Seidel sweep over the vertices of a mesh, in parts that may run at once: the same bytes for any number of
// threads, and for none.
//
// The vertices of a working copy are numbered along a Hilbert curve. They are cut into parts, ranges of about 16,000
// numbers, however many threads there are, and each part improves the vertices that are confined to it (partition.hpp),
// in order; it lists those that are not, or whose flips would not be. These wait for the parts of other cuts
// (ShiftedPartitions): nearly all are inside of one of three. What is left then, mostly nothing, comes one after
// another. A mesh of one part is swept as a whole.
//
// Why parts may run at once. Call a triangle inner to a part when all its corners are in there. While parts run:
//
//  1. A part writes corners only of its inner triangles, and they stay inner. Flips alone write corners, and flip an
//     edge only when its quad is in the part (Lawson::run). So the inner triangles of a part are the same from
//     beginning to end, and a triangle that is inner to no part does not change.
//  2. A part writes twins and flags only of halfedges with both ends in the part: those of its inner triangles, and
//     across the outer edges of a quad. By 1. the ends of a halfedge slot are all in one part throughout or not, so
//     each slot is written by one part at most. Points and outgoing halfedges are written of the part's own vertices.
//  3. A part reads corners only of triangles with a corner in the part, by 1. never written by another. It reads twins
//     and flags only of halfedges with an end in the part, by 2. never written by another: around its own vertices, and
//     of link edges once is_confined has seen both ends inside. It reads coordinates and outgoing halfedges only of its
//     own vertices: a step looks at star, link and across the link; flips look at quads.
//  4. That v is confined holds to the end of its step. A flip makes a new quad only from vertices of the part, and
//     every edge of a triangle that was touched has been tested afterwards, and its quad found inside: otherwise the
//     step is undone whole and the vertex listed. What is asked after flips (stuck edges, the patch gathered again) are
//     edges of touched triangles, or as they were.
//  5. Slots that lie side by side are different objects: bytes, words and doubles, no bits. Regions do not change.
//
// So nothing that one part writes is read or written by another, each part does what it would do alone, and the order
// of parts does not matter. Where more is read (size bands look at the stars of neighbors), or where events are told
// in order, or vertices go, the parts run one after another: the same parts, the same order in each, the same bytes.
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

  /// Writes all that a sweep changes of vertices: what the mesh has of them, and what batches go by.
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
    }
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

/// The improvers of parts that run at once: as many are made as ever are at work together, and kept.
class Improvers {
  struct Place {
    std::atomic<bool> taken = false;
    std::unique_ptr<Improver> improver;
  };

 public:
  explicit Improvers(const StepContext& context) : context_(context) {}

  /// An improver that nobody else has, until this ends.
  struct GiveBack {
    Place* place;
    void operator()(Improver*) const { place->taken.store(false, std::memory_order_release); }
  };
  using Lease = std::unique_ptr<Improver, GiveBack>;

  /// Room for n of them; while none is leased.
  void make_room(std::size_t n);
  /// The first one that is free. With as many places as there are blocks one always is, or is just about to be.
  [[nodiscard]] Lease take();
  /// Every one that has been made; while none is leased.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (Place& place : places_) {
      if (place.improver) visit(*place.improver);
    }
  }
  /// As of VertexStep, of those there are and those to come.
  void begin_sweep(int iteration, Unknowns unknowns);

 private:
  StepContext context_;
  int iteration_ = 0;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  std::deque<Place> places_;  // places do not move; few of them ever get an improver
};

/// Vertices in a part, at most: its boundary is a few per cent of it, and 10⁵ vertices still keep several threads busy.
inline constexpr std::size_t kPartSize = 16384;

class StopToken;

class Sweeper {
 public:
  /// `flipper`: counts what all parts do.
  Sweeper(WorkingCopy& work, const Settings& settings, const SweepState& state, Flipper& flipper,
          const Recorder& recorder, std::size_t part_size);

  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;
  ~Sweeper() = default;

  /// Lines 9 to 16 of Algorithm 1. `sequence`: the order in which to visit the vertices, one after another; empty: in
  /// parts along the numbers. False when the caller or the clock has cut it short.
  bool sweep(int iteration, std::span<const VertexId> sequence, Run& run);

  /// Moves free vertices by up to `amount` of their shortest edge.
  void shake(double amount, Rng& rng);

  /// The mesh has been compacted, or has got new vertices.
  void renumber(const Compaction& kept) {
    limits_.renumber(kept);
    partitions_.clear();
  }
  void grow() { limits_.grow(); }

 private:
  /// What a part has done besides moving vertices.
  struct Done {
    std::vector<VertexId> left;
    std::vector<HalfedgeId> flips;  // for other ranks
  };

  /// One visit of each vertex, of these unknowns.
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
  std::vector<Done> done_;            // by each part of the phase under way: storage is kept
  std::vector<VertexId> waiting_;     // for the phase under way
  std::vector<VertexId> handed_out_;  // as they are put in the order of their parts
  std::vector<std::size_t> begin_;    // of each part among those that wait
  ShiftedPartitions partitions_;      // as the mesh was at the first sweep, or the first with these vertices
};

}  // namespace temper
