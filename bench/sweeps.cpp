#include "sweeps.hpp"

#include <bit>
#include <utility>

#include "child.hpp"
#include "options.hpp"
#include "temper/generate.hpp"

namespace temper::bench {

Mesh mesh_of_random_points(std::size_t vertices) {
  auto mesh = random_mesh({.vertices = vertices, .seed = 1});
  if (!mesh) fail(mesh.error().what());
  return std::move(*mesh);
}

TimedRun timed_run(Mesh& mesh, const OptimizeOptions& options, const std::function<bool(const SweepRecord&)>& enough,
                   Executor* executor) {
  TimedRun run;
  const double cpu = cpu_seconds(), wall = wall_seconds();
  const auto observer = [&](const Progress& progress) {
    if (!run.marks.empty() && run.marks.back().last.sweep == progress.last.sweep) return Continue::yes;
    run.marks.push_back({progress.last, cpu_seconds(), wall_seconds()});
    return enough && enough(progress.last) ? Continue::no : Continue::yes;
  };
  auto report = optimize(mesh, options, {.executor = executor, .observer = observer});
  run.cpu = cpu_seconds() - cpu, run.wall = wall_seconds() - wall;
  if (!report) fail(report.error().what());
  if (run.marks.empty()) fail("a run without sweeps");
  run.before_cpu = run.marks.front().cpu - cpu, run.before_wall = run.marks.front().wall - wall;
  run.report = std::move(*report);
  return run;
}

OptimizeOptions sweeps_only(Solver solver) {
  OptimizeOptions options;
  options.paper.solver = solver;
  options.paper.tolerance = 0;
  return options;
}

OptimizeOptions paper_sweeps() {
  OptimizeOptions options = *options_for("paper");
  options.paper.stopping = StoppingRule::relative;
  options.paper.tolerance = 0;
  return options;
}

TimedRun timed_sweeps(const Mesh& mesh, OptimizeOptions options, int count, Executor* executor) {
  Mesh copy = mesh;
  options.max_sweeps = count + 1;
  TimedRun run = timed_run(
      copy, options, [count](const SweepRecord& last) { return last.sweep == count; }, executor);
  if (run.marks.size() != static_cast<std::size_t>(count) + 1) fail("a run ended early");
  return run;
}

Mesh well_centered_mesh(const Mesh& mesh) {
  constexpr double kLastGamma = 0.003;
  Mesh result = mesh;
  const TimedRun run = timed_run(result, sweeps_only(), [](const SweepRecord& last) {
    return last.bad == 0 && last.length_parameter <= kLastGamma;
  });
  if (run.report.history.back().bad > 0) fail("the mesh does not become well-centered");
  return result;
}

std::uint64_t fingerprint(const Mesh& mesh) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a, by words
  const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 1099511628211U, hash ^= hash >> 29; };
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    for (const double x : {p.x, p.y, p.w}) add(std::bit_cast<std::uint64_t>(x));
  }
  for (const HalfedgeId h : mesh.halfedges()) add(mesh.origin(h).index);
  return hash;
}

}  // namespace temper::bench
