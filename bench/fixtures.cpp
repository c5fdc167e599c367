#include "fixtures.hpp"

#include <cstdlib>

#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::bench {

const Mesh& good_mesh() {
  static const Mesh mesh = [] {
    Mesh m = *random_mesh({.vertices = kVertices, .seed = 1});
    hilbert_order(m);
    if (!optimize(m, {.max_sweeps = 60})) std::abort();
    return m;
  }();
  return mesh;
}

std::vector<Patch> patches(const Mesh& mesh, bool with_outer) {
  std::vector<Patch> result;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    result.emplace_back();
    gather_patch(mesh, v, with_outer, result.back());
  }
  return result;
}

EnergyModel model_of(EnergyKind kind) {
  EnergyModel model;
  model.kind = kind;
  model.gamma = {0.003, LengthScale::relative};
  return model;
}

}  // namespace temper::bench
