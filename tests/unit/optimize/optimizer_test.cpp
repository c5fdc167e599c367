// Optimizer: updates of a mesh that changes a little at a time. tests/python/test_optimizer.py has the same for
// tetrahedra, other surfaces, and for the solver's rows.
#include "temper/optimizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "support/lattice.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

Mesh good_mesh() { return lattice({.n = 20, .jitter = 0.02, .weight = 0.01}); }

Vec3 place_of(const Mesh& mesh, VertexId v) { return mesh.space().place(mesh.point(v)); }

/// An inner vertex, the k-th.
VertexId inner(const Mesh& mesh, int k) {
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v) && k-- == 0) return v;
  }
  return {};
}

void disturb(Optimizer& optimizer, double amount, int every, std::uint64_t seed) {
  Noise noise(seed);
  const Mesh& mesh = optimizer.mesh();
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v) && v.index % static_cast<unsigned>(every) == 0)
      optimizer.move(v, place_of(mesh, v) + Vec3{amount * noise(), amount * noise(), 0});
  }
}

TEST(Optimizer, LeavesAGoodMeshAsItIs) {
  const Mesh input = good_mesh();
  ASSERT_TRUE(meets(input, Criterion::well_centered));
  Optimizer optimizer = *Optimizer::make(input);
  const auto update = optimizer.update();
  ASSERT_TRUE(update) << update.error().what();
  EXPECT_EQ(optimizer.mesh(), input);
  EXPECT_TRUE(update->difference.rows.empty() && update->difference.moved.empty() &&
              update->difference.weighed.empty() && update->difference.vertices.empty());
}

TEST(Optimizer, NamesAllThatChanged) {
  for (const Scheme scheme : {Scheme::all, Scheme::vertex, Scheme::cell}) {
    Optimizer optimizer = *Optimizer::make(good_mesh(), {.scheme = scheme});
    for (std::uint64_t step = 1; step < 4; ++step) {
      const Mesh before = optimizer.mesh();
      disturb(optimizer, 0.6, 37, step);
      const auto update = optimizer.update();
      ASSERT_TRUE(update) << update.error().what();
      const Mesh& mesh = optimizer.mesh();
      EXPECT_EQ(mesh.validate(), std::nullopt);
      EXPECT_TRUE(meets(mesh, criterion_of(scheme)));
      ASSERT_TRUE(update->difference.vertices.empty());
      const std::set<VertexId> rows(update->difference.rows.begin(), update->difference.rows.end());
      EXPECT_LT(rows.size(), mesh.n_vertices() / 2);
      for (const VertexId v : mesh.vertices()) {
        if (rows.contains(v)) continue;
        for (const HalfedgeId h : mesh.star(v)) {
          const HalfedgeId was = before.find_halfedge(v, mesh.target(h));
          ASSERT_TRUE(was.valid());
          EXPECT_EQ(before.opposite(was), mesh.opposite(h));
          for (const VertexId u : mesh.corners(Mesh::triangle(h))) EXPECT_EQ(mesh.point(u), before.point(u));
        }
      }
    }
  }
}

TEST(Optimizer, CarriesAVertexAcrossTheMesh) {
  OptimizeOptions options;
  options.unknowns = Unknowns::weights;
  Optimizer optimizer = *Optimizer::make(good_mesh(), options);
  const Mesh start = optimizer.mesh();
  const VertexId v = inner(start, 30);
  const Vec3 goal = place_of(start, inner(start, 300)) + Vec3{0.3, 0.1, 0};
  optimizer.move(v, goal);
  const auto update = optimizer.update();
  ASSERT_TRUE(update) << update.error().what();
  const Mesh& mesh = optimizer.mesh();
  EXPECT_EQ(place_of(mesh, v), goal);
  EXPECT_EQ(update->difference.moved, std::vector<VertexId>{v});
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
}

TEST(Optimizer, InsertsAndRemoves) {
  Optimizer optimizer = *Optimizer::make(good_mesh());
  const Mesh before = optimizer.mesh();
  const VertexId gone = inner(before, 100);
  optimizer.remove(gone);
  optimizer.remove(gone);
  const Vec3 middle = 0.5 * (place_of(before, inner(before, 10)) + place_of(before, inner(before, 11)));
  optimizer.insert(middle);
  const auto update = optimizer.update();
  ASSERT_TRUE(update) << update.error().what();
  const Mesh& mesh = optimizer.mesh();
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_TRUE(meets(mesh, Criterion::well_centered));
  const auto& numbers = update->difference.vertices;
  ASSERT_EQ(numbers.size(), mesh.n_vertices());
  EXPECT_EQ(std::ranges::count(numbers, gone), 0);
  EXPECT_FALSE(numbers.raw().back().valid());
}

TEST(Optimizer, HasTheSameBytesOnThreads) {
  StdThreads threads(3);
  Optimizer first = *Optimizer::make(good_mesh()), second = *Optimizer::make(good_mesh());
  for (std::uint64_t step = 1; step < 4; ++step) {
    disturb(first, 0.6, 37, step);
    disturb(second, 0.6, 37, step);
    ASSERT_TRUE(first.update() && second.update({.executor = &threads}));
    EXPECT_EQ(first.mesh(), second.mesh());
  }
}

class Named final : public InputNames {
  [[nodiscard]] std::string point(std::size_t index) const override { return "node " + std::to_string(index + 1); }
};

TEST(Optimizer, KeepsMeshAndChangesIfOneIsImpossible) {
  const Mesh input = good_mesh();
  const VertexId v = inner(input, 3);
  const Named names;
  const auto refused = [&](const auto& change, const std::string& words) {
    Optimizer optimizer = *Optimizer::make(input);
    optimizer.move(v, place_of(input, v) + Vec3{0.01, 0, 0});
    change(optimizer);
    for (int i = 0; i < 2; ++i) {
      const auto update = optimizer.update({}, &names);
      if (update || update.error().message.find(words) == std::string::npos) return false;
    }
    optimizer.forget();
    return optimizer.mesh() == input && optimizer.update().has_value();
  };
  EXPECT_TRUE(refused([&](Optimizer& o) { o.move(v, {1e3, 0, 0}); }, "node " + std::to_string(v.index + 1)));
  EXPECT_TRUE(refused([&](Optimizer& o) { o.insert({1e3, 0, 0}); }, "outside the mesh"));
  EXPECT_TRUE(refused([&](Optimizer& o) { o.insert(place_of(input, v) + Vec3{0.01, 0, 0}); }, "a vertex is there"));
  EXPECT_TRUE(refused([&](Optimizer& o) { o.remove(VertexId(99'999)); }, "is not in the mesh"));
  EXPECT_TRUE(refused([&](Optimizer& o) { o.set_weight(v, HUGE_VAL); }, "finite"));
  EXPECT_FALSE(Optimizer::make(input, {.energy = EnergyKind::F}));
}

}  // namespace
}  // namespace temper::test
