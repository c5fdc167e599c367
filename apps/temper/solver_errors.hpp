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
  [[nodiscard]] std::string text(const TextStyle& style) const;
  [[nodiscard]] std::string json() const;

 private:
  [[nodiscard]] VerifyReport measured(const Mesh& mesh) const;

  VerifyOptions options_;
  VerifyReport before_, after_;
};

}  // namespace temper::app
