// --options FILE: options from a JSON object, such as the options of a report.
#pragma once

#include <string>

#include "options/table_options.hpp"

namespace temper::app {

/// Reads the file. Options of the table go into `assignments`, before those that are there. Flags are taken as if the
/// user had given them, unless the user did. Failure names the file and the member that is wrong.
void read_options(Command& command, const std::string& path, Assignments& assignments);

/// The options of a run as the JSON text of such an object: flags and assignments that were given.
[[nodiscard]] std::string options_json(const Command& command, const Assignments& assignments);
/// The options of the table for these cells with their values, as JSON.
[[nodiscard]] std::string options_json(const OptimizeOptions& options, CellKinds cells);

}  // namespace temper::app
