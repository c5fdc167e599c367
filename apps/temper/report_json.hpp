// Reports as JSON, for programs. Infinite energies are null; vertices and triangles count from 0, in the order of
// the file's arrays (points[i] of any reader), not in the numbers a format may give them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "options.hpp"
#include "requirement.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::app {

/// The first number of a report: another one when a key is gone or means something else. docs/schema says what there
/// is.
inline constexpr int kSchema = 1;

/// The numbers of a mesh. `points`: mesh vertex → point of the file; empty when they are the same.
[[nodiscard]] std::string quality_json(const Quality& quality, std::span<const std::size_t> points);
/// `temper check --json`: these, and the outcomes of --require.
[[nodiscard]] std::string check_json(const std::string& path, const Quality& quality,
                                     std::span<const std::size_t> points, std::span<const Outcome> outcomes);
/// Such texts as one.
[[nodiscard]] std::string json_list(std::span<const std::string> reports);

/// Everything `temper optimize --report` says.
struct OptimizeRecord {
  std::string command;
  std::vector<UsedOption> options;
  const Quality& before;
  std::span<const std::size_t> points_before;  ///< of IN; OUT has the points of the mesh
  const Quality& after;
  const OptimizeReport& report;
  const io::DataReport& data;
  std::span<const Outcome> outcomes;  ///< of --require, on `after`
  std::vector<std::string> warnings;
  std::string solver_errors = {};  ///< JSON, of --verify; or nothing
};
[[nodiscard]] std::string optimize_json(const OptimizeRecord& record);

/// `temper optimize --history`: a header and one line a sweep.
[[nodiscard]] std::string history_csv(const OptimizeReport& report);

}  // namespace temper::app
