// The tables of docs/reference/limits.md, as Markdown: what solvers' codes look at, by quality_measures().
//
//     bench_thresholds_table --definitions     one row a measure
//     bench_thresholds_table FILE...           one row a mesh and run, then how many meshes of each run are refused by
//     what
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"

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
          {"`--keep weights`", true, positions},
          {"`--min-edge 0.75 --min-dual 0.3`", true, kept},
          {"the same, `--set repair=vertices`", true, repaired}};
}

void print_definitions() {
  std::printf("| `--require`, JSON | short | code | what | wanted |\n|-|-|-|-|-|\n");
  for (const QualityMeasure& m : quality_measures()) {
    const char* sign = m.better == Preference::equal ? "=" : m.better == Preference::larger ? "≥" : "≤";
    const std::string alias = m.alias.empty() ? "" : "`" + std::string(m.alias) + "`";
    std::string definition;
    for (const char c : m.definition) definition += c == '|' ? std::string("\\|") : std::string(1, c);
    std::printf("| `%s` | %s | %s | %s |", std::string(m.key).c_str(), alias.c_str(), std::string(m.community).c_str(),
                definition.c_str());
    m.wanted ? std::printf(" %s %g |\n", sign, *m.wanted) : std::printf(" – |\n");
  }
}

bool is_met(const QualityMeasure& m, double value) {
  return !m.wanted || (m.better == Preference::equal    ? value == *m.wanted
                       : m.better == Preference::larger ? value >= *m.wanted
                                                        : value <= *m.wanted);
}

/// Bold where the mesh has not what is wanted.
void print_value(const QualityMeasure& m, double value) {
  const char* mark = is_met(m, value) ? "" : "**";
  if (m.count) {
    std::printf(" %s%.0f%s |", mark, value, mark);
  } else if (std::isinf(value)) {
    std::printf(m.better == Preference::larger ? " – |" : " %s∞%s |", mark, mark);  // the least over nothing
  } else {
    constexpr double kRounding = 1e-6;  // of what is 0 but for rounding
    std::printf(" %s%.2g%s |", mark, std::abs(value) < kRounding ? 0 : value, mark);
  }
}

bool is_shown(const QualityMeasure& m) {
  return m.key == "well_centered_fraction" || (!m.community.empty() && m.key.find("grid_spacing") == m.key.npos);
}

/// The head of a table with a column for each measure that passes.
template <class Passes>
void print_head(const char* first, std::size_t columns, Passes&& passes) {
  std::printf("%s", first);
  for (const QualityMeasure& m : quality_measures()) {
    if (passes(m)) std::printf(" %s |", std::string(m.label).c_str()), ++columns;
  }
  std::printf("\n|");
  for (std::size_t i = 0; i < columns; ++i) std::printf("-|");
  std::printf("\n");
}

/// For each run the measures of each mesh.
void print_refused(const std::vector<std::vector<Quality>>& found) {
  const auto is_judged = [](const QualityMeasure& m) { return is_shown(m) && m.wanted; };
  std::printf("\n");
  print_head("| meshes refused by |", 1, is_judged);
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::printf("| %s |", runs()[i].name);
    for (const QualityMeasure& m : quality_measures()) {
      if (!is_judged(m)) continue;
      std::printf(" %td |", std::ranges::count_if(found[i], [&](const Quality& q) { return !is_met(m, m.of(q)); }));
    }
    std::printf("\n");
  }
}

int print_meshes(std::span<const std::string_view> paths) {
  print_head("| mesh | run | s |", 3, is_shown);
  std::vector<std::vector<Quality>> found(runs().size());
  for (const std::string_view path : paths) {
    const auto file = io::read(std::string(path));
    if (!file) return std::fprintf(stderr, "%s\n", file.error().what().c_str()), 1;
    const auto loaded = io::make_mesh(*file);
    if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().what().c_str()), 1;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Run run = runs()[i];
      Mesh mesh = loaded->mesh;
      double seconds = 0;
      if (run.optimized) {
        const auto report = optimize(mesh, run.options, {.solvers = solvers()});
        if (!report) return std::fprintf(stderr, "%s\n", report.error().what().c_str()), 1;
        seconds = report->seconds;
      }
      const Quality& q = found[i].emplace_back(quality(mesh));
      const std::string name(path.substr(path.rfind('/') + 1));
      std::printf("| %s | %s | %.2f |", name.c_str(), run.name, seconds);
      for (const QualityMeasure& m : quality_measures()) {
        if (is_shown(m)) print_value(m, m.of(q));
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  print_refused(found);
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
