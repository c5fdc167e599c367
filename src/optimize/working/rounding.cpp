#include "optimize/working/rounding.hpp"

#include <cmath>

namespace temper {

void take_back_rounding(const Mesh& input, const IdVector<VertexId, VertexId>& vertices, Mesh& mesh) {
  constexpr double kPlacesOfManySteps = 0x1p-40, kWeightsOfManySteps = 0x1p-46;
  const Space& space = mesh.space();
  if (space.is_plane()) return;
  const double least = kWeightsOfManySteps * space.radius() * space.radius();
  for (const VertexId v : mesh.vertices()) {
    const VertexId was = vertices.empty() ? v : vertices[v];
    if (was.index >= input.n_vertices()) continue;
    const bool stays = space.same_place(input.point(was), mesh.point(v), kPlacesOfManySteps);
    const double w = mesh.weight(v), old = input.weight(was);
    const bool keeps = std::abs(w - old) < least;
    if (stays || keeps) mesh.set_point(v, space.with_weight(stays ? input.point(was) : mesh.point(v), keeps ? old : w));
    if (stays && keeps) mesh.set_point(v, input.point(was));
  }
}

}  // namespace temper
