// The mobility that its place gives a vertex in all sweeps. It is decided once, since moves keep lines and planes.
#pragma once

#include <span>

#include "temper/tets/optimize.hpp"
#include "tets/optimize/newton_step.hpp"

namespace temper::tets {

/// Says for each vertex if its position and weight may change. Positions stay on the boundary, between regions, and at
/// tags of any kind, or slide.
///
///     in a plane               along a line             nowhere
///
///     o-----o-----o            o-----o-----o            o-----o-----o       All faces that stay, seen along the normal
///     | \ A | A / |            | \ A | A / |            | \ A | A / |       of one. A and B differ in plane, tags or
///     |   \ | /   |            |   \ | /   |            |   \ | /   |       regions. Edges between such faces and
///     o-----*-----o            o=====*=====o            o=====*     o       tagged lines are creases. A vertex with
///     two |   / | \   |            |   / | \   |            |   / ‖ \   |       creases in one line slides along them,
///     | / A | A \ |            | / B | B \ |            | / B ‖ A \ |       unless the tags of the lines differ. One
///     o-----o-----o            o-----o-----o            o-----o-----o       without a crease slides in its plane.
///
///
/// Neither the position nor the weight of `frozen` vertices changes.
[[nodiscard]] IdVector<VertexId, Mobility> mobilities(const TetMesh& mesh, const OptimizeOptions& options = {},
                                                      std::span<const VertexId> frozen = {});

}  // namespace temper::tets
