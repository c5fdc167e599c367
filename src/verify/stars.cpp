#include "verify/stars.hpp"

#include <algorithm>
#include <cmath>

#include "base/sum.hpp"
#include "geometry/spherical_area.hpp"

namespace temper::verify_detail {
namespace {

/// ∫ u over each signed dual cell, by ∮ V · n around it: along its dual edges, and along the domain's boundary.
std::vector<double> dual_cell_integrals(const Setting& s, const IdVector<EdgeId, EdgeMeans>& means) {
  std::vector<double> integrals(s.mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const DecEdge& edge = s.dec.edges[EdgeId(i)];
    const EdgeMeans& mean = means[EdgeId(i)];
    const Vec2 t = direction(s, edge);
    const double across = dot(s.length_in_frame(edge.dual_length) * mean.dual_potential, t);
    integrals[edge.from.index] += across;
    integrals[edge.to.index] -= across;
    if (!edge.is_boundary()) continue;
    const Vec2 outward = inner_side(edge) * turned_right(t);
    integrals[edge.from.index] += dot(s.length_in_frame(edge.split) * mean.from_potential, outward);
    integrals[edge.to.index] += dot(s.length_in_frame(edge.length - edge.split) * mean.to_potential, outward);
  }
  return integrals;
}

/// ∫ u over each triangle, the same way.
std::vector<double> triangle_integrals(const Setting& s, const IdVector<EdgeId, EdgeMeans>& means) {
  std::vector<double> integrals(s.mesh.n_triangles(), 0.0);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const DecEdge& edge = s.dec.edges[EdgeId(i)];
    const double out_of_left =
        dot(s.length_in_frame(edge.length) * means[EdgeId(i)].potential, turned_right(direction(s, edge)));
    if (edge.left.valid()) integrals[edge.left.index] += out_of_left;
    if (edge.right.valid()) integrals[edge.right.index] -= out_of_left;
  }
  return integrals;
}

std::vector<double> unsigned_cells(const Setting& s) {
  std::vector<double> areas(s.mesh.n_vertices(), 0.0);
  for (const DecEdge& edge : s.dec.edges) {
    const double left = std::abs(edge.left_height), right = std::abs(edge.right_height);
    const auto part = [&](double d) {
      return s.area_in_frame(right_triangle_areas(s.mesh.space(), std::abs(d), left, right));
    };
    areas[edge.from.index] += part(edge.split);
    areas[edge.to.index] += part(edge.length - edge.split);
  }
  return areas;
}

}  // namespace

LocalErrors star_weights(const Setting& s) {
  LocalErrors weights;
  weights[0] = unsigned_cells(s);
  for (const DecEdge& edge : s.dec.edges) {
    weights[1].push_back(s.length_in_frame(edge.length) * s.length_in_frame(std::abs(edge.dual_length)));
  }
  for (const double area : s.dec.areas) weights[2].push_back(s.area_in_frame(area));
  return weights;
}

LocalErrors local_star_errors(const Setting& s, const Field& field, const IdVector<EdgeId, EdgeMeans>& means) {
  const FieldSize size = size_of(field);
  const std::vector<double> cells = unsigned_cells(s);
  LocalErrors errors;
  errors[0] = dual_cell_integrals(s, means);
  for (const VertexId v : s.mesh.vertices()) {
    double& error = errors[0][v.index];
    error -= s.area_in_frame(s.dec.star0[v]) * field.at(s.vertex(v)).u;
    // A cell of no area at all has no error.
    error = cells[v.index] > 0 ? std::abs(error) / cells[v.index] / size.value : 0;
  }
  for (const EdgeMeans& mean : means) {
    errors[1].push_back(length(mean.dual_gradient - mean.gradient) / size.gradient);
  }
  errors[2] = triangle_integrals(s, means);
  for (const TriangleId t : s.mesh.triangles()) {
    double& error = errors[2][t.index];
    error = std::abs(error / s.area_in_frame(s.dec.areas[t]) - field.at(s.orthocenter(t)).u) / size.value;
  }
  return errors;
}

ErrorNorms norms_of(const std::vector<double>& weights, const std::vector<double>& errors) {
  const double sum = blockwise_sum(errors.size(), nullptr, [&](std::size_t i) {
    return weights[i] == 0 ? 0.0 : weights[i] * errors[i] * errors[i];
  });
  double max = 0;
  for (const double error : errors) max = std::max(max, finite_or_infinity(std::abs(error)));
  return {finite_or_infinity(std::sqrt(sum)), max};
}

std::array<ErrorNorms, 3> star_norms(const Setting& setting, const LocalErrors& weights, const LocalErrors& errors) {
  std::array<ErrorNorms, 3> norms;
  for (std::size_t star = 0; star < norms.size(); ++star) {
    norms[star] = norms_of(weights[star], errors[star]);
    norms[star].l2 /= std::sqrt(setting.area * (star == 1 ? 2 : 1));
  }
  return norms;
}

}  // namespace temper::verify_detail
