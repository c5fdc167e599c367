#include "solver_errors.hpp"

#include <cmath>
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

double SolverErrors::mean_ratio() const {
  const VerifyErrors ratio = geometric_mean(or_fail(error_ratios(after_, before_)));
  return std::cbrt(ratio.star[1].l2 * ratio.poisson.l2 * ratio.flux.l2);
}

bool SolverErrors::input_was_better() const {
  return before_.not_well_centered == 0 && before_.non_regular_edges == 0 && mean_ratio() > 1;
}

std::string SolverErrors::text(const TextStyle& style) const { return verify_comparison_text(before_, after_, style); }

std::string SolverErrors::json() const {
  const nlohmann::ordered_json json = {{"before", verify_report_json(before_)}, {"after", verify_report_json(after_)}};
  return json.dump();
}

}  // namespace temper::app
