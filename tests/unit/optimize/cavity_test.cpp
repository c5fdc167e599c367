// The energy of a vertex's cavity without the vertex gives the change of the total, for every energy and star.
#include <gtest/gtest.h>

#include "energy/patch.hpp"
#include "optimize/step/removal.hpp"
#include "support/lattice.hpp"
#include "temper/regularity.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

TEST(CavityEnergy, ChangesThePatchAsTheTotalChanges) {
  int cases = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Mesh mesh = lattice({.n = 6, .jitter = 0.2, .weight = 0.1, .seed = seed});
    ASSERT_TRUE(restore_regularity(mesh).regular());
    for (const VertexId v : mesh.vertices()) {
      const RemovalPlan plan = plan_removal(mesh, v);
      if (mesh.is_boundary(v) || plan.status != RemovalStatus::possible) continue;
      Mesh without = mesh;
      remove_vertex(without, plan);
      without.compact();
      for (const EnergyModel& model : all_models(1)) {
        const double before = total_energy(mesh, model), after = total_energy(without, model);
        if (!std::isfinite(before) || !std::isfinite(after)) continue;
        Patch patch;
        gather_patch(mesh, v, needs_outer(model.kind), patch);
        const double change = cavity_energy(mesh, model, plan) - patch_energy(patch, model, mesh.point(v));
        EXPECT_NEAR(change, after - before, 1e-11 * (1 + std::abs(before) + std::abs(after)));
        ++cases;
      }
    }
  }
  EXPECT_GT(cases, 500);
}

TEST(CavityEnergy, AnInsertionOrASplitChangesWhatItReplacesAsTheTotalChanges) {
  int insertions = 0, boundary_splits = 0, inner_splits = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Mesh mesh = lattice({.n = 5, .jitter = 0.2, .weight = 0.1, .seed = seed});
    ASSERT_TRUE(restore_regularity(mesh).regular());
    const auto check = [&](const InsertionPlan& plan, int& cases) {
      if (plan.status != InsertionStatus::possible) return;
      Mesh with = mesh;
      (void)insert_vertex(with, plan);
      for (const EnergyModel& model : all_models(1)) {
        const double before = total_energy(mesh, model), after = total_energy(with, model);
        if (!std::isfinite(before) || !std::isfinite(after)) continue;
        const double change = insertion_energy(mesh, model, plan) - replaced_energy(mesh, model, plan);
        EXPECT_NEAR(change, after - before, 1e-11 * (1 + std::abs(before) + std::abs(after)));
        ++cases;
      }
    };
    Noise noise(seed);
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.corners(t);
      const double u = 0.2 + 0.1 * noise(), v = 0.4 + 0.1 * noise();
      const Vec2 p = u * mesh.position(a) + v * mesh.position(b) + (1 - u - v) * mesh.position(c);
      check(plan_insertion(mesh, {p.x, p.y, interpolated_weight(mesh, t, p) + 0.05}, t), insertions);
    }
    for (const HalfedgeId h : mesh.halfedges()) {
      check(plan_split(mesh, h, 0.5), mesh.is_boundary(h) ? boundary_splits : inner_splits);
    }
  }
  EXPECT_GT(insertions, 500);
  EXPECT_GT(boundary_splits, 100);
  EXPECT_GT(inner_splits, 500);
}

TEST(CavityEnergy, APlanIsRegularWhenTheMeshIsAfterIt) {
  int regular = 0, irregular = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    const bool restores = seed % 2 == 0;
    Mesh mesh = lattice({.n = 6, .jitter = 0.3, .weight = restores ? 0.1 : 1.0, .seed = seed});
    if (restores) {
      ASSERT_TRUE(restore_regularity(mesh).regular());
    }
    for (const VertexId v : mesh.vertices()) {
      const RemovalPlan plan = plan_removal(mesh, v);
      if (mesh.is_boundary(v) || plan.status != RemovalStatus::possible) continue;
      Mesh without = mesh;
      remove_vertex(without, plan);
      bool all = true;  // edges of the new triangles
      for (const auto& [a, b, c] : plan.triangles) {
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
          all = all && is_regular(without, without.find_halfedge(p, q));
        }
      }
      EXPECT_EQ(is_regular(mesh, plan), all);
      ++(all ? regular : irregular);
    }
  }
  EXPECT_GT(regular, 30);
  EXPECT_GT(irregular, 5);
}

}  // namespace
}  // namespace temper::test
