// Sizes from files: a size field, or depths of water and a rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/input.hpp"
#include "temper/detail/size.hpp"

namespace temper::app {

/// A rule that makes sizes from depths. It also says whether the numbers are depths or heights.
struct DepthRule {
  DepthSizes sizes;
  std::optional<io::Positive> positive = {};  ///< none: by the name of the data
};
/// The rule of a text KEY=VALUE,…. Failure if a key or value is wrong; it names the keys.
[[nodiscard]] DepthRule parse_depth_rule(const std::string& verb, const std::string& text);

/// The size field of the point data `data` of a mesh file. If `data` is empty, they are "size", or the only ones. With
/// a rule, they are depths. Failure if there are no such data, or if a point has no size.
struct ReadSizeField {
  SizeField field;
  std::vector<std::string> warnings;  ///< of reading the file
};
[[nodiscard]] ReadSizeField read_size_field(const Input& input, const std::string& data,
                                            const std::optional<DepthRule>& depths = {});

}  // namespace temper::app
