#include "experiments/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/minimize.hpp"

namespace temper::gallery {
namespace {

constexpr int kSearches = 3;
constexpr double kInversionFraction = 0.9;  // of the way to the first triangle without area

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

}  // namespace

double patch_radius(const Mesh& mesh, VertexId v, SearchRadius which) {
  double sum = 0, least = std::numeric_limits<double>::infinity(), largest = 0;
  std::size_t n = 0;
  const auto add = [&](VertexId neighbor) {
    const double l2 = squared_length(mesh.position(neighbor) - mesh.position(v));
    sum += l2;
    least = std::min(least, l2);
    largest = std::max(largest, l2);
    ++n;
  };
  for (const HalfedgeId h : mesh.star(v)) {
    add(mesh.target(h));
    if (!mesh.rotate(h).valid()) add(mesh.opposite(h));  // the last neighbor along the boundary
  }
  switch (which) {
    case SearchRadius::rms:
      return std::sqrt(sum / static_cast<double>(n));
    case SearchRadius::max:
      return std::sqrt(largest);
    case SearchRadius::min:
      return std::sqrt(least);
  }
  return 0;
}

std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v, SearchRadius radius) {
  std::vector<LineSearch> done;
  for (int i = 0; i < kSearches; ++i) {
    const VertexDerivatives here = vertex_energy(mesh, model, v);
    const Vec2 downhill{-here.gradient[0], -here.gradient[1]};
    if (!(squared_length(downhill) > 0)) break;
    const Vec2 from = mesh.position(v), step = (patch_radius(mesh, v, radius) / length(downhill)) * downhill;
    const double limit = inversion_limit(mesh, v, step);
    const auto along = [&](double t) {
      mesh.set_position(v, from + t * step);
      return vertex_energy(mesh, model, v).value;
    };
    const double t = golden_minimum(along, 0, limit, kSearchTolerance).at;
    const bool lower = along(t) < here.value;
    if (!lower) break;
    done.push_back({from, from + t * step, t / limit});
  }
  return done;
}

}  // namespace temper::gallery
