// The options of temper optimize, and the settings that follow from them.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "files/outputs.hpp"
#include "files/problem_options.hpp"
#include "files/tensor_option.hpp"
#include "help/command.hpp"
#include "options/ranks.hpp"
#include "options/requirement.hpp"
#include "options/table_options.hpp"
#include "reports/reports.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"

namespace temper::app {

struct OptimizeSettings {
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  std::string projection;
  Heights heights;
  std::string input;
  MeshOutput output;
  std::vector<std::string> write;
  FurtherOutputs files;  ///< of `write`
  std::string target = "any", effort = "normal", options_file;
  std::vector<std::string> keep, fix, require;
  Assignments assignments;
  OptimizeOptions options;    ///< what follows from target, effort, keep and assignments
  std::string set_by_target;  ///< options that the target sets, for people
  std::uint64_t threads = 0;
  bool details = false, measure_errors = false;
  bool traced = false;                    ///< by any writer of the trace
  std::optional<double> save_every;       ///< seconds between two times that the best mesh so far is written
  RequirementLists requirement_lists;     ///< of `require`
  std::vector<Requirement> requirements;  ///< the list for the kind of the mesh
  std::string size, size_data;
  TensorOption tensor;
  ProblemOptions problem;
  DataWords data_words;
  io::UpdateOptions data;  ///< by these words
};

/// --for, with the meanings of the targets; also with targets of research.
Option& add_target(Command& command, std::string& target, bool research);

/// The verb, whose options go into `settings`.
[[nodiscard]] Command optimize_command(OptimizeSettings& settings);

/// `--fix 1 2 IN -o OUT`: --fix and --write take all words that follow, so without other input the last one is the
/// input. Failure when there is still none, or no output.
void take_input(Command& command, OptimizeSettings& settings);

/// Finds the options that follow from the command line and the options file. Failure if they contradict each other.
void settle_options(Command& command, OptimizeSettings& settings);

/// Failure if options, or words or values of them, are for other cells than the mesh has.
void expect_for(const Command& command, const OptimizeSettings& settings, CellKinds cells);

/// Failure if the target is for other cells than the mesh has.
void expect_target_for(const std::string& verb, const std::string& input, std::string_view target, CellKinds cells);

/// "12 sweeps in 0.3 s, 4 flips, 2 vertices inserted".
template <class Report>
[[nodiscard]] std::string work_done(const Report& report) {
  std::string work =
      fmt::format("{} in {:.3g} s, {}", plural(static_cast<std::size_t>(report.sweeps), "sweep", "sweeps"),
                  report.seconds, plural(report.flips, "flip", "flips"));
  const auto add_vertices = [&work](std::size_t n, const char* what) {
    if (n > 0) work += fmt::format(", {} {}", plural(n, "vertex", "vertices"), what);
  };
  add_vertices(report.vertices_removed, "removed");
  add_vertices(report.vertices_inserted, "inserted");
  return work;
}
/// "converged after ", to be followed by the work that was done.
[[nodiscard]] std::string ending(Stopped stopped);

/// Options that were given and cannot have their usual effect.
[[nodiscard]] std::vector<std::string> doubtful_options(const Command& command, const OptimizeSettings& settings);
/// The warning that the command in the report would start from its own result; empty if it would not.
[[nodiscard]] std::vector<std::string> warning_of_replaced_input(const OptimizeSettings& settings);

}  // namespace temper::app
