// The promises of the accuracy objective, on public meshes that nobody here made and on fields that no parameter was
// chosen by: errors over those of the input, each mesh well-centered and regular with its margins.
//
// docs/accuracy.md says which errors are reached, and how.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/verify.hpp"

namespace temper::test {
namespace {

constexpr const char* kMeshesForAccuracy[] = {
    "mfem_square-disc.mesh",       "pydec_ResonantCavity.vtu",  "sfepy_circle_in_square.mesh",
    "sfepy_circles_in_square.vtk", "sfepy_its2D.mesh",          "sfepy_osteonT1_11.mesh",
    "skfem_annulus.msh",           "skfem_cylinder_stokes.msh", "skfem_square.msh"};
constexpr double kMostStar1 = 0.72, kMostPoisson = 0.80, kMostPoissonMax = 0.90, kMostFlux = 0.52;
constexpr double kMostBand = 1.3;

/// Sums of logarithms over meshes.
struct Means {
  double star1 = 0, poisson = 0, poisson_max = 0, flux = 0;
  int meshes = 0;
  [[nodiscard]] double of(double sum) const { return std::exp(sum / meshes); }
};

void improve_and_compare(const Mesh& input, Means& means) {
  Mesh mesh = input;
  OptimizeOptions options;
  options.objective = Objective::accuracy;
  const auto report = optimize(mesh, options);
  ASSERT_TRUE(report) << report.error().what();

  const Quality q = quality(mesh);
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_GE(q.min_h_over_l, options.accuracy.margin);
  EXPECT_GE(q.min_d_over_l, options.accuracy.margin);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_LE(report->size.after.band(), kMostBand);
  EXPECT_LT(report->final_energy, report->initial_energy);
  for (const VertexId v : input.vertices()) {
    if (!input.is_boundary(v)) continue;
    EXPECT_EQ(mesh.position(v), input.position(v));
  }

  VerifyOptions verifying;
  verifying.frame = verify_frame(input);
  verifying.fields = {"held-back"};
  const auto after = verify(mesh, verifying), before = verify(input, verifying);
  ASSERT_TRUE(after && before);
  const auto ratios = error_ratios(*after, *before);
  ASSERT_TRUE(ratios);
  const VerifyErrors mean = geometric_mean(*ratios);
  EXPECT_LT(mean.star[1].l2, 1);
  means.star1 += std::log(mean.star[1].l2);
  means.poisson += std::log(mean.poisson.l2);
  means.poisson_max += std::log(mean.poisson.max);
  means.flux += std::log(mean.flux.l2);
  ++means.meshes;
}

TEST(AccuracyOfPublicMeshes, LowersTheErrorsOfSolversOnFieldsThatWereHeldBack) {
  Means means;
  for (const char* name : kMeshesForAccuracy) {
    SCOPED_TRACE(name);
    const std::string path = std::string(TEMPER_SHARED "/meshes") + "/" + name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const auto file = io::read(path);
    ASSERT_TRUE(file) << file.error().what();
    const auto loaded = io::make_mesh(*file);
    ASSERT_TRUE(loaded) << loaded.error().what();
    improve_and_compare(loaded->mesh, means);
  }
  ASSERT_EQ(means.meshes, 9);
  EXPECT_LE(means.of(means.star1), kMostStar1);
  EXPECT_LE(means.of(means.poisson), kMostPoisson);
  EXPECT_LE(means.of(means.poisson_max), kMostPoissonMax);
  EXPECT_LE(means.of(means.flux), kMostFlux);
}

}  // namespace
}  // namespace temper::test
