// The sums of the report over a run of triangles: one Tally a block, merged in the order of the blocks.
//
// Everything here is a count, an extreme or a short list, so the merged result is the same whatever the blocks.
// Each edge is counted by the halfedge that stands for it, in the block of that halfedge's triangle.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "quality/worst.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

namespace temper {

/// Bins of 10°; of 0.1 with a bin edge at h = 0; of 0.05 with a bin edge at d = 0.
[[nodiscard]] Histogram empty_angle_histogram();
[[nodiscard]] Histogram empty_height_histogram();
[[nodiscard]] Histogram empty_split_histogram();
void count_in(Histogram& histogram, double value);

struct Tally {
  explicit Tally(std::size_t n_worst) : worst(n_worst) {}

  std::size_t edges = 0, boundary_edges = 0;
  std::size_t inverted_triangles = 0, orthocenters_outside = 0, well_centered = 0;
  std::size_t non_regular_edges = 0, negative_boundary_duals = 0, edges_not_crossed = 0;
  double min_h_over_l = std::numeric_limits<double>::infinity();
  double min_d_over_l = std::numeric_limits<double>::infinity();
  double min_angle_deg = std::numeric_limits<double>::infinity();
  double max_angle_deg = 0;
  WorstList worst;
  Histogram angles = empty_angle_histogram();
  Histogram h_over_l = empty_height_histogram();
  Histogram d_over_l = empty_split_histogram();

  /// `original`: the number by which the triangle is told of.
  void add(const Mesh& mesh, TriangleId t, TriangleId original);
  void merge(const Tally& other);

 private:
  void add_edge(const Mesh& mesh, HalfedgeId h, const TriangleMeasure& m, int k);
};

}  // namespace temper
