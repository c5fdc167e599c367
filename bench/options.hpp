// The command line of bench_whole_run.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace temper::bench {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // not measured

struct Options {
  std::vector<std::size_t> sizes = {1000, 10000, 100000, 1000000};
  int sweeps = 10;          // timed in a row
  int golden_sweeps = 3;    // of golden, which takes a hundred times as long
  int rounds = 3;           // at least, of everything that is compared; the least of each counts
  std::size_t threads = 0;  // most; 0: as many as the machine has
  bool sweeps_alone = false;
  std::string temper;  // the program, for its start-up time and its memory
  std::string json;
  bool check = false;
};

[[nodiscard]] Options parse(int argc, char** argv);

/// Ends the program.
[[noreturn]] void fail(const std::string& message);

}  // namespace temper::bench
