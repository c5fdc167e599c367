// Data of points and triangles, for optimize and replay: the rules that are given, and what became of the data.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "temper/io.hpp"

namespace temper::app {

/// --point-data, whose words are checked as they come.
void add_point_data(Command& command, std::vector<std::string>& words);

/// The rules of those words, for the data of a file; Failure when it has no array of a name.
[[nodiscard]] io::DataRules data_rules(const std::vector<std::string>& words, const io::MeshFile& file);

/// Lines of `temper optimize`; none where nothing moved that data are on.
[[nodiscard]] std::string data_text(const io::DataReport& report);

}  // namespace temper::app
