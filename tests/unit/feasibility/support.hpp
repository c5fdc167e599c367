// Fixtures for tests of weights alone: meshes that have good weights and that have none, and meshes scaled or weighted.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/rng.hpp"
#include "property/mesh_of_random_points.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/lp.hpp"
#include "temper/feasibility.hpp"
#include "temper/generate.hpp"

namespace temper::test {

/// What a user does with a report: weights that change are set, others stay.
inline Mesh with_weights(Mesh mesh, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.weight(v) != weights[v]) mesh.set_weight(v, weights[v]);
  }
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
    bad += is_well_centered(mesh.space(), mesh.point(p), mesh.point(q), mesh.point(r)) ? 0 : 1;
  }
  return bad;
}

/// A lattice jittered so much that most of its triangulations have bad triangles, and many have weights that cure them.
inline Mesh jittered_lattice(std::uint64_t seed, int n = 6) {
  return lattice({.n = n, .jitter = 0.38, .weight = 0, .seed = seed});
}

/// Two nested triangles, the ring between them divided like a pinwheel: no weights make all of its edges regular. The
/// inner triangle is turned about its middle; all sum of weights cancel around.
inline Mesh pinwheel(double turn = 0.1) {
  std::vector<Vec2> points;
  const double third = 2 * std::numbers::pi / 3;
  for (int k = 0; k < 3; ++k) points.push_back({4 * std::cos(k * third), 4 * std::sin(k * third)});
  for (int k = 0; k < 3; ++k) points.push_back({std::cos(k * third + turn), std::sin(k * third + turn)});
  return build_or_die(points, {{3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
}

inline bool is_upright(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (orientation(mesh.space(), mesh.point(v), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h))) !=
        Sign::positive) {
      return false;
    }
  }
  return true;
}

/// Random globes are far from having good weights; subdivided icosahedra with vertices moved are on either side.
inline Mesh jittered_globe(std::uint64_t seed, double jitter, int level = 1) {
  Mesh mesh = *icosahedral({.level = level});
  Rng rng(seed);
  const double most = jitter * std::sqrt(squared_length(mesh.weighted_vector(mesh.origin(HalfedgeId(std::size_t{0}))) -
                                                        mesh.weighted_vector(mesh.target(HalfedgeId(std::size_t{0})))));
  for (const VertexId v : mesh.vertices()) {
    const Vec3 move = {rng.uniform(-most, most), rng.uniform(-most, most), rng.uniform(-most, most)};
    const Vec3 p = mesh.weighted_vector(v) + move;
    const WeightedPoint was = mesh.point(v);
    mesh.set_point(v, as_point((mesh.space().radius() / length(p)) * p));
    if (!is_upright(mesh, v)) mesh.set_point(v, was);
  }
  return mesh;
}

/// Of a mesh of triangles or of tetrahedra.
template <class M>
WeightReport weights_of(const M& mesh, const WeightOptions& options = {}) {
  const auto solver = clp_solver();
  auto report = find_weights(mesh, *solver, options);
  if (!report) {
    ADD_FAILURE() << report.error().what();
    return {};
  }
  return *std::move(report);
}

inline BestMargin margin_of(const Mesh& mesh, Constraints constraints = Constraints::well_centered,
                            const std::vector<HalfedgeId>& edges = {}) {
  const auto solver = clp_solver();
  return best_margin(mesh, *solver, constraints, edges);
}

}  // namespace temper::test
