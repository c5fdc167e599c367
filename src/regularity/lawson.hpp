// Lawson's algorithm on a queue of edges: the one engine behind restore_regularity, the optimizer's vertex step and
// the Delaunay triangulations of generate.
//
// Why it ends. Lift every vertex to height |x|² − w. An edge is not regular when the lifted surface is concave across
// it. Flipping it replaces the upper two faces of a tetrahedron by the lower two. The surface only ever goes down,
// strictly at each flip, so no triangulation comes twice. (With ties by index this holds for the perturbed weights.) At
// most O(n²) flips; in practice about as many as there are vertices. The signed volume under the surface falls by the
// tetrahedron's volume for any orientation, so it ends even if some triangles are turned over. But then a flip may join
// two vertices that have an edge already. So all triangles must be counter-clockwise. On the sphere the surface is the
// polyhedron of the weighted vectors (space.hpp), below is farther from the center, and all of this holds unchanged.
//
// Queued edges. A flip can spoil, or free, only the four edges around it: it pushes those. The queue holds halfedge
// slots, with no check when one is taken out. That is safe, since a flip moves edges between slots of its own two
// triangles alone. An entry that it displaces stood for one of five edges. Four of them have just been pushed again,
// and the fifth has just become regular. The edge to which a displaced entry now points is tested for nothing. This is
// cheaper than to remember vertex pairs and find them again. For the same reason an entry pushed twice is tested twice.
// Last in, first out: the quads it looks at are still in the cache.
//
// Stuck edges: not regular, but their quad is not strictly convex at one end a, so that no flip exists now. A flip of
// an edge around it may free it; that flip pushes it again, so no list of stuck edges is needed. If it is still stuck
// at the end, a is hidden. Then a is inside triangle bcd of the quad and lifted above the plane of bcd. Scaled towards
// a, the triangle fits into a's star. The regular surface is convex there and nowhere above the present one, so it
// passes below a. (If a is on the boundary or on constrained edges at a reflex corner, it has no power cell on its side
// of the domain.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/sort_unique.hpp"
#include "mesh/predicates.hpp"
#include "temper/topology.hpp"
#include "topology/flip_inline.hpp"

namespace temper {

// The local test of regularity for Lawson's loop: does the vertex across an inner edge conflict?
//
// Two rules for ties. PowerTest keeps an edge of a tie: a flip gains nothing, and might have to be undone.
// PerturbedPowerTest decides ties by the vertices' numbers, so that the triangulation is unique for any order of
// construction.

/// Positive when the edge ab of the quad must flip.
struct PowerTest {
  [[nodiscard]] Sign operator()(const Mesh& mesh, const inlined::Quad& q) const {
    return inlined::power_test(mesh, q.a, q.b, q.c, q.d);
  }
};

/// The power test with ties by rank: rank[v] replaces v's number if numbers must be the user's.
template <class Rank>
struct PerturbedPowerTest {
  Rank rank;

  [[nodiscard]] Sign operator()(const Mesh& mesh, const inlined::Quad& q) const {
    const Sign sign = PowerTest()(mesh, q);
    if (sign != Sign::zero) return sign;
    const auto [a, b, c] = mesh.points(q.a, q.b, q.c);
    return power_test_perturbed(mesh.space(), a, b, c, mesh.point(q.d, a),
                                {rank(q.a), rank(q.b), rank(q.c), rank(q.d)});
  }
};
template <class Rank>
PerturbedPowerTest(Rank) -> PerturbedPowerTest<Rank>;

/// A hook that watches flips. before(mesh, h) sees the edge that goes, after(mesh, h) the new edge in the same slots.
/// Between the two calls only the two triangles of h change. This one watches nothing.
struct IgnoreFlips {
  void before(const Mesh&, HalfedgeId) {}
  void after(const Mesh&, HalfedgeId) {}
};

/// The range of a run that may look at all vertices. Any class with the same member confines a run to some of them.
struct Everywhere {
  [[nodiscard]] static constexpr bool contains(VertexId) { return true; }
};

/// The result of one run.
struct LawsonRun {
  std::size_t flips = 0;
  bool finished = true;  ///< false: edges are left in the queue, for the cap on flips was reached, or
  bool escaped = false;  ///< the quad of an edge is not within the vertices that the run may look at
};

/// Queue, journal and stuck edges: keep one and use it again; once warm it allocates nothing.
class Lawson {
 public:
  static constexpr std::size_t kNoCap = std::numeric_limits<std::size_t>::max();

  /// Forgets queue, journal and stuck edges; keeps their storage.
  void clear() {
    queue_.clear();
    journal_.clear();
    stuck_.clear();
  }

