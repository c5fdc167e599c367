// Drawings of single triangles with their weights and duals, in rows and columns: figs. 4 and 9.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/single_triangle.hpp"

namespace temper::gallery {

inline constexpr const char *kInk = "#222222", *kDual = "#005fa3", *kPositive = "#00845f", *kNegative = "#c8320a";

struct TriangleRow {
  std::string label;                          ///< of the row
  std::vector<std::optional<Corners>> cells;  ///< nothing: no solution there
  std::vector<std::string> captions = {};     ///< under each cell, may be empty
};

struct TriangleTable {
  std::string title;
  std::vector<std::string> columns;  ///< labels above; may be empty
  std::vector<TriangleRow> rows;
  Vec2 low = {-0.8, -0.6}, high = {1.2, 0.9};  ///< what each cell shows; the rest is cut off
  double cell_width = 110;                     ///< pixels
};

/// "d_{ij} and more" as what an SVG text holds: the part in braces lowered.
[[nodiscard]] std::string subscripted(const std::string& text);

/// Triangles black, duals blue from the orthocenter to each edge's line (dashed where they miss the edge), circles of
/// radius √|w|: green for positive weights, red and dashed for negative ones.
[[nodiscard]] std::string triangle_table_svg(const TriangleTable& table);

}  // namespace temper::gallery
