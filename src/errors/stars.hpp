// The diagonal stars on smooth forms: exact integrals over cells against exact integrals over their duals.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "errors/fields.hpp"
#include "temper/dec.hpp"
#include "temper/errors.hpp"
#include "temper/surfaces.hpp"

namespace temper::error_detail {

struct Setting {
  const Mesh& mesh;
  const DecComplex& dec;
  FieldFrame frame;
  double area = 0;  ///< of the domain, in the frame
  Executor* executor = nullptr;
  bool is_closed = false;                          ///< without boundary: nothing is given on a boundary
  const surfaces::SurfaceMesh* surface = nullptr;  ///< if it is one, with `mesh` as its connectivity
  double center_z = 0;                             ///< of the frame, for a surface

  [[nodiscard]] bool is_plane() const { return surface == nullptr && mesh.space().is_plane(); }
  [[nodiscard]] Vec2 in_frame(Vec2 p) const { return (1 / frame.half_size) * (p - frame.center); }
  [[nodiscard]] Place in_frame(Vec3 p) const {
    return (1 / frame.half_size) * (p - Vec3{frame.center.x, frame.center.y, center_z});
  }
  [[nodiscard]] double length_in_frame(double length) const { return length / frame.half_size; }
  [[nodiscard]] double area_in_frame(double area_of_mesh) const {
    return area_of_mesh / frame.half_size / frame.half_size;
  }
  [[nodiscard]] Place vertex(VertexId v) const {
    if (surface != nullptr) return in_frame(surface->position(v));
    if (is_plane()) return in_frame(mesh.position(v));
    return unit(mesh.weighted_vector(v));
  }
  [[nodiscard]] Place orthocenter(TriangleId t) const {
    if (surface != nullptr) return in_frame(dec.sphere_orthocenters[t]);
    if (is_plane()) return in_frame(dec.orthocenters[t]);
    return unit(dec.sphere_orthocenters[t]);
  }
  [[nodiscard]] Place midpoint(EdgeId e) const {
    if (surface != nullptr) return in_frame(dec.sphere_midpoints[e]);
    if (is_plane()) return in_frame(dec.edges[e].midpoint);
    return unit(dec.sphere_midpoints[e]);
  }
  [[nodiscard]] static Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }
};

/// +1 where the domain is on the left of a boundary edge, −1 where it is on the right.
inline double inner_side(const DecEdge& edge) { return edge.left.valid() ? 1 : -1; }

/// The triangle at a boundary edge.
inline TriangleId inner_triangle(const DecEdge& edge) { return edge.left.valid() ? edge.left : edge.right; }

/// Unit vector from `from` to `to`, in the coordinates of the edge's means: x and y of the plane, or on the sphere
/// along the edge and to its left.
inline Vec2 direction(const Setting& setting, const DecEdge& edge) {
  if (!setting.is_plane()) return {1, 0};
  const WeightedPoint from = setting.mesh.point(edge.from), to = setting.mesh.point(edge.to, from);
  return (1 / edge.length) * (to.position() - from.position());
}
/// A vector turned a quarter turn to the left.
inline Vec2 turned_left(Vec2 t) { return {-t.y, t.x}; }
inline Vec2 turned_right(Vec2 t) { return {t.y, -t.x}; }

/// Errors are reported as +∞ and never as NaN.
inline double finite_or_infinity(double value) { return std::isfinite(value) ? value : HUGE_VAL; }

// Means of a field along each edge and its dual edge: the stars and the right-hand sides are made of them. Areas need
// no quadrature of their own: ∫ u = ∮ V · n with div V = u, and ∫ Δu = ∮ ∇u · n.

/// Vectors in the coordinates of direction(): x, y of the plane, or along and to the left of the edge. (On the sphere
/// these two directions turn along an arc.)
struct EdgeMeans {
  Vec2 gradient;        ///< of ∇u, along the edge
  Vec2 dual_gradient;   ///< along the dual edge
  Vec2 potential;       ///< of V, along the edge
  Vec2 dual_potential;  ///< along the dual edge
  Vec2 from_potential;  ///< on the boundary: from `from` to the weighted midpoint
  Vec2 to_potential;    ///< and from there to `to`
};

/// The means over each edge, computed on the executor's threads; equal for any executor.
[[nodiscard]] IdVector<EdgeId, EdgeMeans> edge_means(const Setting& setting, const Field& field);

/// The error of the mean over each vertex, edge and triangle, relative to the form's size.
using LocalErrors = std::array<std::vector<double>, 3>;

/// Relative errors of ★0, ★1, ★2: see ErrorReport::local.
[[nodiscard]] LocalErrors local_star_errors(const Setting& setting, const Field& field,
                                            const IdVector<EdgeId, EdgeMeans>& means);

/// |σ| |∗σ| of each vertex, edge and triangle, in the frame: the weights of their errors. These are areas and lengths
/// of the pieces, without their signs.
[[nodiscard]] LocalErrors star_weights(const Setting& setting);

/// √(Σ weight · error² / (area · n)) and the largest error; n is 2 of ★1, whose weights make twice the area.
[[nodiscard]] std::array<ErrorNorms, 3> star_norms(const Setting& setting, const LocalErrors& weights,
                                                   const LocalErrors& errors);

/// √(Σ weight · error²), and the largest |error|: summed in blocks, with a result that is never NaN.
[[nodiscard]] ErrorNorms norms_of(const std::vector<double>& weights, const std::vector<double>& errors);

}  // namespace temper::error_detail
