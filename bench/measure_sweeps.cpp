// Sweeps, and what they are compared with, in turn: whatever slows the machine down for a while slows all of them.
#include <algorithm>
#include <cmath>
#include <functional>

#include "child.hpp"
#include "limits.hpp"
#include "measure.hpp"
#include "sweeps.hpp"

namespace temper::bench {
namespace {

constexpr double kSeconds = 4;  // of rounds that are more than asked for
constexpr int kMostRounds = 20;
// Beyond this, sweeps alone: what they are compared with does not depend on the size, or takes too long or too much.
constexpr std::size_t kMostCompared = 1000000;
constexpr std::size_t kMostGolden = 100000, kLeastGolden = 10000;
constexpr double kShortest = 0.02;  // seconds of a loop that is timed

/// The least of all rounds.
void note(double& least, double value) { least = std::fmin(least, value); }

double ns(double seconds, std::size_t vertices, int times) {
  return 1e9 * seconds / (static_cast<double>(vertices) * times);
}

double sweep_ns(const Mesh& mesh, const OptimizeOptions& options, int sweeps) {
  const TimedRun run = timed_sweeps(mesh, options, sweeps);
  return ns(run.cpu_between(0, static_cast<std::size_t>(sweeps)), mesh.n_vertices(), sweeps);
}

/// The time per vertex of sweeps of the accuracy objective, from a mesh whose triangles are well-centered: some for the
/// energy may come first.
double accuracy_sweep_ns(const Mesh& mesh, int sweeps) {
  OptimizeOptions options;
  options.objective = Objective::accuracy;
  options.accuracy.tolerance = 0;
  options.accuracy.sweeps = sweeps + 2;  // the last leaves no mark, nor does what is before the first after others
  Mesh copy = mesh;
  const TimedRun run = timed_run(copy, options);
  const auto is_first = [](const Mark& mark) { return mark.last.objective == Objective::accuracy; };
  const auto first = std::find_if(run.marks.begin(), run.marks.end(), is_first);
  if (run.marks.end() - first <= sweeps) fail("accuracy sweeps ended early");
  const auto at = static_cast<std::size_t>(first - run.marks.begin());
  return ns(run.cpu_between(at, at + static_cast<std::size_t>(sweeps)), mesh.n_vertices(), sweeps);
}

/// The time per vertex of a loop over all vertices, run as often as the clock needs.
double loop_ns(std::size_t vertices, const std::function<void()>& loop) {
  const double start = cpu_seconds();
  double seconds = 0;
  int times = 0;
  for (; seconds < kShortest; ++times, seconds = cpu_seconds() - start) loop();
  return ns(seconds, vertices, times);
}

class Comparison {
 public:
  Comparison(const Mesh& settled, const Mesh& mesh, const Options& options)
      : mesh_(mesh), options_(options), stars_(settled), triad_(settled) {}

  void measure(SweepCosts& costs) {
    const std::size_t n = mesh_.n_vertices();
    note(costs.by_triangles, loop_ns(n, [this] { keep(stars_.by_triangles()); }));
    note(costs.by_stars, loop_ns(n, [this] { keep(stars_.by_stars()); }));
    note(costs.triad, loop_ns(n, [this] { triad_.run(); }));
    note(costs.alternating, sweep_ns(mesh_, sweeps_only(Solver::alternating), options_.sweeps));
    const bool golden = n >= kLeastGolden && n <= kMostGolden;
    if (!golden) return;
    note(costs.golden, sweep_ns(mesh_, sweeps_only(Solver::golden), options_.golden_sweeps));
    note(costs.paper, sweep_ns(mesh_, paper_sweeps(), options_.golden_sweeps));
  }

 private:
  void keep(double value) { kept_ = kept_ + value; }

  const Mesh& mesh_;
  const Options& options_;
  PackedStars stars_;
  Triad triad_;
  volatile double kept_ = 0;  // so that no loop can be left out
};

}  // namespace

SweepCosts measure_sweeps(std::size_t vertices, const Options& options) {
  SweepCosts costs;
  const Mesh mesh = random_mesh(vertices);
  const Mesh settled = well_centered_mesh(mesh);
  std::optional<Comparison> comparison;
  if (vertices <= kMostCompared && !options.sweeps_alone) comparison.emplace(settled, mesh, options);
  const double start = cpu_seconds();
  for (int round = 0; round < kMostRounds && (round < options.rounds || cpu_seconds() - start < kSeconds); ++round) {
    note(costs.newton, sweep_ns(mesh, sweeps_only(), options.sweeps));
    note(costs.settled, sweep_ns(settled, sweeps_only(), options.sweeps));
    note(costs.accuracy, accuracy_sweep_ns(settled, options.sweeps));
    if (comparison) comparison->measure(costs);
  }
  return costs;
}

}  // namespace temper::bench
