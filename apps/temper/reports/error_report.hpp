// The errors of solvers, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/quality_report.hpp"
#include "temper/errors.hpp"
#include "temper/surface_errors.hpp"
#include "temper/tets/errors.hpp"

namespace temper::app {

/// A mesh, and another one of the same kind that it is measured against, in the same frame.
template <class Subject>
struct ErrorRecord {
  struct Reference {
    std::string path;
    typename Subject::ErrorReport report;
    std::vector<FieldErrors> ratios;
  };
  std::string path;
  typename Subject::ErrorReport report;
  std::optional<Reference> against;
};
/// The rows of the text: means and what solvers need, or all.
enum class ErrorRows { means, all };
template <class Subject>
[[nodiscard]] std::string error_text(const ErrorRecord<Subject>& record, ErrorRows rows, const TextStyle& style);
template <class Subject>
[[nodiscard]] std::string error_json(const ErrorRecord<Subject>& record);

/// The user's own problem on a mesh, and on another one.
struct ProblemRecord {
  std::string path;
  DiffusionErrors errors;
  std::string against;  ///< path of the other mesh; empty: none
  std::optional<DiffusionErrors> reference;
};
[[nodiscard]] std::string problem_text(const ProblemRecord& record);
[[nodiscard]] std::string problem_json(const ProblemRecord& record);

/// One line per edge: from,to,star1,error. Points count from 0, in the order of the file's arrays.
[[nodiscard]] std::string edge_errors_csv(const ErrorReport& report, const Input& input);

/// The errors of solvers before and after a run: `temper optimize --measure-errors`.
template <class Subject>
class SolverErrors {
 public:
  /// Measures the input; the result is measured in the frame of the input, too.
  SolverErrors(const typename Subject::Mesh& input, Executor* executor);

  void measure_result(const typename Subject::Mesh& result);

  /// Geometric means of the errors of both meshes, one line per measure.
  [[nodiscard]] std::string text(const TextStyle& style) const;
  [[nodiscard]] std::string json() const;

 private:
  using Report = typename Subject::ErrorReport;
  [[nodiscard]] Report measured(const typename Subject::Mesh& mesh, const decltype(Report::frame)& frame) const;

  Executor* executor_;
  Report before_, after_;
};

}  // namespace temper::app
