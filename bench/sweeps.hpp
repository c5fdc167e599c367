// Runs of the optimizer with the time of each sweep: every mark is a moment between two of them.
#pragma once

#include <functional>
#include <vector>

#include "temper/optimize.hpp"

namespace temper::bench {

/// Delaunay triangulation of random points in a non-convex polygon, seed 1: about half of its triangles are bad.
[[nodiscard]] Mesh mesh_of_random_points(std::size_t vertices);

/// Before sweep `last.sweep + 1`.
struct Mark {
  SweepRecord last;
  double cpu = 0, wall = 0;  ///< seconds, of a clock that starts anywhere
};

struct TimedRun {
  std::vector<Mark> marks;  ///< [0]: the mesh is regular, and the first sweep is next
  OptimizeReport report;
  double cpu = 0, wall = 0;                ///< seconds, of the whole call
  double before_cpu = 0, before_wall = 0;  ///< of that, before marks[0]

  /// Seconds of the sweeps from one mark to another.
  [[nodiscard]] double cpu_between(std::size_t first, std::size_t last) const {
    return marks.at(last).cpu - marks.at(first).cpu;
  }
  [[nodiscard]] double wall_between(std::size_t first, std::size_t last) const {
    return marks.at(last).wall - marks.at(first).wall;
  }
};

/// Improves the mesh until it is done, or until `enough` says so between two sweeps.
[[nodiscard]] TimedRun timed_run(Mesh& mesh, const OptimizeOptions& options,
                                 const std::function<bool(const SweepRecord&)>& enough = {},
                                 Executor* executor = nullptr);

/// Options of sweeps and nothing else: no passes over all unknowns, no end by convergence.
[[nodiscard]] OptimizeOptions sweeps_only(Solver solver = Solver::newton);

/// The paper's Algorithm 1 with all its parts, but for its end by convergence.
[[nodiscard]] OptimizeOptions paper_sweeps();

/// A run of that many sweeps, on a copy of the mesh. The sweeps are marks 0 to `count`.
[[nodiscard]] TimedRun timed_sweeps(const Mesh& mesh, OptimizeOptions options, int count, Executor* executor = nullptr);

/// The mesh as sweeps leave it as soon as every triangle is well-centered and γ is at its last.
[[nodiscard]] Mesh well_centered_mesh(const Mesh& mesh);

/// A number that differs when any bit of points, weights or triangles does.
[[nodiscard]] std::uint64_t fingerprint(const Mesh& mesh);

}  // namespace temper::bench
