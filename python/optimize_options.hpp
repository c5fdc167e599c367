// Conversion of OptimizeOptions from and to Python dictionaries, by the library's table of options.
#pragma once

#include "convert.hpp"
#include "temper/detail/optimize_table.hpp"

TEMPER_PYTHON_NAMES(temper::HiddenPolicy, "undo", "remove", "keep");

namespace temper::python {

/// The options, with changes from the dictionary.
OptimizeOptions options_from(const py::dict& dict);
py::dict options_to_dict(const OptimizeOptions& options);
/// One dictionary per row.
py::list option_table();
/// Sentences about the named options that differ from the default and have no effect.
py::list idle_options(const py::dict& options, const py::list& names);

}  // namespace temper::python
