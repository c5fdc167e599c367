// Measures of a mesh for codes with a convention of their own: D-Flow FM, MPAS, and explicit schemes.
#pragma once

#include <cstddef>
#include <limits>

namespace temper {

/// Measures for other codes, which refuse a mesh or run slowly if a value is bad. quality_measures() defines each
/// measure and names its code. The minimum over nothing is +∞, and the maximum is 0. An interior edge has a triangle on
/// both sides. A closed cell is the cell of a vertex inside the domain.
struct SolverMeasures {
  double min_edge_over_size = std::numeric_limits<double>::infinity();  ///< Least relative_lengths() of interior edges
  /// Least relative dual length of interior edges.
  double min_dual_over_size = std::numeric_limits<double>::infinity();
  double min_dual_over_cell_median = std::numeric_limits<double>::infinity();  ///< Least over closed cells
  double max_orthogonality = 0;                                                ///< Largest |cosine| over interior edges
  double max_smoothness = 0;                                          ///< Largest over interior edges, at least 1
  double min_flow_link = std::numeric_limits<double>::infinity();     ///< Least over interior edges
  std::size_t small_flow_links = 0;                                   ///< Number of flow links less than 0.1
  double min_cell_quality = std::numeric_limits<double>::infinity();  ///< Least over closed cells
  double min_grid_spacing = std::numeric_limits<double>::infinity();  ///< [length]
  double max_grid_spacing = 0;                                        ///< [length]
  double min_triangle_quality = std::numeric_limits<double>::infinity();
  double min_triangle_angle_quality = std::numeric_limits<double>::infinity();
  std::size_t obtuse_triangles = 0;          ///< Exact number
  double max_centroid_offset_over_size = 0;  ///< Largest over closed cells
};

}  // namespace temper
