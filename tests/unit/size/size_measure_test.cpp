// The sizes of a mesh compared with a size field: facts by hand, and invariance.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

TEST(LocalSize, IsTheEdgeOfAnEquilateralTriangle) {
  const Mesh triangle = one_triangle({0, 0}, {2, 0}, {1, std::sqrt(3.0)});
  for (const VertexId v : triangle.vertices()) EXPECT_DOUBLE_EQ(local_size(triangle, v), 2);
  const Mesh grid = lattice({.n = 5, .jitter = 0, .weight = 0});
  for (const VertexId v : grid.vertices()) EXPECT_NEAR(local_size(grid, v), 1, 1e-14);
}

TEST(LocalSize, DoesNotChangeWhenTheVertexMovesInItsStar) {
  Mesh mesh = lattice({.n = 5, .jitter = 0.1});
  const VertexId inner(12);
  ASSERT_FALSE(mesh.is_boundary(inner));
  const double before = local_size(mesh, inner);
  mesh.set_position(inner, mesh.position(inner) + Vec2{0.2, -0.1});
  EXPECT_NEAR(local_size(mesh, inner), before, 1e-14);
}

TEST(Spread, IsByNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Spread s = spread(values);
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.p05, 5);
  EXPECT_EQ(s.median, 50);
  EXPECT_EQ(s.p95, 95);
  EXPECT_EQ(s.max, 100);
  EXPECT_EQ(spread({7}).p05, 7);
  EXPECT_EQ(spread({}).max, 0);
}

TEST(MeasureSize, IsOneForAMeshAndItsOwnField) {
  const Mesh mesh = *random_mesh({300, 1, {}});
  const SizeReport report = measure_size(mesh, input_size_field(mesh));
  EXPECT_EQ(report.over_field.min, 1);
  EXPECT_EQ(report.over_field.max, 1);
  EXPECT_EQ(report.band(), 1);
  EXPECT_EQ(report.vertices_outside_field, 0U);
  EXPECT_GE(report.gradation.min, 1);
  EXPECT_GT(report.largest_edge_ratio, 1);
}

TEST(MeasureSize, OfHalfTheFieldIsTwo) {
  const Mesh mesh = lattice({.n = 6, .jitter = 0.1});
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) sizes.push_back((v.index % 2 == 0 ? 0.5 : 0.25) * local_size(mesh, v));
  const SizeReport report = measure_size(mesh, *SizeField::from_values(mesh, sizes));
  EXPECT_EQ(report.over_field.min, 2);
  EXPECT_EQ(report.over_field.max, 4);
  EXPECT_EQ(report.band(), 4);
}

TEST(MeasureSize, CountsVerticesBeyondTheField) {
  const Mesh mesh = lattice({.n = 6, .jitter = 0});
  const Mesh part = lattice({.n = 3, .jitter = 0});  // shares the origin and the spacing
  const SizeReport report = measure_size(mesh, input_size_field(part));
  EXPECT_EQ(report.vertices_outside_field, mesh.n_vertices() - part.n_vertices());
  EXPECT_NEAR(report.band(), 1, 1e-14);
}

TEST(MeasureSize, IsTheSameAfterScalingAndMovingAndRenumbering) {
  const LatticeOptions here{.n = 8, .jitter = 0.3, .weight = 0};
  LatticeOptions there = here;
  there.scale = 0.25;
  const Mesh mesh = lattice(here), scaled = lattice(there);
  const Mesh coarse = lattice({.n = 8, .jitter = 0, .weight = 0}),
             coarse_scaled = lattice({.n = 8, .jitter = 0, .weight = 0, .scale = 0.25});
  const SizeReport a = measure_size(mesh, input_size_field(coarse));
  const SizeReport b = measure_size(scaled, input_size_field(coarse_scaled));
  EXPECT_NEAR(a.over_field.min, b.over_field.min, 1e-13);
  EXPECT_NEAR(a.over_field.median, b.over_field.median, 1e-13);
  EXPECT_NEAR(a.gradation.p95, b.gradation.p95, 1e-6);  // kept in single precision
  EXPECT_NEAR(a.largest_edge_ratio, b.largest_edge_ratio, 1e-13);

  Mesh renumbered = mesh;
  hilbert_order(renumbered);
  ASSERT_NE(renumbered, mesh);
  const SizeReport c = measure_size(renumbered, input_size_field(coarse));
  EXPECT_EQ(a.over_field.max, c.over_field.max);
  EXPECT_EQ(a.over_field.p05, c.over_field.p05);
  EXPECT_EQ(a.gradation.max, c.gradation.max);
}

/// Runs the blocks last first.
class Backwards : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    for (std::size_t i = n; i > 0; --i) block(i - 1);
  }
};

TEST(MeasureSize, DoesNotDependOnTheOrderOfThreads) {
  const Mesh mesh = *random_mesh({9000, 1, {}});  // more than one block
  Mesh moved = mesh;
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) moved.set_position(v, mesh.position(v) + Vec2{1e-4, -1e-4});
  }
  const SizeField field = input_size_field(mesh);
  Backwards backwards;
  const SizeReport a = measure_size(moved, field), b = measure_size(moved, field, &backwards);
  EXPECT_NE(a.over_field.min, 1);
  EXPECT_EQ(a.over_field.min, b.over_field.min);
  EXPECT_EQ(a.over_field.median, b.over_field.median);
  EXPECT_EQ(a.over_field.p95, b.over_field.p95);
  EXPECT_EQ(a.vertices_outside_field, b.vertices_outside_field);
}

TEST(LocalSizes, OfScatteredVerticesAreThoseOfEachByItself) {
  const Mesh mesh = *random_mesh({100000, 3, {}});  // so many that they are visited along a curve
  Backwards backwards;
  const IdVector<VertexId, double> sizes = local_sizes(mesh), with_threads = local_sizes(mesh, &backwards);
  std::vector<double> each;
  for (const VertexId v : mesh.vertices()) {
    each.push_back(local_size(mesh, v));
    ASSERT_EQ(sizes[v], each.back());
  }
  EXPECT_EQ(with_threads.raw(), each);
}

// Gradation is found by counting, in slices that may run at once, or of small meshes by sorting.
TEST(MeasureSize, FindsTheGradationThatSortingFinds) {
  for (const std::size_t n : {10u, 500u, 100000u}) {
    const Mesh mesh = *random_mesh({n, 3, {}});
    std::vector<double> ratios;
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_edge_representative(h)) continue;
      const auto [low, high] = std::minmax({local_size(mesh, mesh.origin(h)), local_size(mesh, mesh.target(h))});
      ratios.push_back(static_cast<double>(static_cast<float>(high / low)));
    }
    const Spread expected = spread(std::move(ratios));
    Backwards backwards;
    const Spread found = measure_size(mesh, input_size_field(mesh), &backwards).gradation;
    for (double Spread::*part : {&Spread::min, &Spread::p05, &Spread::median, &Spread::p95, &Spread::max})
      EXPECT_EQ(found.*part, expected.*part) << n;
  }
}

}  // namespace
}  // namespace temper::test
