// Polygons of a plane that are no mesh of triangles, such as the cut of a mesh of tetrahedra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "temper/draw.hpp"

namespace temper {

struct ColorScale {
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< low > high: there is no finite value
  bool reversed = false;                                              ///< light for low values
  /// Of kScaleColors.
  [[nodiscard]] std::size_t color(double value) const;
};

struct Section {
  enum class Side : std::uint8_t {
    none,   ///< drawn with the neighbor
    plain,  ///< drawn
    kept,   ///< of the boundary or between regions: drawn thicker
  };
  struct Piece {
    std::vector<Vec2> corners;  ///< two: a line, which is not filled or counted
    std::vector<Side> sides;    ///< side i runs from corner i to the next one
    double margin = 0;
    bool bad = false;
  };
  std::vector<Piece> pieces;
  ColorScale scale;          ///< of the margins
  std::string name = {};     ///< "before", "after" or nothing
  std::string where = {};    ///< "tetrahedra bad at z = 0.5"
  std::string element = {};  ///< "tetrahedron", for the legend
};

/// Draws sections next to each other, as draw_before_after_svg() draws meshes.
[[nodiscard]] std::string draw_sections_svg(std::span<const Section> sections, const DrawOptions& options);

}  // namespace temper
