// A constant diffusion tensor K, and the plane in which it is a number.
//
// Two-point fluxes of −div(K ∇u) = f need dual edges at right angles to edges in the metric M = K⁻¹: e · K⁻¹ e* = 0.
// With y = B x, B = (det K)^¼ K^−½, that is a right angle of the plane, and
//
//     −div_x(K ∇_x u) = −√(det K) div_y(∇_y u).
//
// So a mesh is mapped there, improved and measured by all that knows no tensor, and mapped back. B changes no area:
// stars of vertices and triangles are those of the mesh as it was, and ★1 and fluxes want the factor √(det K) alone.
// Weights are of the metric: they stay with their vertices on the way, as they are.
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
  /// That of K = 1.
  Metric() = default;
  /// Error: a tensor that is not positive definite, or not finite, or whose eigenvalues are so far apart (10⁸) that
  /// doubles have no room for it.
  [[nodiscard]] static Expected<Metric> of(const Tensor& tensor);

  [[nodiscard]] const Tensor& tensor() const { return tensor_; }
  [[nodiscard]] Vec2 to_metric(Vec2 x) const { return {to_.xx * x.x + to_.xy * x.y, to_.xy * x.x + to_.yy * x.y}; }
  [[nodiscard]] Vec2 from_metric(Vec2 y) const {
    return {from_.xx * y.x + from_.xy * y.y, from_.xy * y.x + from_.yy * y.y};
  }
  /// √(det K): what ★1 and fluxes of the mapped mesh are times, in those of K.
  [[nodiscard]] double strength() const { return strength_; }

 private:
  Tensor tensor_, to_, from_;  // K, B and its inverse
  double strength_ = 1;
};

/// The mesh in the plane of the metric: the same numbers, flags and weights. Errors: a mesh of the sphere; a triangle
/// that turns over by rounding, in the user's numbers. O(n).
[[nodiscard]] Expected<Mesh> mapped(const Mesh& mesh, const Metric& metric, const InputNames& names = {});

/// A mesh that was mapped, and then changed, in the plane of the one that it comes from. Vertices that are where
/// `original` has them, as those of the boundary and fixed ones, get their places from there, bit for bit. `vertices`:
/// the number in `original` of each vertex, as OptimizeReport has it; empty: the same. Errors as above.
[[nodiscard]] Expected<Mesh> mapped_back(const Mesh& changed, const Mesh& original, const Metric& metric,
                                         const IdVector<VertexId, VertexId>& vertices = {});

}  // namespace temper
