// Cell-centered transmissibilities of the edges of a mesh, compared with each other.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// Of ℓ / |dual| of all interior edges; 1 without any.
struct Transmissibilities {
  double max_over_median = 1;
  double max_over_min = 1;
};
/// O(n), with 8 bytes an edge while it lasts.
[[nodiscard]] Transmissibilities compare_transmissibilities(const Mesh& mesh, Executor* executor);

}  // namespace temper
