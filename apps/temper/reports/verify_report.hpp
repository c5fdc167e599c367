// The errors that solvers make, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/quality_report.hpp"
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

/// The errors of solvers before and after a run: `temper optimize --verify`.
class SolverErrors {
 public:
  /// Measures the input, whose frame the result is measured in, too.
  SolverErrors(const Mesh& input, Executor* executor);

  void measure_result(const Mesh& result);

  [[nodiscard]] std::string text(const TextStyle& style) const;
  [[nodiscard]] std::string json() const;

 private:
  [[nodiscard]] VerifyReport measured(const Mesh& mesh) const;

  VerifyOptions options_;
  VerifyReport before_, after_;
};

}  // namespace temper::app
