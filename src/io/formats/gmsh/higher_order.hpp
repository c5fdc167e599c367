// Types of elements in Gmsh files. Elements of higher order are read as linear ones: their corners come first.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/format.hpp"

namespace temper::io {

struct GmshElementType {
  std::int32_t type, linear;
  std::int32_t others = 0;  ///< nodes after the corners
};
[[nodiscard]] GmshElementType gmsh_element_type(std::int32_t type);
/// The dimension of a type that is read; 2 for others.
[[nodiscard]] std::int32_t gmsh_dimension(std::int32_t type);
/// The name of a type that is not read, for messages.
[[nodiscard]] std::string gmsh_element_name(std::int32_t type);

/// Drops the nodes that are between corners, unless they are corners of other elements, and warns of it.
void drop_nodes_between_corners(Document& document, const std::vector<bool>& between);

}  // namespace temper::io
