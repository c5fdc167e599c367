// The errors of solvers before and after a run: `temper optimize --verify`.
#pragma once

#include <string>

#include "report_text.hpp"
#include "temper/verify.hpp"

namespace temper::app {

class SolverErrors {
 public:
  /// Measures the input, whose frame the result is measured in, too.
  SolverErrors(const Mesh& input, Executor* executor);

  void measure_result(const Mesh& result);
  /// The input has nothing to mend, being regular and well-centered, and the errors of ★1, Poisson and flux are larger
  /// in the mean than they were: superconvergence of a symmetric mesh, mostly.
  [[nodiscard]] bool input_was_better() const;
  /// ★1, Poisson and flux in the mean over all fields: what the result has over what the input has.
  [[nodiscard]] double mean_ratio() const;

  [[nodiscard]] std::string text(const TextStyle& style) const;
  [[nodiscard]] std::string json() const;

 private:
  [[nodiscard]] VerifyReport measured(const Mesh& mesh) const;

  VerifyOptions options_;
  VerifyReport before_, after_;
};

}  // namespace temper::app
