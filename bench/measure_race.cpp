// The time until the energy is what 200 sweeps of plain Gauss-Seidel reach.
#include <cmath>

#include "measure.hpp"
#include "sweeps.hpp"

namespace temper::bench {
namespace {

constexpr int kPlainSweeps = 200;

struct Finish {
  double seconds = kNone, sweeps = kNone;
};

/// Energies compare only at the same γ: `last` is that of the plain run.
Finish time_to(const Mesh& mesh, OptimizeOptions options, const SweepRecord& last) {
  options.paper.tolerance = 0;
  options.max_sweeps = kPlainSweeps + 1;
  Mesh copy = mesh;
  const auto there = [&](const SweepRecord& now) {
    return now.length_parameter == last.length_parameter && now.energy <= last.energy;
  };
  const TimedRun run = timed_run(copy, options, there);
  if (!there(run.marks.back().last)) return {};
  const std::size_t end = run.marks.size() - 1;
  return {run.cpu_between(0, end), static_cast<double>(run.marks.back().last.sweep)};
}

Race race_on(const Mesh& mesh, int rounds) {
  Race race;
  OptimizeOptions plain = sweeps_only();
  plain.paper.relaxation = 1;
  for (int round = 0; round < rounds; ++round) {
    const TimedRun run = timed_sweeps(mesh, plain, kPlainSweeps);
    race.plain = std::fmin(race.plain, run.cpu_between(0, kPlainSweeps));
    const Finish standard = time_to(mesh, {}, run.marks.back().last);
    race.standard = std::fmin(race.standard, standard.seconds);
    race.standard_sweeps = standard.sweeps;
  }
  return race;
}

}  // namespace

Races measure_races(std::size_t vertices, const Options& options) {
  const Mesh mesh = mesh_of_random_points(vertices);
  return {race_on(mesh, options.rounds), race_on(well_centered_mesh(mesh), options.rounds)};
}

}  // namespace temper::bench
