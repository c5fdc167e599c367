// The conventions that the reader and the writer of ADCIRC's fort.14 share.
//
// A boundary is lines of one tag, and its physical name is its kind: "open boundary 2", "land boundary 3, type 20". So
// it survives in all formats that hold names, and comes back to fort.14. The first word of a name decides: open, land
// or island (a land boundary of type 1), then maybe ", type" and the number. So users can name lines "open sea". On
// boundaries with levees (weirs) a row holds
// more numbers. Their nodes are marked points with the same tag: a node, then its partner across the levee.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/conversion/known_arrays.hpp"

namespace temper::io {

inline constexpr std::string_view kAdcircTitle = "adcirc:title";  ///< field data: bytes of the first line
inline constexpr std::string_view kAdcircLevee =
    "adcirc:levee";  ///< of marked points: what follows the node in its row
inline constexpr int kAdcircLeveeNumbers = 6;
/// Line data: how many rows of its string have the first node of the line, how many have the second one, and 0 if the
/// line is none of the string's: it closes an island. A file has them if its strings are other than the writer's own:
/// with the domain on the left, along edges of the boundary, each node in one row.
inline constexpr std::string_view kAdcircRows = "adcirc:rows";
inline constexpr int kAdcircRowNumbers = 3;
inline constexpr std::int32_t kAdcircWall =
    64;  ///< type of vertical element walls: both nodes of a pair are at one place

struct AdcircBoundary {
  bool open = false;
  std::int32_t type = 0;  ///< IBTYPEE or IBTYPE
};

[[nodiscard]] std::string adcirc_boundary_name(const AdcircBoundary& boundary, std::size_t number);
[[nodiscard]] std::optional<AdcircBoundary> adcirc_boundary(std::string_view name);

/// The row of a node by the type of its boundary: whether it has a partner, and how many numbers follow.
struct AdcircRow {
  bool paired = false;
  int numbers = 0;
};
[[nodiscard]] AdcircRow adcirc_row(const AdcircBoundary& boundary);

}  // namespace temper::io
