// Points in longitude and latitude: the map that is chosen for them, and what is said where none is.
#pragma once

#include <string>

#include "options.hpp"
#include "temper/io.hpp"

namespace temper::app {

/// The library's sentence with the option as it is called here.
[[nodiscard]] std::string spell_projection(std::string message);

/// Failure, with the cure, where points are in degrees and no projection is chosen.
void expect_projection(const std::string& path, bool geographic, const std::string& projection, bool guessed = false);

/// The points of a file on the map that is chosen; as they are where none is needed.
void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection);

}  // namespace temper::app
