// Sizes from files: a size field, or depths of water and a rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/input.hpp"
#include "temper/detail/size.hpp"

namespace temper::app {

/// Depths in the place of sizes: the rules, and the direction of the numbers.
struct DepthRule {
  DepthSizes sizes;
  std::optional<bool> positive_up = {};  ///< none: by the name of the data
};
/// The rule of a text KEY=VALUE,…; Failure, with the keys, if it is none.
[[nodiscard]] DepthRule parse_depth_rule(const std::string& verb, const std::string& text);

/// The size field of a mesh file's point data of that name; without a name, of "size" or of the only data. With a rule
/// the data are depths. Failure when there are no such data, or they are no size everywhere.
struct ReadSizeField {
  SizeField field;
  std::vector<std::string> warnings;  ///< of reading the file
};
[[nodiscard]] ReadSizeField read_size_field(const std::string& path, const std::string& data,
                                            const ReadingOptions& options, const std::optional<DepthRule>& depths = {});

}  // namespace temper::app
