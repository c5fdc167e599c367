// Means of fields on curved surfaces. The part of a dual edge in a triangle is in the plane of this triangle.
#pragma once

#include <vector>

#include "errors/stars.hpp"

namespace temper::error_detail {

/// The means over an edge and its dual, in the coordinates of direction(). Across the edge they are means of both
/// triangles, weighted by the heights, so the nearer orthocenter gets more of the source at the edge. There are no
/// potentials.
[[nodiscard]] EdgeMeans means_on_surface(const Setting& setting, const Field& field, EdgeId e);

/// ∫ u over each signed dual cell, and over each triangle, in the frame.
[[nodiscard]] std::vector<double> dual_cell_integrals_on_surface(const Setting& setting, const Field& field);
[[nodiscard]] std::vector<double> triangle_integrals_on_surface(const Setting& setting, const Field& field);

/// ∫ Δu over each dual cell, with Δu of the vertex in the plane of each triangle, and with the sources at the edges.
[[nodiscard]] std::vector<double> laplacians_on_surface(const Setting& setting, const Field& field);

}  // namespace temper::error_detail
