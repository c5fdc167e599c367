// What the reader and the writer of Selafin share.
//
// Records of Fortran: their length in bytes, the bytes, the length again. Numbers are big-endian, and little-endian in
// some files that are read. Real numbers have 4 bytes (SERAFIN) or 8 (SERAFIND).
//
//   title, format                   72 and 8 characters
//   n, 0                            the number of variables
//   name, unit                      16 characters each: a record for each variable
//   ten integers                    the 3rd and 4th are the origin of x and y, the 7th is the number of planes,
//                                   and if the 10th is 1, the next record is a date of six integers
//   triangles, points, 3, 1
//   corners                         counted from 1
//   numbers of boundary points      in their order along the boundary, or 0
//   x; y
//   time; values of each variable   for each time step
//
// A variable is an array of point data with one component for each time step. BOTTOM or FOND is the bed, positive up,
// if it is the same in all time steps. (TELEMAC-2D user manual, appendix "Selafin format".)
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/formats/boundary_codes.hpp"

namespace temper::io {

inline constexpr std::size_t kSelafinNameBytes = 16, kSelafinTitleBytes = 72;

// Field data. The time has the precision of the file, and is left out if it is a single 0 of 4 bytes.
inline constexpr std::string_view kSelafinTitle = "selafin:title";    ///< bytes
inline constexpr std::string_view kSelafinDate = "selafin:date";      ///< six integers
inline constexpr std::string_view kSelafinOrigin = "selafin:origin";  ///< two integers
inline constexpr std::string_view kSelafinBed = "selafin:bed";  ///< bytes: the name of the bed, unless "BOTTOM [M]"
inline constexpr std::string_view kSelafinTime = "selafin:time";
inline constexpr std::string_view kSelafinBottom = "BOTTOM [M]";

/// The numbers of the boundary file (.cli) after the three codes, as data of marked points.
inline constexpr std::string_view kSelafinBoundary = "selafin:boundary";
inline constexpr int kSelafinBoundaryNumbers = 8;

/// "BOTTOM [M]", from a name and a unit of 16 characters each; all 32 characters if they would not come back from it.
[[nodiscard]] std::string selafin_name(std::string_view record);
/// The 32 characters; a name or unit that is too long is cut.
[[nodiscard]] std::string selafin_record(std::string_view name);

/// m.cli of m.slf, and m.cli.cli of m.cli
[[nodiscard]] std::string selafin_boundary_path(const std::string& path);
/// Takes codes and numbers of the nodes from the boundary file, if it exists.
void read_selafin_boundary(Document& document);
/// Writes the boundary file. `nodes`: those of the boundary, in their order.
void write_selafin_boundary(const WriteJob& job, const std::set<DirectedEdge>& edges, const NodeString& nodes);

}  // namespace temper::io
