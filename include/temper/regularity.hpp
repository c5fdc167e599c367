// Regularity (the weighted Delaunay property) of unconstrained interior edges: test it, restore it, and find how far
// one vertex may move before it is lost (§2.4 of the paper).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "temper/mesh.hpp"
#include "temper/topology.hpp"

namespace temper {

class Executor;

/// Says whether the dual length of the edge of h is zero or more. Exact. An edge with four cocircular points (in the
/// power sense) is regular, and so is each boundary edge.
[[nodiscard]] bool is_regular(const Mesh& mesh, HalfedgeId h);

/// Counts interior edges that are not regular, with or without constrained ones. Uses the executor's threads if given.
[[nodiscard]] std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained = true,
                                                  Executor* executor = nullptr);

/// The treatment of vertices whose power cell is empty: no regular triangulation has them.
enum class HiddenPolicy {
  undo,    ///< Put the mesh back as it was, bit for bit, if any vertex is hidden
  remove,  ///< Remove them inside the domain and on straight parts of the boundary and of interfaces; others stay
  keep,    ///< Leave them in, with their edges that are not regular, and report both
};

/// The result of restore_regularity.
struct Restoration {
  std::size_t flips = 0;
  /// Edges that are not regular, and that no sequence of flips makes regular. They end at a vertex that its weight
  /// hides.
  std::vector<HalfedgeId> stuck;
  /// The hidden vertices, by number: their power cells are empty in the regular triangulation of the domain. A vertex
  /// at a corner of the boundary or of constrained edges is named if an edge at it is stuck.
  std::vector<VertexId> hidden;
  /// The hidden vertices that were removed (HiddenPolicy::remove), in this order. The caller may then call
  /// Mesh::compact().
  std::vector<VertexId> removed;
  /// The mesh is unchanged, because a vertex was hidden (HiddenPolicy::undo). Then flips is 0 and stuck is empty.
  bool undone = false;
  /// Says whether every unconstrained interior edge is regular now.
  [[nodiscard]] bool regular() const { return stuck.empty() && !undone; }
};

/// An observer of each change as it happens, for traces, with the numbers of the vertices. Functions may be empty.
struct RestorationObserver {
  /// Called just before a flip. Edge a→b has c on its left and d on its right; d→c replaces it in a→b's slot (flip()).
  std::function<void(VertexId a, VertexId b, VertexId c, VertexId d)> flipped;
  /// Called just before remove_vertex(mesh, plan).
  std::function<void(const RemovalPlan& plan)> removing;
  /// Called when all flips of this call have been taken back.
  std::function<void()> undone;
};

/// Runs Lawson's algorithm on all edges. It flips until every unconstrained interior edge is regular or stuck, then
/// treats hidden vertices by the policy. It always ends, because every flip lowers the lifted surface. Precondition:
/// all triangles counter-clockwise. About n flips in practice, O(n²) at worst.
///
///     const Restoration restored = restore_regularity(mesh);
///     if (!restored.regular()) { … }  // the weights of restored.hidden are too small, or a neighbor's too large
Restoration restore_regularity(Mesh& mesh, HiddenPolicy policy = HiddenPolicy::keep,
                               const RestorationObserver* observer = nullptr);

// --- flip thresholds: §2.4 of the paper ---------------------------------------------------------------
//
// Let p(t) = p + t s be the moving vertex, with s = (s_x, s_y, s_w), and i, j, k three other vertices, all relative to
// p. Eq. 9 gives the power product of triangle ijk with p(t). Its expansion along the row of p(t) is eq. 10:
//   F(t) = −A + t (B s_x − C s_y − D s_w) + t² D (s_x² + s_y²),      D = 2 area(ijk).
// It is quadratic in t. If only the weight changes, it is linear with the root −A/D. Two kinds of edges can stop being
// regular. For an edge of the link of v, ijk is the triangle beyond. For a spoke, ijk are three consecutive vertices of
// the link. The threshold is the least root over both kinds. Before it no edge of the mesh flips, and no vertex is
// hidden: the edges around a vertex stop being regular no later than its power cell vanishes.

/// The threshold if no edge flips at any distance.
inline constexpr double kNoThreshold = std::numeric_limits<double>::infinity();

/// The least t ≥ 0 beyond which a regular unconstrained edge of v's star or link stops being regular, when v moves
/// along `step`. Returns kNoThreshold if there is none. In `step`, x and y are lengths and w is a squared length; on
/// the sphere it has X, Y and Z. t is a pure number, a multiple of the step. It is 0 if such an edge is a tie
/// (cocircular in the power sense) and any move along the step breaks it. Edges that are not regular now, constrained
/// edges and the boundary do not count. Triangles may turn over on the way. Computed in doubles: near the threshold
/// only is_regular decides. O(degree).
[[nodiscard]] double flip_threshold(const Mesh& mesh, VertexId v, const std::array<double, 3>& step);

/// The least change of v's weight [length²] beyond which an edge flips. A positive direction means upwards, a negative
/// one downwards. The result is never negative, and kNoThreshold if no change in that direction flips an edge. v is not
/// hidden before.
///
///     const double up = weight_flip_threshold(mesh, v, +1);  // regular for weights from w to w + up
[[nodiscard]] double weight_flip_threshold(const Mesh& mesh, VertexId v, double direction);

/// The distance that v may move along `direction` with constant weight before an edge flips. The unit is the length of
/// `direction`: the place is p + threshold · direction. kNoThreshold if the line meets no flip, or the direction is
/// zero. Precondition: the mesh lies in the plane.
[[nodiscard]] double position_flip_threshold(const Mesh& mesh, VertexId v, Vec2 direction);

}  // namespace temper
