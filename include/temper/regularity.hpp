// Regularity (the weighted Delaunay property) of unconstrained interior edges: test it, restore it, and say how far one
// vertex may go before it is lost (§2.4 of the paper).
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

/// Is the dual length of the edge of h zero or more? Exact; cocircular in the power sense is regular. Boundary edges
/// always are.
[[nodiscard]] bool is_regular(const Mesh& mesh, HalfedgeId h);

/// Interior edges that are not regular; with constrained ones or without. On the executor's threads when there is one.
[[nodiscard]] std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained = true,
                                                  Executor* executor = nullptr);

/// The fate of vertices whose power cell is empty: no regular triangulation has them.
enum class HiddenPolicy {
  undo,    ///< put the mesh back as it was, bit for bit, when any vertex is hidden
  remove,  ///< remove them: inside the domain, and on straight parts of the boundary and of interfaces; others stay
  keep,    ///< leave them in, with the edges that run into them not regular, and report both
};

/// The result of restore_regularity.
struct Restoration {
  std::size_t flips = 0;
  /// Edges that are not regular and that no flip sequence cures: they run into a vertex hidden by its weight.
  std::vector<HalfedgeId> stuck;
  /// The hidden vertices, by number: those whose power cell is empty in the regular triangulation of the domain. A
  /// vertex at a corner of the boundary or of constrained edges is named when an edge is stuck at it.
  std::vector<VertexId> hidden;
  /// The hidden vertices that were removed (HiddenPolicy::remove), in this order. Mesh::compact() is left to the
  /// caller.
  std::vector<VertexId> removed;
  /// The mesh is what it was (HiddenPolicy::undo, and some vertex hidden). Flips and stuck edges are then none.
  bool undone = false;
  /// Says whether every unconstrained interior edge is regular now.
  [[nodiscard]] bool regular() const { return stuck.empty() && !undone; }
};

/// An observer sees each change as it happens, for traces: in the vertices' numbers. Functions may be empty.
struct RestorationObserver {
  /// Just before: edge a→b, with c on its left and d on its right, is replaced by d→c in a→b's slot (flip()).
  std::function<void(VertexId a, VertexId b, VertexId c, VertexId d)> flipped;
  /// Just before remove_vertex(mesh, plan).
  std::function<void(const RemovalPlan& plan)> removing;
  /// Called when all flips seen since the call began have been taken back.
  std::function<void()> undone;
};

/// Lawson's algorithm on all edges: flips until every unconstrained interior edge is regular or stuck, then treats
/// hidden vertices by the policy. Precondition: all triangles counter-clockwise. Ends always (every flip lowers the
/// lifted surface). About n flips in practice, O(n²) at worst.
///
///     const Restoration restored = restore_regularity(mesh);
///     if (!restored.regular()) { … }  // the weights of restored.hidden are too small, or a neighbor's too large
Restoration restore_regularity(Mesh& mesh, HiddenPolicy policy = HiddenPolicy::keep,
                               const RestorationObserver* observer = nullptr);

// --- flip thresholds: §2.4 of the paper ---------------------------------------------------------------
//
// Let p(t) = p + t s be the vertex on its way, s = (s_x, s_y, s_w), and i, j, k three other vertices, all seen from p.
// The power product of triangle ijk with p(t) (eq. 9), expanded along the row of p(t), is the paper's eq. 10:
//   F(t) = −A + t (B s_x − C s_y − D s_w) + t² D (s_x² + s_y²),      D = 2 area(ijk),
// quadratic in t, and linear, with the root −A/D, when the weight alone changes. Two kinds of edges can cease to be
// regular: edges of the link of v (ijk is the triangle beyond), and spokes (ijk are three consecutive vertices of the
// link). The threshold is the least root over both. Before it no edge of the mesh flips, and no vertex is hidden: the
// edges around a vertex cease to be regular no later than its power cell vanishes.

/// The threshold that says that no edge flips, however far one goes.
inline constexpr double kNoThreshold = std::numeric_limits<double>::infinity();

/// The least t ≥ 0 past which an unconstrained edge of v's star or link that is regular now is not when v moves along
/// `step` (x and y in units of length, w in units of length²; on the sphere X, Y and Z); kNoThreshold when there is
/// none. t is a pure number, the multiple of the step. It is 0 when such an edge is a tie (cocircular in the power
/// sense) and any move along the step breaks it. Edges not regular as it is, constrained ones and the boundary do not
/// count; nor does it matter whether triangles turn over on the way. In doubles: near it, only is_regular decides.
/// O(degree).
[[nodiscard]] double flip_threshold(const Mesh& mesh, VertexId v, const std::array<double, 3>& step);

/// The least change of v's weight [length²], upwards when direction is positive and downwards when it is negative,
/// past which an edge flips; never negative, kNoThreshold when no change that way flips any. v is not hidden before.
///
///     const double up = weight_flip_threshold(mesh, v, +1);  // regular for weights from w to w + up
[[nodiscard]] double weight_flip_threshold(const Mesh& mesh, VertexId v, double direction);

/// The distance that v may go along `direction`, its weight as it is, before an edge flips: in units of the direction's
/// length, so that p + threshold · direction is the place. kNoThreshold when the line meets none, or the direction is
/// zero. Precondition: the mesh lies in the plane.
[[nodiscard]] double position_flip_threshold(const Mesh& mesh, VertexId v, Vec2 direction);

}  // namespace temper
