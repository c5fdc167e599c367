// The Optimizer of meshes of tetrahedra: temper/optimizer.hpp, with a dimension more.
//
// Moves keep the connectivity. If a tetrahedron would turn over, update() returns an error.
#pragma once

#include "temper/optimizer.hpp"
#include "temper/tets/mesh.hpp"
#include "temper/tets/optimize.hpp"

namespace temper {

extern template class OptimizerOf<tets::TetMesh, tets::OptimizeHooks, tets::OptimizeReport, tets::TetId>;

namespace tets {
using Optimizer = OptimizerOf<TetMesh, OptimizeHooks, OptimizeReport, TetId>;
}

}  // namespace temper
