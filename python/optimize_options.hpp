// OptimizeOptions from and to dictionaries of Python's, by the library's table of options.
#pragma once

#include "convert.hpp"
#include "temper/detail/optimize_table.hpp"

TEMPER_PYTHON_NAMES(temper::HiddenPolicy, "undo", "remove", "keep");

namespace temper::python {

/// The options, with those that the dictionary names.
OptimizeOptions options_from(const py::dict& dict);
py::dict options_to_dict(const OptimizeOptions& options);
/// One dictionary a row.
py::list option_table();
/// Of the options named, those that are not as usual and have no effect, in sentences.
py::list idle_options(const py::dict& options, const py::list& names);

py::dict report_to_dict(const OptimizeReport& report);
py::dict record_to_dict(const SweepRecord& record);
py::dict size_report_to_dict(const SizeReport& report);

}  // namespace temper::python
