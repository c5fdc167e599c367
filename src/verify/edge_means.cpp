#include "verify/edge_means.hpp"

#include "mesh/blocks.hpp"
#include "verify/gauss.hpp"

namespace temper::verify_detail {
namespace {

struct SegmentMean {
  Vec2 gradient;
  double antiderivative = 0;
};

SegmentMean mean_along(const Field& field, Vec2 a, Vec2 b) {
  SegmentMean mean;
  along_segment(a, b, [&](Vec2 p, double weight) {
    const FieldValue value = field.at(p);
    mean.gradient = mean.gradient + weight * value.gradient;
    mean.antiderivative += weight * value.antiderivative;
  });
  return mean;
}

EdgeMeans means_of(const Setting& s, const Field& field, const DecEdge& edge) {
  const Vec2 from = s.vertex(edge.from), to = s.vertex(edge.to), middle = s.in_frame(edge.midpoint);
  // The dual edge is straight: it runs along the normal from one orthocenter to the other, also where it runs back.
  const Vec2 normal = turned_left(direction(s, edge));
  const Vec2 right = middle - s.length_in_frame(edge.right_height) * normal;
  const Vec2 left = middle + s.length_in_frame(edge.left_height) * normal;
  const SegmentMean primal = mean_along(field, from, to), dual = mean_along(field, right, left);
  EdgeMeans means = {primal.gradient, dual.gradient, primal.antiderivative, dual.antiderivative, 0, 0};
  if (edge.is_boundary()) {
    means.from_antiderivative = mean_along(field, from, middle).antiderivative;
    means.to_antiderivative = mean_along(field, middle, to).antiderivative;
  }
  return means;
}

}  // namespace

IdVector<EdgeId, EdgeMeans> edge_means(const Setting& setting, const Field& field) {
  const auto& edges = setting.dec.edges;
  IdVector<EdgeId, EdgeMeans> means(edges.size());
  for_each_index(edges.size(), setting.executor,
                 [&](std::size_t i) { means[EdgeId(i)] = means_of(setting, field, edges[EdgeId(i)]); });
  return means;
}

}  // namespace temper::verify_detail
