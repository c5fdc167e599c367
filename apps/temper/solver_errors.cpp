#include "solver_errors.hpp"

#include <nlohmann/json.hpp>

#include "exit.hpp"
#include "verify_report.hpp"

namespace temper::app {

SolverErrors::SolverErrors(const Mesh& input, Executor* executor) {
  options_.frame = verify_frame(input);
  options_.executor = executor;
  before_ = after_ = measured(input);
}

VerifyReport SolverErrors::measured(const Mesh& mesh) const { return or_fail(verify(mesh, options_)); }

void SolverErrors::measure_result(const Mesh& result) { after_ = measured(result); }

std::string SolverErrors::text(const TextStyle& style) const { return verify_comparison_text(before_, after_, style); }

std::string SolverErrors::json() const {
  const nlohmann::ordered_json json = {{"before", verify_report_json(before_)}, {"after", verify_report_json(after_)}};
  return json.dump();
}

}  // namespace temper::app
