// Physical names where a format has only text for them: lines "dimension tag name".
#pragma once

#include <string>
#include <vector>

#include "io/scanner.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The rest of the line.
inline PhysicalName read_physical_name(Scanner& scanner) {
  PhysicalName name;
  name.dimension = scanner.integer("the dimension of a physical name");
  name.tag = scanner.integer("the tag of a physical name");
  name.name = scanner.rest_of_line();
  return name;
}

/// Reads a name from each line of a text, and appends them to `names`.
inline void read_physical_names(Scanner& scanner, std::vector<PhysicalName>& names) {
  while (!scanner.at_end()) names.push_back(read_physical_name(scanner));
}

/// The line of a name, without its end.
inline std::string line_of(const PhysicalName& name) { return text(name.dimension, " ", name.tag, " ", name.name); }

inline std::string lines_of(const std::vector<PhysicalName>& names) {
  std::string all;
  for (const PhysicalName& name : names) all += line_of(name) + "\n";
  return all;
}

}  // namespace temper::io
