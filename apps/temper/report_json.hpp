// Reports as JSON, for programs. Infinite energies are null; vertices and triangles count from 0, in the order of
// the file's arrays (points[i] of any reader), not in the numbers a format may give them.
#pragma once

#include <string>
#include <vector>

#include "input.hpp"
#include "options.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::app {

/// `temper check --json`.
[[nodiscard]] std::string quality_json(const Quality& quality, const Input& input);

/// Everything `temper optimize --report` says.
struct OptimizeRecord {
  std::string command;
  std::vector<UsedOption> options;
  const Quality& before;
  const Quality& after;
  const OptimizeReport& report;
  std::vector<std::string> warnings;
};
[[nodiscard]] std::string optimize_json(const OptimizeRecord& record, const Input& input);

/// `temper optimize --history`: a header and one line a sweep.
[[nodiscard]] std::string history_csv(const OptimizeReport& report);

}  // namespace temper::app
