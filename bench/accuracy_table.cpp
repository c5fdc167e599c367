// Errors of each target over those of the input, as Markdown: see docs/explanation/measured.md. The fields are
// the held-back ones of temper errors.
//
//     bench_accuracy_table FILE...                 one row per mesh and target, and their geometric means
//     bench_accuracy_table --variants FILE...      the means alone, of other stars and constants
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/errors.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"

namespace temper::bench {
namespace {

constexpr std::size_t kMeasures = 7;
constexpr const char* kHeader =
    "★0 | ★1 | ★1 max | ★2 | Poisson L2 | Poisson max | flux L2 | min h/ℓ | min d/ℓ | not well-centered | band |";

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

struct Row {
  std::array<double, kMeasures> errors = {};
  double h_over_l = 1, d_over_l = 1, bad = 0, band = 1;
};

struct Variant {
  std::string name;
  OptimizeOptions options;
};

void print(const std::string& name, const Row& row) {
  std::printf("| %s |", name.c_str());
  for (const double e : row.errors) std::printf(" %.3f |", e);
  std::printf(" %.3f | %.3f | %.0f | %.2f |\n", row.h_over_l, row.d_over_l, row.bad, row.band);
}

std::optional<Row> measured(const Mesh& input, const OptimizeOptions& options) {
  Mesh mesh = input;
  const auto report = optimize(mesh, options, {.solvers = solvers()});
  MeasureErrorsOptions measuring;
  measuring.frame = field_frame(input);
  measuring.fields = {"held-back"};
  const auto before = measure_errors(input, measuring), after = measure_errors(mesh, measuring);
  if (!report || !before || !after) return std::nullopt;
  const auto ratios = error_ratios(*after, *before);
  if (!ratios) return std::nullopt;
  const OperatorErrors e = geometric_mean(*ratios);
  const Quality q = quality(mesh);
  return Row{{e.star[0].l2, e.star[1].l2, e.star[1].max, e.star[2].l2, e.poisson.l2, e.poisson.max, e.flux.l2},
             q.min_h_over_l,
             q.min_d_over_l,
             std::round((1 - q.well_centered_fraction) * static_cast<double>(q.triangles)),
             report->size.after.band()};
}

/// Rows of all meshes when `each`; the geometric mean of errors, with the worst of the rest.
bool print_variant(const std::vector<NamedMesh>& meshes, const Variant& variant, bool each) {
  Row mean;
  for (const NamedMesh& input : meshes) {
    const std::optional<Row> row = measured(input.mesh, variant.options);
    if (!row) {
      std::fprintf(stderr, "%s cannot be measured\n", input.name.c_str());
      return false;
    }
    if (each) print(input.name + " | " + variant.name, *row);
    for (std::size_t i = 0; i < kMeasures; ++i) mean.errors[i] += std::log(row->errors[i]);
    mean.h_over_l = std::min(mean.h_over_l, row->h_over_l);
    mean.d_over_l = std::min(mean.d_over_l, row->d_over_l);
    mean.bad += row->bad;
    mean.band = std::max(mean.band, row->band);
  }
  for (double& e : mean.errors) e = std::exp(e / static_cast<double>(meshes.size()));
  print(each ? "**all** | " + variant.name : variant.name, mean);
  return true;
}

std::vector<Variant> targets_of_solvers() {
  std::vector<Variant> list;
  for (const char* name : {"any", "vertex", "cell", "stars"}) {
    list.push_back({std::string("`--for ") + name + "`", *options_for(name)});
  }
  list.push_back({"`--set objective=energy`", {.objective = Objective::energy}});
  return list;
}

/// Each has one option that is another than in the first.
std::vector<Variant> variants() {
  OptimizeOptions accuracy;
  accuracy.objective = Objective::accuracy;
  accuracy.accuracy = {.offset_factor = 10, .boundary_offset_factor = 18, .margin = 0.02};
  std::vector<Variant> list = {{"c = 10, c_b = 18, ε = 0.02", accuracy}};
  const auto add = [&](const char* name, auto change) {
    list.push_back({name, accuracy});
    change(list.back().options);
  };
  add("`--set star=0`", [](OptimizeOptions& o) { o.star = Star::zero; });
  add("`--set star=2`", [](OptimizeOptions& o) { o.star = Star::two; });
  add("`--set star=all`", [](OptimizeOptions& o) { o.star = Star::all; });
  add("`--set offset_factor=1,boundary_offset_factor=1` (HOT/s²)",
      [](OptimizeOptions& o) { o.accuracy.offset_factor = o.accuracy.boundary_offset_factor = 1; });
  add("`--set offset_factor=5`", [](OptimizeOptions& o) { o.accuracy.offset_factor = 5; });
  add("`--set offset_factor=20`", [](OptimizeOptions& o) { o.accuracy.offset_factor = 20; });
  add("`--set boundary_offset_factor=0.5`", [](OptimizeOptions& o) { o.accuracy.boundary_offset_factor = 0.5; });
  add("`--set boundary_offset_factor=10`", [](OptimizeOptions& o) { o.accuracy.boundary_offset_factor = 10; });
  add("`--set boundary_offset_factor=30`", [](OptimizeOptions& o) { o.accuracy.boundary_offset_factor = 30; });
  add("`--set margin=0.05`", [](OptimizeOptions& o) { o.accuracy.margin = 0.05; });
  add("`--set barrier=0.03`", [](OptimizeOptions& o) { o.accuracy.barrier = 0.03; });
  add("`--set barrier=0.0003`", [](OptimizeOptions& o) { o.accuracy.barrier = 0.0003; });
  add("`--set accuracy_sweeps=5`", [](OptimizeOptions& o) { o.accuracy.sweeps = 5; });
  add("`--set accuracy_sweeps=10`", [](OptimizeOptions& o) { o.accuracy.sweeps = 10; });
  add("`--set accuracy_sweeps=100,accuracy_tolerance=0`",
      [](OptimizeOptions& o) { o.accuracy.sweeps = 100, o.accuracy.tolerance = 0; });
  return list;
}

int run(std::span<const std::string_view> arguments) {
  const bool all = !arguments.empty() && arguments.front() == "--variants";
  std::vector<NamedMesh> meshes;
  for (const std::string_view path : arguments.subspan(all ? 1 : 0)) {
    const auto file = io::read(std::string(path));
    if (!file) return std::fprintf(stderr, "%s\n", file.error().what().c_str()), 1;
    auto loaded = io::make_mesh(*file);
    if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().what().c_str()), 1;
    meshes.push_back({std::string(path.substr(path.rfind('/') + 1)), std::move(loaded->mesh)});
  }
  if (meshes.empty()) return std::fprintf(stderr, "bench_accuracy_table: expected mesh files\n"), 2;
  std::printf(all ? "| | %s\n|" : "| mesh | | %s\n|-|", kHeader);
  for (std::size_t i = 0; i < kMeasures + 5; ++i) std::printf("-|");
  std::printf("\n");
  for (const Variant& variant : all ? variants() : targets_of_solvers()) {
    if (!print_variant(meshes, variant, !all)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace temper::bench

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  return temper::bench::run(arguments);
}
