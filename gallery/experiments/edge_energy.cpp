#include "experiments/edge_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/minimize.hpp"
#include "experiments/numbers.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr double kFactor = 1.0 / 3;  // α = β of ★1
constexpr double kMargin = 1e-3;     // random points keep this far from walls, of ℓ: beyond, e has few digits

EnergyModel model_of(EnergyKind kind, double length_parameter) {
  EnergyModel model;
  model.kind = kind;
  model.gamma = {length_parameter, LengthScale::absolute};
  model.h0 = {length_parameter, LengthScale::absolute};
  return model;
}

}  // namespace

double EdgeEnergy::phi(double h) const {
  switch (kind) {
    case EnergyKind::BHs:
      return h + length_parameter;
    case EnergyKind::BP: {
      const double root = std::sqrt(h * h + length_parameter * length_parameter);
      // For h < 0 the sum cancels: (h + r)/2 = γ²/(2 (r − h)).
      return h >= 0 ? (h + root) / 2 : length_parameter * length_parameter / (2 * (root - h));
    }
    default:
      return h;
  }
}

double EdgeEnergy::operator()(double d, double h) const {
  const double below = phi(h);
  if (!(d > 0 && d < length && below > 0)) return kInfinity;
  const double chi = std::sqrt(d * (length - d));
  return kFactor * (d * d + (length - d) * (length - d) + 2 * h * h) / (chi * below);
}

Consistency consistency(EnergyKind kind, std::size_t tries) {
  constexpr double kLengthParameter = 0.3;
  const EnergyModel model = model_of(kind, kLengthParameter);
  Random random(11);
  Consistency result;
  for (std::size_t k = 0; k < tries; ++k) {
    std::array<WeightedPoint, 3> p;
    for (WeightedPoint& corner : p) corner = {random(-1, 1), random(-1, 1), random(-0.2, 0.2)};
    if (doubled_area(p[0].position(), p[1].position(), p[2].position()) < 0.1) continue;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const WeightedPoint &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
      const EdgeEnergy e{kind, temper::length(b.position() - a.position()), kLengthParameter};
      sum += e(dual_crossing(a, b), signed_height(a, b, c));
    }
    const double whole = triangle_energy(model, p[0], p[1], p[2]);
    if (!std::isfinite(whole) || whole > 1e4) continue;  // at a wall: h has lost its digits
    result.worst = std::max(result.worst, std::abs(sum - whole) / whole);
    ++result.triangles;
  }
  return result;
}

ConvexityTest sample_convexity(const EdgeEnergy& e, double h_low, double h_high, std::size_t segments) {
  Random random(23);
  ConvexityTest test;
  test.worst_quasi = test.worst_convex = -kInfinity;
  const auto point = [&] {
    return Vec2{random(kMargin, 1 - kMargin) * e.length, random(h_low + kMargin * e.length, h_high)};
  };
  for (; test.segments < segments; ++test.segments) {
    const Vec2 a = point(), b = point();
    const double t = random(0, 1), ea = e(a), eb = e(b), larger = std::max(ea, eb);
    const double middle = e(a + t * (b - a));
    test.worst_quasi = std::max(test.worst_quasi, (middle - larger) / larger);
    const double above = (middle - (ea + t * (eb - ea))) / larger;
    if (above > test.worst_convex) {
      test.worst_convex = above;
      test.a = a;
      test.b = b;
      test.at = t;
    }
  }
  return test;
}

MultiStart multi_start(const EdgeEnergy& e, double h_low, double h_high, std::size_t starts) {
  Random random(37);
  MultiStart result;
  result.value = kInfinity;
  std::vector<Minimum2> minima;
  for (; result.starts < starts; ++result.starts) {
    const Vec2 start = {random(kMargin, 1 - kMargin) * e.length, random(h_low + kMargin * e.length, h_high)};
    minima.push_back(simplex_minimum(e, start, 0.05 * e.length));
    if (minima.back().value < result.value) {
      result.value = minima.back().value;
      result.best = minima.back().at;
    }
  }
  for (const Minimum2& m : minima) {
    result.spread = std::max(result.spread, temper::length(m.at - result.best));
    result.rise = std::max(result.rise, m.value - result.value);
  }
  return result;
}

std::string edge_contours(const EdgeEnergy& e, const EdgeLandscape& landscape) {
  ContourPlot plot;
  plot.title = landscape.title;
  plot.x_label = "d_{ij} / ℓ";
  plot.y_label = "h_{k} / ℓ";
  plot.x_range = {0, e.length};
  plot.y_range = {landscape.h_low, landscape.h_high};
  plot.nx = landscape.samples;
  plot.ny = static_cast<std::size_t>(std::lround((landscape.h_high - landscape.h_low) * static_cast<double>(plot.nx)));
  // Beyond the last level the plot is one color: the walls are cut off there, so that lines stay smooth.
  const double cap = 4 * landscape.levels.back();
  for (std::size_t j = 0; j < plot.ny; ++j) {
    const double h = landscape.h_low +
                     (landscape.h_high - landscape.h_low) * static_cast<double>(j) / static_cast<double>(plot.ny - 1);
    for (std::size_t i = 0; i < plot.nx; ++i) {
      const double d = e.length * static_cast<double>(i) / static_cast<double>(plot.nx - 1);
      plot.values.push_back(std::min(e(d, h), cap));
    }
  }
  plot.levels = landscape.levels;
  plot.equal_aspect = true;
  plot.width = 380;
  plot.overlays = {{.points = {landscape.minimum}, .line = false, .label = "minimum"}};
  return contour_plot_svg(plot);
}

}  // namespace temper::gallery
