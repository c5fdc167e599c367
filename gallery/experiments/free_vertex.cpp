#include "experiments/free_vertex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/numbers.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr double kFloor = 0.02;  // the lowest row of samples, of a step above y = 0: there every energy is at a wall
constexpr double kStep = 1e-4;   // of differences: error 1e-8, rounding 1e-8 of E

}  // namespace

double free_vertex_energy(const EnergyModel& model, Vec2 p) {
  if (!(p.y > 0)) return std::numeric_limits<double>::infinity();
  return triangle_energy(model, {kLeft.x, kLeft.y, 0}, {kRight.x, kRight.y, 0}, {p.x, p.y, 0});
}

double apex_degrees(Vec2 p) { return corner_angle(p, kLeft, kRight) * 180 / std::numbers::pi; }

Curvature curvature(const EnergyModel& model, Vec2 p) {
  const auto f = [&](double i, double j) { return free_vertex_energy(model, p + kStep * Vec2{i, j}); };
  const double square = kStep * kStep;
  return {(f(1, 0) - 2 * f(0, 0) + f(-1, 0)) / square, (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / (4 * square),
          (f(0, 1) - 2 * f(0, 0) + f(0, -1)) / square};
}

HalfCircle half_circle(const EnergyModel& model, double radius) {
  HalfCircle result{kInfinity, -kInfinity};
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double t = degrees * std::numbers::pi / 180;
    const double e = free_vertex_energy(model, kRight + radius * Vec2{std::cos(t), std::sin(t)});
    result.least = std::min(result.least, e);
    result.greatest = std::max(result.greatest, e);
  }
  return result;
}

std::string position_contours(const EnergyModel& model, const PositionLandscape& landscape) {
  ContourPlot plot;
  plot.title = landscape.title;
  plot.x_label = "x";
  plot.y_label = "y";
  plot.x_range = landscape.x;
  plot.y_range = landscape.y;
  const auto samples = [&](PlotRange r) {
    return static_cast<std::size_t>(std::lround((r.high - r.low) * static_cast<double>(landscape.per_unit))) + 1;
  };
  plot.nx = samples(landscape.x);
  plot.ny = samples(landscape.y);
  // A few times beyond the outer levels: walls are one color, and lines next to them stay smooth.
  const double span = landscape.levels.back() - landscape.levels.front();
  const double low = landscape.levels.front() - span, high = landscape.levels.back() + span;
  const double step = 1 / static_cast<double>(landscape.per_unit);
  for (std::size_t j = 0; j < plot.ny; ++j) {
    const double y = std::max(landscape.y.low + step * static_cast<double>(j), kFloor * step);
    for (std::size_t i = 0; i < plot.nx; ++i) {
      const double e = free_vertex_energy(model, {landscape.x.low + step * static_cast<double>(i), y});
      plot.values.push_back(std::isfinite(e) ? std::clamp(e, low, high) : e);
    }
  }
  plot.levels = landscape.levels;
  plot.equal_aspect = true;
  plot.width = landscape.width;
  plot.overlays = {{.points = {kLeft, kRight}}};
  plot.overlays.insert(plot.overlays.end(), landscape.overlays.begin(), landscape.overlays.end());
  return contour_plot_svg(plot);
}

}  // namespace temper::gallery
