// The energy of the accuracy objective: HOT split into its two parts, over the local size, behind a barrier.
//
// Consider an interior edge of length ℓ between triangles with heights h_k and h_l. Its dual length is D = h_k + h_l.
// The weighted midpoint is δ = (w_i − w_j)/(2ℓ) from the midpoint of the edge, and the edge is η = (h_k − h_l)/2 from
// the midpoint of its dual. The four half-edge terms of E_F = α d³h + β d h³ are then
//
//     ℓD [ (α ℓ² + β D²)/4 + 3 (α δ² + β η²) ]
//
// (d = ℓ/2 ± δ, so Σ d³ = ℓ³/4 + 3ℓδ²; likewise h = D/2 ± η.) The first part is a moment that no mesh of this size
// avoids. The second part measures how far the midpoints of edge and dual are apart. To first order the error of a
// diagonal ★ is proportional to that. So the offset counts c times as much as in HOT. On the boundary the dual ends on
// the edge: D = h and η = h/2. That offset cannot be avoided, and counts c_b times. With the size s_e at the edge,
//
//     E = Σ_edges s_e⁻² ℓD [ (α ℓ² + β D²)/4 + 3 (c α δ² + (c or c_b) β η²) ],    c = c_b = 1: E_F / s_e²
//
// which is rational in positions and weights. Let L = ℓ², δw = w_i − w_j, G = g_k + g_l and H = g_k − g_l. Then ℓD = G,
// D² = G²/L, δ² = δw²/(4L), η² = H²/(4L). Scaling exponent 2, with the sizes. It is below zero only if a dual is;
// comparisons of meshes use its absolute value. (The units of E_F suggest s⁻⁴. But with sizes tied to vertices its
// minimum has ℓ ~ s², so that grading grows; s⁻² is neutral.)
//
// Behind it stands the barrier − μ Σ_triangles k s_t² Σ_edges [ln(h/ℓ − f) + ½ ln(d_ij/ℓ − f) + ½ ln(d_ji/ℓ − f)], with
// the floor f ≤ ε of the triangle and k = 1 + 10 (ε²/f² − 1). It is +∞ if a triangle is below its floor: see
// AccuracyFloors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/engine.hpp"
#include "energy/accuracy_edge.hpp"
#include "energy/accuracy_star.hpp"
#include "temper/detail/executor.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper {

// Floors of the lengths of edges and dual edges, for the barrier of the accuracy objective: the shortest of them limits
// the time step of explicit schemes.
//
// Let s be the mean of the local sizes at its ends. An interior edge that is longer than X s stays so, and likewise a
// dual longer than Y s. A shorter one stays longer than a part of its length, behind a barrier that rises from sweep to
// sweep, and so grows. Local sizes are the sizes of the current mesh, but no floor falls when they do: otherwise edges
// and sizes would chase each other.

class LengthFloors {
 public:
  /// Raises the floors to the lengths of the mesh; they never fall. Returns the number of edges below their floors that
  /// have gained since the last call. `sizes`: local ones, of the mesh.
  std::size_t raise(const Mesh& mesh, const IdVector<VertexId, double>& sizes, const AccuracyModel& model,
                    Executor* executor = nullptr);

  /// The barrier of an interior edge.
  [[nodiscard]] const LengthBarrier<double>& operator()(const Mesh& mesh, HalfedgeId h) const {
    return floors_[mesh.is_edge_representative(h) ? h : mesh.twin(h)];
  }

 private:
  IdVector<HalfedgeId, LengthBarrier<double>> floors_;  // at the representative
};

using VertexSizes = IdVector<VertexId, double>;

/// Σ |E| over all edges, without barrier: defined for every mesh, equal for any executor. O(n).
[[nodiscard]] double accuracy_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model,
                                     Executor* executor = nullptr);

/// The least of h/ℓ, d/ℓ and 1 − d/ℓ over the edges of the triangle, in doubles.
[[nodiscard]] double triangle_margin(const Mesh& mesh, TriangleId t);

/// The part of a margin below ε that a triangle keeps: the barrier must be finite in the current mesh. A thin one gets
/// more room, with which its neighbors let it grow.
[[nodiscard]] inline double kept_margin(double now, double margin) {
  return 0.9 * now * std::sqrt(std::min(1.0, 2 * now / margin));
}

