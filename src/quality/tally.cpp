#include "quality/tally.hpp"

#include <algorithm>
#include <cmath>

#include "temper/regularity.hpp"

namespace temper {
namespace {

void merge_counts(Histogram& into, const Histogram& from) {
  for (std::size_t i = 0; i < into.counts.size(); ++i) into.counts[i] += from.counts[i];
}

}  // namespace

Histogram empty_angle_histogram() { return {0, 180, std::vector<std::size_t>(18)}; }
Histogram empty_height_histogram() { return {-0.5, 1, std::vector<std::size_t>(15)}; }
Histogram empty_split_histogram() { return {-0.1, 0.5, std::vector<std::size_t>(12)}; }

void count_in(Histogram& histogram, double value) {
  const double last = static_cast<double>(histogram.counts.size() - 1);
  const double bins = static_cast<double>(histogram.counts.size());
  const double bin = std::floor((value - histogram.low) / (histogram.high - histogram.low) * bins);
  ++histogram.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, last))];
}

void Tally::add(const Mesh& mesh, TriangleId t, TriangleId original) {
  const TriangleMeasure m = measure_triangle(mesh, t);
  inverted_triangles += m.orientation == Sign::negative;
  orthocenters_outside += !m.orthocenter_inside();
  well_centered += m.well_centered();
  worst.offer({m.margin(), original});
  for (int k = 0; k < 3; ++k) {
    min_h_over_l = std::min(min_h_over_l, m.h_over_l[k]);
    min_angle_deg = std::min(min_angle_deg, m.angle_deg[k]);
    max_angle_deg = std::max(max_angle_deg, m.angle_deg[k]);
    count_in(angles, m.angle_deg[k]);
    count_in(h_over_l, m.h_over_l[k]);
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (mesh.is_edge_representative(h)) add_edge(mesh, h, m, k);
  }
}

void Tally::add_edge(const Mesh& mesh, HalfedgeId h, const TriangleMeasure& m, int k) {
  ++edges;
  edges_not_crossed += !m.crossed[k];
  min_d_over_l = std::min(min_d_over_l, m.d_over_l[k]);
  count_in(d_over_l, m.d_over_l[k]);
  if (mesh.is_boundary(h)) {
    ++boundary_edges;
    negative_boundary_duals += m.h_sign[k] == Sign::negative;
    return;
  }
  non_regular_edges += !is_regular(mesh, h);
}

void Tally::merge(const Tally& other) {
  edges += other.edges;
  boundary_edges += other.boundary_edges;
  inverted_triangles += other.inverted_triangles;
  orthocenters_outside += other.orthocenters_outside;
  well_centered += other.well_centered;
  non_regular_edges += other.non_regular_edges;
  negative_boundary_duals += other.negative_boundary_duals;
  edges_not_crossed += other.edges_not_crossed;
  min_h_over_l = std::min(min_h_over_l, other.min_h_over_l);
  min_d_over_l = std::min(min_d_over_l, other.min_d_over_l);
  min_angle_deg = std::min(min_angle_deg, other.min_angle_deg);
  max_angle_deg = std::max(max_angle_deg, other.max_angle_deg);
  worst.merge(other.worst);
  merge_counts(angles, other.angles);
  merge_counts(h_over_l, other.h_over_l);
  merge_counts(d_over_l, other.d_over_l);
}

}  // namespace temper
