#include "errors/stars.hpp"

#include <algorithm>
#include <cmath>

#include "base/sum.hpp"
#include "errors/fields.hpp"
#include "errors/surface_means.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"

namespace temper::error_detail {
namespace {

struct PathMean {
  Vec2 gradient, potential;

  void add(const FieldValue& value, Vec3 along, Vec3 left, double weight) {
    gradient = gradient + weight * Vec2{dot(along, value.gradient), dot(left, value.gradient)};
    potential = potential + weight * Vec2{dot(along, value.potential), dot(left, value.potential)};
  }
};

PathMean mean_along_segment(const Field& field, Vec2 a, Vec2 b) {
  PathMean mean;
  along_segment(a, b, [&](Vec2 p, double weight) { mean.add(field.at(p), {1, 0, 0}, {0, 1, 0}, weight); });
  return mean;
}

EdgeMeans means_in_plane(const Setting& s, const Field& field, const DecEdge& edge) {
  const WeightedPoint p = s.mesh.point(edge.from), q = s.mesh.point(edge.to, p);
  const Vec2 from = s.in_frame(p.position()), to = s.in_frame(q.position()), middle = s.in_frame(edge.midpoint);
  // The dual edge is straight: it runs along the normal from one orthocenter to the other, or back if it is negative.
  const Vec2 normal = turned_left(direction(s, edge));
  const Vec2 right = middle - s.length_in_frame(edge.right_height) * normal;
  const Vec2 left = middle + s.length_in_frame(edge.left_height) * normal;
  const PathMean primal = mean_along_segment(field, from, to), dual = mean_along_segment(field, right, left);
  EdgeMeans means = {primal.gradient, dual.gradient, primal.potential, dual.potential, {}, {}};
  if (edge.is_boundary()) {
    means.from_potential = mean_along_segment(field, from, middle).potential;
    means.to_potential = mean_along_segment(field, middle, to).potential;
  }
  return means;
}

/// The great circles of an edge and of its dual, which cross in its midpoint. Places are angles from there, positive
/// along the edge, and to the left on the dual.
struct Cross {
  Vec3 middle, along, left;

  [[nodiscard]] PathMean mean_of_edge(const Field& field, double a, double b) const {
    PathMean mean;
    along_segment({a, 0}, {b, 0}, [&](Vec2 angle, double weight) {
      const double c = std::cos(angle.x), s = std::sin(angle.x);
      mean.add(field.at(c * middle + s * along), c * along - s * middle, left, weight);
    });
    return mean;
  }
  [[nodiscard]] PathMean mean_of_dual(const Field& field, double a, double b) const {
    PathMean mean;
    along_segment({a, 0}, {b, 0}, [&](Vec2 angle, double weight) {
      const double c = std::cos(angle.x), s = std::sin(angle.x);
      mean.add(field.at(c * middle + s * left), along, c * left - s * middle, weight);
    });
    return mean;
  }
};

EdgeMeans means_on_sphere(const Setting& s, const Field& field, EdgeId e) {
  const DecEdge& edge = s.dec.edges[e];
  const Vec3 p = s.mesh.weighted_vector(edge.from), q = s.mesh.weighted_vector(edge.to), middle = s.midpoint(e);
  const Vec3 left = Setting::unit(cross(p, q - p));
  const Cross at = {middle, cross(left, middle), left};
  const double from = -s.length_in_frame(edge.crossing), to = s.length_in_frame(edge.length - edge.crossing);
  const PathMean primal = at.mean_of_edge(field, from, to);
  const PathMean dual =
      at.mean_of_dual(field, -s.length_in_frame(edge.right_height), s.length_in_frame(edge.left_height));
  EdgeMeans means = {primal.gradient, dual.gradient, primal.potential, dual.potential, {}, {}};
  if (edge.is_boundary()) {
    means.from_potential = at.mean_of_edge(field, from, 0).potential;
    means.to_potential = at.mean_of_edge(field, 0, to).potential;
  }
  return means;
}

EdgeMeans means_of(const Setting& s, const Field& field, EdgeId e) {
  if (s.surface != nullptr) return means_on_surface(s, field, e);
  return s.dec.sphere_midpoints.empty() ? means_in_plane(s, field, s.dec.edges[e]) : means_on_sphere(s, field, e);
}

}  // namespace

IdVector<EdgeId, EdgeMeans> edge_means(const Setting& setting, const Field& field) {
  const auto& edges = setting.dec.edges;
  IdVector<EdgeId, EdgeMeans> means(edges.size());
  for_each_index(edges.size(), setting.executor,
                 [&](std::size_t i) { means[EdgeId(i)] = means_of(setting, field, EdgeId(i)); });
  return means;
}

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
    integrals[edge.from.index] += dot(s.length_in_frame(edge.crossing) * mean.from_potential, outward);
    integrals[edge.to.index] += dot(s.length_in_frame(edge.length - edge.crossing) * mean.to_potential, outward);
  }
  return integrals;
}

/// ∫ u over each triangle, by ∮ V · n around it.
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
    areas[edge.from.index] += part(edge.crossing);
    areas[edge.to.index] += part(edge.length - edge.crossing);
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
  errors[0] = s.surface != nullptr ? dual_cell_integrals_on_surface(s, field) : dual_cell_integrals(s, means);
  for (const VertexId v : s.mesh.vertices()) {
    double& error = errors[0][v.index];
    error -= s.area_in_frame(s.dec.star0[v]) * field.at(s.vertex(v)).u;
    // A cell of no area at all has no error.
    error = cells[v.index] > 0 ? std::abs(error) / cells[v.index] / size.value : 0;
  }
  for (const EdgeMeans& mean : means) {
    errors[1].push_back(length(mean.dual_gradient - mean.gradient) / size.gradient);
  }
  errors[2] = s.surface != nullptr ? triangle_integrals_on_surface(s, field) : triangle_integrals(s, means);
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

}  // namespace temper::error_detail
