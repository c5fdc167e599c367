// The user's own problem −div(K grad u) = f: K on triangles, f at vertices, values on parts of the boundary by name.
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

/// The number for all vertices, or the point data of that name; empty if the text is. Failure if there are none.
[[nodiscard]] std::vector<double> read_source(const Command& command, const std::string& text, const Input& input);

/// Boundary edges with a tag or name, and their value.
struct NamedValue {
  std::string name;
  double value = 0;
  std::vector<std::array<VertexId, 2>> edges;
};
/// The parts of a text NAME=VALUE,…; "boundary" is all of it. Failure if a name is no part of the boundary.
[[nodiscard]] std::vector<NamedValue> read_boundary_values(const Command& command, const std::string& option,
                                                           const std::string& text, const Input& input);

}  // namespace temper::app
