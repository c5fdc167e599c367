#include "verify/edge_means.hpp"

#include <cmath>

#include "mesh/blocks.hpp"
#include "verify/gauss.hpp"

namespace temper::verify_detail {
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
  // The dual edge is straight: it runs along the normal from one orthocenter to the other, also where it runs back.
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

/// The great circles of an edge and of its dual, which cross in its midpoint: places by their angle from there, along
/// the one and to the left on the other.
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
  const Vec3 p = s.mesh.lifted_point(edge.from), q = s.mesh.lifted_point(edge.to), middle = s.midpoint(e);
  const Vec3 left = Setting::unit(cross(p, q - p));
  const Cross at = {middle, cross(left, middle), left};
  const double from = -s.length_in_frame(edge.split), to = s.length_in_frame(edge.length - edge.split);
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

}  // namespace temper::verify_detail
