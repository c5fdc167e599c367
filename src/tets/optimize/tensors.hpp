// A run in the metrics of diffusion tensors (temper/tets/tensor.hpp), as src/optimize/tensors.hpp has it for triangles.
#pragma once

#include <functional>
#include <span>

#include "temper/tets/optimize.hpp"

namespace temper::tets {

struct PiecesRunOptions {
  const OptimizeOptions& options;
  const OptimizeHooks& hooks;
  std::span<const VertexId> frozen;  ///< Vertices that keep their position and weight
};
/// Optimizes a mesh in its own space.
using PiecesRun = std::function<OptimizeReport(TetMesh& there, const PiecesRunOptions& options)>;

/// Optimizes the pieces of a mesh. Precondition: the options have tensors.
[[nodiscard]] Expected<OptimizeReport> optimize_in_metrics(TetMesh& mesh, const OptimizeOptions& options,
                                                           const OptimizeHooks& hooks, const PiecesRun& run);

}  // namespace temper::tets
