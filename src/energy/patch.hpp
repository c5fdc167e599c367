// The patch P(p) of the paper: the star of one vertex, and the energy as a function of this vertex alone.
//
//              q2 ------- q1            triangle i = (center, q_i, q_{i+1}), counter-clockwise
//             /  \  t1  /   \           spoke i    = center → q_i
//            /  t2\    /  t0 \          link edge i = q_i → q_{i+1}; its outer triangle, across it, does not
//          q3 ---- center --- q0                     change shape; in E_T its height decides a sign
//
// A boundary center has one point more than it has triangles. The arrays are reused from vertex to vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "energy/star_kernels.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct Patch {
  Space space;
  VertexId center;
  bool closed = true;                      ///< an interior vertex
  std::vector<VertexId> link;              ///< of q_0 … q_{n−1}, and q_n when open
  std::vector<HalfedgeId> spoke;           ///< center → q_i, one for each triangle
  std::vector<double> x, y, w;             ///< points q_0 … q_n, where q_n is q_0 again when closed; longer than that
  std::vector<double> outer_g;             ///< h ℓ of link edge i in its outer triangle; empty unless gathered
  std::vector<double> outer_doubled_area;  ///< of that triangle; as long as outer_g
  std::vector<std::uint8_t> link_boundary;  ///< link edge i is a boundary edge; as long as outer_g

  /// Forgets the star, and keeps the memory.
  void clear() {
    link.clear(), spoke.clear();
    outer_g.clear(), outer_doubled_area.clear(), link_boundary.clear();
  }
  [[nodiscard]] std::size_t size() const { return spoke.size(); }
  [[nodiscard]] WeightedPoint q(std::size_t i) const { return {x[i], y[i], w[i]}; }
  [[nodiscard]] WeightedPoint r(std::size_t i) const { return q(i + 1); }
  [[nodiscard]] LinkArrays arrays() const { return {x.data(), y.data(), w.data(), size()}; }
};

/// Fills patch with the star of v; outer heights only for energies without barrier, which need signs.
void gather_patch(const Mesh& mesh, VertexId v, bool with_outer, Patch& patch);

/// Says whether the model looks across link edges and at boundary flags.
[[nodiscard]] inline bool needs_outer(EnergyKind kind) { return !energy_info(kind).barrier; }

/// The patch's energy with its center at p. +∞ outside the domain of a barrier.
[[nodiscard]] double patch_energy(const Patch& patch, const EnergyModel& model, const WeightedPoint& p);

/// Value, gradient and Hessian at p, on the sphere in its chart.
[[nodiscard]] VertexDerivatives patch_derivatives(const Patch& patch, const EnergyModel& model, const WeightedPoint& p);

/// The energy of the two triangles at an interior edge, and of everything that flipping it changes:
/// total(after) − total(before) = flip_energy(after) − flip_energy(before).
[[nodiscard]] double flip_energy(const Mesh& mesh, const EnergyModel& model, HalfedgeId h);

/// Adds the parts of triangles first … last − 1 and their edges in the HOT energies to `sums`, one entry per model.
/// Entries of barriers stay.
void add_hot_energies(const Mesh& mesh, std::span<const EnergyModel> models, std::size_t first, std::size_t last,
                      std::span<double> sums);

/// An edge in one of its triangles, h measured towards the third corner.
struct EdgeInTriangle {
  EdgeShape edge;
  double doubled_area;
};
/// The edge pq of triangle pqr.
[[nodiscard]] EdgeInTriangle edge_in_triangle(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                              const WeightedPoint& r);

/// The factor of an edge's HOT energy: a sign, and for E_F the treatment at the boundary. g and g_other are same-side
/// heights of the edge in its two triangles; g_other is 0 on the boundary.
[[nodiscard]] double hot_factor(const EnergyModel& model, double g, double g_other, bool boundary);

}  // namespace temper
