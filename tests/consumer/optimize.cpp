// A program as users write it: it reads a mesh, optimizes it for a solver, and writes it.
#include <cstdio>
#include <string>

#include "temper/temper.hpp"

namespace {

int fail(const std::string& error) { return std::printf("%s\n", error.c_str()), 1; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  auto file = temper::io::read(argv[1]);
  if (!file) return fail(file.error().what());
  auto loaded = temper::io::make_mesh(*file);
  if (!loaded) return fail(loaded.error().what());
  auto report = temper::optimize(loaded->mesh, {.scheme = temper::Scheme::cell}, {.solvers = temper::solvers()});
  if (!report) return fail(report.error().what());
  temper::io::update(*file, *loaded, loaded->mesh, report->vertices);
  auto written = temper::io::write(argv[2], *file);
  if (!written) return fail(written.error().what());
  return report->objective == temper::Objective::solver_error ? 0 : 1;
}
