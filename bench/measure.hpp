// The measurements, each to be made in a process of its own.
#pragma once

#include <string>

#include "row.hpp"

namespace temper::bench {

[[nodiscard]] SweepCosts measure_sweeps(std::size_t vertices, const Options& options);
/// `rounds`: of wall times; bytes are compared in any case.
[[nodiscard]] ThreadCosts measure_threads(std::size_t vertices, int rounds, const Options& options);
[[nodiscard]] Races measure_races(std::size_t vertices, const Options& options);

/// Writes the random mesh of that many vertices.
void make_input(std::size_t vertices, const std::string& path);
/// `threads`: 1, or more.
[[nodiscard]] FileRun measure_file_run(const std::string& input, const std::string& output, std::size_t threads);

}  // namespace temper::bench
