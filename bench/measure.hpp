// The measurements, each to be made in a process of its own.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "options.hpp"

namespace temper::bench {

// One row of measurements, for one size; NaN where nothing was measured. Plain numbers, so that a child process can
// send them.

/// Nanoseconds a vertex and sweep, of one thread's processor time; and of the limits, measured between them.
struct SweepCosts {
  double newton = kNone;                          ///< the first sweeps: most flips, all γ
  double settled = kNone;                         ///< sweeps after the mesh has become well-centered
  double accuracy = kNone;                        ///< sweeps of the accuracy objective, all triangles well-centered
  double alternating = kNone;                     ///< the first sweeps of Solver::alternating
  double golden = kNone;                          ///< the first sweeps of the paper's search, and nothing else of it
  double paper = kNone;                           ///< the first sweeps of Algorithm 1, with collapses and removals
  double by_triangles = kNone, by_stars = kNone;  ///< value, gradient and Hessian of all stars, packed
  double triad = kNone;                           ///< streaming as many bytes as the mesh has
};

/// Sweeps in wall time.
struct ThreadCosts {
  static constexpr std::size_t kMost = 8;
  std::array<double, kMost> ns;      ///< a vertex and sweep, with 1, 2, … threads
  double same_threads = kNone;       ///< 1: the same bytes for 1, 2, 3 and 8 threads
  double same_instructions = kNone;  ///< 1: and for each instruction set
  ThreadCosts() { ns.fill(kNone); }
};

/// To the energy that 200 sweeps of plain Gauss-Seidel reach.
struct Race {
  double plain = kNone, standard = kNone;  ///< seconds: relaxation 1; no option at all
  double standard_sweeps = kNone;
};

struct Races {
  Race whole;    ///< from the input: steps that go far while edges flip find a better minimum, too
  Race settled;  ///< both from the same well-centered mesh, nearly without flips
};

/// Seconds of a run from file to file: of the processor with one thread, on the wall with several.
struct Stages {
  double read = kNone, build = kNone;
  double order = kNone, make_regular = kNone;
  double to_well_centered = kNone;  ///< sweeps until no triangle is bad
  double to_converged = kNone;      ///< sweeps and passes after that
  double back = kNone;              ///< into the user's order; measures of before and after
  double update = kNone, write = kNone;

  [[nodiscard]] double optimize() const { return order + make_regular + to_well_centered + to_converged + back; }
  [[nodiscard]] double total() const { return read + build + optimize() + update + write; }
  /// Reading and writing in all of it.
  [[nodiscard]] double io_share() const { return (read + build + update + write) / total(); }
};

/// Read, optimize with no option, write.
struct FileRun {
  Stages seconds;
  double sweeps = kNone, sweeps_to_good = kNone;
  double triangles = kNone, bad_before = kNone, bad = kNone;
  double peak_bytes = kNone;
};

struct Row {
  std::size_t vertices = 0;
  SweepCosts costs;
  ThreadCosts threads;
  Races races;
  FileRun one, all;  ///< on one thread, and on all that were asked for
  double program_peak_bytes = kNone;
};

[[nodiscard]] SweepCosts measure_sweeps(std::size_t vertices, const Options& options);
/// `rounds`: of wall times; bytes are compared in any case.
[[nodiscard]] ThreadCosts measure_threads(std::size_t vertices, int rounds, const Options& options);
[[nodiscard]] Races measure_races(std::size_t vertices, const Options& options);

/// Writes the random mesh of that many vertices.
void make_input(std::size_t vertices, const std::string& path);
/// `threads`: 1, or more.
[[nodiscard]] FileRun measure_file_run(const std::string& input, const std::string& output, std::size_t threads);

}  // namespace temper::bench
