// Moves of vertices on interfaces between tensors, which a run of the pieces keeps where they are.
#pragma once

#include <functional>

#include "temper/tets/optimize.hpp"
#include "temper/tets/tensor.hpp"

namespace temper::tets {

/// Moves vertices of interfaces in the plane of the interface, or along its straight line, where mobilities() lets them
/// slide. All copies of a vertex move together, and the sum of the energies of all tetrahedra around them falls:
///
///         region 0        in its space              E(x) = E₀(B₀ x) + E₁(B₁ x), with x in the plane
///      ------x------  →   ------B₀x------
///         region 1        ------B₁x------  in its space
///
/// Weights stay. Those that are zero on interfaces keep their equations at all places. `whole`: the mesh that the
/// pieces make. `must_stop` is asked now and then. Returns false if no vertex has moved.
bool slide_seams(MetricMesh& pieces, const TetMesh& whole, const OptimizeOptions& options,
                 const std::function<bool()>& must_stop);

}  // namespace temper::tets
