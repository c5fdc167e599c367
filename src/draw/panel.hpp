// One panel: the layers of a picture from the bottom up, one path for each class of thing.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "draw/viewport.hpp"
#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A panel of a picture, with the data for its caption and the legend.
struct Panel {
  std::string svg;            ///< a <g> element, its origin the upper left corner of the panel
  std::size_t triangles = 0;  ///< of the whole mesh
  std::size_t bad = 0;        ///< of these, not well-centered
  bool dual = false, positive = false, negative = false, rings = false;  ///< drawn at all
  bool too_dense = false;  ///< duals and weights asked for, but left out at this scale
};

/// `number`: of the panel, from 0. `id` names the clip path: unique in the document.
[[nodiscard]] Panel draw_panel(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options,
                               std::size_t number, const std::string& id);

/// Evenly growing lightness, for color-blind readers and gray print: ten of Matplotlib's viridis.
inline constexpr std::array<const char*, 10> kScaleColors = {"#440154", "#482878", "#3e4989", "#31688e", "#26828e",
                                                             "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"};
struct ColorScale {
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< low > high: there is no finite value
  /// Of kScaleColors.
  [[nodiscard]] std::size_t color(double value) const;
};
[[nodiscard]] ColorScale scale_of(const TriangleColors& colors);

/// Colors that differ for color-blind readers and in gray print.
struct Palette {
  static constexpr const char* bad = "#f8c471";
  static constexpr const char* bad_dense = "#e88a00";
  static constexpr const char* primal = "#222222";
  static constexpr const char* primal_dense = "#8a8a8a";
  static constexpr const char* dual = "#005fa3";
  static constexpr const char* positive = "#00845f";
  static constexpr const char* negative = "#c8320a";
  static constexpr const char* ring = "#b0389a";
  static constexpr const char* viewport = "#c8c8c8";
};

}  // namespace temper
