// The reports of `temper weights`: text for people, and JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "input.hpp"
#include "temper/connectivity.hpp"
#include "temper/feasibility.hpp"

namespace temper::app {

struct WeightsRecord {
  std::string_view mode;
  const WeightOptions& options;
  const WeightReport& report;
  const Input& input;
  const Mesh& mesh;                                 ///< that the report is of: the input's, or with edges flipped
  const std::optional<ConnectivityReport>& search;  ///< with --connectivity search
  std::string_view output;                          ///< empty: not written
  std::string_view certificate;                     ///< the same
};

[[nodiscard]] std::string weights_text(const WeightsRecord& record);
[[nodiscard]] std::string weights_json(const WeightsRecord& record);

/// "h over edge 3-9 of triangle 17 (angle of 138.3 degrees at vertex 10)", in the file's numbers.
[[nodiscard]] std::string constraint_text(const WeightConstraint& constraint, const Input& input, const Mesh& mesh);

}  // namespace temper::app
