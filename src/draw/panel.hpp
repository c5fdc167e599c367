// One panel: the layers of a picture from the bottom up, one path for each class of thing.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "draw/section.hpp"
#include "draw/viewport.hpp"
#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A panel of a picture, with the data for its caption and the legend.
struct Panel {
  std::string svg;           ///< a <g> element, its origin the upper left corner of the panel
  std::size_t elements = 0;  ///< of the whole mesh, or pieces of a section
  std::size_t bad = 0;       ///< of these, not well-centered
  // Drawn at all:
  bool dual = false, negative_dual = false, positive = false, negative = false, rings = false, faces = false;
  bool fixed = false;
};

/// `number`: of the panel, from 0. `id` names the clip path: unique in the document.
[[nodiscard]] Panel draw_panel(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options,
                               std::size_t number, const std::string& id);
[[nodiscard]] Panel draw_panel(const Section& section, const Viewport& viewport, const DrawOptions& options,
                               const std::string& id);

/// From blue to yellow with growing lightness, for color-blind readers and gray print; light, so that all lines stand
/// out.
inline constexpr std::array<const char*, 10> kScaleColors = {"#7690c8", "#8ba1cc", "#9fb3d0", "#b3c5d3", "#c6d7d6",
                                                             "#d5e2d2", "#e1e6c6", "#eceaba", "#f6eead", "#fff2a0"};
[[nodiscard]] ColorScale scale_of(const TriangleColors& colors);
/// The colors of regions, by turns. They are light, so that lines stand out. Color-blind readers can tell them apart.
inline constexpr std::array<const char*, 8> kRegionColors = {"#f3e3b3", "#b5cfe8", "#c3e0b4", "#efc0ad",
                                                             "#d5c6e8", "#f5cf8f", "#b3dcd8", "#d9d9d9"};
/// The regions of the cells of all panels, ascending.
[[nodiscard]] std::vector<std::int32_t> regions_of(const RegionCells& cells);
/// Of margins, in every picture: an equilateral triangle without weights has 0.289.
inline constexpr ColorScale kMargins = {0, 0.3};

/// One warning color, for what a solver cannot use. A hatching or dashes say the same without color.
struct Palette {
  static constexpr const char* warning = "#c83a00";
  static constexpr const char* primal = "#6b7280";
  static constexpr const char* outline = "#1d232b";
  static constexpr const char* dual = "#084f9c";
  static constexpr const char* positive = "#00866b";
  static constexpr const char* negative = "#9a4f96";
  static constexpr const char* outside = "#e7e9ec";  ///< the globe where it has no mesh
  static constexpr const char* frame = "#c8c8c8";
};

/// The hatching of bad triangles, and a reference to it, for coordinates of which one pixel has so many.
[[nodiscard]] std::string hatching(const Viewport& viewport, double per_pixel);
[[nodiscard]] std::string hatched(const Viewport& viewport, double per_pixel);

}  // namespace temper
