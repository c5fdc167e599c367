// The promises of the accuracy objective, on public meshes that nobody here made and on fields that no parameter was
// chosen by: errors over those of the input, each mesh well-centered and regular with its margins.
//
// docs/explanation/accuracy.md says which errors are reached, and how.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "temper/errors.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"

namespace temper::test {
namespace {

constexpr const char* kMeshesForAccuracy[] = {
    "mfem_square-disc.mesh",       "pydec_ResonantCavity.vtu",  "sfepy_circle_in_square.mesh",
    "sfepy_circles_in_square.vtk", "sfepy_its2D.mesh",          "sfepy_osteonT1_11.mesh",
    "skfem_annulus.msh",           "skfem_cylinder_stokes.msh", "skfem_square.msh"};

constexpr std::size_t kMostVertices = 2000;

struct Errors {
  double star1 = 0, poisson = 0, poisson_max = 0, flux = 0;
};

/// What a scheme promises: means over the meshes, and of each mesh.
struct Promise {
  Objective objective;
  Scheme scheme;
  Errors mean, worst;
  double band;
};
constexpr double kAny = 10;  // no promise
constexpr Promise kPromises[] = {
    {Objective::accuracy, Scheme::all, {0.70, 0.70, 0.74, 0.67}, {0.85, 0.85, 0.92, 0.86}, 1.45},
    {Objective::accuracy, Scheme::vertex, {0.61, 0.58, 0.60, 0.64}, {0.93, 0.77, 0.76, kAny}, 1.8},
    {Objective::accuracy, Scheme::cell, {0.53, kAny, kAny, 0.39}, {0.81, kAny, kAny, 0.62}, 1.8},
    {Objective::accuracy, Scheme::stars, {0.50, kAny, kAny, 0.44}, {0.70, kAny, kAny, kAny}, 1.8},
    {Objective::solver_error, Scheme::vertex, {0.69, 0.48, 0.49, kAny}, {kAny, 0.63, 0.65, kAny}, 1.8},
    {Objective::solver_error, Scheme::cell, {0.58, kAny, kAny, 0.30}, {kAny, kAny, kAny, 0.55}, 1.8},
};

/// Logarithms, summed over meshes.
struct Means {
  Errors sum;
  int meshes = 0;
  void add(const Errors& e) {
    sum.star1 += std::log(e.star1);
    sum.poisson += std::log(e.poisson);
    sum.poisson_max += std::log(e.poisson_max);
    sum.flux += std::log(e.flux);
    ++meshes;
  }
  [[nodiscard]] Errors mean() const {
    const auto of = [this](double s) { return std::exp(s / meshes); };
    return {of(sum.star1), of(sum.poisson), of(sum.poisson_max), of(sum.flux)};
  }
};

void expect_at_most(const Errors& found, const Errors& promised) {
  EXPECT_LE(found.star1, promised.star1);
  EXPECT_LE(found.poisson, promised.poisson);
  EXPECT_LE(found.poisson_max, promised.poisson_max);
  EXPECT_LE(found.flux, promised.flux);
}

Mesh public_mesh(const std::string& path) {
  const auto file = io::read(path);
  EXPECT_TRUE(file) << file.error().what();
  auto loaded = io::make_mesh(*file);
  EXPECT_TRUE(loaded) << loaded.error().what();
  return loaded->mesh;
}

/// Errors over those of the input.
Errors improved_errors(const Mesh& input, const Promise& promise) {
  Mesh mesh = input, barrier = input;
  OptimizeOptions options;
  options.objective = promise.objective;
  options.scheme = promise.scheme;
  const auto report = optimize(mesh, options, {.solvers = solvers()});
  EXPECT_TRUE(report) << report.error().what();
  EXPECT_TRUE(optimize(barrier, {.objective = Objective::energy}));

  const Quality q = quality(mesh), of_barrier = quality(barrier);
  const double margin = scheme_weights(promise.scheme).margin;
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_GE(q.min_h_over_l, std::min(margin, 0.9 * of_barrier.min_h_over_l));
  EXPECT_GE(q.min_d_over_l, margin);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_LE(report->size.after.band(), promise.band);
  // A price in errors may have to be paid for good triangles, but not in the offsets that bound them.
  if (!wants_error_model(options, input)) {
    EXPECT_LT(report->objective_after, report->objective_before);
  }
  for (const VertexId v : input.vertices()) {
    if (!input.is_boundary(v)) continue;
    EXPECT_EQ(mesh.position(v), input.position(v));
  }

  MeasureErrorsOptions measuring;
  measuring.frame = field_frame(input);
  measuring.fields = {"held-back"};
  const auto after = measure_errors(mesh, measuring), before = measure_errors(input, measuring);
  EXPECT_TRUE(after && before);
  const auto ratios = error_ratios(*after, *before);
  EXPECT_TRUE(ratios);
  const OperatorErrors mean = geometric_mean(*ratios);
  return {mean.star[1].l2, mean.poisson.l2, mean.poisson.max, mean.flux.l2};
}

TEST(AccuracyOfPublicMeshes, KeepsThePromisesOfEachSchemeOnFieldsThatWereHeldBack) {
  for (const Promise& promise : kPromises) {
    SCOPED_TRACE(static_cast<int>(promise.scheme));
    Means means;
    for (const char* name : kMeshesForAccuracy) {
      SCOPED_TRACE(name);
      const std::string path = std::string(TEMPER_SHARED "/meshes") + "/" + name;
      if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
      const Mesh mesh = public_mesh(path);
      if (mesh.n_vertices() > kMostVertices) continue;
      const Errors errors = improved_errors(mesh, promise);
      expect_at_most(errors, promise.worst);
      means.add(errors);
    }
    ASSERT_EQ(means.meshes, 9);
    expect_at_most(means.mean(), promise.mean);
  }
}

}  // namespace
}  // namespace temper::test
