#include "optimize/flips/guard_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "optimize/flips/guard.hpp"
#include "size/solver_measures.hpp"

namespace temper {
namespace {

// Values in the user's units differ by rounding from those in the units of the run.
constexpr double kRounding = 1e-9;
// A right angle of coordinates with some nine digits is one to this cosine.
constexpr double kRoundedOrthogonality = 1e-6;
// A map from degrees changes the areas of neighbors by up to a few thousandths, each in its own way.
constexpr double kMargin = 1.005;

/// The bounds of the options, as limits. A bound that is off is below each value.
GuardValues bounds_of(const GuardOptions& o) {
  const auto squared = [](double x) { return x * x; };
  const double nothing = std::numeric_limits<double>::infinity();
  GuardValues bounds;
  const double angle = o.angle * std::numbers::pi / 180;
  bounds.value[GuardValues::sine] = squared(std::sin(angle));
  // A triangle whose two other angles are at the bound has this largest angle.
  bounds.value[GuardValues::cosine] = o.angle > 0 ? 1 - std::cos(2 * angle) : 0;
  bounds.value[GuardValues::edge] = squared(o.edge);
  bounds.value[GuardValues::areas] = o.areas ? 1 / *o.areas : 0;
  bounds.value[GuardValues::shortest] = squared(o.length.value_or(nothing));
  const double step = o.depth.empty() ? 0 : o.step.value_or(nothing);
  bounds.value[GuardValues::crossing] = bounds.value[GuardValues::edge_crossing] = squared(step);
  bounds.value[GuardValues::orthogonality] = -kRoundedOrthogonality;
  bounds.value[GuardValues::link] = kSmallFlowLink;
  return bounds;
}

}  // namespace

Expected<std::shared_ptr<const GuardLimits>> guard_limits(const Mesh& input, const OptimizeOptions& options,
                                                          Executor* executor) {
  const GuardOptions& o = options.guard;
  if (!o.depth.empty() && o.depth.size() != input.n_vertices()) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      "the guard has " + std::to_string(o.depth.size()) + " depths; expected one for each of the " +
                          std::to_string(input.n_vertices()) + " vertices"};
  }
  const bool off = o.angle == 0 && o.edge == 0 && !o.areas && !o.length && !o.step && o.client == Client::none;
  if (off || objective_of(options) == Objective::energy) return std::shared_ptr<const GuardLimits>();
  auto limits = std::make_shared<GuardLimits>();
  if (!o.depth.empty()) limits->depth = std::make_shared<const DepthField>(input, o.depth);
  limits->client = o.client;
  limits->has_flow = o.client == Client::dflowfm;
  limits->has_cells = o.client == Client::mpas;
  WorkingUnits same;
  same.space = input.space();
  const Guard guard(input, same, limits);
  limits->values = guard.worst(executor);
  limits->values.take(bounds_of(o));
  limits->for_steps = scaled(limits->values, kMargin);
  limits->of_client = client_values(o.client, input, same, executor);
  return std::shared_ptr<const GuardLimits>(std::move(limits));
}

std::vector<double> client_values(Client client, const Mesh& mesh, const WorkingUnits& units, Executor* executor) {
  if (client == Client::none) return {};
  const SolverMeasures m = solver_measures(mesh, false, executor);
  std::vector<double> values = {-static_cast<double>(m.obtuse_triangles)};
  if (client == Client::dflowfm) {
    values.insert(values.end(), {-std::max(m.max_orthogonality, kRoundedOrthogonality), -m.max_smoothness,
                                 m.min_flow_link, -static_cast<double>(m.small_flow_links)});
  } else if (client == Client::mpas) {
    values.insert(values.end(),
                  {m.min_cell_quality, units.scale * m.min_grid_spacing, -units.scale * m.max_grid_spacing,
                   m.min_triangle_quality, m.min_triangle_angle_quality, -m.max_centroid_offset_over_size});
  }
  return values;
}

std::size_t count_beyond(const Mesh& mesh, const WorkingUnits& units, const std::shared_ptr<const GuardLimits>& limits,
                         Executor* executor) {
  if (limits == nullptr) return 0;
  std::size_t beyond = Guard(mesh, units, limits).count_beyond(scaled(limits->values, 1 - kRounding), executor);
  const std::vector<double> values = client_values(limits->client, mesh, units, executor);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double limit = limits->of_client[i];
    beyond += values[i] < limit - kRounding * std::abs(limit) ? 1 : 0;
  }
  return beyond;
}

}  // namespace temper
