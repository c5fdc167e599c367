// One Gauss-Seidel sweep over the vertices of a mesh, in parts that may run at once: the same bytes for any number of
// threads, and for none.
//
// The vertices of a working copy are numbered along a Hilbert curve. They are cut into parts, ranges of about 16,000
// numbers, however many threads there are, and each part improves the vertices that are confined to it (partition.hpp),
// in order; it lists those that are not, or whose flips would not be. These wait for the parts of other cuts
// (shifted_cuts.hpp, for_parts.hpp). A mesh of one part is swept as a whole.
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
// of parts does not matter. Where more is read (size bands look at the stars of neighbours), or where events are told
// in order, or vertices go, the parts run one after another: the same parts, the same order in each, the same bytes.
#pragma once

#include <cstddef>
#include <span>

#include "optimize/batch/improver.hpp"
#include "optimize/sweep/for_parts.hpp"

namespace temper {

/// Vertices in a part, at most: its boundary is a few per cent of it, and 10⁵ vertices still keep several threads busy.
inline constexpr std::size_t kPartSize = 16384;

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
    parts_.renumber();
  }
  void grow() { limits_.grow(); }

 private:
  /// One visit of each vertex, of these unknowns.
  bool visit_all(int iteration, Unknowns unknowns, std::span<const VertexId> sequence, Run& run);
  [[nodiscard]] Engine engine();
  void add_changes();

  VertexLimits limits_;
  StepContext context_;
  Flipper& flipper_;
  WorkerPool<Improver> improvers_;
  PartSweep<Improver> parts_;
  int iteration_ = 0;
  Unknowns unknowns_ = Unknowns::positions_and_weights;
  SerialExecutor in_order_;
};

}  // namespace temper
