// Fixtures for tests of weights alone: meshes that have good weights and that have none, and meshes scaled or weighted.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "property/random_mesh.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/feasibility.hpp"
#include "temper/generate.hpp"
#include "temper/geometry.hpp"
#include "temper/lp.hpp"

namespace temper::test {

inline Mesh with_weights(Mesh mesh, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, weights[v]);
  return mesh;
}

inline Mesh scaled(Mesh mesh, double factor, Vec2 offset = {}) {
  for (const VertexId v : mesh.vertices()) {
    mesh.set_position(v, factor * mesh.position(v) + offset);
    mesh.set_weight(v, factor * factor * mesh.weight(v));
  }
  return mesh;
}

inline std::size_t bad_triangles(const Mesh& mesh) {
  std::size_t bad = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    bad += is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r)) ? 0 : 1;
  }
  return bad;
}

/// A lattice jittered so much that most of its triangulations have bad triangles, and many have weights that cure them.
inline Mesh jittered_lattice(std::uint64_t seed, int n = 6) {
  return lattice({.n = n, .jitter = 0.38, .weight = 0, .seed = seed});
}

inline WeightReport weights_of(const Mesh& mesh, const WeightOptions& options = {}) {
  const auto solver = clp_solver();
  auto report = find_weights(mesh, *solver, options);
  if (!report) {
    ADD_FAILURE() << report.error().what();
    return {};
  }
  return *std::move(report);
}

inline BestMargin margin_of(const Mesh& mesh, Conditions conditions = Conditions::well_centered,
                            const std::vector<HalfedgeId>& edges = {}) {
  const auto solver = clp_solver();
  return best_margin(mesh, *solver, conditions, edges);
}

}  // namespace temper::test
