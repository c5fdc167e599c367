// One Gauss-Seidel sweep over the vertices of a mesh, in parts that may run at once: the same bytes for any number of
// threads, and for none.
//
// The vertices of a working copy are numbered along a Hilbert curve. They are cut into parts, ranges of about 16,000
// numbers, however many threads there are, and each part improves the vertices that are confined to it (partition.hpp),
// in order; it lists those that are not, or whose flips would not be. What is listed comes next, with parts that are
// shifted by half of their size, then with parts four times as large and again, since some neighbours in the plane are
// far apart on the curve. The last part is the whole mesh: it takes what is left, about 1 % of a million vertices. A
// mesh of one part is swept as a whole.
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
#include <vector>

#include "optimize/run.hpp"
#include "optimize/settings.hpp"
#include "optimize/step/flipper.hpp"
#include "optimize/step/vertex_limits.hpp"
#include "optimize/step/vertex_step.hpp"
#include "optimize/sweep/desks.hpp"
#include "optimize/sweep/newton_pass.hpp"
#include "optimize/sweep/partition.hpp"
#include "optimize/sweep/watch.hpp"
#include "optimize/trace/recorder.hpp"

namespace temper {

/// Vertices in a part, at most: its boundary is a few per cent of it, and 10⁵ vertices still keep several threads busy.
inline constexpr std::size_t kPartSize = 16384;

class Sweeper {
 public:
  /// `flipper`: counts what all parts do.
  Sweeper(Mesh& mesh, const Settings& settings, const Frame& frame, Flipper& flipper, const Recorder& recorder,
          std::size_t part_size);

  /// Lines 9 to 16 of Algorithm 1. `sequence`: the order in which to visit the vertices, one after another; empty: as
  /// they are numbered. False when the caller or the clock has cut it short.
  bool sweep(int iteration, std::span<const VertexId> sequence, Run& run);

  /// A step of all vertices of each part at once, where allows_newton_passes() and no triangle is bad: see
  /// newton_pass.hpp. False when the caller or the clock has cut it short.
  bool newton_pass(int iteration, Run& run);

  /// Moves free vertices by up to `amount` of their shortest edge.
  void shake(double amount, Rng& rng) { main_.shake(amount, rng); }

  /// The mesh has been compacted, or has got new vertices.
  void renumber(const Compaction& kept) { limits_.renumber(kept); }
  void grow() { limits_.grow(); }

 private:
  /// What one part needs while it runs.
  struct Worker {
    explicit Worker(Sweeper& sweeper);
    Flipper flipper;
    VertexStep step;
  };
  /// A part, and those of its vertices that it could not improve.
  struct Piece {
    Part part;
    std::vector<VertexId> left;
  };

  void sweep_in_order(std::span<const VertexId> sequence, Watch& watch);
  void sweep_in_parts(Watch& watch);
  void cut(std::size_t count, bool shifted);
  void run_pieces(bool first, Watch& watch);
  void improve_numbers(VertexStep& step, std::size_t first, std::size_t last, Piece& piece, Watch& watch);
  void improve(VertexStep& step, std::span<const VertexId> vertices, Piece& piece, Watch& watch);
  bool improve_stretch(VertexStep& step, std::span<const VertexId> vertices, Piece& piece, Watch& watch);
  [[nodiscard]] bool may_run_at_once() const;

  Mesh& mesh_;
  const Settings& settings_;
  const Frame& frame_;
  Flipper& flipper_;
  const Recorder& recorder_;
  std::size_t part_size_;
  VertexLimits limits_;
  VertexStep main_;  // of the thread that calls
  int iteration_ = 0;
  std::vector<Piece> pieces_;  // of the phase under way, the first n_pieces_ of them: storage is kept
  std::size_t n_pieces_ = 0;
  std::vector<VertexId> waiting_;  // for the phase under way, in order
  Desks<Worker> desks_;
  NewtonPass passes_;
};

}  // namespace temper
