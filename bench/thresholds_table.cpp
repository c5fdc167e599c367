// The tables of docs/thresholds.md, as Markdown: what solvers' codes look at, by quality_measures().
//
//     bench_thresholds_table --definitions     one row a measure
//     bench_thresholds_table FILE...           one row a mesh and run: input, default, margins kept, one repaired
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::bench {
namespace {

struct Run {
  const char* name;
  bool optimized;
  OptimizeOptions options;
};

std::vector<Run> runs() {
  OptimizeOptions positions;
  positions.unknowns = Unknowns::positions;
  OptimizeOptions kept;
  kept.accuracy.min_edge = 0.75;
  kept.accuracy.min_dual = 0.3;
  OptimizeOptions repaired = kept;
  repaired.repair = Repair::vertices;
  return {{"input", false, {}},
          {"default", true, {}},
          {"`--unknowns positions`", true, positions},
          {"`--min-edge 0.75 --min-dual 0.3`", true, kept},
          {"the same, `--repair vertices`", true, repaired}};
}

void print_definitions() {
  std::printf("| `--require`, JSON | short | code | what | wanted |\n|-|-|-|-|-|\n");
  for (const QualityMeasure& m : quality_measures()) {
    const char* sign = m.better == Better::equal ? "=" : m.better == Better::larger ? "≥" : "≤";
    const std::string alias = m.alias.empty() ? "" : "`" + std::string(m.alias) + "`";
    std::string definition;
    for (const char c : m.definition) definition += c == '|' ? std::string("\\|") : std::string(1, c);
    std::printf("| `%s` | %s | %s | %s |", std::string(m.key).c_str(), alias.c_str(), std::string(m.community).c_str(),
                definition.c_str());
    m.wanted ? std::printf(" %s %g |\n", sign, *m.wanted) : std::printf(" – |\n");
  }
}

/// Bold where the mesh has not what is wanted.
void print_value(const QualityMeasure& m, double value) {
  const bool met = !m.wanted || (m.better == Better::equal    ? value == *m.wanted
                                 : m.better == Better::larger ? value >= *m.wanted
                                                              : value <= *m.wanted);
  const char* mark = met ? "" : "**";
  if (m.count) {
    std::printf(" %s%.0f%s |", mark, value, mark);
  } else if (std::isinf(value)) {
    std::printf(m.better == Better::larger ? " – |" : " %s∞%s |", mark, mark);  // the least over nothing
  } else {
    constexpr double kRounding = 1e-6;  // of what is 0 but for rounding
    std::printf(" %s%.2g%s |", mark, std::abs(value) < kRounding ? 0 : value, mark);
  }
}

bool is_shown(const QualityMeasure& m) {
  return m.key == "well_centered_fraction" || (!m.community.empty() && m.key.find("grid_spacing") == m.key.npos);
}

int print_meshes(std::span<const std::string_view> paths) {
  std::printf("| mesh | run | s |");
  std::size_t columns = 3;
  for (const QualityMeasure& m : quality_measures()) {
    if (is_shown(m)) std::printf(" %s |", std::string(m.label).c_str()), ++columns;
  }
  std::printf("\n|");
  for (std::size_t i = 0; i < columns; ++i) std::printf("-|");
  std::printf("\n");
  for (const std::string_view path : paths) {
    const auto file = io::read(std::string(path));
    if (!file) return std::fprintf(stderr, "%s\n", file.error().what().c_str()), 1;
    const auto loaded = io::make_mesh(*file);
    if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().what().c_str()), 1;
    for (const Run& run : runs()) {
      Mesh mesh = loaded->mesh;
      double seconds = 0;
      if (run.optimized) {
        const auto report = optimize(mesh, run.options);
        if (!report) return std::fprintf(stderr, "%s\n", report.error().what().c_str()), 1;
        seconds = report->seconds;
      }
      const Quality q = quality(mesh);
      const std::string name(path.substr(path.rfind('/') + 1));
      std::printf("| %s | %s | %.2f |", name.c_str(), run.name, seconds);
      for (const QualityMeasure& m : quality_measures()) {
        if (is_shown(m)) print_value(m, m.of(q));
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  return 0;
}

int run(std::span<const std::string_view> arguments) {
  if (arguments.empty()) return std::fprintf(stderr, "bench_thresholds_table: expected mesh files\n"), 2;
  if (arguments.front() == "--definitions") return print_definitions(), 0;
  return print_meshes(arguments);
}

}  // namespace
}  // namespace temper::bench

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  return temper::bench::run(arguments);
}
