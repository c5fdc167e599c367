// The guard: measures that no run makes worse than in the input, or than a bound.
//
// Codes with explicit time steps, fluxes or linear elements look at the worst value of each measure over the mesh:
//   - of triangles: the least and the largest angle, the shortest edge, the time that a long wave takes to cross
//   - of pairs: the length of an edge over the size of its two triangles, the ratio of their areas
//   - of flow links, for D-Flow FM: the orthogonality, the length (geometry/flow_cell.hpp)
//   - of cells and their triangles, for MPAS (size/cell_ring.hpp). These depend on two rings of triangles around a
//     change, so that sweeps must go in order
// A limit is the worse of bound and input, so a bound that the input misses is no goal.
//
// A change of the mesh replaces some triangles. The guard refuses it if the worst measure around it becomes worse, and
// is then beyond the limit. So good triangles may become worse as far as the limit, and the worst ones never do. Steps,
// flips, insertions and removals ask the guard; the judge (judge.hpp) counts the triangles beyond it in each candidate.
// Some changes ask nobody, such as the flips that make the input regular. The judge is for them. It also compares the
// measures of the client over the whole mesh, such as counts, which no single change can know.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/flow_cell.hpp"
#include "optimize/flips/guard_limits.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/working/working_units.hpp"
#include "size/cell_ring.hpp"
#include "temper/optimize.hpp"
#include "temper/topology.hpp"

namespace temper {

/// The neighbors of a vertex that a copy of a few triangles does not have: counter-clockwise, after those it has.
struct OutsideNeighbors {
  std::vector<WeightedPoint> points;
  bool is_outside = false;  ///< there are triangles outside
  bool is_closed = false;   ///< the vertex is not on the boundary of the whole mesh
};

/// Guards of different parts may work at once: a copy has working storage of its own, and shares the depths of
/// vertices.
class Guard {
 public:
  /// The guard of a mesh in working units. Without limits it is off. A copy of a few triangles does not know all cells
  /// at its rim, and asking for cells takes most of the time. So steps there do not ask, but worst() does at the end.
  Guard(const Mesh& mesh, const WorkingUnits& units, std::shared_ptr<const GuardLimits> limits, bool in_copy = false);

  [[nodiscard]] bool on() const { return limits_ != nullptr; }
  /// Says whether a question reads the stars of neighbors.
  [[nodiscard]] bool reads_stars() const { return on() && limits_->has_cells && !in_copy_; }

  /// Say whether these changes are within the guard: v moves to p, a plan is committed. Call begin_step() before the
  /// moves that one step tries.
  void begin_step();
  [[nodiscard]] bool allows_move(VertexId v, const WeightedPoint& p);
  [[nodiscard]] bool allows(const RemovalPlan& plan);
  [[nodiscard]] bool allows(const InsertionPlan& plan);
  /// Call this when v goes to the p of the last allows_move(), and again if it goes back.
  void moved(VertexId v) {
    if (on() && has_depth()) std::swap((*depths_)[v], there_);
  }
  /// Call this if v has moved without allows_move().
  void follow(VertexId v);

  // The flips of one step. Call begin_flips() first, about_to_flip() before each flip, and allow_flips() at the end, if
  // no flip was to leave the part.
  void begin_flips(const Part& part);
  void about_to_flip(HalfedgeId h);
  [[nodiscard]] bool allow_flips() const;

  /// Returns the worst values of the mesh. `outside`: of vertices of a copy; new vertices have none.
  [[nodiscard]] GuardValues worst(Executor* executor = nullptr, std::span<const OutsideNeighbors> outside = {}) const;
  /// Returns the values at boundary edge h, if its triangle had a neighbor with this third corner.
  [[nodiscard]] GuardValues across(HalfedgeId h, const WeightedPoint& beyond) const;
  [[nodiscard]] const GuardValues& limits() const { return limits_->for_steps; }
  /// Counts the triangles that are beyond these limits, alone or with a neighbor.
  [[nodiscard]] std::size_t count_beyond(const GuardValues& limits, Executor* executor = nullptr) const;

  /// Follow a compaction of the mesh, and new vertices at its end.
  void renumber(const Compaction& kept);
  void grow();

