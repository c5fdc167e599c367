// The mesh that kernels are timed on: random, of 10,000 vertices, improved.
#pragma once

#include <vector>

#include "energy/patch.hpp"

namespace temper::bench {

inline constexpr std::size_t kVertices = 10000;

/// In Hilbert order, as the optimizer has it, and well-centered, so that every energy is finite.
[[nodiscard]] const Mesh& good_mesh();

/// Those of inner vertices.
[[nodiscard]] std::vector<Patch> patches(const Mesh& mesh, bool with_outer);

/// With γ as it is at the end of a run.
[[nodiscard]] EnergyModel model_of(EnergyKind kind);

}  // namespace temper::bench
