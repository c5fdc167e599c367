// Runs with diffusion tensors: in the planes of their metrics, and back.
#pragma once

#include <functional>

#include "temper/optimize.hpp"

namespace temper {

/// A run in the plane of a mesh.
using PlaneRun = std::function<Expected<OptimizeReport>(Mesh& mesh, const OptimizeOptions&, const OptimizeHooks&)>;

/// Runs in the planes of the tensors of the options, and maps back. With several planes the mesh is cut along
/// interfaces. Vertices of interfaces stay in a run, with their weights, which keep the equations of interfaces
/// (temper/detail/tensor.hpp). Between runs edges of interfaces are split, and a program after the last run finds
/// better weights. O(runs).
[[nodiscard]] Expected<OptimizeReport> optimize_in_metrics(Mesh& mesh, const OptimizeOptions& options,
                                                           const OptimizeHooks& hooks, const PlaneRun& run);

/// Says whether tensors differ at too many edges for a run. Vertices of those edges stay, so few could move.
[[nodiscard]] bool turns_everywhere(const Mesh& mesh, const Metrics& metrics);
/// Runs with the mean tensor of each region, by `run`, and gives each triangle of the result its own tensor, and
/// weights of corners that keep the equations of all edges. Precondition: `triangle_tensors` of the options are
/// tensors.
[[nodiscard]] Expected<OptimizeReport> optimize_with_means(Mesh& mesh, const OptimizeOptions& options,
                                                           const OptimizeHooks& hooks, const PlaneRun& run);

}  // namespace temper
