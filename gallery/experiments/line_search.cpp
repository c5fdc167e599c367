#include "experiments/line_search.hpp"

#include <algorithm>
#include <cmath>

namespace temper::gallery {
namespace {

constexpr double kInversionFraction = 0.9;  // of the way to the first triangle without area
constexpr double kTolerance = 1e-8;         // of the interval: what golden section can tell apart in doubles

double patch_radius(const Mesh& mesh, VertexId v) {
  double sum = 0;
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    sum += squared_length(mesh.position(mesh.target(h)) - mesh.position(v));
    ++n;
  }
  return std::sqrt(sum / static_cast<double>(n));
}

/// Areas are linear along the step.
double inversion_limit(const Mesh& mesh, VertexId v, Vec2 step) {
  double limit = 1;
  for (const HalfedgeId h : mesh.star(v)) {
    const Vec2 p = mesh.position(v), a = mesh.position(mesh.target(h)), b = mesh.position(mesh.opposite(h));
    const double area = cross(a - p, b - p), slope = cross(b - a, step);
    if (slope < 0) limit = std::min(limit, -kInversionFraction * area / slope);
  }
  return limit;
}

template <class Function>
double golden_section(Function&& f, double limit) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  double low = 0, high = limit;
  while (high - low > kTolerance * limit) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (f(b) < f(a) ? low : high) = f(b) < f(a) ? a : b;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v, int searches) {
  std::vector<LineSearch> done;
  for (int i = 0; i < searches; ++i) {
    const VertexDerivatives here = vertex_energy(mesh, model, v);
    const Vec2 downhill{-here.gradient[0], -here.gradient[1]};
    if (!(squared_length(downhill) > 0)) break;
    const Vec2 from = mesh.position(v), step = (patch_radius(mesh, v) / length(downhill)) * downhill;
    const double limit = inversion_limit(mesh, v, step);
    const auto along = [&](double t) {
      mesh.set_position(v, from + t * step);
      return vertex_energy(mesh, model, v).value;
    };
    const double t = golden_section(along, limit);
    const bool lower = along(t) < here.value;
    if (!lower) break;
    done.push_back({from, from + t * step, t / limit});
  }
  return done;
}

}  // namespace temper::gallery