/// Says whether every triangle is well-centered, exactly, with a margin of more than `margin`.
[[nodiscard]] bool has_margins(const Mesh& mesh, double margin, Executor* executor = nullptr);

/// The ε of each triangle. It is the model's ε if the triangle has more, else a little less than the triangle has. A
/// triangle has none if it is not well-centered, or so barely that its heights are rounding. Nearly all triangles have
/// the model's ε: blocks in which all do take no memory.
class AccuracyFloors {
 public:
  /// Raises the floor of each triangle whose margin has grown, never lowers one. Returns how many it raised. `margin`
  /// is the same each time.
  std::size_t raise(const Mesh& mesh, double margin, Executor* executor = nullptr);
  /// Says whether t has a floor. A triangle without one is no part of the barrier, and must stay as it is.
  [[nodiscard]] bool has(TriangleId t) const { return (*this)[t] > 0; }
  [[nodiscard]] double operator[](TriangleId t) const {
    const auto& block = blocks_[t.index / kBlock];
    return block.empty() ? margin_ : block[t.index % kBlock];
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Bytes of the arrays, without the lengths.
  [[nodiscard]] std::size_t memory_bytes() const;

  LengthFloors lengths;  ///< if the model has floors of lengths

 private:
  static constexpr std::size_t kBlock = 32;  // few triangles have less, and each of them costs a block

  std::size_t raise_block(const Mesh& mesh, std::size_t block, bool first);

  std::size_t size_ = 0;
  double margin_ = 0;
  std::vector<std::vector<double>> blocks_;  // empty: all of its triangles have the margin
};

/// The domain of the accuracy energy on one mesh: sizes at its vertices, floors of its triangles.
struct AccuracyDomain {
  VertexSizes sizes;
  AccuracyFloors floors;
};

/// Energy, if requested, and barrier of the whole mesh. The barrier is a sum over triangles that have a floor.
struct AccuracyTotal {
  double energy = 0, barrier = 0;
};
[[nodiscard]] AccuracyTotal accuracy_total(const Mesh& mesh, const AccuracyDomain& domain, const AccuracyModel& model,
                                           const Engine& engine = nullptr, bool with_energy = true);

/// The derivatives of energy + barrier by each vertex: in x, y and w, on the sphere in its chart. A vertex has 0 if a
/// triangle of its star, or across its link, has no floor. Precondition: energy + barrier is finite. O(n).
[[nodiscard]] IdVector<VertexId, WeightedPoint> accuracy_gradient(const Mesh& mesh, const AccuracyDomain& domain,
                                                                  const AccuracyModel& model, Executor* executor);

/// Energy and barrier as a function of one vertex. Storage is kept from vertex to vertex.
class AccuracyPatch {
 public:
  /// False when a triangle of the star, or across its link, has no floor.
  bool gather(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors, const AccuracyModel& model,
              VertexId v);

  /// Energy and barrier of all that depends on the center, at p: total after − total before = value after − value
  /// before. +∞ if a triangle turns over or is not above its floor.
  [[nodiscard]] double value(const WeightedPoint& p);
  /// All derivatives at the point of the last call of value(), which was finite.
  [[nodiscard]] VertexDerivatives derivatives();
  /// Says whether all triangles of the star are well-centered with the center at p, exactly.
  [[nodiscard]] bool is_well_centered(const WeightedPoint& p) const;
  /// The length of the shortest spoke.
  [[nodiscard]] double shortest_spoke(const WeightedPoint& p) const;

 private:
  template <class In>
  struct Star {
    std::vector<AccuracySpoke<In>> spokes;  // one more than triangles
    std::vector<AccuracyTriangle<In>> triangles;

    [[nodiscard]] AccuracyStarOf<In> view(const AccuracyModel& model, bool open);
  };

  Star<InPlaneOf<double>> in_plane_;
  Star<OnSphereOf<double>> on_sphere_;
  Space space_;
  const AccuracyModel* model_ = nullptr;
  bool open_ = false;
  WeightedPoint at_;  // where value() was asked for last
  double value_ = 0;
};

}  // namespace temper
