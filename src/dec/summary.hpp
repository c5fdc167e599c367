// A summary of operators, for meshes whose operators are a DecComplex.
#pragma once

#include "temper/dec.hpp"

namespace temper {

/// All of the summary but the number of triangles that are not well-centered. Of the mesh connectivity alone counts.
[[nodiscard]] DecSummary summary_of_operators(const Mesh& mesh, const DecComplex& complex);

}  // namespace temper
