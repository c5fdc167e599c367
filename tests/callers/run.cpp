// The caller in C++: callers_cpp IN OUT SET reads a mesh, optimizes it with a set of options, and writes it.
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/solvers.hpp"

namespace {

int fail(const temper::InputError& error) { return std::fprintf(stderr, "%s\n", error.what().c_str()), 1; }

/// The options of a set of callers.py.
temper::Expected<temper::OptimizeOptions> options_of(std::string_view set) {
  if (set == "vertex" || set == "cell") return temper::options_for(set);
  constexpr std::string_view kWeights[] = {"weights"};
  const auto keep = std::span<const std::string_view>(kWeights).first(set == "positions" ? 1 : 0);
  auto options = temper::options_for("any", "normal", keep);
  if (set == "energy") options->objective = temper::Objective::energy;
  if (set == "positions") options->boundary = temper::BoundaryVertices::slide;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const auto options = options_of(argv[3]);
  if (!options) return fail(options.error());
  auto file = temper::io::read(argv[1]);
  if (!file) return fail(file.error());
  auto loaded = temper::io::make_mesh(*file);
  if (!loaded) return fail(loaded.error());
  const auto report = temper::optimize(loaded->mesh, *options, {.solvers = temper::solvers()});
  if (!report) return fail(report.error());
  temper::io::update(*file, *loaded, loaded->mesh, report->vertices);
  const auto written = temper::io::write(argv[2], *file);
  if (!written) return fail(written.error());
  std::printf("%s\n", std::string(temper::name(report->objective)).c_str());
}
