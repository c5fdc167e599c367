// Points in longitude and latitude: the map that is chosen for them, and what is said where none is.
#pragma once

#include <string>

#include "options.hpp"
#include "temper/io.hpp"

namespace temper::app {

/// The library's sentence with the option as it is called here.
[[nodiscard]] std::string spell_projection(std::string message);

/// Failure, with the cure, where the points of an outline are in degrees and no projection is chosen.
void expect_projection_of_outline(const std::string& path, bool geographic, const std::string& projection);

/// The points of a mesh on the map that is chosen, or the sphere; as they are where none is needed. Failure, with the
/// cure, where they are in degrees and none is chosen.
void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection);

}  // namespace temper::app
