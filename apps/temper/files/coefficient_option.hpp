// A coefficient K of −div(K grad u), constant on each triangle: data of the mesh file, or a value for each region.
#pragma once

#include <string>
#include <vector>

#include "files/input.hpp"
#include "help/command.hpp"

namespace temper::app {

/// Adds --coefficient.
void add_coefficient(Command& command, std::string& target);

/// The coefficient of each triangle; empty if the text is. Failure if the file has no such data, or if a region has no
/// value or is not in the file.
[[nodiscard]] std::vector<double> read_coefficient(const Command& command, const std::string& text, const Input& input);

}  // namespace temper::app
