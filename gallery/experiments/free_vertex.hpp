// A triangle without weights, two vertices at (−1, 0) and (1, 0), the third free: figs. 3 and 8.
#pragma once

#include <string>
#include <vector>

#include "plot/plot.hpp"
#include "temper/detail/vec.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

inline constexpr Vec2 kLeft = {-1, 0}, kRight = {1, 0};

/// E as a function of the free vertex, y > 0; +∞ at y ≤ 0 and outside a barrier.
[[nodiscard]] double free_vertex_energy(const EnergyModel& model, Vec2 p);

/// The angle at the free vertex, degrees.
[[nodiscard]] double apex_degrees(Vec2 p);

/// Second derivatives by central differences.
struct Curvature {
  double xx = 0, xy = 0, yy = 0;
};
[[nodiscard]] Curvature curvature(const EnergyModel& model, Vec2 p);

/// Least and greatest E on a half circle around the right vertex; directions, 1° apart, keep as far from the edge's
/// line.
struct HalfCircle {
  double least = 0, greatest = 0;
};
[[nodiscard]] HalfCircle half_circle(const EnergyModel& model, double radius);

struct PositionLandscape {
  std::string title;
  PlotRange x = {-2, 2}, y = {0, 3};
  std::size_t per_unit = 40;   ///< samples
  std::vector<double> levels;  ///< ascending; walls are cut off above the last
  std::vector<PlotOverlay> overlays = {};
  double width = 400;
};
/// Contours of the energy over the free vertex's position, with the fixed edge.
[[nodiscard]] std::string position_contours(const EnergyModel& model, const PositionLandscape& landscape);

}  // namespace temper::gallery
