// Whole runs that are compared with each other, or with their input. They look for no new path of the code, so that the
// optimized library is enough.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/instruction_set.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

constexpr double kRounding = 1e-8;

Mesh result_of(Mesh mesh, const OptimizeOptions& options, const OptimizeHooks& hooks = {}) {
  const auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  return mesh;
}

void expect_same_bytes(const Mesh& before, const OptimizeOptions& options) {
  const Mesh first = result_of(before, options);
  for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
    StdThreads executor(threads);
    EXPECT_TRUE(result_of(before, options, {.executor = &executor}) == first) << threads << " threads";
    EXPECT_GT(executor.runs(), 0U);
  }
  const InstructionSet used = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    EXPECT_TRUE(result_of(before, options) == first) << name(set);
  }
  ASSERT_TRUE(use_instruction_set(used));
}

TEST(WholeRuns, HaveTheSameBytesForAnyThreadsAndInstructionSet) {
  const OptimizeOptions both = {.objective = Objective::accuracy};  // after the sweeps of a barrier
  expect_same_bytes(globe(2500, 9), both);
  const auto torus = random_periodic({2500, 9, {1, 1}});
  ASSERT_TRUE(torus);
  expect_same_bytes(*torus, {.objective = Objective::accuracy, .max_sweeps = 20});
}

TEST(WholeRuns, OfAMeshThatNobodyLooksAtIsTheSame) {
  const auto made = random_mesh({.vertices = 400, .seed = 4});
  ASSERT_TRUE(made);
  const OptimizeOptions cases[] = {
      {},
      {.objective = Objective::accuracy},
      {.max_sweeps = 1},                                         // left bad: repaired
      {.energy = EnergyKind::F, .unknowns = Unknowns::weights},  // may be no better: then the input is returned
      {.repair = Repair::none, .paper = {.tolerance = 1e-2}},    // more than one restart
      {.boundary = BoundaryVertices::split, .size_band = 1.5},   // the field of the band refers to it
  };
  for (const OptimizeOptions& options : cases) {
    Mesh seen = *made, unseen = *made;
    const auto expected = optimize(seen, options), report = optimize(unseen, options, {.exclusive = true});
    ASSERT_EQ(expected.has_value(), report.has_value());
    EXPECT_EQ(unseen, seen);
    EXPECT_EQ(unseen.validate(), std::nullopt);
  }
  const auto scattered = random_mesh({.vertices = 33000, .seed = 4});
  ASSERT_TRUE(scattered);
  const OptimizeOptions one_sweep = {.repair = Repair::none, .max_sweeps = 1};
  Mesh seen = *scattered, unseen = *scattered;
  std::vector<std::size_t> viewed;
  const auto view = [&](const Mesh& mesh) { viewed.push_back(mesh.n_vertices()); };
  const auto expected = optimize(seen, one_sweep),
             report = optimize(unseen, one_sweep, {.exclusive = true, .viewer = view});
  ASSERT_TRUE(expected && report);
  EXPECT_EQ(unseen, seen);
  EXPECT_EQ(report->objective_after, expected->objective_after);
  EXPECT_EQ(viewed, std::vector<std::size_t>(2, 33000));
  Mesh refused = *made;
  EXPECT_FALSE(optimize(refused, {.max_sweeps = -1}, {.exclusive = true}));
  EXPECT_EQ(refused, *made);
}

/// The largest of −h/ℓ, −d/ℓ and d/ℓ − 1.
double worst_of(const Mesh& mesh) {
  const Quality q = quality(mesh);
  return std::max(-q.min_h_over_l, -q.min_d_over_l);
}

/// Meshes that no run can cure without more vertices: sharp wedges, and outlines without inner vertices.
TEST(WholeRuns, DoNotMakeTheWorstTriangleWorse) {
  std::size_t left_bad = 0;
  for (const Mesh& input : {*wedge({.angle_deg = 5, .pieces = 8}), *wedge({.angle_deg = 3, .pieces = 5, .seed = 2}),
                            letter_a(), *regular_polygon({.corners = 17}), *random_mesh({40, 5, {}})}) {
    for (const char* const target : {"any", "valid", "vertex", "cell", "stars", "mpas", "dflowfm", "adcirc", "fem"}) {
      Mesh mesh = input;
      OptimizeOptions options = *options_for(target, "quick");
      options.repair_trials = 300;
      ASSERT_TRUE(optimize(mesh, options));
      if (quality(mesh).well_centered_fraction == 1) continue;
      ++left_bad;
      EXPECT_LE(worst_of(mesh), worst_of(input) + kRounding) << target << ", " << input.n_triangles() << " triangles";
    }
  }
  EXPECT_GT(left_bad, 5u);
}

}  // namespace
}  // namespace temper::test