 private:
  using Corners = std::array<VertexId, 3>;
  struct Triangle {
    double doubled_area = 0;        // of the whole cell, if this is half a quadrilateral
    std::array<double, 3> l2 = {};  // of the edges from corner k to k + 1
    double depth = 0;
    std::optional<std::size_t> diagonal = {};  // of half a quadrilateral: the edge inside of it
    // For flow links: center and area of the cell, and places of the corners near the first one.
    FlowCell cell;
    std::array<Vec3, 3> at = {};
    Corners corners = {};
  };
  /// An edge across from the vertex that moves, with the triangle on its other side, if there is one.
  struct LinkEdge {
    VertexId from, to;
    TriangleId across;
    std::optional<Triangle> outside = {};  ///< once it was needed
  };
  /// The measures of triangles, of pairs and of flow links are disjoint.
  enum Stage { alone, pairs, links };
  /// A depth of the field, and the triangle of the field in which it was found.
  struct Depth {
    double value = 0;
    TriangleId near;
  };
  /// A triangle of the mesh; or of plans, where the vertex `moving_` (invalid: a new one) is at `place_`.
  /// It lacks the cell for flow links.
  [[nodiscard]] Triangle triangle(const Corners& corners, bool of_plan = false) const;
  void add_cell(Triangle& t) const;
  [[nodiscard]] Triangle triangle(TriangleId t) const;
  /// These take the values of a triangle, of two triangles that share edge k of s, and of the flow link between those.
  /// The values that are not below `limits` may be infinite: most need no inverse cosine to show that.
  void take_alone(GuardValues& v, const Triangle& t, const GuardValues& limits) const;
  static void take_pair(GuardValues& v, const Triangle& s, std::size_t k, const Triangle& t);
  void take_link(GuardValues& v, const Triangle& s, std::size_t k, const Triangle& t) const;
  void take_pair_and_link(GuardValues& v, const Triangle& s, std::size_t k, const Triangle& t) const {
    take_pair(v, s, k, t);
    if (limits_->has_flow) take_link(v, s, k, t);
  }
  /// Returns the values of t and of its pairs with neighbors, except those that are listed.
  [[nodiscard]] GuardValues around(TriangleId t, const GuardValues& limits,
                                   std::span<const TriangleId> except = {}) const;
  [[nodiscard]] GuardValues around(std::span<const TriangleId> triangles) const;
  /// Returns the values of the cell of a vertex; if `moved`, with the vertex `moving_` at `place_`.
  [[nodiscard]] GuardValues cell(VertexId v, bool moved = false, const OutsideNeighbors* outside = nullptr) const;
  /// Returns the values of the cells of v and its neighbors.
  [[nodiscard]] GuardValues cells_around(VertexId v, bool moved) const;
  [[nodiscard]] bool allows(std::span<const TriangleId> old, std::span<const Corners> fresh);
  void find_star(std::vector<Triangle>& star, bool moved) const;
  void take_stage(GuardValues& v, Stage stage, std::vector<Triangle>& star);
  [[nodiscard]] bool allows_stage(Stage stage);
  [[nodiscard]] bool has_depth() const { return limits_->depth != nullptr; }
  [[nodiscard]] Depth depth_at(const WeightedPoint& p, TriangleId near) const;

  const Mesh& mesh_;
  const WorkingUnits& units_;
  std::shared_ptr<const GuardLimits> limits_;
  bool in_copy_;
  std::shared_ptr<IdVector<VertexId, Depth>> depths_;  // of all parts; if there are depths
  VertexId moving_;
  WeightedPoint place_;
  Depth there_;  // at place_
  // Of the present step, before it.
  std::vector<LinkEdge> link_;
  std::vector<Triangle> star_;
  GuardValues least_;                    // the limits; after the first refusal at a stage, the worse of star and limits
  std::array<bool, 3> knows_star_ = {};  // by stage, whether least_ has its values
  std::optional<GuardValues> cells_;
  Part part_;                        // of the present step
  std::vector<TriangleId> touched_;  // by flips
  std::vector<VertexId> corners_;    // of these, if cells are measured
  GuardValues before_;               // of both
  mutable CellRing ring_;
  std::vector<TriangleId> old_;
  std::vector<Corners> fresh_;
  std::vector<Triangle> shapes_;
};

}  // namespace temper
