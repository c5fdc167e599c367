// A size band holds after optimization, costs nothing where it does not bind, and is told in the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/shapes.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

// Sizes are compared in the units of the run, and once more in the user's: a few roundings apart.
constexpr double kBandRounding = 1e-12;

struct Optimized {
  Mesh mesh;
  OptimizeReport report;
};

Optimized optimized(const Mesh& input, OptimizeOptions options) {
  options.repair = Repair::none;
  options.objective = Objective::energy;
  options.max_sweeps = std::min(options.max_sweeps, 100);  // laws hold after every sweep; more only takes longer
  Optimized result{input, {}};
  auto report = optimize(result.mesh, options);
  EXPECT_TRUE(report.has_value()) << report.error().what();
  if (report) result.report = *std::move(report);
  return result;
}

OptimizeOptions in_band(double band) {
  OptimizeOptions options;
  options.size_band = band;
  return options;
}

TEST(SizeBand, IsKeptOnRandomAndGradedMeshes) {
  const std::vector<Mesh> meshes = {*random_mesh({300, 1, {}}), *random_mesh({300, 2, {}}), *airfoil(), *annulus(),
                                    *horseshoe()};
  for (const Mesh& mesh : meshes) {
    const double without = optimized(mesh, {}).report.size.after.band();
    EXPECT_GT(without, 1.2);  // else the band would not bind
    for (const double band : {1.1, 1.5, 2.0}) {
      const Optimized result = optimized(mesh, in_band(band));
      EXPECT_GT(result.report.sweeps, 0);
      EXPECT_GT(result.report.size.after.band(), 1);
      EXPECT_LE(result.report.size.after.band(), band + kBandRounding);
      EXPECT_NE(result.mesh, mesh);
      EXPECT_GE(quality(result.mesh).well_centered_fraction, quality(mesh).well_centered_fraction);
    }
  }
}

TEST(SizeBand, IsKeptByEverySolver) {
  const Mesh mesh = *random_mesh({200, 5, {}});
  for (const Solver solver : {Solver::newton, Solver::golden, Solver::alternating}) {
    OptimizeOptions options = in_band(1.3);
    options.paper.solver = solver;
    options.max_sweeps = 20;
    const Optimized result = optimized(mesh, options);
    EXPECT_GT(result.report.size.after.band(), 1);
    EXPECT_LE(result.report.size.after.band(), 1.3 + kBandRounding);
  }
}

TEST(SizeBand, ThatNeverBindsChangesNoByteOfSweepsVertexByVertex) {
  const Mesh mesh = *random_mesh({300, 3, {}});
  const Optimized without = optimized(mesh, {});
  ASSERT_NE(without.mesh, mesh);
  for (const double band : {1e6, std::numeric_limits<double>::max()}) {
    const Optimized with = optimized(mesh, in_band(band));
    EXPECT_EQ(with.mesh, without.mesh);
    EXPECT_EQ(with.report.objective_after, without.report.objective_after);
  }
}

TEST(SizeBand, CuresWhatCanBeCuredWithinIt) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Optimized result = optimized(*random_mesh({400, seed, {}}), in_band(2));
    EXPECT_EQ(quality(result.mesh).well_centered_fraction, 1);
  }
}

/// A vertex that is out of the band of a user's field may come nearer, and never goes further away.
TEST(SizeBand, OfAFieldThatTheMeshDoesNotFollowIsNotLeftFurther) {
  const Mesh mesh = *random_mesh({300, 4, {}});
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) sizes.push_back(0.02 + 0.1 * std::abs(mesh.position(v).x));
  OptimizeOptions options = in_band(1.2);
  options.size_field = *SizeField::from_values(mesh, sizes);
  const Optimized result = optimized(mesh, options);
  const SizeChange& size = result.report.size;
  EXPECT_GT(size.before.band(), 1.5);
  ASSERT_EQ(result.report.notes.size(), 1U);
  EXPECT_EQ(result.report.notes[0].find("the input is outside of its size band"), 0U);
  EXPECT_LE(size.after.band(), size.before.band() * (1 + kBandRounding));
  EXPECT_EQ(measure_size(result.mesh, *options.size_field).over_field.max, size.after.over_field.max);
}

TEST(SizeChange, IsReportedWithoutABand) {
  const Mesh mesh = *random_mesh({200, 6, {}});
  const Optimized result = optimized(mesh, {});
  EXPECT_EQ(result.report.size.before.band(), 1);
  const SizeReport after = measure_size(result.mesh, input_size_field(mesh));
  EXPECT_GT(after.band(), 1.1);
  EXPECT_EQ(result.report.size.after.band(), after.band());
  EXPECT_EQ(result.report.size.after.gradation.p95, after.gradation.p95);
}

TEST(SizeBand, BelowOneIsRefused) {
  Mesh mesh = *random_mesh({100, 1, {}});
  for (const double band : {0.5, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto report = optimize(mesh, in_band(band));
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
  }
  OptimizeOptions tangled = *options_for("paper");
  tangled.size_band = 2;
  EXPECT_FALSE(optimize(mesh, tangled).has_value());
}

}  // namespace
}  // namespace temper::test
