#include "optimize/working/working_units.hpp"

#include <cmath>

#include "base/box.hpp"

namespace temper {
namespace {

/// Returns the midpoint of [low, high] if the whole interval is within a factor of two of it, else 0.
double center_of(double low, double high) {
  if (low > 0 ? high <= 2 * low : (high < 0 && low >= 2 * high)) return low + (high - low) / 2;
  return 0;
}

}  // namespace

WorkingUnits WorkingUnits::of(const Mesh& mesh) {
  WorkingUnits units;
  units.space = mesh.space();
  if (!mesh.space().is_plane()) {
    units.scale = std::exp2(std::ilogb(mesh.space().radius()));
    return units;
  }
  PlaneBox box;
  for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
  const auto& [low, high] = box;
  const Vec2 period = mesh.space().period();
  units.center = {period.x > 0 ? 0 : center_of(low.x, high.x), period.y > 0 ? 0 : center_of(low.y, high.y)};
  units.scale = std::exp2(std::ilogb(box.longer_side()));
  const auto rounding_of_axis = [&](double middle, double period_there) {
    return period_there > 0 ? Space::rounding_of(period_there / units.scale) : middle / units.scale;
  };
  units.rounding = {rounding_of_axis(units.center.x, period.x), rounding_of_axis(units.center.y, period.y)};
  return units;
}

void WorkingUnits::enter(Mesh& mesh) const {
  mesh.set_space(space.in_units_of(scale));
  for (const VertexId v : mesh.vertices()) mesh.set_point(v, from_user(mesh.point(v)));
}

void WorkingUnits::leave(Mesh& mesh) const {
  mesh.set_space(space);
  for (const VertexId v : mesh.vertices()) mesh.set_point(v, to_user(mesh.point(v)));
}

void take_back_rounding(const Mesh& input, const IdVector<VertexId, VertexId>& vertices, Mesh& mesh) {
  constexpr double kPlacesOfManySteps = 0x1p-40, kWeightsOfManySteps = 0x1p-46;
  const Space& space = mesh.space();
  if (space.is_plane()) return;
  const double least = kWeightsOfManySteps * space.radius() * space.radius();
  for (const VertexId v : mesh.vertices()) {
    const VertexId was = vertices.empty() ? v : vertices[v];
    const double w = mesh.weight(v);
    if (was.index >= input.n_vertices()) {
      if (w != 0 && std::abs(w) < least) mesh.set_point(v, space.with_weight(mesh.point(v), 0));
      continue;
    }
    const bool stays = space.same_place(input.point(was), mesh.point(v), kPlacesOfManySteps);
    const double old = input.weight(was);
    const bool keeps = std::abs(w - old) < least;
    if (stays || keeps) mesh.set_point(v, space.with_weight(stays ? input.point(was) : mesh.point(v), keeps ? old : w));
    if (stays && keeps) mesh.set_point(v, input.point(was));
  }
}

}  // namespace temper
