// Heights and splits as linear functions of the weights, over the length of their edge.
//
//   height  h/ℓ = (D_r + (D_p w_q + D_q w_p)/ℓ² − w_r) / (2 S)      D_p = (q − p)·(r − p), …; S twice the area
//   split   d/ℓ = 1/2 + (w_p − w_q)/(2 ℓ²)
//
// The coefficients of one form sum to zero: a constant on all weights changes nothing.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/feasibility.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct LinearForm {
  int size = 0;  ///< 3 for a height, 2 for a split
  std::array<VertexId, 3> vertices;
  std::array<double, 3> coefficients = {};
  double constant = 0;
};

[[nodiscard]] LinearForm linear_form(const Mesh& mesh, const WeightConstraint& constraint);

/// Its value where weight_of(v) are the weights. By differences, so that a large weight common to all costs no digits.
template <class WeightOf>
double value_of(const LinearForm& form, const WeightOf& weight_of) {
  const double first = weight_of(form.vertices[0]);
  double value = form.constant;
  for (int k = 1; k < form.size; ++k) value += form.coefficients[k] * (weight_of(form.vertices[k]) - first);
  return value;
}

/// The height over the edge of h in its triangle, and the splits of an edge from either end.
[[nodiscard]] WeightConstraint height_constraint(const Mesh& mesh, HalfedgeId h);
[[nodiscard]] WeightConstraint split_constraint(VertexId from, VertexId to);

/// The edges of these triangles, each once, by a halfedge that is in one of them. `triangles` is sorted.
[[nodiscard]] std::vector<HalfedgeId> edges_of(const Mesh& mesh, std::span<const TriangleId> triangles);
/// The corners of these triangles, sorted, each once.
[[nodiscard]] std::vector<VertexId> vertices_of(const Mesh& mesh, std::span<const TriangleId> triangles);
/// The constraints of these triangles: three heights each, and two splits an edge.
[[nodiscard]] std::vector<WeightConstraint> constraints_of(const Mesh& mesh, std::span<const TriangleId> triangles,
                                                           Conditions conditions);

}  // namespace temper
