// The caller in C++: callers_cpp IN OUT SET reads a mesh, optimizes it with a set of options, and writes it.
#include <cstdio>
#include <map>
#include <string>

#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/solvers.hpp"

namespace {

int fail(const temper::InputError& error) { return std::fprintf(stderr, "%s\n", error.what().c_str()), 1; }

/// As callers.py has them.
const std::map<std::string, temper::OptimizeOptions> kSets = {
    {"default", {}},
    {"vertex", {.scheme = temper::Scheme::vertex}},
    {"cell", {.scheme = temper::Scheme::cell}},
    {"energy", {.objective = temper::Objective::energy}},
    {"positions", {.unknowns = temper::Unknowns::positions, .boundary = temper::BoundaryVertices::slide}}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || !kSets.contains(argv[3])) return 2;
  auto file = temper::io::read(argv[1]);
  if (!file) return fail(file.error());
  auto loaded = temper::io::make_mesh(*file);
  if (!loaded) return fail(loaded.error());
  const auto report = temper::optimize(loaded->mesh, kSets.at(argv[3]), {.solvers = temper::solvers()});
  if (!report) return fail(report.error());
  temper::io::update(*file, *loaded, loaded->mesh, report->vertices);
  const auto written = temper::io::write(argv[2], *file);
  if (!written) return fail(written.error());
  std::printf("%s\n", std::string(temper::name(report->objective)).c_str());
}
