// A constant diffusion tensor K, and the plane in which it becomes a number.
//
// Two-point fluxes of −div(K ∇u) = f need dual edges at right angles to edges in the metric M = K⁻¹: e · K⁻¹ e* = 0.
// With y = B x and B = (det K)^¼ K^−½, this is a right angle of the plane, and
//
//     −div_x(K ∇_x u) = −√(det K) div_y(∇_y u).
//
// So a mesh is mapped to this plane, improved and measured there without any tensor, and mapped back. B changes no
// area. The stars of vertices and triangles do not change, and ★1 and fluxes only need the factor √(det K). Weights
// belong to the metric: mapping does not change them.
#pragma once

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A symmetric tensor.
struct Tensor {
  double xx = 1, xy = 0, yy = 1;
  friend bool operator==(const Tensor&, const Tensor&) = default;
};

class Metric {
 public:
  /// The metric of K = 1.
  Metric() = default;
  /// Makes the metric of a tensor. Error: the tensor is not positive definite, not finite, or the ratio of its
  /// eigenvalues is too large for doubles (10⁸).
  [[nodiscard]] static Expected<Metric> of(const Tensor& tensor);

  [[nodiscard]] const Tensor& tensor() const { return tensor_; }
  [[nodiscard]] Vec2 to_metric(Vec2 x) const { return {to_.xx * x.x + to_.xy * x.y, to_.xy * x.x + to_.yy * x.y}; }
  [[nodiscard]] Vec2 from_metric(Vec2 y) const {
    return {from_.xx * y.x + from_.xy * y.y, from_.xy * y.x + from_.yy * y.y};
  }
  /// The factor √(det K) between ★1 and fluxes of the mapped mesh and those for K.
  [[nodiscard]] double strength() const { return strength_; }

 private:
  Tensor tensor_, to_, from_;  // K, B and its inverse
  double strength_ = 1;
};

/// Maps a mesh to the plane of the metric. Numbers, flags and weights stay. Errors, in the user's numbers: a mesh of
/// the sphere; a triangle that turns over by rounding. O(n).
[[nodiscard]] Expected<Mesh> mapped(const Mesh& mesh, const Metric& metric, const InputNames& names = {});

/// Maps a changed mesh back to the plane of `original`. Vertices that have not moved since mapped(original), such
/// as boundary and fixed vertices, get their place from there, bit for bit. `vertices`: number of each vertex in
/// `original`, as in OptimizeReport; empty: the same numbers. Errors as for mapped().
[[nodiscard]] Expected<Mesh> mapped_back(const Mesh& changed, const Mesh& original, const Metric& metric,
                                         const IdVector<VertexId, VertexId>& vertices = {});

}  // namespace temper
