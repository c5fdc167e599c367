// Sizes, for optimize: the field that is given in a file, and what a run did to the sizes, for people.
#pragma once

#include <string>
#include <vector>

#include "input.hpp"
#include "temper/optimize.hpp"
#include "temper/size.hpp"

namespace temper::app {

/// The size field of a mesh file's point data of that name; Failure when there is none, or it is no size everywhere.
struct ReadSizeField {
  SizeField field;
  std::vector<std::string> warnings;  ///< of reading the file
};
[[nodiscard]] ReadSizeField read_size_field(const std::string& path, const std::string& data,
                                            const ReadingOptions& options);

/// Rows of the table of `temper optimize`, below those of comparison_text.
[[nodiscard]] std::string size_text(const SizeChange& size);

}  // namespace temper::app
