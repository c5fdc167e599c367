// The reports of `temper verify`: tables for people, and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report_text.hpp"
#include "temper/verify.hpp"

namespace temper::app {

/// The mesh that another one is measured against, in the same frame.
struct VerifyReference {
  std::string path;
  VerifyReport report;
  std::vector<FieldErrors> ratios;
};

struct VerifyRecord {
  std::string path;
  VerifyReport report;
  std::optional<VerifyReference> against;
};

[[nodiscard]] std::string verify_text(const VerifyRecord& record, const TextStyle& style);
[[nodiscard]] std::string verify_json(const VerifyRecord& record);

/// Geometric means of the errors of two meshes, a line a measure: `temper optimize --verify`.
[[nodiscard]] std::string verify_comparison_text(const VerifyReport& before, const VerifyReport& after,
                                                 const TextStyle& style);
/// One report, for other reports to hold.
[[nodiscard]] nlohmann::ordered_json verify_report_json(const VerifyReport& report);

/// A line an edge: from,to,star1,error. Points count from 0, in the order of the file's arrays.
[[nodiscard]] std::string edge_errors_csv(const VerifyReport& report, const Input& input);

}  // namespace temper::app
