// Reports as JSON, and options from it, with the names that Python has.
#pragma once

#include "answer.hpp"
#include "temper/detail/report.hpp"
#include "temper/detail/trace.hpp"
#include "temper/energy.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::wasm {

/// A number, relative to each edge, or {"value", "scale": "absolute" | "relative"}.
[[nodiscard]] LengthParameter length_parameter_from(std::string_view name, const Json& given);
/// The model of {"energy", "star", "boundary_treatment", "gamma", "h0", "wall"}, each of which may be left out.
[[nodiscard]] EnergyModel model_from(const Json& given);
/// The options of a run: {"target", "effort", "keep", "boundary", "time_limit", "options"}, each of which may be left
/// out.
[[nodiscard]] OptimizeOptions options_from(const Json& given);
/// A text of the library with its options as JavaScript has them: boundary: "split".
[[nodiscard]] std::string spelled(std::string_view text);
[[nodiscard]] InputError spelled(InputError error);

/// A report, by the rows of its table.
[[nodiscard]] Json json_of(const ReportView& report);
template <class Report>
[[nodiscard]] Json json_of(const Report& report) {
  return json_of(view_of(report));
}
[[nodiscard]] TraceEvent event_from(const Json& given);
[[nodiscard]] Json to_json(const OptimizeOptions& options);
/// The table of options with their default values.
[[nodiscard]] Json option_table();
/// The words of target, effort and keep.
[[nodiscard]] Json preset_table();
[[nodiscard]] Json energy_table();

}  // namespace temper::wasm
