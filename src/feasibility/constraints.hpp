// Heights, crossings and dual lengths as linear functions of the potentials (potential.hpp), over the length of their
// edge.
//
// In the plane, of the weights:
//
//   height  h/ℓ = (D_r + (D_p w_q + D_q w_p)/ℓ² − w_r) / (2 S)      D_p = (q − p)·(r − p), …; S twice the area
//   crossing   d/ℓ = 1/2 + (w_p − w_q)/(2 ℓ²)
//   dual    (h_r + h_s)/ℓ, the sum of the heights over either side
//
// The coefficients of one form sum to zero: a constant on all weights changes nothing.
//
// On the sphere, of σ = R/|P|, where p, q, r are places, D = det(p, q, r), and m = (σ_p + σ_q)/2:
//
//   height  R³/D (σ_r + ((p×q)·(q×r) σ_p + (p×q)·(r×p) σ_q)/|p×q|²) / m      R tan h/ℓ, were all σ one
//   crossing   (R² σ_q − p·q σ_p)/|p − q|² / m                                    1/2; the two of an edge sum to one
//   dual    the sum of the heights over either side / m
//
// All have the signs of h, d and the dual length. They do not change with σ times a number, and tend to the plane's
// values.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "feasibility/potential.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct LinearForm {
  int size = 0;  ///< 3 for a height, 2 for a crossing, 4 for a dual
  std::array<VertexId, 4> vertices;
  std::array<double, 4> coefficients = {};
  double constant = 0;
  double slope =
      0;  ///< m = 1 − slope · the mean of the first two potentials; the coefficients sum to −slope · constant
};

[[nodiscard]] LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint);
/// The form that is ≥ 0 if and only if the value of this one is ≥ margin.
[[nodiscard]] LinearForm beyond_margin(LinearForm form, double margin);

/// m for the potentials potential(v): one in the plane.
template <class Potential>
double scale_of(const LinearForm& form, const Potential& potential) {
  return 1 - 0.5 * form.slope * (potential(form.vertices[0]) + potential(form.vertices[1]));
}
/// The linear function, by differences, so that a large potential common to all costs no digits.
template <class Potential>
double numerator_of(const LinearForm& form, const Potential& potential) {
  const double first = potential(form.vertices[0]);
  double value = form.constant * (1 - form.slope * first);
  for (int k = 1; k < form.size; ++k) value += form.coefficients[k] * (potential(form.vertices[k]) - first);
  return value;
}
/// h/ℓ, d/ℓ or dual length/ℓ.
template <class Potential>
double value_of(const LinearForm& form, const Potential& potential) {
  return numerator_of(form, potential) / scale_of(form, potential);
}

/// |p − q|² of places: on the sphere of the chord.
[[nodiscard]] double squared_distance(const Mesh& mesh, VertexId p, VertexId q);
[[nodiscard]] inline double squared_length_of(const Mesh& mesh, HalfedgeId h) {
  return squared_distance(mesh, mesh.origin(h), mesh.target(h));
}

/// The vertex with another weight; unchanged if it has this weight.
[[nodiscard]] inline WeightedPoint point_with_weight(const Mesh& mesh, VertexId v, double w) {
  const WeightedPoint p = mesh.point(v);
  return mesh.space().weight(p) == w ? p : mesh.space().with_weight(p, w);
}

/// The height over the edge of h in its triangle, the crossings of an edge from either end, and its dual length.
[[nodiscard]] WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h);
[[nodiscard]] WeightConstraint split_constraint(VertexId from, VertexId to);
/// Precondition: h is inside the mesh.
[[nodiscard]] WeightConstraint dual_constraint(const Mesh& mesh, HalfedgeId h);

/// Constraints on a mesh, with their edges.
class Demand {
 public:
  Demand(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges);

  [[nodiscard]] Constraints constraints() const { return constraints_; }
  [[nodiscard]] bool has_heights() const { return constraints_ != Constraints::regular; }
  [[nodiscard]] bool has_crossings() const { return constraints_ == Constraints::well_centered; }
  [[nodiscard]] bool has_duals() const { return constraints_ == Constraints::regular; }
  /// The margin that is refuted when no weights satisfy the constraints; `duals`: for dual lengths, in the plane.
  [[nodiscard]] double refuted_margin(double duals) const {
    return !has_duals() ? 0 : in_plane_ ? duals : kLeastRefutedDual;
  }
  /// Says whether the dual length of the edge of h counts.
  [[nodiscard]] bool has_dual(const Mesh& mesh, HalfedgeId h) const {
    return has_duals() && !mesh.is_boundary(h) && (prescribed_.empty() || prescribed_[h] != 0);
  }
  /// Says whether t satisfies all its constraints, exactly, with the weights weight_of(v).
  template <class WeightOf>
  [[nodiscard]] bool is_kept(const Mesh& mesh, TriangleId t, const WeightOf& weight_of) const {
    const auto at = [&](VertexId v) { return point_with_weight(mesh, v, weight_of(v)); };
    const Space& space = mesh.space();
    const auto [a, b, c] = mesh.corners(t);
    if (has_crossings()) return is_well_centered(space, at(a), at(b), at(c));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      const WeightedPoint p = at(mesh.origin(h)), q = at(mesh.target(h)), r = at(mesh.opposite(h));
      if (has_heights() && signed_height_sign(space, p, q, r) != Sign::positive) return false;
      if (!has_dual(mesh, h)) continue;
      if (power_test(space, p, q, r, at(mesh.opposite(mesh.twin(h)))) != Sign::negative) return false;
    }
    return true;
  }
  /// The least value of t's constraints with these weights, in doubles; kUnbounded when it has none.
  template <class WeightOf>
  [[nodiscard]] double margin_of(const Mesh& mesh, TriangleId t, const WeightOf& weight_of) const {
    double margin = kUnbounded;
    const auto potential = [&](VertexId v) { return potential_of(mesh.space(), weight_of(v)); };
    const auto value = [&](const WeightConstraint& c) { return value_of(linear_form(mesh, c), potential); };
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (has_heights()) margin = std::min(margin, value(height_constraint(mesh, h)));
      if (has_crossings()) {
        const double crossing = value(split_constraint(mesh.origin(h), mesh.target(h)));
        margin = std::min({margin, crossing, 1 - crossing});
      }
      if (has_dual(mesh, h)) margin = std::min(margin, value(dual_constraint(mesh, h)));
    }
    return margin;
  }

 private:
  Constraints constraints_;
  bool in_plane_;
  IdVector<HalfedgeId, std::uint8_t> prescribed_;  ///< none: every edge is
};

/// The edges of these triangles, each once, by a halfedge that is in one of them. `triangles` is sorted.
[[nodiscard]] std::vector<HalfedgeId> edges_of(const Mesh& mesh, std::span<const TriangleId> triangles);
/// The corners of these triangles, sorted, each once.
[[nodiscard]] std::vector<VertexId> vertices_of(const Mesh& mesh, std::span<const TriangleId> triangles);
/// The constraints of these triangles that the demand has: three heights each, two crossings per edge, and a dual
/// length per edge with both its triangles among them.
[[nodiscard]] std::vector<WeightConstraint> constraints_of(const Mesh& mesh, std::span<const TriangleId> triangles,
                                                           const Demand& demand);

}  // namespace temper
