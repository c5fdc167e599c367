#include "experiments/line_search.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/minimise.hpp"

namespace temper::gallery {
namespace {

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

double patch_radius(const Mesh& mesh, VertexId v) {
  double sum = 0;
  std::size_t n = 0;
  const auto add = [&](VertexId neighbour) {
    sum += squared_length(mesh.position(neighbour) - mesh.position(v));
    ++n;
  };
  for (const HalfedgeId h : mesh.star(v)) {
    add(mesh.target(h));
    if (!mesh.rotate(h).valid()) add(mesh.opposite(h));  // the last neighbour along the boundary
  }
  return std::sqrt(sum / static_cast<double>(n));
}

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
    const double t = golden_minimum(along, 0, limit, kSearchTolerance).at;
    const bool lower = along(t) < here.value;
    if (!lower) break;
    done.push_back({from, from + t * step, t / limit});
  }
  return done;
}

}  // namespace temper::gallery
