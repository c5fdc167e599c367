// Runs with diffusion tensors: in the planes of their metrics, and back.
#pragma once

#include <functional>

#include "temper/optimize.hpp"

namespace temper {

/// A run in the plane of a mesh.
using PlaneRun = std::function<Expected<OptimizeReport>(Mesh& mesh, const OptimizeOptions&, const OptimizeHooks&)>;

/// Runs in the planes of the tensors of the options, and maps back. With several planes the mesh is cut along
/// interfaces. Vertices of interfaces stay in a run, with their weights, which keep the equations of interfaces
/// (temper/detail/tensor.hpp). Between runs programs find better weights. O(runs).
[[nodiscard]] Expected<OptimizeReport> optimize_in_metrics(Mesh& mesh, const OptimizeOptions& options,
                                                           OptimizeHooks hooks, const PlaneRun& run);

}  // namespace temper
