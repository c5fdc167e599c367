// Algorithm 1 of the paper: sweeps over the vertices of a working copy until the energy no longer falls.
#pragma once

#include <chrono>
#include <cmath>
#include <optional>

#include "optimize/frame.hpp"
#include "optimize/schedule.hpp"
#include "optimize/settings.hpp"
#include "optimize/vertex_step.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Triangles that are not well-centered, exact.
[[nodiscard]] std::size_t count_bad(const Mesh& mesh, Executor* executor);

/// What the attempts of one call of optimize share: the report that grows, the clock, and the caller's ear.
class Run {
 public:
  Run(const OptimizeOptions& options, const Observer& observer)
      : options_(options), observer_(observer), start_(Clock::now()) {}

  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool sweeps_left() const { return report.sweeps < options_.max_sweeps; }
  /// Asks the clock and the caller; sets report.stopped when the answer is yes.
  bool asked_to_stop(double fraction_of_sweep);

  OptimizeReport report;

 private:
  using Clock = std::chrono::steady_clock;

  const OptimizeOptions& options_;
  const Observer& observer_;
  Clock::time_point start_;
};

class Driver {
 public:
  Driver(Mesh& mesh, Settings& settings, const Frame& frame, Run& run)
      : mesh_(mesh),
        settings_(settings),
        energy_unit_(std::pow(frame.scale, settings_.energy.length_exponent)),
        run_(run),
        step_(mesh, settings_, frame) {}

  /// One attempt. With `may_give_up`, it ends too when triangles stay bad for many sweeps.
  void optimize(const Attempt& attempt, bool may_give_up);

 private:
  bool improve_all_vertices(int sweep);
  bool halve_weights();
  void shift_weights_to_anchor();
  std::size_t restore_deferred_flips();
  [[nodiscard]] bool converged(double before, double after) const;
  bool stagnates();
  void keep_if_best();
  void return_best();
  [[nodiscard]] double total() const;
  void record(std::size_t flips);

  Mesh& mesh_;
  Settings& settings_;
  double energy_unit_;  // the user's energy of one unit in the frame
  Run& run_;
  VertexStep step_;
  std::size_t least_bad_ = 0;  // of this attempt so far, and for how many sweeps
  int sweeps_since_fewer_bad_ = 0;
  int infinite_sweeps_ = 0;
  bool shrunk_ = false;
  std::optional<Mesh> best_;  // of HOT energies: the best sweep
  double best_energy_ = 0;
};

}  // namespace temper
