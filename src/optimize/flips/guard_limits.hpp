// The limits of the guard (guard.hpp): the worse of the input and the bounds of the options.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "optimize/flips/guard_values.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/detail/location.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The depths of the input, linear on its triangles. It is in the user's units.
class DepthField {
 public:
  DepthField(Mesh mesh, std::span<const double> depths)
      : mesh_(std::move(mesh)), depths_(depths.begin(), depths.end()) {
    for (double& depth : depths_) depth = std::isnan(depth) ? 0 : depth;
  }
  [[nodiscard]] double at(const WeightedPoint& p, TriangleId& near) const {
    const Place place = finder_.find(p, near);
    near = place.triangle;
    return interpolated(place, [this](VertexId v) { return depths_[v.index]; });
  }

 private:
  Mesh mesh_;
  std::vector<double> depths_;
  PointLocator finder_{mesh_};
};

/// The limits of a run.
struct GuardLimits {
  GuardValues values;     ///< of the judge
  GuardValues for_steps;  ///< tighter by a margin, since other maps and units give slightly other values
  std::shared_ptr<const DepthField> depth;  ///< or null
  Client client = Client::none;
  bool has_cells = false;  ///< cells and their triangles are measured
  bool has_flow = false;   ///< flow links are measured
  [[nodiscard]] bool has_cells_or_flow() const { return has_cells || has_flow; }
  std::vector<double> of_client;  ///< client_values() of the input
};

/// Returns the limits for an input, by the options, or null if they set none.
/// Error: the number of depths is not that of the vertices.
[[nodiscard]] Expected<std::shared_ptr<const GuardLimits>> guard_limits(const Mesh& input,
                                                                        const OptimizeOptions& options,
                                                                        Executor* executor = nullptr);

/// Returns the measures of the client over a mesh, larger ones better: of `check`, in the user's units. O(n).
[[nodiscard]] std::vector<double> client_values(Client client, const Mesh& mesh, const WorkingUnits& units,
                                                Executor* executor);

/// Counts the triangles of a mesh, and the measures of the client, that are beyond the limits. O(n).
[[nodiscard]] std::size_t count_beyond(const Mesh& mesh, const WorkingUnits& units,
                                       const std::shared_ptr<const GuardLimits>& limits, Executor* executor = nullptr);

}  // namespace temper
