#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sum.hpp"
#include "size/star_area.hpp"
#include "temper/size.hpp"

namespace temper {
namespace {

/// The value of that rank: the least one that at least `part` of all values do not exceed.
template <class Number>
double percentile(std::vector<Number>& values, double part) {
  const auto n = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(part * n)) - 1);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

template <class Number>
Spread spread_of(std::vector<Number> values) {
  if (values.empty()) return {};
  return {percentile(values, 0), percentile(values, 0.05), percentile(values, 0.5), percentile(values, 0.95),
          percentile(values, 1)};
}

/// The field's triangle to look for v from.
TriangleId start_for(VertexId v, const Mesh& mesh, const Mesh& of_field, const IdVector<VertexId, VertexId>& near) {
  VertexId there = v;
  if (near.size() == mesh.n_vertices()) {
    there = near[v];
  } else if (mesh.n_vertices() != of_field.n_vertices()) {
    return {};
  }
  return there.index < of_field.n_vertices() ? Mesh::triangle(of_field.outgoing(there)) : TriangleId();
}

/// The gradation at every edge, from the sizes at the vertices.
std::vector<float> gradations(const Mesh& mesh, const IdVector<VertexId, double>& sizes) {
  std::vector<float> ratios;  // as many as there are edges: the largest array here
  ratios.reserve(mesh.n_halfedges() / 2);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    const auto [low, high] = std::minmax(sizes[mesh.origin(h)], sizes[mesh.target(h)]);
    ratios.push_back(static_cast<float>(high / low));
  }
  return ratios;
}

double largest_edge_ratio(const Mesh& mesh) {
  double largest2 = 1;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
    const auto [low, high] = std::minmax({squared_length(q - p), squared_length(r - q), squared_length(p - r)});
    largest2 = std::max(largest2, high / low);
  }
  return std::sqrt(largest2);
}

}  // namespace

double local_size(const Mesh& mesh, VertexId v) { return star_area(mesh, v).size(); }

Spread spread(std::vector<double> values) { return spread_of(std::move(values)); }

double SizeReport::band() const { return std::max(over_field.max, 1 / over_field.min); }

SizeReport measure_size(const Mesh& mesh, const SizeField& field, Executor* executor,
                        const IdVector<VertexId, VertexId>& near) {
  SizeReport report;
  IdVector<VertexId, double> sizes(mesh.n_vertices());
  std::vector<double> ratios(mesh.n_vertices());
  report.outside = static_cast<std::size_t>(blockwise_sum(mesh.n_vertices(), executor, [&](std::size_t i) {
    const VertexId v(i);
    const SizeField::Sample s = field.at(mesh.position(v), start_for(v, mesh, field.mesh(), near));
    sizes[v] = local_size(mesh, v);
    ratios[i] = sizes[v] / s.size;
    return s.outside ? 1.0 : 0.0;
  }));
  report.over_field = spread(std::move(ratios));
  report.gradation = spread_of(gradations(mesh, sizes));
  report.largest_edge_ratio = largest_edge_ratio(mesh);
  return report;
}

}  // namespace temper
