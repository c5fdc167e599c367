// Runs with a tensor for each region.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/layers_of_rock.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/feasibility.hpp"
#include "temper/optimize.hpp"

namespace temper {
namespace {

struct Result {
  Mesh mesh;
  OptimizeReport report;
  MetricMesh pieces;
};

Result run_of(const test::LayersOfRock& rock, OptimizeOptions options = {}) {
  Result run = {rock.mesh, {}, {}};
  options.triangle_tensors = rock.tensors;
  auto report = optimize(run.mesh, options);
  EXPECT_TRUE(report) << report.error().what();
  run.report = *std::move(report);
  run.pieces = *mapped(run.mesh, *Metrics::of(run.report.triangle_tensors), run.report.corner_weights);
  return run;
}

std::size_t bad_in(const Mesh& mesh) {
  std::size_t bad = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    bad += is_well_centered(mesh.space(), p, q, r) ? 0 : 1;
  }
  return bad;
}

TEST(RunsWithTensors, MakeTrianglesWellCenteredInTheMetricOfTheirRegion) {
  for (const double ratio : {2.0, 3.0, 8.0}) {
    const test::LayersOfRock rock = test::layers_of_rock(3, ratio, 4);
    EXPECT_GT(bad_in(rock.pieces().mesh), ratio > 2 ? 5U : 0U);
    const Result run = run_of(rock, {.boundary = BoundaryVertices::split});
    EXPECT_FALSE(run.mesh.validate());
    EXPECT_EQ(bad_in(run.pieces.mesh), 0U) << ratio;
    EXPECT_LT(largest_gap(run.pieces), 1e-14);
    EXPECT_EQ(run.report.triangle_tensors.size(), run.mesh.n_triangles());
    EXPECT_EQ(run.report.corner_weights.size(), run.mesh.n_halfedges());
  }
}

TEST(RunsWithTensors, KeepInterfacesAndTheirVertices) {
  const test::LayersOfRock rock = test::layers_of_rock(3, 4, 4);
  const Result run = run_of(rock);
  ASSERT_TRUE(run.report.vertices.empty());
  const MetricMesh before = rock.pieces();
  EXPECT_EQ(seams_of(run.pieces).size(), seams_of(before).size());
  for (const SeamEdge& seam : seams_of(before)) {
    for (const HalfedgeId h : {seam.one, seam.other}) {
      const VertexId v = before.first_copy(before.mesh.origin(h));
      EXPECT_EQ(run.mesh.position(v).x, rock.mesh.position(v).x);
      EXPECT_EQ(run.mesh.position(v).y, rock.mesh.position(v).y);
      EXPECT_FALSE(run.mesh.is_frozen(v));
      EXPECT_FALSE(run.mesh.is_fixed(v));
    }
  }
}

TEST(RunsWithTensors, TakeAnyWeightsOfTheInput) {
  test::LayersOfRock rock = test::layers_of_rock(3, 4, 4);
  test::Noise noise(3);
  for (const VertexId v : rock.mesh.vertices()) rock.mesh.set_weight(v, 0.1 * noise());
  EXPECT_GT(largest_gap(rock.pieces()), 1e-3);
  const Result run = run_of(rock);
  EXPECT_LT(largest_gap(run.pieces), 1e-14);
  EXPECT_LT(bad_in(run.pieces.mesh), bad_in(rock.pieces().mesh));
}

TEST(RunsWithTensors, SplitInterfacesOnBothSides) {
  const test::LayersOfRock rock = test::layers_of_rock(2, 60, 3);
  const Result run = run_of(rock, {.boundary = BoundaryVertices::split});
  EXPECT_GT(seams_of(run.pieces).size(), seams_of(rock.pieces()).size());
  EXPECT_FALSE(run.mesh.validate());
  EXPECT_LT(largest_gap(run.pieces), 1e-13);
  ASSERT_EQ(run.report.vertices.size(), run.mesh.n_vertices());
  EXPECT_GT(run.report.vertices_inserted, 0U);
  EXPECT_LT(10 * bad_in(run.pieces.mesh), bad_in(rock.pieces().mesh));
}

TEST(RunsWithTensors, OfOneTensorAreThoseOfAConstant) {
  test::LayersOfRock rock = test::layers_of_rock(2, 4);
  rock.tensors.assign(rock.tensors.size(), Tensor{1, 0.2, 3});
  const Result run = run_of(rock);
  Mesh constant = rock.mesh;
  ASSERT_TRUE(optimize(constant, {.tensor = Tensor{1, 0.2, 3}}));
  EXPECT_EQ(run.mesh, constant);
  EXPECT_TRUE(run.report.corner_weights.empty());
}

TEST(RunsWithTensors, WithTheLeastChangeReturnAMeshThatIsGood) {
  const test::LayersOfRock rock = test::layers_of_rock(3, 2, 4);
  const Result first = run_of(rock, {.boundary = BoundaryVertices::split});
  ASSERT_EQ(bad_in(first.pieces.mesh), 0U);
  Mesh again = first.mesh;
  const auto report = optimize(again, {.change = Change::least,
                                       .triangle_tensors = first.report.triangle_tensors,
                                       .corner_weights = first.report.corner_weights});
  ASSERT_TRUE(report);
  EXPECT_EQ(again, first.mesh);
  EXPECT_EQ(report->corner_weights, first.report.corner_weights);
}

TEST(RunsWithTensors, WhoseAxesTurnFromTriangleToTriangleTakeTheMeanOfTheRegion) {
  test::LayersOfRock rock = test::layers_of_rock(2, 4, 4);
  const auto angle_at = [](const Mesh& mesh, TriangleId t) {
    return 0.1 * std::sin(mesh.position(mesh.corners(t)[0]).x);
  };
  for (const TriangleId t : rock.mesh.triangles()) {
    const double c = std::cos(angle_at(rock.mesh, t)), s = std::sin(angle_at(rock.mesh, t));
    rock.tensors[t.index] = {4 * c * c + s * s, 3 * c * s, 4 * s * s + c * c};
  }
  const std::size_t before = bad_in(rock.pieces().mesh);
  const Result run = run_of(rock, {.boundary = BoundaryVertices::split});
  EXPECT_GT(before, 10U);
  EXPECT_LT(4 * bad_in(run.pieces.mesh), before);
  EXPECT_LT(largest_gap(run.pieces), 1e-13) << "each edge is an interface";
  EXPECT_EQ(run.report.corner_weights.size(), run.mesh.n_halfedges());
  // Where axes turn so fast that the mean says nothing, the input comes back.
  test::Noise noise(9);
  for (Tensor& k : rock.tensors) {
    const double a = 3 * noise(), c = std::cos(a), s = std::sin(a);
    k = {50 * c * c + s * s, 49 * c * s, 50 * s * s + c * c};
  }
  const std::size_t bad = bad_in(rock.pieces().mesh);
  const Result wild = run_of(rock);
  EXPECT_LE(bad_in(wild.pieces.mesh), bad);
}

TEST(RunsWithTensors, OfAResultMakeNothingWorse) {
  for (const double ratio : {3.0, 40.0}) {
    const test::LayersOfRock rock = test::layers_of_rock(3, ratio, 3);
    const Result first = run_of(rock, {.boundary = BoundaryVertices::split});
    OptimizeOptions again;
    again.boundary = BoundaryVertices::split;
    again.triangle_tensors = first.report.triangle_tensors;
    again.corner_weights = first.report.corner_weights;
    Mesh mesh = first.mesh;
    const auto report = optimize(mesh, again);
    ASSERT_TRUE(report);
    const MetricMesh pieces = *mapped(mesh, *Metrics::of(report->triangle_tensors), report->corner_weights);
    EXPECT_LE(bad_in(pieces.mesh), bad_in(first.pieces.mesh)) << ratio;
  }
}

TEST(RunsWithTensors, TellWrongArrays) {
  test::LayersOfRock rock = test::layers_of_rock(2, 4);
  rock.tensors.pop_back();
  Mesh mesh = rock.mesh;
  const auto refused = optimize(mesh, {.triangle_tensors = rock.tensors});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "tensors: expected 72 for 72 triangles, found 71");
  EXPECT_EQ(mesh, rock.mesh);
}

}  // namespace
}  // namespace temper