  /// Queues the edge of h. Boundary and constrained edges may be pushed; they are skipped.
  void push(HalfedgeId h) { queue_.push_back(h); }
  /// Queues the edges that a change of v's position or weight can spoil: the edges of its star and of its link.
  void push_star(const Mesh& mesh, VertexId v) {
    for (const HalfedgeId h : mesh.star(v)) {
      push(h);
      push(Mesh::next(h));
    }
  }
  /// Queues the edges of the triangles that remove_vertex(mesh, plan) has just written. The journal must be empty, or
  /// never rolled back: it cannot undo a removal.
  void push_removal(const Mesh& mesh, const RemovalPlan& plan) {
    for (const auto& corners : plan.triangles) {
      const HalfedgeId h = mesh.find_halfedge(corners[0], corners[1]);
      push(h);
      push(Mesh::next(h));
      push(Mesh::prev(h));
    }
  }
  void push_all(const Mesh& mesh) {
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_edge_representative(h)) push(h);
    }
  }

  /// Flips until the queue is empty, or `max_flips` are done, or the next edge has a quad that is not all within.
  /// Appends the result of each flip to the journal. Confined, it looks at the quads of constrained edges, too. Then at
  /// its end all edges of all triangles that it has touched have their quads within.
  template <class Hook = IgnoreFlips, class Test = PowerTest, class Within = Everywhere>
  LawsonRun run(Mesh& mesh, Hook&& hook = {}, std::size_t max_flips = kNoCap, const Test& test = {},
                const Within& within = {}) {
    LawsonRun result;
    while (!queue_.empty()) {
      const HalfedgeId h = queue_.back();
      queue_.pop_back();
      if (mesh.is_boundary(h)) continue;
      const inlined::Quad q = inlined::quad(mesh, h);
      if (!(within.contains(q.a) && within.contains(q.b) && within.contains(q.c) && within.contains(q.d))) {
        result.finished = false;
        result.escaped = true;
        break;
      }
      if (mesh.is_constrained(h) || test(mesh, q) != Sign::positive) continue;
      if (!is_strictly_convex(mesh, q)) {
        stuck_.push_back(h);
        continue;
      }
      if (result.flips == max_flips) {
        queue_.push_back(h);
        result.finished = false;
        break;
      }
      hook.before(mesh, h);
      const HalfedgeId flipped = inlined::flip(mesh, h);
      hook.after(mesh, flipped);
      journal_.push_back(flipped);
      ++result.flips;
      push_outer_edges(mesh, flipped);
    }
    return result;
  }

  /// Undoes the flips of the journal, last first: the mesh is bit for bit as it was when the journal was empty. Then
  /// clears everything.
  void rollback(Mesh& mesh) {
    for (auto flipped = journal_.rbegin(); flipped != journal_.rend(); ++flipped) inlined::unflip(mesh, *flipped);
    clear();
  }

  /// The halfedges that the flips since clear() returned, in order.
  [[nodiscard]] const std::vector<HalfedgeId>& journal() const { return journal_; }
  /// Forgets the flips so far, so that rollback returns to the present state.
  void commit() { journal_.clear(); }

  /// Were edges found stuck since clear() that are stuck still? Each once, as the smaller of its two halfedges, sorted.
  template <class Test = PowerTest>
  [[nodiscard]] const std::vector<HalfedgeId>& stuck(const Mesh& mesh, const Test& test = {}) {
    for (HalfedgeId& h : stuck_) {
      if (mesh.is_edge_representative(h)) continue;
      h = mesh.twin(h);
    }
    sort_unique(stuck_);
    std::erase_if(stuck_, [&](HalfedgeId h) {
      return mesh.is_unflippable(h) || test(mesh, inlined::quad(mesh, h)) != Sign::positive;
    });
    return stuck_;
  }

 private:
  [[nodiscard]] static bool is_strictly_convex(const Mesh& mesh, const inlined::Quad& q) {
    return inlined::orientation(mesh, q.d, q.c, q.a) == Sign::positive &&
           inlined::orientation(mesh, q.c, q.d, q.b) == Sign::positive;
  }

  void push_outer_edges(const Mesh& mesh, HalfedgeId flipped) {
    const HalfedgeId other = mesh.twin(flipped);
    push(Mesh::next(flipped));
    push(Mesh::prev(flipped));
    push(Mesh::next(other));
    push(Mesh::prev(other));
  }

  std::vector<HalfedgeId> queue_, journal_, stuck_;
};

}  // namespace temper
