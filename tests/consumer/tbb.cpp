// A program as users of threads write it: an executor, and a run whose result does not depend on it.
#include <cstdio>

#include "temper/detail/tbb_executor.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

int main() {
  const auto mesh = temper::random_mesh({.vertices = 20000, .seed = 3});
  if (!mesh) return 1;
  temper::TbbExecutor threads(2);
  temper::QualityOptions options;
  const temper::Quality alone = temper::quality(*mesh, options);
  options.executor = &threads;
  const temper::Quality together = temper::quality(*mesh, options);
  std::printf("%zu triangles by %zu threads\n", together.triangles, threads.threads());
  return threads.threads() == 2 && alone.min_h_over_l == together.min_h_over_l ? 0 : 1;
}
