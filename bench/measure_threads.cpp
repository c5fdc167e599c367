// The same sweeps with one thread, two, and so on: their wall time, and that no bit of the result depends on it.
#include <algorithm>
#include <cmath>

#include "measure.hpp"
#include "sweeps.hpp"
#include "temper/detail/instruction_set.hpp"
#include "threads.hpp"

namespace temper::bench {
namespace {

double wall_ns(const Mesh& mesh, int sweeps, std::size_t threads) {
  const auto executor = make_executor(threads);
  const TimedRun run = timed_sweeps(mesh, sweeps_only(), sweeps, executor.get());
  const double seconds = run.wall_between(0, static_cast<std::size_t>(sweeps));
  return 1e9 * seconds / (static_cast<double>(mesh.n_vertices()) * sweeps);
}

/// A hash of the mesh after a run with all defaults: long enough for passes, but on large meshes, where the first
/// sweeps show all kinds of parts, and each run takes seconds.
std::uint64_t result_with(const Mesh& mesh, std::size_t threads) {
  constexpr std::size_t kLarge = 200000;
  const auto executor = make_executor(threads);
  OptimizeOptions options;
  options.max_sweeps = mesh.n_vertices() < kLarge ? 16 : 4;
  Mesh copy = mesh;
  static_cast<void>(timed_run(copy, options, {}, executor.get()));
  return fingerprint(copy);
}

}  // namespace

ThreadCosts measure_threads(std::size_t vertices, int rounds, const Options& options) {
  ThreadCosts costs;
  const Mesh mesh = mesh_of_random_points(vertices);
  const std::uint64_t expected = result_with(mesh, 1);
  costs.same_instructions = 1;
  const InstructionSet fastest = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    if (set == fastest || !use_instruction_set(set)) continue;
    if (result_with(mesh, 1) != expected) costs.same_instructions = 0;
  }
  static_cast<void>(use_instruction_set(fastest));
  if (!kHasThreads) return costs;
  costs.same_threads = 1;
  for (const std::size_t threads : {2, 3, 8}) {
    if (result_with(mesh, threads) != expected) costs.same_threads = 0;
  }
  const std::size_t most = std::min(options.threads, ThreadCosts::kMost);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t threads = 1; threads <= most; ++threads) {
      double& least = costs.ns[threads - 1];
      least = std::fmin(least, wall_ns(mesh, options.sweeps, threads));
    }
  }
  return costs;
}

}  // namespace temper::bench
