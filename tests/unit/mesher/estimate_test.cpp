// The estimate of the cost of a mesh, what it refuses, and what a caller hears before the optimization.
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "outlines.hpp"
#include "temper/generate.hpp"
#include "temper/mesher.hpp"

namespace temper::test {
namespace {

double expected_triangles(const Outline& outline, const MesherOptions& options) {
  const Expected<MeshEstimate> estimate = estimate_outline(outline, options);
  EXPECT_TRUE(estimate.has_value()) << estimate.error().what();
  return estimate ? estimate->triangles : 0;
}

std::string error_of(const Expected<OutlineMesh>& made) { return made ? "a mesh" : made.error().message; }

/// The number behind "a size of " in the advice.
double advised_size(const std::string& message) {
  const std::string words = "Next: a size of ";
  const std::size_t at = message.find(words);
  EXPECT_NE(at, std::string::npos) << message;
  return at == std::string::npos ? 0 : std::stod(message.substr(at + words.size()));
}

constexpr std::uint64_t kGigabyte = 1'000'000'000;

/// A square of side 1 with a point in it that has a size of its own.
Outline well(double size) {
  Outline outline = square();
  outline.points.push_back({0.5, 0.5});
  const auto point = static_cast<std::int32_t>(outline.points.size() - 1);
  outline.sizes.push_back({{point, point}, size});
  return outline;
}

TEST(MesherEstimate, OneSizeHasTheAreaOverAnEquilateralTriangle) {
  EXPECT_NEAR(expected_triangles(square(), of_size(0.001)), 4e6 / std::sqrt(3.0), 1e-3);
  const double globe = 4 * std::numbers::pi * 6371e3 * 6371e3;
  const Expected<MeshEstimate> sphere = estimate_sphere({}, of_size(1000));
  ASSERT_TRUE(sphere.has_value());
  EXPECT_NEAR(sphere->triangles, globe * 4e-6 / std::sqrt(3.0), 1e-6 * sphere->triangles);
}

TEST(MesherEstimate, IsTheNumberOfTrianglesOfTheMesh) {
  for (const NamedOutline& named : outlines()) {
    for (const double part : {0.03, 0.015}) {
      SCOPED_TRACE(named.name + ", size " + std::to_string(part) + " of the extent");
      MesherOptions options = of_size(part * extent(named.outline));
      options.optimize.reset();
      const Expected<OutlineMesh> made = mesh_outline(named.outline, options);
      ASSERT_TRUE(made.has_value());
      const double ratio = expected_triangles(named.outline, options) / static_cast<double>(made->mesh.n_triangles());
      EXPECT_GT(ratio, 0.4);
      EXPECT_LT(ratio, 2.5);
    }
  }
}

// The integral of 4/√3 / s² around a point, for s = least + grade r, is 8π/√3 / grade² (ln(1/least) − 1) up to s = 1.
TEST(MesherEstimate, SizesThatGrowAwayFromAPointAreIntegrated) {
  const double with = expected_triangles(well(1e-9), of_size(0.01)),
               without = expected_triangles(square(), of_size(0.01));
  const double growing = 8 * std::numbers::pi / std::sqrt(3.0) / 0.09 * (std::log(0.01 / 1e-9) - 1);
  const double replaced = 4 / std::sqrt(3.0) / 1e-4 * std::numbers::pi * std::pow(0.01 / 0.3, 2);
  EXPECT_NEAR(with - without, growing - replaced, 0.4 * growing);
}

TEST(MesherEstimate, ASmallSpotOfASizeFieldIsSeen) {
  const Mesh grid = *sheared_grid({.nx = 100, .ny = 100, .shear = 0});
  std::vector<double> sizes(grid.n_vertices(), 1);
  for (const std::size_t corner : {50 * 101 + 37, 50 * 101 + 38, 51 * 101 + 37, 51 * 101 + 38}) sizes[corner] = 1e-4;
  MesherOptions options;
  options.field = *SizeField::from_values(grid, sizes);
  const Outline outline = loop({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  const double in_spot = 4e8 / std::sqrt(3.0);
  EXPECT_NEAR(expected_triangles(outline, options), in_spot, 0.1 * in_spot);
}

TEST(MesherMemory, ASizeThatNeedsTooMuchIsRefusedWithOneThatFits) {
  for (const double size : {1e-4, 1e-9, 1e-300}) {
    for (const Outline& outline : {square(), well(1e-6)}) {
      MesherOptions options = of_size(size);
      options.memory = kGigabyte;
      const std::string message = error_of(mesh_outline(outline, options));
      EXPECT_NE(message.find("but 1 GB are free"), std::string::npos) << message;
      const Expected<MeshEstimate> fits = estimate_outline(outline, of_size(advised_size(message)));
      ASSERT_TRUE(fits.has_value());
      EXPECT_LE(fits->bytes, 1e9) << message;
      EXPECT_GT(fits->bytes, 0.5e9) << message;
    }
  }
}

TEST(MesherMemory, SpheresFieldsRegionsAndFewPointsAreRefusedToo) {
  MesherOptions options = of_size(1000);
  options.memory = kGigabyte;
  const std::string globe = error_of(mesh_sphere({}, options));
  // 0.8 of the memory less 60 MB, at 250 bytes per triangle, is enough for 3 million triangles.
  EXPECT_NE(globe.find("Next: a size of 20000 or more"), std::string::npos) << globe;
  const Mesh corners = *sheared_grid({.nx = 1, .ny = 1, .shear = 0});
  options.size = 0;
  options.field = *SizeField::from_values(corners, std::vector<double>(corners.n_vertices(), 1e-200));
  EXPECT_NE(error_of(mesh_outline(square(), options)).find("the size field would make about 1e+300 or more triangles"),
            std::string::npos);
  options.field.reset();
  options.size = 1;
  options.region_sizes = {{0, 1e-200}};
  EXPECT_NE(error_of(mesh_outline(square(), options)).find("sizes of regions and lines"), std::string::npos);
  options.region_sizes.clear();
  options.memory = 1'000'000;
  options.points = MeshPoints::few;
  EXPECT_NE(error_of(mesh_outline(square(), options)).find("an outline of 4 points would make about 8 triangles"),
            std::string::npos);
}

TEST(MesherMemory, TheEstimateComesBeforeTheWork) {
  MesherOptions options = of_size(0.1);
  double told = 0;
  options.estimated = [&](const MeshEstimate& estimate) { told += estimate.triangles; };
  ASSERT_TRUE(mesh_outline(square(), options).has_value());
  EXPECT_NEAR(told, 4e2 / std::sqrt(3.0), 1e-6);
}

TEST(MesherMemory, NumbersAreForPeople) {
  EXPECT_EQ((MeshEstimate{23094.01, 0}.triangles_text()), "23094");
  EXPECT_EQ((MeshEstimate{192'900'000, 0}.triangles_text()), "193 million");
  EXPECT_EQ((MeshEstimate{2.3e15, 0}.triangles_text()), "2.3e+15");
  EXPECT_EQ((MeshEstimate{0, 77.4e9}.memory_text()), "77 GB");
  EXPECT_EQ((MeshEstimate{0, 850e6}.memory_text()), "850 MB");
}

TEST(MesherProgress, EachLongPhaseHasItsNameAndItsShare) {
  MesherOptions options = of_size(0.004);
  options.optimize.reset();
  std::set<std::string> phases;
  OptimizeHooks hooks;
  hooks.observer = [&](const Progress& progress) {
    phases.emplace(progress.phase);
    EXPECT_GE(progress.fraction, 0);
    EXPECT_LT(progress.fraction, 1);
    return Continue::yes;
  };
  ASSERT_TRUE(mesh_outline(square(), options, hooks).has_value());
  // Shorter phases may end before it is time to tell them.
  for (const char* phase : {"placing points", "triangulating"}) EXPECT_EQ(phases.count(phase), 1u) << phase;
  EXPECT_EQ(phases.count(""), 0u);
}

}  // namespace
}  // namespace temper::test
